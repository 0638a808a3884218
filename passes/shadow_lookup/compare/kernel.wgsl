@compute @workgroup_size(64)
fn compare(@builtin(global_invocation_id) id: vec3<u32>) {
    lookup_write(linear_index(id), 1u);
}
