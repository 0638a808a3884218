// Sizes of the two dispatches that take what is left: groups folded into x and y.
struct Numbers {
    // Casters a workgroup, workgroups a caster.
    casters: u32,
    shares: u32,
    // Which of the two: 0 or 1.
    kind: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> queued: array<u32>;
@group(0) @binding(2) var<storage, read_write> groups: array<u32>;

@compute @workgroup_size(1)
fn fused_share() {
    let count = (queued[numbers.kind] + numbers.casters - 1u) / numbers.casters;
    groups[0] = min(count, MAX_GROUPS);
    groups[1] = (count + MAX_GROUPS - 1u) / MAX_GROUPS;
    groups[2] = numbers.shares;
}
