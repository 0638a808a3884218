// Drops view-samples that face away from every light sample.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // view-samples, light samples, 0, 0
@group(0) @binding(1) var<storage, read> position: array<f32>;
@group(0) @binding(2) var<storage, read> normal: array<f32>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> light_samples: array<f32>;
@group(0) @binding(5) var<storage, read_write> sample_state: array<u32>;

// By the exponent's bits: a compiler may assume that floats are finite.
fn is_finite(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7f800000u) != 0x7f800000u;
}

@compute @workgroup_size(64)
fn light_facing(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.x {
        return;
    }
    let word = 3u * index;
    let p = vec3<f32>(position[word], position[word + 1u], position[word + 2u]);
    if triangle[index] == NO_TRIANGLE || !(is_finite(p.x) && is_finite(p.y) && is_finite(p.z)) {
        sample_state[index] = BACKGROUND;
        return;
    }
    let n = vec3<f32>(normal[word], normal[word + 1u], normal[word + 2u]);
    var state = FACING_AWAY;
    for (var light = 0u; light < size.y; light++) {
        let s = vec3<f32>(light_samples[3u * light], light_samples[3u * light + 1u], light_samples[3u * light + 2u]);
        if !(dot(n, s - p) <= 0.0) {
            state = KEPT;
            break;
        }
    }
    sample_state[index] = state;
}
