// Joined after light_frame, face_light, hull, influence and pair_walk, which it gives casters and their influence regions.
const QUAD: u32 = 1u;
const CUT: u32 = 2u;

fn corner_from_light(triangle: u32, corner: u32) -> vec3<f32> {
    let start = triangle * 9u + corner * 3u;
    return vec3<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u]) - light_origin(0u);
}

fn has(choice: u32) -> bool {
    return (numbers.choice & choice) != 0u;
}

fn caster_of(triangle: u32) -> Caster {
    let a = corner_from_light(triangle, 0u);
    let b = corner_from_light(triangle, 1u);
    let c = corner_from_light(triangle, 2u);
    return caster_at(a, b, c, has(CUT), !has(QUAD));
}

fn region_of(caster: Caster, face: u32) -> Region {
    var own = caster;
    return influence_region(&own, face, numbers.faces, numbers.side, has(QUAD));
}

fn region_columns(region: ptr<function, Region>, row: u32) -> vec2<u32> {
    return influence_columns(region, row, numbers.side);
}

fn region_is_behind(region: ptr<function, Region>, far: f32, at: vec2<u32>) -> bool {
    return influence_is_behind(region, far, at, numbers.side);
}

@compute @workgroup_size(64)
fn influence(@builtin(global_invocation_id) id: vec3<u32>) {
    walk_caster(linear_index(id));
}

@compute @workgroup_size(64)
fn influence_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_row_queue(group, local);
}

@compute @workgroup_size(64)
fn influence_shares(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_share_queue(group, local);
}
