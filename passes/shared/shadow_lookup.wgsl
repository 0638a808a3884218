// Looking a view-sample up in the shadow map; the same operations in the same order as shadow_lookup.rs.
// Joined after light_frame.wgsl and shadow_map.wgsl. The kernel declares `depth_map`, a depth texture array, and a uniform
// `lookup` with at least face_count, side, bias_constant, bias_slope and normal_offset.

const SLOPE_CAP: f32 = 64.0;

// A view-sample moved along its normal, as a face sees it.
struct Placed {
    // Its depth is not above zero: no face sees it, which is lit.
    point: LightPoint,
    pitch: vec2<f32>,
    far: f32,
    toward: vec3<f32>,
    // Of the face's origin below the view-sample's plane, over its depth, absolute.
    along: f32,
    // A texel's larger side at the view-sample's depth.
    width: f32,
}

// Where the view-sample falls among the faces from `first` on.
fn lookup_place(at: vec3<f32>, n: vec3<f32>, first: u32) -> Placed {
    var placed: Placed;
    let unmoved = light_project_from(at, first, lookup.face_count);
    if !(unmoved.depth > 0.0) {
        return placed;
    }
    let first_pitch = light_window(unmoved.face).zw / f32(lookup.side);
    let toward = select(n, -n, light_dot(n, light_origin(unmoved.face) - at) < 0.0);
    let texel_width = unmoved.depth * max(first_pitch.x, first_pitch.y);
    let moved = at + toward * (lookup.normal_offset * texel_width);
    let point = light_project_from(moved, first, lookup.face_count);
    if !(point.depth > 0.0) {
        return placed;
    }
    placed.point = point;
    placed.pitch = light_window(point.face).zw / f32(lookup.side);
    placed.far = light_depth_range(point.face).y;
    placed.toward = toward;
    placed.along = abs(light_dot(toward, moved - light_origin(point.face)) / point.depth);
    placed.width = point.depth * max(placed.pitch.x, placed.pitch.y);
    return placed;
}

// Bias of a square of kernel x kernel texels, scene units.
fn lookup_bias(placed: Placed, kernel: u32) -> f32 {
    // Growth of the plane's depth w = n . P / (n . (u x + v y + z)) over a texel in u and in v.
    let face = placed.point.face;
    let across = abs(light_dot(placed.toward, light_axis_x(face)) * placed.pitch.x)
        + abs(light_dot(placed.toward, light_axis_y(face)) * placed.pitch.y);
    let depth = placed.point.depth;
    let growth = min(depth * across, SLOPE_CAP * placed.width * placed.along) / max(placed.along, 1e-20);
    return lookup.bias_constant + lookup.bias_slope * 0.5 * f32(kernel) * growth + depth_step(depth, placed.far);
}

// Depth that the map holds in a texel, given as whole numbers, of a layer; further than anything outside the map.
fn lookup_seen(texel: vec2<f32>, layer: u32, far: f32) -> f32 {
    if all(texel >= vec2<f32>(0.0)) && all(texel <= vec2<f32>(f32(lookup.side) - 1.0)) {
        return linear_from_depth(textureLoad(depth_map, vec2<u32>(texel), layer, 0u), far);
    }
    return NOTHING_SEEN;
}

// Share of kernel x kernel taps that see the light, 0..1, among the faces from `first` on, whose first lies in layer `layer`.
fn lookup_visible(at: vec3<f32>, n: vec3<f32>, first: u32, layer: u32, kernel: u32) -> f32 {
    let placed = lookup_place(at, n, first);
    let point = placed.point;
    if !(point.depth > 0.0) {
        return 1.0;
    }
    let bias = lookup_bias(placed, kernel);
    let texel = floor((vec2<f32>(point.u, point.v) - light_window(point.face).xy) / placed.pitch);
    let reach = f32(kernel / 2u);
    var lit = 0u;
    for (var tap = 0u; tap < kernel * kernel; tap++) {
        let at_tap = texel + vec2<f32>(f32(tap % kernel), f32(tap / kernel)) - reach;
        lit += select(0u, 1u, point.depth - bias <= lookup_seen(at_tap, layer + point.face - first, placed.far));
    }
    return f32(lit) / f32(kernel * kernel);
}
