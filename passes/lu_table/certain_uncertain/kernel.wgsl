// Joined after lu_fill.wgsl.
const GROUPS: u32 = 2u;
// CERTAIN_SLACK of lu_fill.rs.
const SLACK: f32 = 3e-4;

// Row of the opposite direction.
fn opposite(row: u32) -> u32 {
    let size = numbers.size;
    return (size - 1u - row / size) * size + (row % size + size / 2u) % size;
}

// Smallest and largest at cos delta + along sin delta for |delta| up to the angle of `half`.
fn ends(at: f32, along: f32, half: vec2<f32>) -> vec2<f32> {
    let spread = abs(along) * half.x;
    return vec2<f32>(min(at, at * half.y) - spread, max(at, at * half.y) + spread);
}

fn firsts(row: u32, offset: vec3<f32>) -> vec2<u32> {
    let theta = numbers.turns[row / numbers.size].xy;
    let phi = numbers.turns[row % numbers.size].zw;
    let flat_range = ends(offset.x * phi.y + offset.y * phi.x, offset.y * phi.y - offset.x * phi.x, numbers.half_phi);
    let z = offset.z;
    let low = ends(flat_range.x * theta.x + z * theta.y, flat_range.x * theta.y - z * theta.x, numbers.half_theta).x;
    let high = ends(flat_range.y * theta.x + z * theta.y, flat_range.y * theta.y - z * theta.x, numbers.half_theta).y;
    let half_size = 0.5 * f32(numbers.size);
    return vec2<u32>(first_bin((1.0 - low + SLACK) * half_size), first_bin((1.0 - high - SLACK) * half_size - 1.0));
}
