// How many light samples a mask blocks, as blocked.rs counts them. Joined after the prelude.

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
@group(0) @binding(3) var<storage, read_write> visible: array<f32>;

fn blocked_count(index: u32) -> u32 {
    var count = 0u;
    for (var word = 0u; word < size.words; word++) {
        var keep = 0xffffffffu;
        if 32u * (word + 1u) > size.samples {
            keep >>= 32u * (word + 1u) - size.samples;
        }
        count += countOneBits(mask[index * size.words + word] & keep);
    }
    return count;
}
