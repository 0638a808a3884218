// Looking a view-sample up in the shadow map; the same operations in the same order as shadow_lookup.rs.
// Joined after light_frame.wgsl and shadow_map.wgsl. The kernel declares `depth_map`, a depth texture array, and a uniform
// `lookup` with at least face_count, side, bias_constant, bias_slope and normal_offset.

const SLOPE_CAP: f32 = 64.0;

// A view-sample moved along its normal, as a face sees it.
struct Placed {
    // Its depth is not above zero: no face sees it, which is lit.
    point: LightPoint,
    // Window of the face, and extent of a texel, in u and v.
    low: vec2<f32>,
    pitch: vec2<f32>,
    far: f32,
    toward: vec3<f32>,
    axis_x: vec3<f32>,
    axis_y: vec3<f32>,
    // Distance of the face's origin from the view-sample's plane, over its depth.
    along: f32,
    // A texel's larger side at the view-sample's depth.
    width: f32,
}

// Where the view-sample falls among the faces from `first` on, of which `face` is the one that sees it unmoved.
fn lookup_place_on(face: LightFace, at: vec3<f32>, n: vec3<f32>, first: u32) -> Placed {
    var placed: Placed;
    let toward = select(n, -n, light_dot(n, face.origin - at) < 0.0);
    var seen_by = face;
    var moved = at;
    if lookup.normal_offset != 0.0 {
        let depth = light_see(face, at).depth;
        if !(depth > 0.0) {
            return placed;
        }
        let pitch = light_window(face.index).zw / f32(lookup.side);
        moved = at + toward * (lookup.normal_offset * (depth * max(pitch.x, pitch.y)));
        if lookup.face_count > 1u {
            seen_by = light_face(light_face_of(moved, first, lookup.face_count));
        }
    }
    placed.point = light_see(seen_by, moved);
    let depth = placed.point.depth;
    if depth > 0.0 {
        let window = light_window(seen_by.index);
        placed.low = window.xy;
        placed.pitch = window.zw / f32(lookup.side);
        placed.far = light_depth_range(seen_by.index).y;
        placed.toward = toward;
        placed.axis_x = seen_by.axis_x;
        placed.axis_y = seen_by.axis_y;
        placed.along = abs(light_dot(toward, moved - seen_by.origin) / depth);
        placed.width = depth * max(placed.pitch.x, placed.pitch.y);
    }
    return placed;
}

// Where the view-sample falls among the faces from `first` on.
fn lookup_place(at: vec3<f32>, n: vec3<f32>, first: u32) -> Placed {
    var index = first;
    if lookup.face_count > 1u {
        index = light_face_of(at, first, lookup.face_count);
    }
    return lookup_place_on(light_face(index), at, n, first);
}

// Bias of a square of kernel x kernel texels, scene units.
fn lookup_bias(placed: Placed, kernel: u32) -> f32 {
    // Growth of the plane's depth w = n . P / (n . (u x + v y + z)) over a texel in u and in v.
    let across = abs(light_dot(placed.toward, placed.axis_x) * placed.pitch.x)
        + abs(light_dot(placed.toward, placed.axis_y) * placed.pitch.y);
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

// Share of kernel x kernel taps that see the light, 0..1; the face that placed it lies in layer `layer`.
fn lookup_share(placed: Placed, layer: u32, kernel: u32) -> f32 {
    let point = placed.point;
    if !(point.depth > 0.0) {
        return 1.0;
    }
    let bias = lookup_bias(placed, kernel);
    let texel = floor((vec2<f32>(point.u, point.v) - placed.low) / placed.pitch);
    let reach = f32(kernel / 2u);
    var lit = 0u;
    for (var tap = 0u; tap < kernel * kernel; tap++) {
        let at_tap = texel + vec2<f32>(f32(tap % kernel), f32(tap / kernel)) - reach;
        lit += select(0u, 1u, point.depth - bias <= lookup_seen(at_tap, layer, placed.far));
    }
    return f32(lit) / f32(kernel * kernel);
}
