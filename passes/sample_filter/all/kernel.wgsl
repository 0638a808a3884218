// Keeps every view-sample that is not background. (`all` is a word of WGSL itself, hence the longer name.)

@group(0) @binding(0) var<uniform> size: vec4<u32>; // view-samples, 0, 0, 0
@group(0) @binding(1) var<storage, read> position: array<u32>; // bits of floats
@group(0) @binding(2) var<storage, read> triangle: array<u32>;
@group(0) @binding(3) var<storage, read_write> sample_state: array<u32>;

// By the exponent's bits: a compiler may assume that floats are finite.
fn is_finite(bits: u32) -> bool {
    return (bits & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(64)
fn all_samples(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.x {
        return;
    }
    let word = 3u * index;
    let finite = is_finite(position[word]) && is_finite(position[word + 1u]) && is_finite(position[word + 2u]);
    sample_state[index] = select(BACKGROUND, KEPT, triangle[index] != NO_TRIANGLE && finite);
}
