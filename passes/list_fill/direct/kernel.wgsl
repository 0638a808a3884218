// One invocation a view-sample.

@group(0) @binding(4) var<storage, read_write> list_entries: array<u32>;

@compute @workgroup_size(64)
fn direct(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.rows {
        return;
    }
    let place = table_place(index);
    if place != NO_PLACE {
        list_entries[place] = index;
    }
}
