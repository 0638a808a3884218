// Fans in memory, and the vertex stage of draws over them. The kernel that joins this piece declares `fans: array<f32>`.

// Words a caster: six corners in clip space, all equal where nothing is to be drawn; the smallest depth that can be blocked; three lines of
// slope, lift and rest, see `Footprint`.
const FAN: u32 = 22u;
const FAN_NEAR: u32 = 12u;
const FAN_LINES: u32 = 13u;

struct Vertex {
    @builtin(position) position: vec4<f32>,
    @location(0) @interpolate(flat) triangle: u32,
}

// Twelve vertices an instance, one instance a caster: triangle k of the fan has corners 0, k + 1, k + 2.
@vertex
fn fan(@builtin(vertex_index) vertex: u32, @builtin(instance_index) triangle: u32) -> Vertex {
    let corner = select(vertex / 3u + vertex % 3u, 0u, vertex % 3u == 0u);
    let start = triangle * FAN + 2u * corner;
    return Vertex(vec4<f32>(fans[start], fans[start + 1u], 0.5, 1.0), triangle);
}

// Whether a fragment's texel is touched by the caster itself, not only by what was drawn for it; view-samples as far as `far` lie
// there. Border texels reach to infinity.
fn fragment_counts(vertex: Vertex, side: u32, far: f32) -> bool {
    let start = vertex.triangle * FAN;
    let texel = floor(vertex.position.xy);
    let last = f32(side) - 1.0;
    let low = select(texel, vec2<f32>(-1e12), texel == vec2<f32>(0.0));
    let high = select(texel + 1.0, vec2<f32>(1e12), texel == vec2<f32>(last));
    var counts = fans[start + FAN_NEAR] <= far;
    for (var k = 0u; k < 3u; k++) {
        let line = start + FAN_LINES + 3u * k;
        let most = max(fans[line] * low.x, fans[line] * high.x) + max(fans[line + 1u] * low.y, fans[line + 1u] * high.y);
        counts = counts && most + fans[line + 2u] >= 0.0;
    }
    return counts;
}

// Cell of a fragment.
fn fragment_cell(vertex: Vertex, face: u32, side: u32) -> u32 {
    return (face * side + u32(vertex.position.y)) * side + u32(vertex.position.x);
}
