// The size of an indirect dispatch over a queue: groups folded into x and y.
struct Numbers {
    // Items a workgroup takes, and workgroups an item takes.
    items: u32,
    groups: u32,
    // Word of the queue's length.
    word: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> queued: array<u32>;
@group(0) @binding(2) var<storage, read_write> groups: array<u32>;

@compute @workgroup_size(1)
fn share() {
    let count = (queued[numbers.word] + numbers.items - 1u) / numbers.items;
    groups[0] = min(count, MAX_GROUPS);
    groups[1] = (count + MAX_GROUPS - 1u) / MAX_GROUPS;
    groups[2] = numbers.groups;
}
