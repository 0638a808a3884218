@group(0) @binding(7) var<storage, read> corner_light: array<f32>;

@compute @workgroup_size(64)
fn bent_lambert(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if !is_surface(row) {
        return;
    }
    let surface = surface_at(row);
    let offset = from_surface_to_light(surface);
    let toward_light = unit(offset);
    let smooth_light = max(shading_dot(surface.shading_normal, toward_light), 0.0);
    let corner = 3u * triangle[row];
    let corners = vec3<f32>(corner_light[corner], corner_light[corner + 1u], corner_light[corner + 2u]);
    var bent = shading_dot(surface.weights, corners);
    if surface.is_flipped {
        bent = min(-bent, shading_dot(surface.geometric_normal, toward_light));
    }
    let alpha = clamp(numbers.first * bent, 0.0, 1.0);
    store_lighting(row, offset, alpha * smooth_light + (1.0 - alpha) * max(bent, 0.0), 0.0);
}
