// The faces of every light sample, F of them each, one sample after another. Joined after light_fit.wgsl, whose `light_frame`
// they are and whose reduction has a group for each.

@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>; // behind
@group(0) @binding(7) var<storage, read> common_frame: array<f32>;

// The common axes, from where the light sample is.
@compute @workgroup_size(64)
fn multi_shadow_map_axes(@builtin(global_invocation_id) id: vec3<u32>) {
    let face = linear_index(id);
    if face >= size.light_count * size.face_count {
        return;
    }
    let pattern = face % size.face_count;
    for (var word = 0u; word < FACE_WORDS; word++) {
        light_frame[face * FACE_WORDS + word] = common_frame[pattern * FACE_WORDS + word];
    }
    store_vector(face, 0u, light_sample(face / size.face_count));
}

// Bounds of (u, v, depth) of every `invocations`-th view-sample on the faces of one light sample.
@compute @workgroup_size(64)
fn multi_shadow_map_windows(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= size.invocations * size.light_count {
        return;
    }
    let first_face = index / size.invocations * size.face_count;
    // Neighbours share a face: bounds are handed in when it changes.
    var face = light_face(first_face);
    var bounds = Bounds(vec3<f32>(0.0), vec3<f32>(0.0), true);
    var behind = 0u;
    for (var sample = index % size.invocations; sample < size.sample_count; sample += size.invocations) {
        if sample_state[sample] == KEPT {
            let at = position_of(sample);
            if size.face_count > 1u {
                let index = light_face_of(at, first_face, size.face_count);
                if index != face.index {
                    if !bounds.is_empty {
                        raise_bounds(1u + face.index, bounds);
                    }
                    face = light_face(index);
                    bounds.is_empty = true;
                }
            }
            let point = light_see(face, at);
            if point.depth > 0.0 {
                bounds = bounds_with(bounds, vec3<f32>(point.u, point.v, point.depth));
            } else {
                behind += 1u;
            }
        }
    }
    if !bounds.is_empty {
        raise_bounds(1u + face.index, bounds);
    }
    if behind > 0u {
        atomicAdd(&counters[0], behind);
    }
}

@compute @workgroup_size(64)
fn multi_shadow_map_fit(@builtin(global_invocation_id) id: vec3<u32>) {
    let face = linear_index(id);
    if face < size.light_count * size.face_count {
        fit(face);
    }
}
