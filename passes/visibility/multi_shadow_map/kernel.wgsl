// A range of light samples, whose maps are the layers of `depth_map`: one comparison with each decides its bit.

struct LookupParams {
    sample_count: u32,
    // Of one light sample.
    face_count: u32,
    side: u32,
    // Words of a view-sample's mask.
    row_words: u32,
    bias_constant: f32,
    bias_slope: f32,
    normal_offset: f32,
    // First light sample of the range, and one past the last, all within one word of the mask.
    first: u32,
    end: u32,
}

@group(0) @binding(0) var<uniform> lookup: LookupParams;
@group(0) @binding(1) var depth_map: texture_depth_2d_array;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> normal: array<f32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read_write> mask: array<u32>;

@compute @workgroup_size(64)
fn multi_shadow_map(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row >= lookup.sample_count {
        return;
    }
    let state = sample_state[row];
    var bits = select(0xffffffffu, 0u, state == BACKGROUND || state == KEPT);
    if state == KEPT {
        let at = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
        let n = vec3<f32>(normal[3u * row], normal[3u * row + 1u], normal[3u * row + 2u]);
        // All light samples share their axes.
        var face = light_face(lookup.first * lookup.face_count);
        for (var sample = lookup.first; sample < lookup.end; sample++) {
            let first = sample * lookup.face_count;
            if lookup.face_count > 1u {
                face = light_face(light_face_of(at, first, lookup.face_count));
            } else {
                face.index = first;
                face.origin = light_origin(first);
            }
            let placed = lookup_place_on(face, at, n, first);
            let share = lookup_share(placed, placed.point.face - lookup.first * lookup.face_count, 1u);
            bits |= select(0u, 1u, share < 0.5) << (sample % 32u);
        }
    }
    let word = row * lookup.row_words + lookup.first / 32u;
    // The first range of a word starts it.
    if lookup.first % 32u != 0u {
        bits |= mask[word];
    }
    mask[word] = bits;
}
