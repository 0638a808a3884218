// Corners of triangles in three vectors, which devices read in three steps. Joined after the prelude.
@group(0) @binding(0) var<uniform> count: u32;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
// w of the first: 1 where it casts.
@group(0) @binding(3) var<storage, read_write> casters: array<vec4<f32>>;

@compute @workgroup_size(64)
fn soft_casters(@builtin(global_invocation_id) id: vec3<u32>) {
    let triangle = linear_index(id);
    if triangle >= count {
        return;
    }
    for (var corner = 0u; corner < 3u; corner++) {
        let start = 9u * triangle + 3u * corner;
        let casts = select(0.0, 1.0, corner == 0u && caster_state[triangle] != 0u);
        casters[3u * triangle + corner] = vec4<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u], casts);
    }
}
