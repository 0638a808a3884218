@group(0) @binding(13) var<storage, read> camera: array<f32>;

@compute @workgroup_size(64)
fn phong(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if !is_shaded(row) {
        return;
    }
    let surface = surface_at(row);
    let n = surface.shading_normal;
    let l = surface.toward_light;
    let cosine = shading_dot(n, l);
    var reflected = vec3<f32>(0.0);
    if cosine > 0.0 {
        let mirrored = 2.0 * cosine * n - l;
        let toward_eye = unit(vec3<f32>(camera[0], camera[1], camera[2]) - surface.position);
        let along = max(shading_dot(mirrored, toward_eye), 0.0);
        // pow of 0 is not defined everywhere.
        let highlight = select(0.0, params.first * pow(along, params.second), along > 0.0);
        reflected = surface.light * (surface.albedo * cosine + highlight);
    }
    store(pixel[row], params.ambient * surface.albedo + visible[row] * reflected, 1.0);
}
