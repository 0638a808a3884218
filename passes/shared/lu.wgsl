// Which bin a plane falls in, as lu.rs says. Joined after soft_join.wgsl.
@group(0) @binding(17) var<storage, read> lu: array<vec4<u32>>;
@group(0) @binding(18) var<storage, read> lu_layout: array<f32>;
@group(0) @binding(19) var<uniform> lu_size: u32;

const PI: f32 = 3.14159265;

// atan2(y, x) to within 2e-5; 0 at the origin.
fn angle(y: f32, x: f32) -> f32 {
    let small = min(abs(x), abs(y));
    let large = max(abs(x), abs(y));
    let q = select(0.0, small / large, large > 0.0);
    let z = q * q;
    let turn = q * (0.999866 + z * (-0.3302995 + z * (0.180141 + z * (-0.085133 + z * 0.0208351))));
    let octants = select(turn, 0.5 * PI - turn, abs(y) > abs(x));
    let half_turn = select(octants, PI - octants, x < 0.0);
    return select(half_turn, -half_turn, y < 0.0);
}

// The tables of the block's halves, of 128 light samples each; where there is no second half, the first once more.
fn tables_of_block() -> vec2<u32> {
    return min(vec2<u32>(2u * numbers.block, 2u * numbers.block + 1u), vec2<u32>((numbers.words - 1u) / 4u));
}

// A bit for each plane that may cut the light.
fn planes_to_look_up(pair: Pair) -> u32 {
    return select(bits_of(pair.cut), 15u, pair.winding == 0.0);
}

fn bin_of(share: f32) -> u32 {
    return min(u32(max(share * f32(lu_size), 0.0)), lu_size - 1u);
}

// A plane to look up: n . s + d over offsets s from the middle of the light.
struct Plane {
    normal: vec3<f32>,
    constant: f32,
    // Whether inside is where the value is below zero.
    is_turned: bool,
}

fn comes_before(a: vec3<f32>, b: vec3<f32>) -> bool {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.z < b.z)));
}

// Plane `k` of a pair, the ends of an edge in order, so that neighbours at an edge look up one plane.
fn ordered_plane(k: u32, winding: f32, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Plane {
    let is_front = k == 3u;
    let first = select(select(a, b, k == 1u), c, k == 2u);
    let second = select(select(b, c, k == 1u), a, k == 2u);
    let in_order = comes_before(first, second) || is_front;
    let near = select(second, first, in_order);
    let far = select(first, second, in_order);
    // Edges: (near - P) x (far - near) and the light seen from P; the supporting plane: (B - A) x (C - A) and the light seen from A.
    let left = select(near - receiver.place, b - a, is_front);
    let right = select(far - near, c - a, is_front);
    let normal = cross(left, right);
    let constant = dot(normal, select(receiver.to_light, light.middle - a, is_front));
    return Plane(normal, constant, (winding < 0.0) == in_order);
}

// 1 or -1 as the caster is seen from the view-sample; 0 edge-on.
fn winding_of(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver) -> f32 {
    return select(pair.winding, sign(dot(cross(b - a, c - a), a - receiver.place)), pair.winding == 0.0);
}

// All of the light is on one side of a plane that takes no bin: 1 inside, -1 outside, 0 it takes one.
fn whole_side(plane: Plane, reach: f32) -> f32 {
    let side = select(1.0, -1.0, plane.is_turned) * plane.constant;
    return select(0.0, select(-1.0, 1.0, side >= 0.0), abs(plane.constant) >= reach);
}

// Row of a direction: theta, then phi.
fn direction_row(normal: vec3<f32>) -> u32 {
    let theta = bin_of(angle(sqrt(normal.x * normal.x + normal.y * normal.y), normal.z) / PI);
    return theta * lu_size + bin_of(angle(normal.y, normal.x) / (2.0 * PI) + 0.5);
}
