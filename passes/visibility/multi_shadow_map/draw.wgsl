@group(0) @binding(0) var<uniform> face: vec4<u32>;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_frame: array<f32>;

@vertex
fn multi_shadow_map_draw(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return shadow_vertex(index, face.x);
}
