@group(0) @binding(0) var<uniform> face: vec4<u32>;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_frame: array<f32>;
@group(0) @binding(4) var first: texture_depth_2d_array;

@vertex
fn second_surface(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return shadow_vertex(index, face.x);
}

// Lets only what lies behind the nearest surface be written.
@fragment
fn second_surface_behind(@builtin(position) position: vec4<f32>) {
    if position.z <= textureLoad(first, vec2<u32>(position.xy), 0u, 0u) + SECOND_STEP {
        discard;
    }
}
