// Joined after light_frame, predicate and pyramid.
struct Numbers {
    samples: u32,
    cells: u32,
    side: u32,
    // First word of `beyond` that is a face's.
    beyond: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read> position: array<f32>;
@group(0) @binding(5) var<storage, read> own_triangle: array<u32>;
@group(0) @binding(6) var<storage, read> cell: array<u32>;
@group(0) @binding(7) var<storage, read> list_offset: array<u32>;
@group(0) @binding(8) var<storage, read> list_entries: array<u32>;
// In list order: a `Sample`, and 0.
@group(0) @binding(9) var<storage, read_write> packed: array<vec4<u32>>;
@group(0) @binding(10) var<storage, read_write> blocked: array<u32>;
// For each face, 1 if view-samples lie beyond its window.
@group(0) @binding(11) var<storage, read_write> beyond: array<atomic<u32>>;

@group(0) @binding(12) var<storage, read> sample_state: array<u32>;
@group(0) @binding(13) var<storage, read_write> mask: array<u32>;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

// Starts the masks, and packs what the tests read of each view-sample in list order, so that a row of texels is one run of memory.
@compute @workgroup_size(64)
fn pack(@builtin(global_invocation_id) id: vec3<u32>) {
    let light = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    let total = list_offset[numbers.cells];
    let entry = linear_index(id);
    if entry < numbers.samples {
        mask[entry] = select(0u, 0xffffffffu, sample_state[entry] == FACING_AWAY);
    }
    if entry >= total {
        return;
    }
    let index = list_entries[entry];
    let place = vec3<f32>(position[index * 3u], position[index * 3u + 1u], position[index * 3u + 2u]);
    let sample = sample_of(place, own_triangle[index], light);
    packed[entry] = vec4<u32>(bitcast<vec3<u32>>(sample.offset), sample.own);
    blocked[entry] = 0u;
    let face = cell[index] / (numbers.side * numbers.side);
    let depth = light_dot(light_axis_z(face), sample.offset);
    let uv = vec2<f32>(light_dot(light_axis_x(face), sample.offset), light_dot(light_axis_y(face), sample.offset)) / depth;
    let window = light_window(face);
    let stray = light_uv_pad(uv.x, uv.y);
    if any(uv < window.xy - stray) || any(uv > window.xy + window.zw + stray) {
        atomicStore(&beyond[numbers.beyond + face], 1u);
    }
}
