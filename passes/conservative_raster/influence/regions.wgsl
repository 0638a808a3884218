// Influence regions of a range of casters into memory, one invocation for each caster and face. Joined after light_frame, face_light,
// hull, influence and influence_store.
struct Numbers {
    triangles: u32,
    faces: u32,
    side: u32,
    choice: u32,
    // Casters of this dispatch: the first, and how many.
    first: u32,
    count: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(4) var<storage, read> light_frame: array<f32>;

const QUAD: u32 = 1u;
const CUT: u32 = 2u;

fn corner_from_light(triangle: u32, corner: u32) -> vec3<f32> {
    let start = triangle * 9u + corner * 3u;
    return vec3<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u]) - light_origin(0u);
}

fn has(choice: u32) -> bool {
    return (numbers.choice & choice) != 0u;
}

@compute @workgroup_size(64)
fn influence_regions(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= numbers.count * numbers.faces {
        return;
    }
    let face = index / numbers.count;
    let triangle = numbers.first + index % numbers.count;
    clear_region(index);
    if caster_state[triangle] == 0u || !light_valid(face) {
        return;
    }
    let a = corner_from_light(triangle, 0u);
    let b = corner_from_light(triangle, 1u);
    let c = corner_from_light(triangle, 2u);
    if all(a == b) || all(b == c) || all(c == a) {
        return;
    }
    var caster = caster_at(a, b, c, has(CUT), !has(QUAD));
    var region = influence_region(&caster, face, numbers.faces, numbers.side, has(QUAD));
    if region.touched {
        store_region(index, &region);
    }
}
