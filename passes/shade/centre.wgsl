// The factored form: light terms from the light's centre, three numbers a view-sample. Joined after surface; binding 7 is the pass's.
@group(0) @binding(6) var<storage, read> light: array<f32>;
// Weakening by distance, and two terms of the pass.
@group(0) @binding(8) var<storage, read_write> lighting: array<f32>;

fn from_surface_to_light(surface: Surface) -> vec3<f32> {
    return vec3<f32>(light[0], light[1], light[2]) - surface.position;
}

fn store_lighting(row: u32, offset: vec3<f32>, first: f32, second: f32) {
    lighting[3u * row] = weakening(offset);
    lighting[3u * row + 1u] = first;
    lighting[3u * row + 2u] = second;
}
