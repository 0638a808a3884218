// Influence regions of a range of casters into memory, one invocation for each caster and face. Joined after light_frame, face_light,
// hull and influence.
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
// See kernel.wgsl, which reads them.
@group(0) @binding(5) var<storage, read_write> regions: array<vec4<f32>>;

const QUAD: u32 = 1u;
const CUT: u32 = 2u;
const REGION_WORDS: u32 = 32u;

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
    let start = index * REGION_WORDS;
    regions[start] = vec4<f32>(0.0);
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
    if !region.touched {
        return;
    }
    regions[start] = vec4<f32>(f32(region.groups), region.near, region.least_q, region.reach);
    regions[start + 1u] = vec4<f32>(vec2<f32>(region.first), vec2<f32>(region.last));
    regions[start + 2u] = vec4<f32>(region.rooms, region.pad);
    regions[start + 3u] = region.window;
    for (var group = 0u; group < PLANE_GROUPS; group++) {
        regions[start + 4u + group] = region.depth[group];
        regions[start + 6u + group] = region.slack[group];
    }
    for (var group = 0u; group < region.groups; group++) {
        regions[start + 8u + 3u * group] = region.u[group];
        regions[start + 9u + 3u * group] = region.v[group];
        regions[start + 10u + 3u * group] = region.one[group];
    }
}
