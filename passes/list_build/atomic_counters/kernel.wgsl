// One invocation a view-sample. The atomics order nothing but themselves: counts are read by later dispatches.

@group(0) @binding(4) var<storage, read_write> cell: array<u32>;
@group(0) @binding(5) var<storage, read_write> slot: array<u32>;
@group(0) @binding(6) var<storage, read_write> list_length: array<atomic<u32>>;
// Bits of depths above zero, which are ordered as the depths are.
@group(0) @binding(7) var<storage, read_write> list_far: array<atomic<u32>>;
// View-samples that no face sees; the length of the longest list.
@group(0) @binding(8) var<storage, read_write> counters: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn atomic_counters(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.count {
        return;
    }
    let point = place(index);
    if !(point.depth > 0.0) {
        cell[index] = NO_CELL;
        slot[index] = 0u;
        if sample_state[index] == KEPT {
            atomicAdd(&counters[0], 1u);
        }
        return;
    }
    let own = light_cell(point, size.side);
    cell[index] = own;
    let place = atomicAdd(&list_length[own], 1u);
    slot[index] = place;
    // Few get past the look: most lists are not the longest yet.
    if place >= atomicLoad(&counters[1]) {
        atomicMax(&counters[1], place + 1u);
    }
    atomicMax(&list_far[own], bitcast<u32>(point.depth));
}
