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

// The body as each invocation keeps it: reading it from memory for every product is dear.
struct Body {
    flat: bool,
    sides: u32,
    thickness: f32,
    // Largest sum of sizes.
    reach: f32,
    centre: vec3<f32>,
    // Half axes of a solid, and rows of the map that takes it to the unit ball.
    axes: mat3x3<f32>,
    rows: mat3x3<f32>,
    flat_normal: vec3<f32>,
    // Corners of a flat one, four in each; the first fills the rest.
    x: array<vec4<f32>, 2>,
    y: array<vec4<f32>, 2>,
    z: array<vec4<f32>, 2>,
}
var<private> body: Body;

fn body_vector(word: u32) -> vec3<f32> {
    return vec3<f32>(light_body[word], light_body[word + 1u], light_body[word + 2u]);
}

fn body_matrix(word: u32) -> mat3x3<f32> {
    return mat3x3<f32>(body_vector(word), body_vector(word + 3u), body_vector(word + 6u));
}

fn body_corner(k: u32) -> vec3<f32> {
    return body_vector(28u + 3u * select(0u, k, k < body.sides));
}

fn load_body() {
    body.flat = light_body[0] > 0.5;
    body.sides = u32(light_body[15]);
    body.thickness = light_body[13];
    body.reach = light_body[14];
    body.centre = body_vector(1u);
    body.axes = body_matrix(4u);
    body.rows = body_matrix(16u);
    body.flat_normal = body_vector(25u);
    for (var four = 0u; four < 2u; four++) {
        let a = body_corner(4u * four);
        let b = body_corner(4u * four + 1u);
        let c = body_corner(4u * four + 2u);
        let d = body_corner(4u * four + 3u);
        body.x[four] = vec4<f32>(a.x, b.x, c.x, d.x);
        body.y[four] = vec4<f32>(a.y, b.y, c.y, d.y);
        body.z[four] = vec4<f32>(a.z, b.z, c.z, d.z);
    }
}

fn sum_of_sizes(a: vec3<f32>) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

