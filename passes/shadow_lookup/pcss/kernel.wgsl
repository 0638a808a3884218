// Blockers, penumbra, filter; the same operations in the same order as cpu.rs. Joined after shadow_lookup.wgsl.

struct PcssParams {
    sample_count: u32,
    face_count: u32,
    side: u32,
    light_count: u32,
    bias_constant: f32,
    bias_slope: f32,
    normal_offset: f32,
    nearest_blocker: f32,
    largest_width: f32,
    search_taps: u32,
    filter_taps: u32,
    unused: u32,
    // Two taps of the unit disc in each: those of the search, from 128 on those of the filter.
    taps: array<vec4<f32>, 256>,
}

@group(0) @binding(0) var<uniform> lookup: PcssParams;
@group(0) @binding(1) var depth_map: texture_depth_2d_array;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> normal: array<f32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read> light: array<f32>;
@group(0) @binding(7) var<storage, read_write> mask: array<u32>;
@group(0) @binding(8) var<storage, read_write> visible: array<f32>;

const FILTER_FIRST: u32 = 256u;

fn tap_of_disc(tap: u32) -> vec2<f32> {
    let two = lookup.taps[tap / 2u];
    return select(two.xy, two.zw, tap % 2u == 1u);
}

// Depth the map holds at `offset` from the receiver, where that is nearer to the light than the receiver's plane there; further
// than anything where it is not.
fn blocker(placed: Placed, bias: f32, slope: vec2<f32>, offset: vec2<f32>) -> f32 {
    let point = placed.point;
    let texel = floor((vec2<f32>(point.u, point.v) + offset - placed.low) / placed.pitch);
    let seen = lookup_seen(texel, point.face, placed.far);
    // The receiver's plane at the tap, within the cap of a slope.
    let texels = abs(offset.x / placed.pitch.x) + abs(offset.y / placed.pitch.y);
    let cap = SLOPE_CAP * placed.width * texels;
    let nearness = 1.0 / point.depth + slope.x * offset.x + slope.y * offset.y;
    var plane = point.depth + cap;
    if nearness > 0.0 {
        plane = clamp(1.0 / nearness, point.depth - cap, point.depth + cap);
    }
    return select(NOTHING_SEEN, seen, seen < plane - bias);
}

// Share of the light that the view-sample sees, 0..1.
fn pcss_visible(at: vec3<f32>, n: vec3<f32>) -> f32 {
    let placed = lookup_place(at, n, 0u);
    let depth = placed.point.depth;
    if !(depth > 0.0) {
        return 1.0;
    }
    let face = placed.point.face;
    let height = max(abs(light_dot(placed.toward, light_origin(face) - at)), 1e-20);
    let slope = -vec2<f32>(light_dot(placed.toward, placed.axis_x), light_dot(placed.toward, placed.axis_y)) / height;
    let bias = lookup_bias(placed, 1u);
    let largest = lookup.largest_width * light_window(face).zw;
    let light_radius = light[3];

    let reach = min(vec2<f32>(light_radius * (1.0 / (lookup.nearest_blocker * depth) - 1.0 / depth)), largest);
    var sum = 0.0;
    var count = 0u;
    for (var tap = 0u; tap < lookup.search_taps; tap++) {
        let found = blocker(placed, bias, slope, reach * tap_of_disc(tap));
        if found < NOTHING_SEEN {
            sum += found;
            count += 1u;
        }
    }
    if count == 0u {
        return 1.0;
    }
    let penumbra = max(light_radius * (1.0 / (sum / f32(count)) - 1.0 / depth), 0.0);
    let width = max(min(vec2<f32>(penumbra), largest), 0.5 * placed.pitch);
    var lit = 0u;
    for (var tap = 0u; tap < lookup.filter_taps; tap++) {
        let found = blocker(placed, bias, slope, width * tap_of_disc(FILTER_FIRST + tap));
        lit += select(1u, 0u, found < NOTHING_SEEN);
    }
    return f32(lit) / f32(lookup.filter_taps);
}

@compute @workgroup_size(64)
fn pcss(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row >= lookup.sample_count {
        return;
    }
    let state = sample_state[row];
    let row_words = (lookup.light_count + 31u) / 32u;
    var share = 1.0;
    var blocked = 0u;
    if state == KEPT {
        let at = vec3<f32>(position[3u * row], position[3u * row + 1u], position[3u * row + 2u]);
        let n = vec3<f32>(normal[3u * row], normal[3u * row + 1u], normal[3u * row + 2u]);
        share = pcss_visible(at, n);
        blocked = u32(floor((1.0 - share) * f32(lookup.light_count) + 0.5));
    } else if state != BACKGROUND {
        share = 0.0;
        blocked = 32u * row_words;
    }
    visible[row] = share;
    // So many of the lowest bits.
    for (var word = 0u; word < row_words; word++) {
        let bits = max(blocked, 32u * word) - 32u * word;
        mask[row * row_words + word] = select((1u << (bits & 31u)) - 1u, 0xffffffffu, bits >= 32u);
    }
}
