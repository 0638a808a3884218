@group(0) @binding(3) var<storage, read> light_box: array<f32>;

fn light_cosine(normal: vec3<f32>, at: vec3<f32>) -> f32 {
    if light_box[6] == 0.0 {
        return 0.0;
    }
    let low = vec3<f32>(light_box[0], light_box[1], light_box[2]);
    let high = vec3<f32>(light_box[3], light_box[4], light_box[5]);
    var least = NONE;
    for (var bits = 0u; bits < 8u; bits++) {
        let corner = select(low, high, (vec3<u32>(bits) >> vec3<u32>(0u, 1u, 2u) & vec3<u32>(1u)) == vec3<u32>(1u));
        least = min(least, shading_dot(unit(corner - at), normal));
    }
    return least;
}

@compute @workgroup_size(64)
fn bounding_box_step(@builtin(global_invocation_id) id: vec3<u32>) {
    step_entry(linear_index(id));
}

@compute @workgroup_size(64)
fn bounding_box(@builtin(global_invocation_id) id: vec3<u32>) {
    step_corner(linear_index(id));
}
