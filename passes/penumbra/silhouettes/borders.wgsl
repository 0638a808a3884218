// Influence regions of a range of borders into memory, one invocation for each and each face. Border 4 t + k is edge k of triangle t,
// and triangle t itself for k = 3. Joined after light_frame, face_light, hull, influence, influence_store and whole_side.
struct Numbers {
    triangles: u32,
    faces: u32,
    side: u32,
    // Borders of this dispatch: the first, and how many.
    first: u32,
    count: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(4) var<storage, read> light_frame: array<f32>;
@group(0) @binding(6) var<storage, read> triangle_across: array<u32>;
@group(0) @binding(7) var<storage, read> light_box: array<vec4<f32>>;
// 1 for each of all borders that there is.
@group(0) @binding(8) var<storage, read_write> border_state: array<u32>;
// Edges, silhouette edges, cut triangles, and others' counts.
@group(0) @binding(9) var<storage, read_write> counters: array<atomic<u32>, 6>;

const WHOLE: u32 = 3u;

fn corner_of(triangle: u32, corner: u32) -> vec3<f32> {
    let start = triangle * 9u + corner * 3u;
    return vec3<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u]);
}

fn side_of(triangle: u32) -> f32 {
    return whole_side(corner_of(triangle, 0u), corner_of(triangle, 1u), corner_of(triangle, 2u));
}

// Whether there is border `k` of a casting triangle; counted once.
fn is_border(triangle: u32, k: u32, counts: bool) -> bool {
    let side = side_of(triangle);
    if k == WHOLE {
        if counts && side == 0.0 {
            atomicAdd(&counters[2], 1u);
        }
        return side == 0.0;
    }
    let other = triangle_across[3u * triangle + k];
    // The other of two tells of their edge.
    if other != NO_TRIANGLE && other < triangle {
        return false;
    }
    var is_silhouette = true;
    if other != NO_TRIANGLE {
        let beyond = side_of(other);
        is_silhouette = beyond == 0.0 || beyond != side;
    }
    if counts {
        atomicAdd(&counters[0], 1u);
        if is_silhouette {
            atomicAdd(&counters[1], 1u);
        }
    }
    return is_silhouette;
}

@compute @workgroup_size(64)
fn border_regions(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= numbers.count * numbers.faces {
        return;
    }
    let face = index / numbers.count;
    let border = numbers.first + index % numbers.count;
    let triangle = border / 4u;
    let k = border % 4u;
    clear_region(index);
    var found = caster_state[triangle] != 0u;
    if found {
        found = is_border(triangle, k, face == 0u);
    }
    if face == 0u {
        border_state[border] = u32(found);
    }
    if !found || !light_valid(face) {
        return;
    }
    let origin = light_origin(0u);
    let a = corner_of(triangle, k % 3u) - origin;
    let b = corner_of(triangle, (k + 1u) % 3u) - origin;
    // An edge is a triangle with two corners in one place.
    let c = select(b, corner_of(triangle, 2u) - origin, k == WHOLE);
    var caster = caster_at(a, b, c, true, true);
    var region = influence_region(&caster, face, numbers.faces, numbers.side, false);
    if region.touched {
        store_region(index, &region);
    }
}
