// Joined after light_frame, predicate, pyramid and footprint. Which of four ways a caster's work goes depends on the view-samples and rows
// under it: tested by one invocation; by eight that share out its rows; by several workgroups, every invocation in every row; and
// once more, by eight, where f32 left a doubt. So no invocation comes near the loop limit, and neighbours in a SIMD group do like
// work. Software rasterisers run both sides of every branch, so the costly decision is kept out of the common loops.
struct Numbers {
    triangles: u32,
    faces: u32,
    side: u32,
    // Workgroups for a caster of the third kind.
    shares: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_frame: array<f32>;
@group(0) @binding(4) var<storage, read> light_samples: array<f32>;
@group(0) @binding(5) var<storage, read> list_offset: array<u32>;
@group(0) @binding(6) var<storage, read> list_entries: array<u32>;
@group(0) @binding(7) var<storage, read> position: array<f32>;
@group(0) @binding(8) var<storage, read> own_triangle: array<u32>;
// In list order: a `Sample`, and whether it is blocked.
@group(0) @binding(9) var<storage, read> packed: array<vec4<u32>>;
@group(0) @binding(10) var<storage, read_write> blocked: array<atomic<u32>>;
// Casters left to other kernels, as face * triangles + triangle: four queues of faces * triangles words. A caster is in each at
// most once for each face.
@group(0) @binding(11) var<storage, read_write> queue: array<atomic<u32>>;
// Casters in each queue; from word OPEN on, for each face, 1 if view-samples lie beyond its window.
@group(0) @binding(12) var<storage, read_write> queued: array<atomic<u32>>;
// Number of doubtful pairs that were decided.
@group(0) @binding(13) var<storage, read_write> counters: array<atomic<u32>>;

const OPEN: u32 = 4u;
const ROWS: u32 = 0u;
const SHARES: u32 = 1u;
const ROW_DOUBTS: u32 = 2u;
const SHARE_DOUBTS: u32 = 3u;
// View-samples and rows that one invocation tests itself, at most.
const OWN_SAMPLES: u32 = 256u;
const OWN_ROWS: u32 = 16u;
// View-samples that one invocation tests in a shared caster, at most.
const ROW_SAMPLES: u32 = 2048u;
// Invocations for a caster whose rows are shared out.
const ROW_LANES: u32 = 8u;
// Marks in a queue: the caster is in a later queue too.
const IN_SHARES: u32 = 0x80000000u;
const IN_DOUBTS: u32 = 0x40000000u;
const ITEM: u32 = 0x3fffffffu;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

fn light_sample() -> vec3<f32> {
    return vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
}

// First list entry of a row's touched columns, and one past the last.
fn row_entries(print: Footprint, face: u32, row: u32) -> vec2<u32> {
    let columns = footprint_columns(print, row, numbers.side);
    let start = (face * numbers.side + row) * numbers.side;
    return vec2<u32>(list_offset[start + columns.x], list_offset[start + columns.y]);
}

struct Caster {
    face: u32,
    triangle: u32,
    light: vec3<f32>,
    pyramid: Pyramid,
    print: Footprint,
}

fn caster_of(item: u32) -> Caster {
    var caster: Caster;
    caster.face = item / numbers.triangles;
    caster.triangle = item % numbers.triangles;
    caster.light = light_sample();
    let a = triangle_corner(caster.triangle, 0u);
    let b = triangle_corner(caster.triangle, 1u);
    let c = triangle_corner(caster.triangle, 2u);
    let open = atomicLoad(&queued[OPEN + caster.face]) != 0u;
    caster.pyramid = pyramid_of(a, b, c, caster.light);
    caster.print = footprint_of(
        caster.pyramid, a - caster.light, b - caster.light, c - caster.light, caster.face, numbers.side, open);
    return caster;
}

fn verdict(pyramid: Pyramid, triangle: u32, entry: u32) -> u32 {
    let words = packed[entry];
    let found = pyramid_verdict(pyramid, triangle, Sample(bitcast<vec3<f32>>(words.xyz), words.w));
    if found == BLOCKED {
        // Casters combine by OR.
        atomicStore(&blocked[entry], 1u);
    }
    return found;
}

fn push(kind: u32, item: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.faces * numbers.triangles + place], item);
}

@compute @workgroup_size(64)
fn fused(@builtin(global_invocation_id) id: vec3<u32>) {
    let light = light_sample();
    let triangle = linear_index(id);
    if triangle >= numbers.triangles || caster_state[triangle] == 0u {
        return;
    }
    let a = triangle_corner(triangle, 0u);
    let b = triangle_corner(triangle, 1u);
    let c = triangle_corner(triangle, 2u);
    if is_collapsed(a, b, c) {
        return;
    }
    let pyramid = pyramid_of(a, b, c, light);
    for (var face = 0u; face < numbers.faces; face++) {
        if !light_valid(face) {
            continue;
        }
        let open = atomicLoad(&queued[OPEN + face]) != 0u;
        let print = footprint_of(pyramid, a - light, b - light, c - light, face, numbers.side, open);
        if !print.touched {
            continue;
        }
        let start = face * numbers.side * numbers.side;
        let begin = list_offset[start + print.first.y * numbers.side + print.first.x];
        if list_offset[start + print.last.y * numbers.side + print.last.x + 1u] == begin {
            continue;
        }
        var left = OWN_SAMPLES;
        var doubt = false;
        var row = print.first.y;
        if print.last.y - print.first.y < OWN_ROWS {
            for (; row <= print.last.y; row++) {
                let entries = row_entries(print, face, row);
                if entries.y - entries.x > left {
                    break;
                }
                left -= entries.y - entries.x;
                for (var entry = entries.x; entry < entries.y; entry++) {
                    doubt |= verdict(pyramid, triangle, entry) == DOUBTFUL;
                }
            }
        }
        let unfinished = row <= print.last.y;
        if unfinished || doubt {
            push(select(ROW_DOUBTS, ROWS, unfinished), face * numbers.triangles + triangle);
        }
    }
}

