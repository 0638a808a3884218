// The light as casters see it, as face_light.rs tells it, in world offsets from the origin of the light frame: what it sends through a
// corner, how far it is from a caster, and which planes separate the two. f32, with bounds on its rounding. Joined after
// light_frame.wgsl; reads `light_body`, which light_bound.wgsl wrote.
@group(0) @binding(3) var<storage, read> light_body: array<f32>;

// A product of a point with a normal errs by this share of the sizes of both.
const ERROR: f32 = 1e-6;
// Rounding of a view-sample's direction and of what it is compared with, as a share of 1 + |u| + |v|.
const SLACK: f32 = 4e-6;
// Slack beyond which a plane is left out.
const BLUNT: f32 = 1e-2;
// Planes that bound nothing fill the rest.
const PLANES: u32 = 8u;

fn body_vector(word: u32) -> vec3<f32> {
    return vec3<f32>(light_body[word], light_body[word + 1u], light_body[word + 2u]);
}

fn body_is_flat() -> bool {
    return light_body[0] > 0.5;
}

fn body_centre() -> vec3<f32> {
    return body_vector(1u);
}

fn body_thickness() -> f32 {
    return light_body[13];
}

fn body_reach() -> f32 {
    return light_body[14];
}

fn body_sides() -> u32 {
    return u32(light_body[15]);
}

fn body_corner(k: u32) -> vec3<f32> {
    return body_vector(28u + 3u * k);
}

fn sum_of_sizes(a: vec3<f32>) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

// To where the solid is the unit ball, and a normal back from there.
fn to_ball(offset: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(dot(body_vector(16u), offset), dot(body_vector(19u), offset), dot(body_vector(22u), offset));
}

fn from_ball(normal: vec3<f32>) -> vec3<f32> {
    return normal.x * body_vector(16u) + normal.y * body_vector(19u) + normal.z * body_vector(22u);
}

// The largest product with `normal` over the body.
fn body_most(normal: vec3<f32>) -> f32 {
    if !body_is_flat() {
        let along = vec3<f32>(
            dot(normal, body_vector(4u)), dot(normal, body_vector(7u)), dot(normal, body_vector(10u)));
        return dot(normal, body_centre()) + length(along);
    }
    var most = -3e38;
    for (var k = 0u; k < body_sides(); k++) {
        most = max(most, dot(normal, body_corner(k)));
    }
    return most + body_thickness() * length(normal) * 1.00001;
}

// Two unit vectors across a unit vector and each other.
struct Across {
    x: vec3<f32>,
    y: vec3<f32>,
}

fn across(axis: vec3<f32>) -> Across {
    let size = abs(axis);
    var unit = vec3<f32>(0.0, 0.0, 1.0);
    if size.x <= size.y && size.x <= size.z {
        unit = vec3<f32>(1.0, 0.0, 0.0);
    } else if size.y <= size.z {
        unit = vec3<f32>(0.0, 1.0, 0.0);
    }
    let x = normalize(cross(axis, unit));
    return Across(x, cross(axis, x));
}

// Where view-samples behind `corner` are, seen from the body: directions, by how much each may be off, none where it touches.
struct Directions {
    ray: array<vec3<f32>, 8>,
    stray: f32,
    any: bool,
}

