// One face that sees the scene's whole bounding box.

@group(0) @binding(6) var<storage, read_write> counters: array<atomic<u32>>; // behind
@group(0) @binding(7) var<storage, read> scene_bounds: array<f32>;

@compute @workgroup_size(64)
fn whole_corners(@builtin(global_invocation_id) id: vec3<u32>) {
    if linear_index(id) != 0u {
        return;
    }
    let low = vec3<f32>(scene_bounds[0], scene_bounds[1], scene_bounds[2]);
    let high = vec3<f32>(scene_bounds[3], scene_bounds[4], scene_bounds[5]);
    let origin = origin_of_light();
    look(origin, 0.5 * low + 0.5 * high - origin);
    var bounds = Bounds(vec3<f32>(0.0), vec3<f32>(0.0), true);
    var all_in_front = true;
    for (var corner = 0u; corner < 8u; corner++) {
        let is_high = vec3<bool>((corner & 1u) != 0u, (corner & 2u) != 0u, (corner & 4u) != 0u);
        let point = light_project(select(low, high, is_high), 1u);
        if point.depth > 0.0 {
            bounds = bounds_with(bounds, vec3<f32>(point.u, point.v, point.depth));
        } else {
            all_in_front = false;
        }
    }
    if bounds.is_empty {
        return;
    }
    let nearest = size.nearest * bounds.high.z;
    if all_in_front {
        bounds.low.z = max(bounds.low.z, nearest);
        fit_window(0u, bounds);
    } else {
        bounds.low.z = nearest;
    }
    fit_depth(0u, bounds);
}

@compute @workgroup_size(64)
fn whole_depths(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < size.invocations {
        let behind = reduce_window(index);
        if behind > 0u {
            atomicAdd(&counters[0], behind);
        }
    }
}

@compute @workgroup_size(64)
fn whole_fit(@builtin(global_invocation_id) id: vec3<u32>) {
    if linear_index(id) != 0u {
        return;
    }
    let scene = light_depth_range(0u);
    let bounds = bounds_of(1u);
    store_valid(0u, !bounds.is_empty);
    if !bounds.is_empty {
        fit_depth(0u, bounds);
        let samples = light_depth_range(0u);
        store_depth_range(0u, min(scene.x, samples.x), max(scene.y, samples.y));
    }
}