// Tests rows first_row, first_row + row_step, ... and in each its entries from first_entry on in steps, up to ROW_SAMPLES of them.
// Marks for what is left to do.
fn test_rows(item: u32, first_row: u32, row_step: u32, first_entry: u32, entry_step: u32) -> u32 {
    let caster = caster_of(item);
    var left = ROW_SAMPLES;
    var marks = 0u;
    for (var row = caster.print.first.y + first_row; row <= caster.print.last.y; row += row_step) {
        let entries = row_entries(caster.print, caster.face, row);
        let steps = (entries.y - entries.x) / entry_step;
        if steps > left {
            marks = IN_SHARES;
            break;
        }
        left -= steps;
        for (var entry = entries.x + first_entry; entry < entries.y; entry += entry_step) {
            if verdict(caster.pyramid, caster.triangle, entry) == DOUBTFUL {
                marks |= IN_DOUBTS;
            }
        }
    }
    return marks;
}

// Eight invocations for each caster, which share out its rows.
@compute @workgroup_size(64)
fn fused_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = (group.x + group.y * MAX_GROUPS) * (GROUP / ROW_LANES) + local / ROW_LANES;
    if place >= atomicLoad(&queued[ROWS]) {
        return;
    }
    let item = atomicLoad(&queue[place]) & ITEM;
    let marks = test_rows(item, local % ROW_LANES, ROW_LANES, 0u, 1u);
    // Whoever sets a mark first passes the caster on.
    let fresh = marks & ~atomicOr(&queue[place], marks);
    if (fresh & IN_SHARES) != 0u {
        push(SHARES, item);
    }
    if (fresh & IN_DOUBTS) != 0u {
        push(ROW_DOUBTS, item);
    }
}

// `shares` workgroups for each caster, all in every row.
@compute @workgroup_size(64)
fn fused_shares(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = group.x + group.y * MAX_GROUPS;
    if index >= atomicLoad(&queued[SHARES]) {
        return;
    }
    let place = SHARES * numbers.faces * numbers.triangles + index;
    let item = atomicLoad(&queue[place]) & ITEM;
    let marks = test_rows(item, 0u, 1u, group.z * GROUP + local, GROUP * numbers.shares);
    if (marks & ~atomicOr(&queue[place], marks) & IN_DOUBTS) != 0u {
        push(SHARE_DOUBTS, item);
    }
}

// As `test_rows`, but decides what is doubtful. One loop finds the next doubtful view-sample, so that all invocations of a SIMD group
// decide theirs at the same time.
fn decide_rows(item: u32, first_row: u32, row_step: u32, first_entry: u32, entry_step: u32) {
    let caster = caster_of(item);
    var left = ROW_SAMPLES;
    var row = caster.print.first.y + first_row;
    var entry = 0u;
    var end = 0u;
    loop {
        var found = NO_CELL;
        while found == NO_CELL && left > 0u && (entry < end || row <= caster.print.last.y) {
            if entry < end {
                let doubtful = verdict(caster.pyramid, caster.triangle, entry) == DOUBTFUL;
                found = select(NO_CELL, entry, doubtful && atomicLoad(&blocked[entry]) == 0u);
                entry += entry_step;
                left -= 1u;
            } else {
                let entries = row_entries(caster.print, caster.face, row);
                entry = entries.x + first_entry;
                end = entries.y;
                row += row_step;
            }
        }
        if found == NO_CELL {
            break;
        }
        atomicAdd(&counters[0], 1u);
        let sample = list_entries[found];
        let place = vec3<f32>(position[sample * 3u], position[sample * 3u + 1u], position[sample * 3u + 2u]);
        if pyramid_decide(caster.triangle, place, own_triangle[sample], caster.light) {
            atomicStore(&blocked[found], 1u);
        }
    }
}

// A workgroup for each caster with doubts: eight rows at a time, each by eight neighbours.
@compute @workgroup_size(64)
fn fused_row_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = group.x + group.y * MAX_GROUPS;
    if index < atomicLoad(&queued[ROW_DOUBTS]) {
        let item = atomicLoad(&queue[ROW_DOUBTS * numbers.faces * numbers.triangles + index]);
        decide_rows(item, local / 8u, 8u, local % 8u, 8u);
    }
}

// As `fused_shares`.
@compute @workgroup_size(64)
fn fused_share_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = group.x + group.y * MAX_GROUPS;
    if index < atomicLoad(&queued[SHARE_DOUBTS]) {
        let item = atomicLoad(&queue[SHARE_DOUBTS * numbers.faces * numbers.triangles + index]);
        decide_rows(item, 0u, 1u, group.z * GROUP + local, GROUP * numbers.shares);
    }
}
