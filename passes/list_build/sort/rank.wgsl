// Lists from sorted keys: where each cell's run starts, how long it is, and each view-sample's rank in it.

struct RankSize {
    // Pairs.
    count: u32,
    // Key of view-samples in no list.
    cells: u32,
}

@group(0) @binding(0) var<uniform> size: RankSize;
@group(0) @binding(1) var<storage, read> keys: array<u32>;
@group(0) @binding(2) var<storage, read> order: array<u32>;
// Written by sort_bounds, read by sort_rank; undefined for empty cells.
@group(0) @binding(3) var<storage, read_write> list_start: array<u32>;
// The end of each run after sort_bounds, its length after sort_rank.
@group(0) @binding(4) var<storage, read_write> list_length: array<u32>;
@group(0) @binding(5) var<storage, read_write> slot: array<u32>;
// The length of the longest list, second.
@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>, 2>;

// The two ends of a run write, each its own word.
@compute @workgroup_size(64)
fn sort_bounds(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = linear_index(id);
    if at >= size.count {
        return;
    }
    let key = keys[at];
    if at == 0u || keys[max(at, 1u) - 1u] != key {
        list_start[key] = at;
    }
    if key < size.cells && (at + 1u == size.count || keys[min(at + 1u, size.count - 1u)] != key) {
        list_length[key] = at + 1u;
    }
}

@compute @workgroup_size(64)
fn sort_rank(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = linear_index(id);
    if at >= size.count {
        return;
    }
    let key = keys[at];
    let start = list_start[key];
    if key == size.cells {
        slot[order[at]] = 0u;
        return;
    }
    slot[order[at]] = at - start;
    // The first of a run alone turns its end into its length.
    if at == start {
        let length = list_length[key] - start;
        list_length[key] = length;
        // Few get past the look: most lists are not the longest.
        if length > atomicLoad(&counters[1]) {
            atomicMax(&counters[1], length);
        }
    }
}
