// One invocation a triangle. (`all` is a word of WGSL itself, hence the longer name.)

@group(0) @binding(0) var<uniform> size: vec4<u32>; // triangles, 0, 0, 0
@group(0) @binding(1) var<storage, read_write> caster_state: array<u32>;

@compute @workgroup_size(64)
fn all_casters(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < size.x {
        caster_state[index] = 1u;
    }
}
