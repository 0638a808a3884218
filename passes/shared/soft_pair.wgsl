// A caster as one view-sample sees it, in f32 with bounds on its rounding: what view_planes.rs does in f64. Joined after predicate.wgsl
// and pyramid.wgsl, of which it takes `plane_through` and `sum_of_sizes`.

// The whole light.
struct Light {
    middle: vec3<f32>,
    half: vec3<f32>,
    // Sum of the half extents.
    reach: f32,
    // Largest distance from the middle.
    radius: f32,
}

// Half the range of n . s over the light, rounded up: over its box, or over the ball around it where that is less.
fn spread_of(normal: vec3<f32>, light: Light) -> f32 {
    return min(dot(abs(normal), light.half), length(normal) * light.radius) * 1.000002;
}

// A view-sample, and the plane of the triangle it lies on.
struct Receiver {
    place: vec3<f32>,
    own: u32,
    to_light: vec3<f32>,
    // Normal of the own plane; w: times the sum of |offset| from `base`, how far rounding can move a height.
    plane: vec4<f32>,
    base: vec3<f32>,
    // Axes along which the own triangle has no extent: a corner level with it there is exactly in the plane.
    flat: vec3<bool>,
    // Side of the own plane that all of the light is on, -1 or 1; 0: on both, or rounding hides it.
    light_side: f32,
    has_plane: bool,
}

const NOTHING: u32 = 0u;
const ALL: u32 = 1u;
const WITHIN: u32 = 2u;

// Planes of a pair: the first three through the view-sample and the edges, the last the supporting plane.
struct Pair {
    kind: u32,
    // 1 or -1 times a plane's value is above zero inside; 0: rounding hides it.
    winding: f32,
    // Whether a plane may cut the light's box.
    cut: vec4<bool>,
    // Normals, values at the light's middle, and how far rounding can move a value anywhere in the light's box.
    normals: array<vec3<f32>, 4>,
    value: vec4<f32>,
    slack: vec4<f32>,
}

fn receiver_of(place: vec3<f32>, own: u32, light: Light) -> Receiver {
    var receiver: Receiver;
    receiver.place = place;
    receiver.own = own;
    receiver.to_light = light.middle - place;
    receiver.has_plane = false;
    if own < arrayLength(&triangles) / 9u {
        let a = triangle_corner(own, 0u);
        let b = triangle_corner(own, 1u);
        let c = triangle_corner(own, 2u);
        receiver.has_plane = !is_collapsed(a, b, c);
        receiver.base = a;
        receiver.plane = plane_through(b - a, c - a);
        receiver.flat = (a == b) & (b == c);
        let offset = light.middle - a;
        let height = dot(receiver.plane.xyz, offset);
        let slack = receiver.plane.w * (sum_of_sizes(offset) + light.reach);
        receiver.light_side = select(0.0, sign(height), abs(height) > spread_of(receiver.plane.xyz, light) + slack);
    }
    return receiver;
}

fn bits_of(is: vec4<bool>) -> u32 {
    let bits = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), is);
    return bits.x | bits.y | bits.z | bits.w;
}

// Whether a corner surely lies below, and surely above the own plane; and whether it may.
fn sides_of_corner(receiver: Receiver, corner: vec3<f32>) -> vec4<bool> {
    let offset = corner - receiver.base;
    let height = dot(receiver.plane.xyz, offset);
    let slack = receiver.plane.w * sum_of_sizes(offset);
    let is_level = any(receiver.flat & (offset == vec3<f32>(0.0))) || all(offset == vec3<f32>(0.0));
    let sure = vec2<bool>((height < -slack), (height > slack));
    let may = vec2<bool>((height < slack), (height > -slack));
    return select(vec4<bool>(sure, may), vec4<bool>(false), is_level);
}

