// Joined after lu_fill.wgsl.
const GROUPS: u32 = 1u;

// Row of the opposite direction.
fn opposite(row: u32) -> u32 {
    return (row + numbers.size / 2u) % numbers.size;
}

fn firsts(row: u32, offset: vec3<f32>) -> vec2<u32> {
    let phi = numbers.turns[row].zw;
    let along = dot(phi.y * layout_vector(4u) + phi.x * layout_vector(8u), offset);
    return vec2<u32>(first_bin(((1.0 - along) * f32(numbers.size) - 1.0) * 0.5), 0u);
}
