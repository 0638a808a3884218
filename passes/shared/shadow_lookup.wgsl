// Looking a view-sample up in the shadow map; the same operations in the same order as shadow_lookup.rs.
// Joined after light_frame.wgsl and shadow_map.wgsl; declares the bindings of every lookup.

const SLOPE_CAP: f32 = 64.0;

struct LookupParams {
    sample_count: u32,
    face_count: u32,
    side: u32,
    kernel: u32,
    bias_constant: f32,
    bias_slope: f32,
    normal_offset: f32,
}

@group(0) @binding(0) var<uniform> lookup: LookupParams;
@group(0) @binding(1) var depth_map: texture_depth_2d_array;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> normal: array<f32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read_write> mask: array<u32>;
@group(0) @binding(7) var<storage, read_write> visible: array<f32>;

// Share of kernel x kernel taps that see the light, 0..1.
fn lookup_visible(at: vec3<f32>, n: vec3<f32>, kernel: u32) -> f32 {
    let first = light_project(at, lookup.face_count);
    if !(first.depth > 0.0) {
        return 1.0;
    }
    let first_pitch = light_window(first.face).zw / f32(lookup.side);
    let toward = select(n, -n, light_dot(n, light_origin(first.face) - at) < 0.0);
    let texel_width = first.depth * max(first_pitch.x, first_pitch.y);
    let moved = at + toward * (lookup.normal_offset * texel_width);
    let point = light_project(moved, lookup.face_count);
    if !(point.depth > 0.0) {
        return 1.0;
    }
    let window = light_window(point.face);
    let pitch = window.zw / f32(lookup.side);
    let far = light_depth_range(point.face).y;

    // Growth of the plane's depth w = n . P / (n . (u x + v y + z)) over a texel in u and in v.
    let along = abs(light_dot(toward, moved - light_origin(point.face)) / point.depth);
    let across = abs(light_dot(toward, light_axis_x(point.face)) * pitch.x)
        + abs(light_dot(toward, light_axis_y(point.face)) * pitch.y);
    let width = point.depth * max(pitch.x, pitch.y);
    let growth = min(point.depth * across, SLOPE_CAP * width * along) / max(along, 1e-20);
    let bias = lookup.bias_constant + lookup.bias_slope * 0.5 * f32(kernel) * growth + depth_step(point.depth, far);

    let texel = floor((vec2<f32>(point.u, point.v) - window.xy) / pitch);
    let last = f32(lookup.side) - 1.0;
    let reach = f32(kernel / 2u);
    var lit = 0u;
    for (var tap = 0u; tap < kernel * kernel; tap++) {
        let at_tap = texel + vec2<f32>(f32(tap % kernel), f32(tap / kernel)) - reach;
        var seen = NOTHING_SEEN;
        if all(at_tap >= vec2<f32>(0.0)) && all(at_tap <= vec2<f32>(last)) {
            seen = linear_from_depth(textureLoad(depth_map, vec2<u32>(at_tap), point.face, 0u), far);
        }
        lit += select(0u, 1u, point.depth - bias <= seen);
    }
    return f32(lit) / f32(kernel * kernel);
}

// Writes one view-sample's share and mask.
fn lookup_write(row: u32, kernel: u32) {
    if row >= lookup.sample_count {
        return;
    }
    let state = sample_state[row];
    var share = 1.0;
    var bits = 0u;
    if state == KEPT {
        let at = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
        let n = vec3<f32>(normal[3u * row], normal[3u * row + 1u], normal[3u * row + 2u]);
        share = lookup_visible(at, n, kernel);
        bits = select(0u, 1u, share < 0.5);
    } else if state != BACKGROUND {
        share = 0.0;
        bits = 0xffffffffu;
    }
    visible[row] = share;
    mask[row] = bits;
}