// What the coplanar rule says of a caster: ALL or NOTHING for the whole light, or WITHIN: light sample by light sample.
fn admitted(receiver: Receiver, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> u32 {
    if !receiver.has_plane {
        return ALL;
    }
    let sides = sides_of_corner(receiver, a) | sides_of_corner(receiver, b) | sides_of_corner(receiver, c);
    let is_above = receiver.light_side > 0.0;
    let sure = select(sides.x, sides.y, is_above);
    let may = select(sides.z, sides.w, is_above);
    let both = select(select(NOTHING, WITHIN, sides.z || sides.w), ALL, sides.x && sides.y);
    return select(select(select(NOTHING, WITHIN, may), ALL, sure), both, receiver.light_side == 0.0);
}

// How much further than the ball's radius a plane beside it passes.
const BESIDE: f32 = 1e-5;

// Whether a plane through the view-sample, close to the ball around the light, has the corners beyond it: `is_beside` of view_planes.rs.
// Both sides are asked, so any normal would do.
fn is_beside(p: vec3<f32>, q: vec3<f32>, r: vec3<f32>, receiver: Receiver, light: Light) -> bool {
    let distance = length(receiver.to_light);
    let axis = receiver.to_light / select(1.0, distance, distance > 0.0);
    let tilt = light.radius * (1.0 + BESIDE) / select(1.0, distance, distance > 0.0) + BESIDE;
    let middle = p + q + r;
    let across = middle - axis * dot(middle, axis);
    let width = length(across);
    let normal = across / select(1.0, width, width > 0.0) * sqrt(max(1.0 - tilt * tilt, 0.0)) - axis * tilt;
    let corners = vec3<f32>(dot(normal, p), dot(normal, q), dot(normal, r));
    let sizes = vec3<f32>(sum_of_sizes(p), sum_of_sizes(q), sum_of_sizes(r));
    let light_side = dot(normal, receiver.to_light) + light.radius * length(normal) * 1.000002;
    return all(corners > ROUNDING * 2.0 * sizes) && light_side < -ROUNDING * 2.0 * sum_of_sizes(receiver.to_light);
}

// Planes that are seen from two sides err alike: the bound is of the value, whatever its sign.
fn pair_of(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Pair {
    let p = a - receiver.place;
    let q = b - receiver.place;
    let r = c - receiver.place;
    let front = plane_through(b - a, c - a);
    let planes = array<vec4<f32>, 3>(plane_through(p, b - a), plane_through(q, c - b), plane_through(r, a - c));
    let w = dot(front.xyz, p);
    let winding = select(0.0, sign(w), abs(w) > front.w * sum_of_sizes(p));
    let from_light = light.middle - a;
    let value = vec4<f32>(
        dot(planes[0].xyz, receiver.to_light),
        dot(planes[1].xyz, receiver.to_light),
        dot(planes[2].xyz, receiver.to_light),
        dot(front.xyz, from_light),
    );
    let range = vec4<f32>(
        spread_of(planes[0].xyz, light),
        spread_of(planes[1].xyz, light),
        spread_of(planes[2].xyz, light),
        spread_of(front.xyz, light),
    );
    let far = sum_of_sizes(receiver.to_light) + light.reach;
    let slack = vec4<f32>(planes[0].w * far, planes[1].w * far, planes[2].w * far,
        front.w * (sum_of_sizes(from_light) + light.reach));
    let width = range + slack;
    let surely_plus = value > width;
    let surely_minus = value < -width;
    // Without a winding the edges must agree with each other.
    let mixed = any(surely_plus.xyz) && any(surely_minus.xyz);
    let outside = (winding > 0.0 && any(surely_minus)) || (winding < 0.0 && any(surely_plus)) || mixed
        || is_beside(p, q, r, receiver, light);
    let cut = !(surely_plus | surely_minus);
    let whole = winding != 0.0 && !any(cut);
    let normals = array<vec3<f32>, 4>(planes[0].xyz, planes[1].xyz, planes[2].xyz, front.xyz);
    return Pair(select(select(WITHIN, ALL, whole), NOTHING, outside), winding, cut, normals, value, slack);
}
