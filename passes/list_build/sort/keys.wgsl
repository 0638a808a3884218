// One invocation a view-sample: its cell, the key it is sorted by, and the depth of its cell. The atomics order nothing but
// themselves.

@group(0) @binding(4) var<storage, read_write> cell: array<u32>;
@group(0) @binding(5) var<storage, read_write> keys: array<u32>;
// Bits of depths above zero, which are ordered as the depths are.
@group(0) @binding(6) var<storage, read_write> list_far: array<atomic<u32>>;
// View-samples that no face sees, first; the second is counted in the end.
@group(0) @binding(7) var<storage, read_write> counters: array<atomic<u32>, 2>;

@compute @workgroup_size(64)
fn sort_keys(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.count {
        return;
    }
    let point = place(index);
    if !(point.depth > 0.0) {
        cell[index] = NO_CELL;
        keys[index] = size.cells;
        if sample_state[index] == KEPT {
            atomicAdd(&counters[0], 1u);
        }
        return;
    }
    let own = light_cell(point, size.side);
    cell[index] = own;
    keys[index] = own;
    // Where all view-samples share a cell, nearly all are spared the exchange.
    let depth = bitcast<u32>(point.depth);
    if atomicLoad(&list_far[own]) < depth {
        atomicMax(&list_far[own], depth);
    }
}
