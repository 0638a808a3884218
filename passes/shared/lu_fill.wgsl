// Rows of look-up tables, as lu_fill.rs fills them: one invocation takes all distances of one direction in one block of 128 light
// samples. Each light sample is put at the first bin where its bit is set; a running OR does the rest. Joined after the prelude; the pass
// defines `GROUPS`, words of a bin over four, and `firsts`.
struct Numbers {
    light_samples: u32,
    size: u32,
    // Rows of a block.
    rows: u32,
    blocks: u32,
    // sin and cos of half a bin of theta, and of phi.
    half_theta: vec2<f32>,
    half_phi: vec2<f32>,
    // Of the middle of each bin of theta, then of phi.
    turns: array<vec4<f32>, 1024>,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> light_samples: array<f32>;
@group(0) @binding(2) var<storage, read> lu_layout: array<f32>;
@group(0) @binding(3) var<storage, read_write> lu: array<vec4<u32>>;

fn layout_vector(start: u32) -> vec3<f32> {
    return vec3<f32>(lu_layout[start], lu_layout[start + 1u], lu_layout[start + 2u]);
}

fn first_bin(at: f32) -> u32 {
    return min(u32(max(ceil(at), 0.0)), numbers.size);
}

@compute @workgroup_size(64)
fn lu_fill(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    let size = numbers.size;
    if index >= numbers.rows * numbers.blocks {
        return;
    }
    let block = index / numbers.rows;
    let row = index % numbers.rows;
    let is_mirrored = 2u * row >= numbers.rows;
    let filled = select(row, opposite(row), is_mirrored);
    let start = index * size * GROUPS;
    for (var at = 0u; at < size * GROUPS; at++) {
        lu[start + at] = vec4<u32>(0u);
    }
    let middle = layout_vector(0u);
    let radius = lu_layout[3];
    let inverse = select(0.0, 1.0 / radius, radius > 0.0);
    let count = min(numbers.light_samples - 128u * block, 128u);
    for (var place = 0u; place < count; place++) {
        let sample = 3u * (128u * block + place);
        let offset = vec3<f32>(light_samples[sample], light_samples[sample + 1u], light_samples[sample + 2u]) - middle;
        let bins = firsts(filled, offset * inverse);
        for (var group = 0u; group < GROUPS; group++) {
            if bins[group] < size {
                // Mirrored rows are filled from the other end, groups exchanged, and complemented below.
                let bin = select(bins[group], size - 1u - bins[group], is_mirrored);
                let at = start + bin * GROUPS + select(group, GROUPS - 1u - group, is_mirrored);
                lu[at][place / 32u] |= 1u << (place % 32u);
            }
        }
    }
    var running = array<vec4<u32>, 2>();
    for (var step = 0u; step < size * GROUPS; step++) {
        let bin = select(step / GROUPS, size - 1u - step / GROUPS, is_mirrored);
        let group = step % GROUPS;
        let at = start + bin * GROUPS + group;
        running[group] |= lu[at];
        lu[at] = select(running[group], ~running[group], is_mirrored);
    }
}
