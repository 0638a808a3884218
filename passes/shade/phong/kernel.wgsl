@group(0) @binding(7) var<storage, read> camera: array<f32>;

@compute @workgroup_size(64)
fn phong(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if !is_surface(row) {
        return;
    }
    let surface = surface_at(row);
    let n = surface.shading_normal;
    let offset = from_surface_to_light(surface);
    let l = unit(offset);
    let toward_eye = unit(vec3<f32>(camera[0], camera[1], camera[2]) - surface.position);
    let terms = phong_terms(n, l, toward_eye);
    store_lighting(row, offset, terms.x, terms.y);
}
