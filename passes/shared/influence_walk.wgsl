// Joined after light_frame and pair_walk, which it gives casters and their influence regions from memory.
//
// A region there is 32 vectors: groups, near, least_q, reach; first and last column and row; rooms and pad; window; depths and slacks of
// two groups of planes; then u, v and one of each group of four lines. No groups: it touches nothing.
@group(0) @binding(12) var<storage, read> regions: array<vec4<f32>>;

const REGION_WORDS: u32 = 32u;
const PLANE_GROUPS: u32 = 2u;
const SLACK: f32 = 4e-6;

struct Caster {
    triangle: u32,
    casts: bool,
}

// Members as those of the region in influence.wgsl; lines stay where they are.
struct Region {
    touched: bool,
    start: u32,
    first: vec2<u32>,
    last: vec2<u32>,
    groups: u32,
    near: f32,
    least_q: f32,
    reach: f32,
    rooms: vec2<f32>,
    pad: vec2<f32>,
    window: vec4<f32>,
}

fn caster_of(triangle: u32) -> Caster {
    return Caster(triangle, true);
}

fn region_of(caster: Caster, face: u32) -> Region {
    var region: Region;
    region.start = (face * numbers.count + caster.triangle - numbers.first) * REGION_WORDS;
    let head = regions[region.start];
    region.touched = head.x > 0.0;
    if !region.touched {
        return region;
    }
    let box = vec4<u32>(regions[region.start + 1u]);
    let rounding = regions[region.start + 2u];
    region.first = box.xy;
    region.last = box.zw;
    region.groups = u32(head.x);
    region.near = head.y;
    region.least_q = head.z;
    region.reach = head.w;
    region.rooms = rounding.xy;
    region.pad = rounding.zw;
    region.window = regions[region.start + 3u];
    return region;
}

// Smallest and largest of a border texel's and an inner texel's coordinates along an axis.
fn region_extent(region: ptr<function, Region>, axis: u32, index: u32) -> vec2<f32> {
    let low = (*region).window[axis];
    let texel = (*region).window[axis + 2u];
    let pad = (*region).pad[axis];
    let start = low + (f32(index) - pad) * texel;
    let end = low + (f32(index) + 1.0 + pad) * texel;
    return vec2<f32>(
        select(start, min(start, -(*region).reach), index == 0u),
        select(end, max(end, (*region).reach), index + 1u == numbers.side),
    );
}

// First column touched in a row of the bounding box, and one past the last; equal when none is.
fn region_columns(region: ptr<function, Region>, row: u32) -> vec2<u32> {
    let v = region_extent(region, 1u, row);
    var left = -3e38;
    var right = 3e38;
    for (var group = 0u; group < (*region).groups; group++) {
        var slack = vec4<f32>(SLACK);
        var rest = regions[(*region).start + 10u + 3u * group];
        if group < PLANE_GROUPS {
            slack = regions[(*region).start + 6u + group];
            rest -= regions[(*region).start + 4u + group] * (*region).least_q;
        }
        let lift = regions[(*region).start + 9u + 3u * group];
        rest += slack + max(lift * v.x + slack * abs(v.x), lift * v.y + slack * abs(v.y));
        let u = regions[(*region).start + 8u + 3u * group];
        let turned = select(-slack, slack, rest < vec4<f32>(0.0));
        let is_left = u > 4.0 * slack;
        let is_right = u < -4.0 * slack;
        let lefts = select(vec4<f32>(-3e38), -rest / (u + turned), is_left);
        let rights = select(vec4<f32>(3e38), -rest / (u - turned), is_right);
        left = max(left, max(max(lefts.x, lefts.y), max(lefts.z, lefts.w)));
        right = min(right, min(min(rights.x, rights.y), min(rights.z, rights.w)));
        if any(!is_left & !is_right & (rest + 5.0 * slack * (*region).reach < vec4<f32>(0.0))) {
            return vec2<u32>(0u);
        }
    }
    let window = (*region).window;
    let pad = (*region).pad.x;
    if left > right || right < -(*region).reach || left > (*region).reach {
        return vec2<u32>(0u);
    }
    let end = f32(numbers.side) - 1.0;
    let first = max(u32(clamp(floor((left - window.x) / window.z - pad), 0.0, end)), (*region).first.x);
    let last = min(u32(clamp(floor((right - window.x) / window.z + pad), 0.0, end)), (*region).last.x);
    if first > last {
        return vec2<u32>(0u);
    }
    return vec2<u32>(first, last + 1u);
}

// Whether some plane of a group has all of the range of columns and rows before it. No loop: it runs once for every cell.
fn is_outside(region: ptr<function, Region>, group: u32, u: vec2<f32>, v: vec2<f32>, q: f32) -> bool {
    let line = (*region).start + 8u + 3u * group;
    let slope = regions[line];
    let lift = regions[line + 1u];
    let slack = regions[(*region).start + 6u + group];
    let along_u = max(slope * u.x + slack * abs(u.x), slope * u.y + slack * abs(u.y));
    let along_v = max(lift * v.x + slack * abs(v.x), lift * v.y + slack * abs(v.y));
    let value = along_u + along_v + regions[line + 2u] + slack;
    return any(value < regions[(*region).start + 4u + group] * q);
}

// Whether no view-sample of the cell at column and row `at`, whose largest depth is `far`, can be blocked.
fn region_is_behind(region: ptr<function, Region>, far: f32, at: vec2<u32>) -> bool {
    let border = any(at == vec2<u32>(0u)) || any(at + 1u == vec2<u32>(numbers.side));
    if (*region).near > far * select((*region).rooms.x, (*region).rooms.y, border) {
        return true;
    }
    let q = 1.0 / far;
    // The span has seen to it where the cell is as deep as the face.
    if q < 1.02 * (*region).least_q {
        return false;
    }
    let u = region_extent(region, 0u, at.x);
    let v = region_extent(region, 1u, at.y);
    return is_outside(region, 0u, u, v, q) || is_outside(region, 1u, u, v, q);
}

@compute @workgroup_size(64)
fn influence(@builtin(global_invocation_id) id: vec3<u32>) {
    walk_caster(linear_index(id));
}

@compute @workgroup_size(64)
fn influence_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_row_queue(group, local);
}

@compute @workgroup_size(64)
fn influence_shares(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    walk_share_queue(group, local);
}