// The largest product with `normal` over the body.
fn body_most(normal: vec3<f32>) -> f32 {
    if !body.flat {
        return dot(normal, body.centre) + length(normal * body.axes);
    }
    let low = normal.x * body.x[0] + normal.y * body.y[0] + normal.z * body.z[0];
    let high = normal.x * body.x[1] + normal.y * body.y[1] + normal.z * body.z[1];
    let most = max(low, high);
    return max(max(most.x, most.y), max(most.z, most.w)) + body.thickness * length(normal) * 1.00001;
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

// Where view-samples behind a corner are, seen from the body: the directions of a cone.
struct Cone {
    corner: vec3<f32>,
    axis: vec3<f32>,
    x: vec3<f32>,
    y: vec3<f32>,
    // How far each direction may be off.
    stray: f32,
    // Whether the corner is clear of the body.
    any: bool,
}

fn cone_through(corner: vec3<f32>) -> Cone {
    var cone: Cone;
    cone.corner = corner;
    cone.any = true;
    if body.flat {
        cone.stray = ERROR * (sum_of_sizes(corner) + body.reach) + body.thickness;
        return cone;
    }
    let at = (corner - body.centre) * body.rows;
    // How far rounding may have moved `at`.
    let sizes = max(sum_of_sizes(body.rows[0]), max(sum_of_sizes(body.rows[1]), sum_of_sizes(body.rows[2])));
    let strayed = ERROR * sizes * (sum_of_sizes(corner) + body.reach);
    let away = length(at) - 3.0 * strayed;
    cone.any = away >= 1.01;
    let axis = normalize(at);
    let slope = inverseSqrt(max(away * away, 1.02) - 1.0);
    let tangent = slope + 3.0 * (1.0 + slope * slope) * (strayed / away + ERROR);
    let turn = across(axis);
    cone.axis = body.axes * axis;
    cone.x = body.axes * (tangent * turn.x);
    cone.y = body.axes * (tangent * turn.y);
    let far = sum_of_sizes(body.axes[0]) + sum_of_sizes(body.axes[1]) + sum_of_sizes(body.axes[2]);
    cone.stray = 4.0 * ERROR * far * (1.0 + 2.0 * tangent);
    return cone;
}

// Direction `k`, to the polygon's corner with that number.
fn cone_ray(cone: Cone, k: u32) -> vec3<f32> {
    if body.flat {
        return cone.corner - body_corner(k);
    }
    return cone.axis + light_body[52u + 2u * k] * cone.x + light_body[53u + 2u * k] * cone.y;
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
    var a = (*caster).a - body.centre;
    var b = (*caster).b - body.centre;
    var c = (*caster).c - body.centre;
    // The caster's own plane, and the light's; and the way to the nearest point, of the scaled caster where the body is solid.
    var tried = array<vec3<f32>, 3>(
        select(normal, -normal, dot(normal, a) < 0.0),
        select(body.flat_normal, -body.flat_normal, dot(body.flat_normal, a) < 0.0),
        vec3<f32>(0.0),
    );
    if !body.flat {
        a = a * body.rows;
        b = b * body.rows;
        c = c * body.rows;
    }
    let nearest = nearest_to_origin(a, b, c);
    tried[2] = nearest;
    if !body.flat {
        tried[2] = body.rows * nearest;
    }
    var gap = -1.0;
    // One call in a loop, because compilers copy what is called into every place.
    for (var k = 0u; k < 3u; k++) {
        let size = sum_of_sizes(tried[k]);
        if size > 1e-30 && size < 1e30 {
            let n = tried[k] / size;
            let ends = margin(caster, n);
            gap = max(gap, (ends.x - ends.y) / length(n));
        }
    }
    return gap;
}

fn turn_of(p: vec2<f32>, q: vec2<f32>) -> f32 {
    return p.x * q.y - p.y * q.x;
}

// Normals of the two planes through an edge that touch the body; zero where there are none.
struct Pair {
    one: vec3<f32>,
    other: vec3<f32>,
}

fn edge_normals(a: vec3<f32>, b: vec3<f32>) -> Pair {
    let none = Pair(vec3<f32>(0.0), vec3<f32>(0.0));
    if !body.flat {
        let offset = (a - body.centre) * body.rows;
        let edge = (b - a) * body.rows;
        let square = dot(edge, edge);
        let foot = offset - edge * (dot(offset, edge) / square);
        let away = length(foot);
        if !(square > 1e-30 && away > 1.0) {
            return none;
        }
        let unit = foot / away;
        let aside = normalize(cross(edge, unit)) * sqrt(max(1.0 - 1.0 / (away * away), 0.0));
        return Pair(body.rows * (unit / away + aside), body.rows * (unit / away - aside));
    }
    let edge = b - a;
    let long = length(edge);
    if !(long > 1e-30) {
        return none;
    }
    // Around the edge the corners are directions of the plane; the outermost ones touch.
    let plane = across(edge / long);
    let first = body_corner(0u) - a;
    var left = vec2<f32>(dot(plane.x, first), dot(plane.y, first));
    var right = left;
    for (var corner = 1u; corner < body.sides; corner++) {
        let offset = body_corner(corner) - a;
        let here = vec2<f32>(dot(plane.x, offset), dot(plane.y, offset));
        left = select(left, here, turn_of(left, here) > 0.0);
        right = select(right, here, turn_of(right, here) < 0.0);
    }
    return Pair(left.x * plane.y - left.y * plane.x, right.y * plane.x - right.x * plane.y);
}

// Sets the planes: the caster's own where `cut` says so, those through its edges where `edges` does.
fn set_planes(caster: ptr<function, Caster>, cut: bool, edges: bool) {
    var corners = array<vec3<f32>, 4>((*caster).a, (*caster).b, (*caster).c, (*caster).a);
    let normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    let gap = gap_of(caster, normal);
    if gap <= 0.0 {
        return;
    }
    var normals: array<vec3<f32>, PLANES>;
    let own = select(normal, -normal, dot(normal, corners[0]) < 0.0);
    normals[0] = select(vec3<f32>(0.0), own, cut);
    for (var k = 0u; k < select(0u, 3u, edges); k++) {
        let two = edge_normals(corners[k], corners[k + 1u]);
        normals[2u * k + 1u] = two.one;
        normals[2u * k + 2u] = two.other;
    }
    for (var k = 0u; k < PLANES; k++) {
        let size = sum_of_sizes(normals[k]);
        if !(size > 1e-30 && size < 1e30) {
            continue;
        }
        let n = normals[k] / size;
        let ends = margin(caster, n);
        let blunt = max(ends.y - ends.x, 0.0) / gap;
        let depth = select(ends.x, ends.y - body.reach * blunt, ends.x < ends.y);
        if blunt < BLUNT && depth >= 0.0 {
            (*caster).planes[k] = vec4<f32>(n, depth);
            (*caster).blunt[k] = blunt;
        }
    }
}

// The caster with corners at `a`, `b`, `c` from the origin.
fn caster_at(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, cut: bool, edges: bool) -> Caster {
    load_body();
    var caster: Caster;
    caster.a = a;
    caster.b = b;
    caster.c = c;
    caster.casts = !(all(a == b) || all(b == c) || all(c == a));
    caster.far = max(body.reach, max(sum_of_sizes(a), max(sum_of_sizes(b), sum_of_sizes(c))));
    for (var k = 0u; k < PLANES; k++) {
        caster.planes[k] = vec4<f32>(0.0);
        caster.blunt[k] = 0.0;
    }
    set_planes(&caster, cut, edges);
    return caster;
}
