// Which cell a view-sample falls in. Joined after the prelude and the projection onto the light frame.

struct PlaceSize {
    // View-samples.
    count: u32,
    // Light texels a side.
    side: u32,
    faces: u32,
    // Key of view-samples in no list: one past the last cell.
    cells: u32,
}

@group(0) @binding(0) var<uniform> size: PlaceSize;
@group(0) @binding(1) var<storage, read> position: array<f32>;
@group(0) @binding(2) var<storage, read> sample_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_frame: array<f32>;

// Depth is not above zero when the view-sample is not kept or no face sees it.
fn place(index: u32) -> LightPoint {
    if sample_state[index] != KEPT {
        return LightPoint(0u, 0.0, 0.0, 0.0);
    }
    let at = vec3<f32>(position[3u * index], position[3u * index + 1u], position[3u * index + 2u]);
    return light_project(at, size.faces);
}
