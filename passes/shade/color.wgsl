// Light terms to colours. Joined after numbers. The pass's `arriving` gives the light that a view-sample sends to the viewer beyond
// the ambient; what it binds alone is from binding 7 on.
@group(0) @binding(1) var<storage, read> lighting: array<f32>;
@group(0) @binding(2) var<storage, read> place: array<u32>;
@group(0) @binding(3) var<storage, read> triangle: array<u32>;
@group(0) @binding(4) var<storage, read> triangle_albedo: array<f32>;
@group(0) @binding(5) var<storage, read> light: array<f32>;
@group(0) @binding(6) var<storage, read_write> image: array<f32>;

fn light_color() -> vec3<f32> {
    return vec3<f32>(light[4], light[5], light[6]);
}

@compute @workgroup_size(64)
fn shade_color(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row >= numbers.sample_count {
        return;
    }
    let at = place[row];
    if at == NO_PLACE {
        return;
    }
    let first = 3u * triangle[row];
    let albedo = vec3<f32>(triangle_albedo[first], triangle_albedo[first + 1u], triangle_albedo[first + 2u]);
    let color = numbers.ambient * albedo + arriving(row, albedo);
    image[4u * at] = color.x;
    image[4u * at + 1u] = color.y;
    image[4u * at + 2u] = color.z;
    image[4u * at + 3u] = 1.0;
}
