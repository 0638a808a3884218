// Corners of the casters in a face's map. Joined after light_frame.wgsl and shadow_map.wgsl; the kernel declares
// `triangles: array<f32>`, `caster_state: array<u32>` and `light_frame: array<f32>`.

// Clip-space position of corner `index % 3` of triangle `index / 3` in the map of `face`: columns grow with u, rows with v.
// Triangles that do not cast, and all of a face without view-samples, are moved to one point outside.
fn shadow_vertex(index: u32, face: u32) -> vec4<f32> {
    if caster_state[index / 3u] != 1u || !light_valid(face) {
        return vec4<f32>(2.0, 2.0, 2.0, 1.0);
    }
    let corner = vec3<f32>(triangles[index * 3u], triangles[index * 3u + 1u], triangles[index * 3u + 2u]);
    let offset = corner - light_origin(face);
    let w = light_dot(light_axis_z(face), offset);
    let window = light_window(face);
    let across = 2.0 * (light_dot(light_axis_x(face), offset) - window.x * w) / window.z - w;
    let down = 2.0 * (light_dot(light_axis_y(face), offset) - window.y * w) / window.w - w;
    let far = light_depth_range(face).y;
    let near = far * NEAR_SHARE;
    return vec4<f32>(across, -down, far / (far - near) * (w - near), w);
}
