// Joined after lu_fill.wgsl.
const GROUPS: u32 = 1u;

// Row of the opposite direction.
fn opposite(row: u32) -> u32 {
    let size = numbers.size;
    return (size - 1u - row / size) * size + (row % size + size / 2u) % size;
}

fn firsts(row: u32, offset: vec3<f32>) -> vec2<u32> {
    let theta = numbers.turns[row / numbers.size].xy;
    let phi = numbers.turns[row % numbers.size].zw;
    let along = dot(vec3<f32>(theta.x * phi.y, theta.x * phi.x, theta.y), offset);
    return vec2<u32>(first_bin(((1.0 - along) * f32(numbers.size) - 1.0) * 0.5), 0u);
}
