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
    // Side of the own plane that all of the light is on, -1 or 1; 0: on both, or rounding hides it.
    light_side: f32,
    has_plane: bool,
}

const NOTHING: u32 = 0u;
const ALL: u32 = 1u;
const WITHIN: u32 = 2u;
// The coplanar rule needs a closer look.
const UNKNOWN: u32 = 3u;

// Planes of a pair: the first three through the view-sample and the edges, the last the supporting plane.
struct Pair {
    kind: u32,
    // 1 or -1 times a plane's value is above zero inside; 0: rounding hides it.
    winding: f32,
    // Whether a plane may cut the light's box.
    cut: vec4<bool>,
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
        let offset = light.middle - a;
        let height = dot(receiver.plane.xyz, offset);
        let range = spread_of(receiver.plane.xyz, light);
        let slack = receiver.plane.w * (sum_of_sizes(offset) + light.reach);
        receiver.light_side = select(0.0, sign(height), abs(height) > range + slack);
    }
    return receiver;
}

// Whether a corner surely lies below, and surely above the own plane.
fn sides_of_corner(receiver: Receiver, corner: vec3<f32>) -> vec2<bool> {
    let offset = corner - receiver.base;
    let height = dot(receiver.plane.xyz, offset);
    let slack = receiver.plane.w * sum_of_sizes(offset);
    return vec2<bool>((height < -slack), (height > slack));
}

// What the coplanar rule says of a caster for the whole light: ALL, NOTHING or UNKNOWN.
fn admitted(receiver: Receiver, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> u32 {
    if !receiver.has_plane {
        return ALL;
    }
    let first = sides_of_corner(receiver, a);
    let second = sides_of_corner(receiver, b);
    let third = sides_of_corner(receiver, c);
    let some = first | second | third;
    let every = first & second & third;
    if receiver.light_side == 0.0 {
        return select(UNKNOWN, ALL, some.x && some.y);
    }
    let above = select(some.x, some.y, receiver.light_side > 0.0);
    let below = select(every.y, every.x, receiver.light_side > 0.0);
    return select(select(UNKNOWN, NOTHING, below), ALL, above);
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
    let outside = (winding > 0.0 && any(surely_minus)) || (winding < 0.0 && any(surely_plus)) || mixed;
    let cut = !(surely_plus | surely_minus);
    let whole = winding != 0.0 && !any(cut);
    return Pair(select(select(WITHIN, ALL, whole), NOTHING, outside), winding, cut);
}
