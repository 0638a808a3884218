// Before surfaces are shaded: the background of every pixel (an imported list of view-samples need not name all), and where the
// colour of each view-sample goes.
@group(0) @binding(1) var<storage, read> triangle: array<u32>;
@group(0) @binding(2) var<storage, read> pixel: array<u32>;
@group(0) @binding(3) var<storage, read> sample_state: array<u32>;
// A pixel, or NO_PLACE.
@group(0) @binding(4) var<storage, read_write> place: array<u32>;
@group(0) @binding(5) var<storage, read_write> image: array<f32>;
@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>;

@compute @workgroup_size(64)
fn shade_place(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = linear_index(id);
    if at < numbers.pixel_count {
        image[4u * at] = numbers.background.x;
        image[4u * at + 1u] = numbers.background.y;
        image[4u * at + 2u] = numbers.background.z;
        image[4u * at + 3u] = 0.0;
    }
    if at >= numbers.sample_count {
        return;
    }
    var goes_to = NO_PLACE;
    if sample_state[at] != BACKGROUND && triangle[at] < numbers.triangle_count {
        if pixel[at] < numbers.pixel_count {
            goes_to = pixel[at];
        } else {
            atomicAdd(&counters[0], 1u);
        }
    }
    place[at] = goes_to;
}
