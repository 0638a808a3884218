// One invocation a view-sample; sums in the order of cpu.rs.

struct CombineSize {
    // View-samples.
    count: u32,
    // Words of a mask.
    words: u32,
    // Light samples.
    samples: u32,
}

@group(0) @binding(0) var<uniform> size: CombineSize;
@group(0) @binding(1) var<storage, read> mask: array<u32>;
@group(0) @binding(2) var<storage, read> sample_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_weights: array<f32>;
@group(0) @binding(4) var<storage, read_write> visible: array<f32>;
@group(0) @binding(5) var<storage, read_write> visible_color: array<f32>;

// ITU-R BT.709.
fn luminance(color: vec3<f32>) -> f32 {
    return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

@compute @workgroup_size(64)
fn weighted(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.count {
        return;
    }
    let is_background = sample_state[index] == BACKGROUND;
    var lit = vec3<f32>(0.0);
    var all = vec3<f32>(0.0);
    for (var word = 0u; word < size.words; word++) {
        let blocked = select(mask[index * size.words + word], 0u, is_background);
        let end = min(32u * (word + 1u), size.samples);
        var lit_of_word = vec3<f32>(0.0);
        var all_of_word = vec3<f32>(0.0);
        for (var sample = 32u * word; sample < end; sample++) {
            let weight = vec3<f32>(
                light_weights[3u * sample],
                light_weights[3u * sample + 1u],
                light_weights[3u * sample + 2u]);
            all_of_word += weight;
            if (blocked >> (sample % 32u) & 1u) == 0u {
                lit_of_word += weight;
            }
        }
        lit += lit_of_word;
        all += all_of_word;
    }
    let lit_luminance = luminance(lit);
    let all_luminance = luminance(all);
    // A division need not be exact even where both are equal.
    var share = 1.0;
    if lit_luminance != all_luminance {
        share = lit_luminance / all_luminance;
    }
    visible[index] = share;
    visible_color[3u * index] = lit.x;
    visible_color[3u * index + 1u] = lit.y;
    visible_color[3u * index + 2u] = lit.z;
}
