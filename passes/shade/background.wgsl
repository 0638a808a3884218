// Every pixel, before surfaces are put there: an imported list of view-samples need not name all.
@compute @workgroup_size(64)
fn shade_background(@builtin(global_invocation_id) id: vec3<u32>) {
    let at = linear_index(id);
    if at < params.pixel_count {
        store(at, params.background, 0.0);
    }
}
