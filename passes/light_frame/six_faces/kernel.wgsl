// Six faces along the world's axes, each fitted to its view-samples.

@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>; // behind
@group(0) @binding(7) var<uniform> choice: vec4<u32>; // whether to fit, 0, 0, 0

@compute @workgroup_size(64)
fn six_faces_axes(@builtin(global_invocation_id) id: vec3<u32>) {
    let face = linear_index(id);
    if face >= size.face_count {
        return;
    }
    let axis = face / 2u;
    let is_up = face % 2u == 0u;
    let next = (axis + 1u) % 3u;
    let last = (axis + 2u) % 3u;
    var axis_x = vec3<f32>(0.0);
    var axis_y = vec3<f32>(0.0);
    var axis_z = vec3<f32>(0.0);
    axis_x[select(last, next, is_up)] = 1.0;
    axis_y[select(next, last, is_up)] = 1.0;
    axis_z[axis] = select(-1.0, 1.0, is_up);
    store_axes(face, origin_of_light(), axis_x, axis_y, axis_z);
    store_window(face, vec2<f32>(-1.0), vec2<f32>(2.0));
    store_depth_range(face, 1.0, 2.0);
}

@compute @workgroup_size(64)
fn six_faces_window(@builtin(global_invocation_id) id: vec3<u32>) {
    let first = linear_index(id);
    if first >= size.invocations {
        return;
    }
    var behind = 0u;
    for (var sample = first; sample < size.sample_count; sample += size.invocations) {
        if sample_state[sample] == KEPT {
            let point = light_project(position_of(sample), size.face_count);
            if point.depth > 0.0 {
                let values = vec3<f32>(point.u, point.v, point.depth);
                raise_bounds(1u + point.face, Bounds(values, values, false));
            } else {
                behind += 1u;
            }
        }
    }
    if behind > 0u {
        atomicAdd(&counters[0], behind);
    }
}

@compute @workgroup_size(64)
fn six_faces_fit(@builtin(global_invocation_id) id: vec3<u32>) {
    let face = linear_index(id);
    if face >= size.face_count {
        return;
    }
    if choice.x != 0u {
        fit(face);
        return;
    }
    let bounds = bounds_of(1u + face);
    store_valid(face, !bounds.is_empty);
    if !bounds.is_empty {
        fit_depth(face, bounds);
    }
}