fn directions_through(corner: vec3<f32>) -> Directions {
    var result: Directions;
    result.any = true;
    let sides = body_sides();
    if body_is_flat() {
        for (var k = 0u; k < sides; k++) {
            result.ray[k] = corner - body_corner(k);
        }
        result.stray = ERROR * (sum_of_sizes(corner) + body_reach()) + body_thickness();
        return result;
    }
    let offset = corner - body_centre();
    let at = to_ball(offset);
    // How far rounding may have moved `at`.
    let sizes = vec3<f32>(
        sum_of_sizes(body_vector(16u)), sum_of_sizes(body_vector(19u)), sum_of_sizes(body_vector(22u)));
    let strayed = ERROR * max(sizes.x, max(sizes.y, sizes.z)) * (sum_of_sizes(corner) + body_reach());
    let away = length(at) - 3.0 * strayed;
    if away < 1.01 {
        result.any = false;
        return result;
    }
    let axis = normalize(at);
    let cone = inverseSqrt(away * away - 1.0);
    let tangent = cone + 3.0 * (1.0 + cone * cone) * (strayed / away + ERROR);
    let turn = across(axis);
    var far = 0.0;
    for (var k = 0u; k < sides; k++) {
        let ring = tangent * vec2<f32>(light_body[52u + 2u * k], light_body[53u + 2u * k]);
        let ray = axis + ring.x * turn.x + ring.y * turn.y;
        result.ray[k] = ray.x * body_vector(4u) + ray.y * body_vector(7u) + ray.z * body_vector(10u);
        far = max(far, abs(ray.x) * sum_of_sizes(body_vector(4u)) + abs(ray.y) * sum_of_sizes(body_vector(7u))
            + abs(ray.z) * sum_of_sizes(body_vector(10u)));
    }
    result.stray = 2.0 * ERROR * far;
    return result;
}

// Corners from the origin, and planes that separate the caster from the body.
struct Caster {
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    // Largest sum of sizes of these and of the body.
    far: f32,
    // dot(xyz, view-sample) >= w, but for `blunt` times the sum of its sizes.
    planes: array<vec4<f32>, PLANES>,
    blunt: array<f32, PLANES>,
    casts: bool,
}

// Smallest product with `normal` over the caster and largest over the body, both on the safe side.
fn margin(caster: ptr<function, Caster>, normal: vec3<f32>) -> vec2<f32> {
    let room = ERROR * (*caster).far * sum_of_sizes(normal);
    let least = min(dot(normal, (*caster).a), min(dot(normal, (*caster).b), dot(normal, (*caster).c)));
    return vec2<f32>(least - room, max(body_most(normal) + room, 0.0));
}

