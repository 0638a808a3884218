// Influence regions into memory, as influence_walk.wgsl reads them. Joined after influence.
@group(0) @binding(5) var<storage, read_write> regions: array<vec4<f32>>;

const REGION_WORDS: u32 = 32u;

// Region `index`, to begin with: it touches nothing.
fn clear_region(index: u32) {
    regions[index * REGION_WORDS] = vec4<f32>(0.0);
}

fn store_region(index: u32, region: ptr<function, Region>) {
    let start = index * REGION_WORDS;
    regions[start] = vec4<f32>(f32((*region).groups), (*region).near, (*region).least_q, (*region).reach);
    regions[start + 1u] = vec4<f32>(vec2<f32>((*region).first), vec2<f32>((*region).last));
    regions[start + 2u] = vec4<f32>((*region).rooms, (*region).pad);
    regions[start + 3u] = (*region).window;
    for (var group = 0u; group < PLANE_GROUPS; group++) {
        regions[start + 4u + group] = (*region).depth[group];
        regions[start + 6u + group] = (*region).slack[group];
    }
    for (var group = 0u; group < (*region).groups; group++) {
        regions[start + 8u + 3u * group] = (*region).u[group];
        regions[start + 9u + 3u * group] = (*region).v[group];
        regions[start + 10u + 3u * group] = (*region).one[group];
    }
}
