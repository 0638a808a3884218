@group(0) @binding(0) var<uniform> counts: vec4<u32>; // corners
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> light: array<f32>;
@group(0) @binding(3) var<storage, read_write> corner_light: array<f32>;

fn corner_at(index: u32) -> vec3<f32> {
    return vec3<f32>(triangles[3u * index], triangles[3u * index + 1u], triangles[3u * index + 2u]);
}

@compute @workgroup_size(64)
fn own_face(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= counts.x {
        return;
    }
    let first = index / 3u * 3u;
    let normal = face_normal(corner_at(first), corner_at(first + 1u), corner_at(first + 2u));
    let toward = unit(vec3<f32>(light[0], light[1], light[2]) - corner_at(index));
    corner_light[index] = shading_dot(toward, normal);
}
