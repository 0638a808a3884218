// Joined after light_frame, predicate, pyramid, footprint and pair_walk, which it gives casters and their footprints.
@group(0) @binding(12) var<storage, read> triangles: array<f32>;
@group(0) @binding(13) var<storage, read> light_samples: array<f32>;

struct Caster {
    // Corners from the light sample.
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    pyramid: Pyramid,
    casts: bool,
}

alias Region = Footprint;

fn caster_of(triangle: u32) -> Caster {
    let light = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    let a = triangle_corner(triangle, 0u);
    let b = triangle_corner(triangle, 1u);
    let c = triangle_corner(triangle, 2u);
    return Caster(a - light, b - light, c - light, pyramid_of(a, b, c, light), !is_collapsed(a, b, c));
}

fn region_of(caster: Caster, face: u32) -> Region {
    return footprint_of(caster.pyramid, caster.a, caster.b, caster.c, face, numbers.side, true);
}

fn region_columns(region: ptr<function, Region>, row: u32) -> vec2<u32> {
    return footprint_columns(*region, row, numbers.side);
}

fn region_is_behind(region: ptr<function, Region>, far: f32, at: vec2<u32>) -> bool {
    return (*region).near > far;
}

@compute @workgroup_size(64)
fn binning(@builtin(global_invocation_id) id: vec3<u32>) {
    walk_caster(linear_index(id));
}

@compute @workgroup_size(64)
fn binning_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_row_queue(group, local);
}

@compute @workgroup_size(64)
fn binning_shares(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_share_queue(group, local);
}
