// One link of the running sum: entries first..end, going on from the last offset of the link before.

struct Link {
    first: u32,
    end: u32,
}

@group(0) @binding(0) var<uniform> link: Link;
@group(0) @binding(1) var<storage, read> lengths: array<u32>;
@group(0) @binding(2) var<storage, read_write> offsets: array<u32>;

@compute @workgroup_size(1)
fn serial() {
    var running = 0u;
    if link.first == 0u {
        offsets[0] = 0u;
    } else {
        running = offsets[link.first];
    }
    for (var i = link.first; i < link.end; i++) {
        running += lengths[i];
        offsets[i + 1u] = running;
    }
}
