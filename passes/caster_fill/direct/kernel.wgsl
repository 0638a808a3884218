// One invocation a pair.

@group(0) @binding(4) var<storage, read> pair_caster: array<u32>;
@group(0) @binding(5) var<storage, read_write> caster_entries: array<u32>;

@compute @workgroup_size(64)
fn direct(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    // Past the number of pairs, rows are undefined.
    if index >= min(size.rows, offset[size.cells]) {
        return;
    }
    let place = table_place(index);
    if place != NO_PLACE {
        caster_entries[place] = pair_caster[index];
    }
}
