// The texels that a caster touches on a face of the light, row by row: never one too few (Sintorn 2008, section 3.2).
// Joined after light_frame.wgsl and pyramid.wgsl.
//
// Direction (u, v, 1) of a face meets the caster when dot(side_k, u x + v y + z) >= 0 for its three planes: linear functions of
// (u, v), right even where corners lie behind the light. They are kept in texels. Border texels reach to infinity, so columns and
// rows are clamped, not cut.

// A texel bound that no view-sample lies beyond.
const BEYOND: f32 = 1e12;

struct Footprint {
    // slope x column + lift x row + rest >= 0 in texels, for the three planes; rounding is in rest.
    lift: vec3<f32>,
    rest: vec3<f32>,
    // -1 / slope; 0 where the plane does not bound columns.
    turn: vec3<f32>,
    // First and last column and row of the bounding box.
    first: vec2<u32>,
    last: vec2<u32>,
    // How far a view-sample may be from where it belongs, texels.
    pad: vec2<f32>,
    // A view-sample at smaller depth along the face's axis cannot be blocked, scene units.
    near: f32,
    touched: bool,
}

// The footprint of the triangle with corners at `a`, `b`, `c` from the light.
// `open`: view-samples may lie beyond the window, in its border texels.
fn footprint_of(
    pyramid: Pyramid, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, face: u32, side: u32, open: bool,
) -> Footprint {
    var print: Footprint;
    print.touched = false;
    let axis_z = light_axis_z(face);
    let depth = vec3<f32>(dot(axis_z, a), dot(axis_z, b), dot(axis_z, c));
    let size = vec3<f32>(sum_of_sizes(a), sum_of_sizes(b), sum_of_sizes(c));
    if !any(depth >= -1e-6 * size) {
        return print;
    }
    let axis_x = light_axis_x(face);
    let axis_y = light_axis_y(face);
    let window = light_window(face);
    let texel = window.zw / f32(side);
    let far = light_depth_range(face).y;
    // Largest |u| and |v| in the window, and what bounds the sum of sizes of a direction in it.
    let reach = max(abs(window.xy), abs(window.xy + window.zw));
    let spread = 1.0 + reach.x + reach.y;
    print.near = min(depth.x, min(depth.y, depth.z)) - 1e-6 * (max(size.x, max(size.y, size.z)) + far * spread);
    // Farther than every view-sample.
    print.touched = print.near <= far;
    print.pad = light_uv_pad(reach.x, reach.y) / texel + 2e-3;

    // Columns and rows between the corners in front of the light; where an edge passes the plane beside the light, to infinity on
    // the side it passes on; all of them where a corner is close to that plane.
    let x = vec3<f32>(dot(axis_x, a), dot(axis_x, b), dot(axis_x, c));
    let y = vec3<f32>(dot(axis_y, a), dot(axis_y, b), dot(axis_y, c));
    let front = depth > 1e-3 * size;
    let beside = any(abs(depth) <= 1e-3 * size);
    let u = x / depth;
    let v = y / depth;
    let stray = light_uv_pad3(u, v);
    let passes = front != front.yzx;
    let passing_x = passage(x, depth, size);
    let passing_y = passage(y, depth, size);
    var low = vec2<f32>(
        least(select(vec3<f32>(BEYOND), u - stray, front)), least(select(vec3<f32>(BEYOND), v - stray, front)));
    var high = vec2<f32>(
        most(select(vec3<f32>(-BEYOND), u + stray, front)), most(select(vec3<f32>(-BEYOND), v + stray, front)));
    low = (low - window.xy) / texel - print.pad;
    high = (high - window.xy) / texel + print.pad;
    low.x = select(low.x, -BEYOND, beside || any(passes & (passing_x <= vec3<f32>(0.0))));
    low.y = select(low.y, -BEYOND, beside || any(passes & (passing_y <= vec3<f32>(0.0))));
    high.x = select(high.x, BEYOND, beside || any(passes & (passing_x >= vec3<f32>(0.0))));
    high.y = select(high.y, BEYOND, beside || any(passes & (passing_y >= vec3<f32>(0.0))));
    if !open && (any(high < vec2<f32>(0.0)) || any(low > vec2<f32>(f32(side)))) {
        print.touched = false;
    }
    let end = vec2<f32>(f32(side) - 1.0);
    print.first = vec2<u32>(clamp(floor(low), vec2<f32>(0.0), end));
    print.last = vec2<u32>(clamp(floor(high), vec2<f32>(0.0), end));

    let nx = vec3<f32>(dot(pyramid.side_0.xyz, axis_x), dot(pyramid.side_1.xyz, axis_x), dot(pyramid.side_2.xyz, axis_x));
    let ny = vec3<f32>(dot(pyramid.side_0.xyz, axis_y), dot(pyramid.side_1.xyz, axis_y), dot(pyramid.side_2.xyz, axis_y));
    let nz = vec3<f32>(dot(pyramid.side_0.xyz, axis_z), dot(pyramid.side_1.xyz, axis_z), dot(pyramid.side_2.xyz, axis_z));
    let slack = vec3<f32>(pyramid.side_0.w, pyramid.side_1.w, pyramid.side_2.w);
    let slope = nx * texel.x;
    print.lift = ny * texel.y;
    // Eight times the bound: products with the axes, the change to texels and the sums each cost no more than the normal did.
    print.rest = nz + nx * window.x + ny * window.y + 8.0 * spread * slack;
    let bounds = abs(slope) > vec3<f32>(1e-30);
    print.turn = select(vec3<f32>(0.0), vec3<f32>(-1.0) / slope, bounds);
    return print;
}