// The point of a triangle nearest to the origin, but for rounding.
fn nearest_to_origin(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec3<f32> {
    let normal = cross(b - a, c - a);
    let square = dot(normal, normal);
    let inside = vec3<f32>(dot(cross(a, b), normal), dot(cross(b, c), normal), dot(cross(c, a), normal));
    if square > 1e-30 && all(inside >= vec3<f32>(0.0)) {
        return normal * (dot(normal, a) / square);
    }
    let on = array<vec3<f32>, 3>(nearest_on(a, b), nearest_on(b, c), nearest_on(c, a));
    var nearest = on[0];
    if dot(on[1], on[1]) < dot(nearest, nearest) {
        nearest = on[1];
    }
    if dot(on[2], on[2]) < dot(nearest, nearest) {
        nearest = on[2];
    }
    return nearest;
}

fn nearest_on(p: vec3<f32>, q: vec3<f32>) -> vec3<f32> {
    let edge = q - p;
    let square = dot(edge, edge);
    return p + edge * select(0.0, clamp(-dot(p, edge) / square, 0.0, 1.0), square > 0.0);
}

// Distance of the caster and the body, at most; not above zero where they may touch.
fn gap_of(caster: ptr<function, Caster>, normal: vec3<f32>) -> f32 {
    let centre = body_centre();
    let a = (*caster).a - centre;
    let b = (*caster).b - centre;
    let c = (*caster).c - centre;
    var towards: vec3<f32>;
    if body_is_flat() {
        towards = nearest_to_origin(a, b, c);
    } else {
        // The nearest point of the scaled caster, and its normal taken back.
        towards = from_ball(nearest_to_origin(to_ball(a), to_ball(b), to_ball(c)));
    }
    let flat = body_vector(25u);
    var tried = array<vec3<f32>, 5>(towards, normal, -normal, flat, -flat);
    var gap = -1.0;
    for (var k = 0u; k < 5u; k++) {
        let size = sum_of_sizes(tried[k]);
        if size > 1e-30 && size < 1e30 {
            let ends = margin(caster, tried[k] / size);
            gap = max(gap, (ends.x - ends.y) / length(tried[k] / size));
        }
    }
    return gap;
}

// Sets plane `k` to that of `normal`, where it bounds something.
fn set_plane(caster: ptr<function, Caster>, k: u32, normal: vec3<f32>, gap: f32) {
    let size = sum_of_sizes(normal);
    if !(size > 1e-30 && size < 1e30) {
        return;
    }
    let n = normal / size;
    let ends = margin(caster, n);
    let blunt = max(ends.y - ends.x, 0.0) / gap;
    let depth = select(ends.x, ends.y - body_reach() * blunt, ends.x < ends.y);
    if blunt < BLUNT && depth >= 0.0 {
        (*caster).planes[k] = vec4<f32>(n, depth);
        (*caster).blunt[k] = blunt;
    }
}

fn turn_of(p: vec2<f32>, q: vec2<f32>) -> f32 {
    return p.x * q.y - p.y * q.x;
}

// Sets planes `k` and `k` + 1 to those through an edge that touch the body.
fn set_edge_planes(caster: ptr<function, Caster>, k: u32, a: vec3<f32>, b: vec3<f32>, gap: f32) {
    if !body_is_flat() {
        let offset = to_ball(a - body_centre());
        let edge = to_ball(b - a);
        let square = dot(edge, edge);
        if !(square > 1e-30) {
            return;
        }
        let foot = offset - edge * (dot(offset, edge) / square);
        let away = length(foot);
        if away > 1.0 {
            let unit = foot / away;
            let aside = normalize(cross(edge, unit));
            let sin = sqrt(max(1.0 - 1.0 / (away * away), 0.0));
            set_plane(caster, k, from_ball(unit / away + sin * aside), gap);
            set_plane(caster, k + 1u, from_ball(unit / away - sin * aside), gap);
        }
        return;
    }
    let edge = b - a;
    let long = length(edge);
    if !(long > 1e-30) {
        return;
    }
    // Around the edge the corners are directions of the plane; the outermost ones touch.
    let plane = across(edge / long);
    let first = body_corner(0u) - a;
    var left = vec2<f32>(dot(plane.x, first), dot(plane.y, first));
    var right = left;
    for (var corner = 1u; corner < body_sides(); corner++) {
        let other = body_corner(corner) - a;
        let here = vec2<f32>(dot(plane.x, other), dot(plane.y, other));
        left = select(left, here, turn_of(left, here) > 0.0);
        right = select(right, here, turn_of(right, here) < 0.0);
    }
    set_plane(caster, k, left.x * plane.y - left.y * plane.x, gap);
    set_plane(caster, k + 1u, right.y * plane.x - right.x * plane.y, gap);
}

// The caster with corners at `a`, `b`, `c` from the origin; `cut`: with its own plane, `edges`: with those through its edges.
fn caster_at(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, cut: bool, edges: bool) -> Caster {
    var caster: Caster;
    caster.a = a;
    caster.b = b;
    caster.c = c;
    caster.casts = !(all(a == b) || all(b == c) || all(c == a));
    caster.far = max(body_reach(), max(sum_of_sizes(a), max(sum_of_sizes(b), sum_of_sizes(c))));
    for (var k = 0u; k < PLANES; k++) {
        caster.planes[k] = vec4<f32>(0.0);
        caster.blunt[k] = 0.0;
    }
    let normal = cross(b - a, c - a);
    let gap = gap_of(&caster, normal);
    if gap > 0.0 {
        if cut {
            set_plane(&caster, 0u, select(normal, -normal, dot(normal, a) < 0.0), gap);
        }
        if edges {
            set_edge_planes(&caster, 1u, a, b, gap);
            set_edge_planes(&caster, 3u, b, c, gap);
            set_edge_planes(&caster, 5u, c, a, gap);
        }
    }
    return caster;
}
