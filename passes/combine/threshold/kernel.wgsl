// One invocation a view-sample.

@compute @workgroup_size(64)
fn threshold(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.count {
        return;
    }
    var lit = 1.0;
    if size.samples > 0u && sample_state[index] != BACKGROUND {
        let count = blocked_count(index);
        lit = select(1.0, 0.0, count >= size.samples - count);
    }
    visible[index] = lit;
}