fn light_uv_pad3(u: vec3<f32>, v: vec3<f32>) -> vec3<f32> {
    return 1e-6 * (1.0 + u * u + v * v);
}

// Side, -1 or 1, on which each edge (from a corner to the next) passes the axis where its depth is zero; 0 where rounding hides it.
fn passage(x: vec3<f32>, depth: vec3<f32>, size: vec3<f32>) -> vec3<f32> {
    let crossing = x * depth.yzx - x.yzx * depth;
    let slack = 1e-6 * (size * abs(depth.yzx) + size.yzx * abs(depth));
    let side = sign(crossing) * sign(depth.yzx - depth);
    return select(side, vec3<f32>(0.0), abs(crossing) <= slack);
}

fn least(v: vec3<f32>) -> f32 {
    return min(v.x, min(v.y, v.z));
}

fn most(v: vec3<f32>) -> f32 {
    return max(v.x, max(v.y, v.z));
}

// First column touched in a row of the bounding box, and one past the last; equal when none is.
fn footprint_columns(print: Footprint, row: u32, side: u32) -> vec2<u32> {
    let low = select(f32(row) - print.pad.y, -BEYOND, row == 0u);
    let high = select(f32(row) + 1.0 + print.pad.y, BEYOND, row + 1u == side);
    // The most each function can be in the row, but for its term in the column.
    let most_of_row = print.rest + max(print.lift * low, print.lift * high);
    let bound = most_of_row * print.turn;
    let left = most(select(vec3<f32>(-BEYOND), bound, print.turn < vec3<f32>(0.0))) - print.pad.x;
    let right = least(select(vec3<f32>(BEYOND), bound, print.turn > vec3<f32>(0.0))) + print.pad.x;
    let none = any((print.turn == vec3<f32>(0.0)) & (most_of_row < vec3<f32>(0.0))) || left > right;
    // What lies beyond a border belongs to its column.
    let end = f32(side) - 1.0;
    let first = max(u32(clamp(floor(left), 0.0, end)), print.first.x);
    let last = min(u32(clamp(floor(right), 0.0, end)), print.last.x);
    if none || first > last {
        return vec2<u32>(0u);
    }
    return vec2<u32>(first, last + 1u);
}
