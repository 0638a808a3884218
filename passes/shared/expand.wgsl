// The outline of each caster on a face, grown on every side, as the six corners of a fan (Sintorn 2008, section 3.2, Figure 4; Hasselgren,
// Akenine-Moller, Ohlsson 2005). Joined after light_frame, predicate, pyramid and footprint.
//
// A square about each corner of the triangle is met by the grown lines of both its edges, each at the corner of the square that the
// edge's outward normal points to. Where those are opposite ones, both are moved on along their edges by the width of the square,
// which takes in the third. Casters that have no such outline get their box: those seen edge-on or nearly so, those that pass the
// plane beside the light, and those that reach beyond a window whose border texels hold view-samples from there.
struct Numbers {
    triangles: u32,
    face: u32,
    side: u32,
    // How far to grow, on top of what rounding asks for, texels.
    grow: f32,
    // 1: view-samples may lie beyond every window; 0: as `beyond` says.
    open: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read> light_frame: array<f32>;
// See fan.wgsl, which is joined too.
@group(0) @binding(5) var<storage, read_write> fans: array<f32>;
// For each face, 1 if view-samples lie beyond its window.
@group(0) @binding(6) var<storage, read> beyond: array<u32>;

// Least height of an outline, texels: some hundred times the rounding of its corners.
const LEAST_HEIGHT: f32 = 0.05;
// Windows that an outline may reach beyond its own on each side, where nothing lies there: corners are still exact enough.
const FAIR_WINDOWS: f32 = 4.0;
// Rasterisers snap corners to a 256th of a texel.
const SNAP: f32 = 1.0 / 128.0;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

struct Outline {
    corner: array<vec2<f32>, 3>,
    // 1 or -1: counter-clockwise or not; 0: to be drawn as a box.
    turn: f32,
}

// Corners of the triangle in texels.
fn outline_of(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, open: bool) -> Outline {
    let axis_x = light_axis_x(numbers.face);
    let axis_y = light_axis_y(numbers.face);
    let axis_z = light_axis_z(numbers.face);
    let window = light_window(numbers.face);
    let side = f32(numbers.side);
    let size = vec3<f32>(sum_of_sizes(a), sum_of_sizes(b), sum_of_sizes(c));
    let depth = vec3<f32>(dot(axis_z, a), dot(axis_z, b), dot(axis_z, c));
    let u = vec3<f32>(dot(axis_x, a), dot(axis_x, b), dot(axis_x, c)) / depth;
    let v = vec3<f32>(dot(axis_y, a), dot(axis_y, b), dot(axis_y, c)) / depth;
    let column = (u - window.x) / window.z * side;
    let row = (v - window.y) / window.w * side;
    var outline: Outline;
    outline.corner = array(vec2(column.x, row.x), vec2(column.y, row.y), vec2(column.z, row.z));
    let along = vec2(column.y - column.x, row.y - row.x);
    let other = vec2(column.z - column.x, row.z - row.x);
    let area = along.x * other.y - along.y * other.x;
    let longest = max(length(along), max(length(other), length(other - along)));
    let beyond = select(FAIR_WINDOWS * side, 0.0, open);
    let inside = least(min(column, row)) >= -beyond && most(max(column, row)) <= side + beyond;
    let fair = all(depth > 1e-3 * size) && inside && abs(area) > LEAST_HEIGHT * longest;
    outline.turn = select(0.0, sign(area), fair);
    return outline;
}

// 1 for zero too: either corner of the square is on the grown line then.
fn sides(v: vec2<f32>) -> vec2<f32> {
    return select(vec2<f32>(-1.0), vec2<f32>(1.0), v >= vec2<f32>(0.0));
}

// One of the two fan corners at corner `at` of the outline, texels.
fn grown_corner(outline: Outline, at: u32, second: bool, reach: vec2<f32>) -> vec2<f32> {
    var corners = outline.corner;
    let here = corners[at];
    let before = normalize(here - corners[(at + 2u) % 3u]);
    let after = normalize(corners[(at + 1u) % 3u] - here);
    let toward_before = sides(vec2<f32>(before.y, -before.x) * outline.turn);
    let toward_after = sides(vec2<f32>(after.y, -after.x) * outline.turn);
    let opposite = all(toward_before == -toward_after);
    let further = select(0.0, 2.0 * max(reach.x, reach.y), opposite);
    if second {
        return here + toward_after * reach - after * further;
    }
    return here + toward_before * reach + before * further;
}

fn clip_space(texel: vec2<f32>) -> vec2<f32> {
    return texel * vec2<f32>(2.0, -2.0) / f32(numbers.side) + vec2<f32>(-1.0, 1.0);
}

@compute @workgroup_size(64)
fn expand(@builtin(global_invocation_id) id: vec3<u32>) {
    let light = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    let triangle = linear_index(id);
    if triangle >= numbers.triangles {
        return;
    }
    let a = triangle_corner(triangle, 0u);
    let b = triangle_corner(triangle, 1u);
    let c = triangle_corner(triangle, 2u);
    let open = numbers.open != 0u || beyond[numbers.face] != 0u;
    let pyramid = pyramid_of(a, b, c, light);
    let print = footprint_of(pyramid, a - light, b - light, c - light, numbers.face, numbers.side, open);
    let drawn = caster_state[triangle] != 0u && light_valid(numbers.face) && print.touched && !is_collapsed(a, b, c);
    let outline = outline_of(a - light, b - light, c - light, open);
    let reach = numbers.grow + print.pad + SNAP;
    let low = vec2<f32>(print.first) + 0.25;
    let high = vec2<f32>(print.last) + 0.75;
    for (var corner = 0u; corner < 6u; corner++) {
        var texel = vec2<f32>(0.0);
        if drawn {
            // A box is a fan of its four corners, the last of them three times.
            texel = select(low, high, vec2<bool>(corner == 1u || corner == 2u, corner >= 2u));
            if outline.turn != 0.0 {
                texel = grown_corner(outline, corner / 2u, corner % 2u == 1u, reach);
            }
        }
        let place = clip_space(texel);
        fans[triangle * FAN + 2u * corner] = place.x;
        fans[triangle * FAN + 2u * corner + 1u] = place.y;
    }
    fans[triangle * FAN + FAN_NEAR] = print.near;
    let slope = select(-1.0 / print.turn, vec3<f32>(0.0), print.turn == vec3<f32>(0.0));
    for (var k = 0u; k < 3u; k++) {
        let start = triangle * FAN + FAN_LINES + 3u * k;
        fans[start] = slope[k];
        fans[start + 1u] = print.lift[k];
        // The most that padding adds, as if to every texel.
        fans[start + 2u] = print.rest[k] + abs(slope[k]) * print.pad.x + abs(print.lift[k]) * print.pad.y;
    }
}
