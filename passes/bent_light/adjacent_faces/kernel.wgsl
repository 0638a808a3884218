@group(0) @binding(3) var<storage, read> light: array<f32>;

fn light_cosine(normal: vec3<f32>, at: vec3<f32>) -> f32 {
    return shading_dot(unit(vec3<f32>(light[0], light[1], light[2]) - at), normal);
}

@compute @workgroup_size(64)
fn adjacent_faces_step(@builtin(global_invocation_id) id: vec3<u32>) {
    step_entry(linear_index(id));
}

@compute @workgroup_size(64)
fn adjacent_faces(@builtin(global_invocation_id) id: vec3<u32>) {
    step_corner(linear_index(id));
}
