// One invocation a view-sample.

@compute @workgroup_size(64)
fn popcount(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.count {
        return;
    }
    var fraction = 1.0;
    if size.samples > 0u && sample_state[index] != BACKGROUND {
        fraction = f32(size.samples - blocked_count(index)) / f32(size.samples);
    }
    visible[index] = fraction;
}
