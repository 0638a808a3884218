// One face with window, near and far fitted to the kept view-samples.

@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>; // behind

@compute @workgroup_size(64)
fn fitted_origin(@builtin(global_invocation_id) id: vec3<u32>) {
    if linear_index(id) == 0u {
        store_vector(0u, 0u, origin_of_light());
    }
}

@compute @workgroup_size(64)
fn fitted_directions(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < size.invocations {
        reduce_directions(index);
    }
}

@compute @workgroup_size(64)
fn fitted_axes(@builtin(global_invocation_id) id: vec3<u32>) {
    if linear_index(id) == 0u {
        let directions = bounds_of(0u);
        look(light_origin(0u), directions.low + directions.high);
    }
}

@compute @workgroup_size(64)
fn fitted_window(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < size.invocations {
        let behind = reduce_window(index);
        if behind > 0u {
            atomicAdd(&counters[0], behind);
        }
    }
}

@compute @workgroup_size(64)
fn fitted_fit(@builtin(global_invocation_id) id: vec3<u32>) {
    if linear_index(id) == 0u {
        fit(0u);
    }
}
