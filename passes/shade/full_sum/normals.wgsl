// Shading normal, then geometric normal.
@group(0) @binding(6) var<storage, read_write> normals: array<f32>;

@compute @workgroup_size(64)
fn full_sum_normals(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if !is_surface(row) {
        return;
    }
    let surface = surface_at(row);
    for (var k = 0u; k < 3u; k++) {
        normals[6u * row + k] = surface.shading_normal[k];
        normals[6u * row + 3u + k] = surface.geometric_normal[k];
    }
}
