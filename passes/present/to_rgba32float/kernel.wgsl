// Copies the picture to a texture.

@group(0) @binding(0) var<uniform> size: vec4<u32>; // columns, 0, 0, 0
@group(0) @binding(1) var<storage, read> image: array<f32>;

// One triangle whose lower left quarter is the texture.
@vertex
fn to_rgba32float_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4<f32> {
    let corner = vec2<f32>(f32(vertex & 1u), f32(vertex >> 1u));
    return vec4<f32>(4.0 * corner - 1.0, 0.0, 1.0);
}

@fragment
fn to_rgba32float(@builtin(position) texel: vec4<f32>) -> @location(0) vec4<f32> {
    let word = 4u * (u32(texel.y) * size.x + u32(texel.x));
    return vec4<f32>(image[word], image[word + 1u], image[word + 2u], image[word + 3u]);
}
