// Cosines travel as keys that order as the numbers do, so that the smallest is an atomicMin; keys are kept inverted, so that
// the largest inverted key is wanted and zeroed memory means that nothing was counted.

@group(0) @binding(0) var<uniform> counts: vec4<u32>; // corners, vertices, entries of faces
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> corner_vertex: array<u32>;
@group(0) @binding(3) var<storage, read> light: array<f32>;
@group(0) @binding(4) var<storage, read_write> smallest: array<atomic<u32>>;

const NONE: f32 = 2.0;

fn corner_at(index: u32) -> vec3<f32> {
    return vec3<f32>(triangles[3u * index], triangles[3u * index + 1u], triangles[3u * index + 2u]);
}

// The cosine of the face of a corner at that corner, or NONE if the face has no normal.
fn cosine(corner: u32) -> f32 {
    let first = corner / 3u * 3u;
    let normal = face_normal(corner_at(first), corner_at(first + 1u), corner_at(first + 2u));
    if all(normal == vec3<f32>(0.0)) {
        return NONE;
    }
    return shading_dot(unit(vec3<f32>(light[0], light[1], light[2]) - corner_at(corner)), normal);
}

fn key_of(value: f32) -> u32 {
    let bits = bitcast<u32>(value);
    return ~select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

fn value_of(key: u32) -> f32 {
    if key == 0u {
        return NONE;
    }
    let bits = ~key;
    return bitcast<f32>(select(~bits, bits & 0x7fffffffu, (bits & 0x80000000u) != 0u));
}
