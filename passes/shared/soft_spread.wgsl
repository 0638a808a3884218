// The answer of one light sample, in the place of all. Joined after the prelude; numbers as in soft_split.wgsl.
struct Numbers {
    samples: u32,
    total_at: u32,
    words: u32,
    light_samples: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> whole_total: array<u32>;
@group(0) @binding(2) var<storage, read> whole_entries: array<u32>;
@group(0) @binding(3) var<storage, read> whole_mask: array<u32>;
@group(0) @binding(4) var<storage, read_write> mask: array<u32>;

@compute @workgroup_size(64)
fn soft_spread(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    let place = index / numbers.words;
    let word = index % numbers.words;
    if place >= numbers.samples || place >= whole_total[numbers.total_at] {
        return;
    }
    let sample = whole_entries[place];
    // Light samples past the last have no bit.
    let left = min(numbers.light_samples - 32u * word, 32u);
    let used = 0xffffffffu >> (32u - left);
    mask[sample * numbers.words + word] = select(0u, used, whole_mask[sample] != 0u);
}
