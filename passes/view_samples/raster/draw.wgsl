// Writes the number of the nearest triangle to each pixel.
//
// The depth buffer holds half of depth / farthest depth: linear, and as a float equally precise at every distance, which the
// usual hyperbolic depth with a near plane this close would not be. Half, as the farthest must still be less than the clear 1.

@group(0) @binding(0) var<storage, read> triangles: array<f32>;
@group(0) @binding(1) var<storage, read> camera: array<f32>;
@group(0) @binding(2) var<storage, read> farthest: array<u32>; // one word: bits of a float

// The near plane, as a share of the farthest depth.
const NEAR: f32 = 1e-6;

struct Corner {
    @builtin(position) clip: vec4<f32>,
    @location(0) depth: f32,
    @location(1) @interpolate(flat) triangle: u32,
}

struct Seen {
    @location(0) triangle: u32,
    @builtin(frag_depth) depth: f32,
}

@vertex
fn raster_vertex(@builtin(vertex_index) vertex: u32) -> Corner {
    let word = 3u * vertex;
    let offset = vec3<f32>(triangles[word], triangles[word + 1u], triangles[word + 2u]) - camera_eye();
    let depth = dot(camera_forward(), offset);
    let across = vec2<f32>(dot(camera_right(), offset), dot(camera_up(), offset)) / camera_tan();
    // The clip volume 0 <= z <= w starts at the near plane and has no end.
    let beyond_near = depth - NEAR * bitcast<f32>(farthest[0]);
    return Corner(vec4<f32>(across, beyond_near, depth), depth, vertex / 3u);
}

@fragment
fn raster_fragment(corner: Corner) -> Seen {
    return Seen(corner.triangle, clamp(0.5 * corner.depth / bitcast<f32>(farthest[0]), 0.0, 0.75));
}
