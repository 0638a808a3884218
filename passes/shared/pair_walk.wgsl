// The (cell, caster) pairs of a face's regions. Joined after light_frame and what regions are made of; followed by a kernel that names
// a type `Caster` with a member `casts`, a type `Region` with members `touched`, `first` and `last` (columns and rows of its box), and
// binds what it makes them of from 12 on, and gives `caster_of(triangle)`, `region_of(caster, face)`, `region_columns(region, row)` and `region_is_behind(region, far, at)`.
//
// Which of three ways a caster goes depends on the texels under it: walked by one invocation; by eight that share out its rows; by
// workgroups that do. So no invocation comes near the loop limit, and neighbours in a SIMD group do like work.
struct Numbers {
    triangles: u32,
    faces: u32,
    side: u32,
    // Workgroups for a caster of the third kind.
    shares: u32,
    zero: u32,
    // Casters of this walk: the first, and how many.
    first: u32,
    count: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> caster_state: array<u32>;
@group(0) @binding(2) var<storage, read> light_frame: array<f32>;
@group(0) @binding(3) var<storage, read> list_length: array<u32>;
@group(0) @binding(4) var<storage, read> list_far: array<f32>;
@group(0) @binding(5) var<storage, read_write> pair_cell: array<u32>;
@group(0) @binding(6) var<storage, read_write> pair_slot: array<u32>;
@group(0) @binding(7) var<storage, read_write> pair_caster: array<u32>;
@group(0) @binding(8) var<storage, read_write> caster_length: array<atomic<u32>>;
// Pairs, and pairs left out because no view-sample of the cell can be blocked.
@group(0) @binding(9) var<storage, read_write> counters: array<atomic<u32>, 2>;
// Casters left to other kernels, as face * triangles + triangle: two queues of faces * count words. A caster is in each at most
// once for each face.
@group(0) @binding(10) var<storage, read_write> queue: array<atomic<u32>>;
// Casters in each queue.
@group(0) @binding(11) var<storage, read_write> queued: array<atomic<u32>, 2>;

const ROWS: u32 = 0u;
const SHARES: u32 = 1u;
// Rows and texels that one invocation walks itself, at most.
const OWN_ROWS: u32 = 16u;
const OWN_TEXELS: u32 = 128u;
// Texels that one invocation of a shared caster walks, at most.
const ROW_TEXELS: u32 = 24000u;
// Invocations for a caster whose rows are shared out.
const ROW_LANES: u32 = 8u;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

fn push(kind: u32, item: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.faces * numbers.count + place], item);
}

// Pairs the caster with a cell that has view-samples, some of which it may block. 1 if it can block none of them.
fn pair(region: ptr<function, Region>, cell: u32, at: vec2<u32>, triangle: u32) -> u32 {
    if list_length[cell] == 0u {
        return 0u;
    }
    if region_is_behind(region, list_far[cell], at) {
        return 1u;
    }
    let slot = atomicAdd(&caster_length[cell], 1u);
    // The count goes on past the capacity: it is what would have been needed.
    let place = atomicAdd(&counters[0], 1u);
    if place < arrayLength(&pair_cell) {
        pair_cell[place] = cell;
        pair_slot[place] = slot;
        pair_caster[place] = triangle;
    }
    return 0u;
}

// Pairs the caster with rows first, first + step, ... of its region; how many pairs were left out.
fn walk_rows(region: ptr<function, Region>, face: u32, triangle: u32, first: u32, step: u32) -> u32 {
    var behind = 0u;
    for (var row = (*region).first.y + first; row <= (*region).last.y; row += step) {
        let columns = region_columns(region, row);
        let start = (face * numbers.side + row) * numbers.side;
        for (var column = columns.x; column < columns.y; column++) {
            behind += pair(region, start + column, vec2<u32>(column, row), triangle);
        }
    }
    return behind;
}

fn count_behind(behind: u32) {
    if behind > 0u {
        atomicAdd(&counters[1], behind);
    }
}

// One invocation a caster: small regions are walked, others go to the first queue.
fn walk_caster(index: u32) {
    let triangle = numbers.first + index;
    if index >= numbers.count || caster_state[triangle] == 0u {
        return;
    }
    let caster = caster_of(triangle);
    if !caster.casts {
        return;
    }
    var behind = 0u;
    for (var face = 0u; face < numbers.faces; face++) {
        if !light_valid(face) {
            continue;
        }
        var region = region_of(caster, face);
        if !region.touched {
            continue;
        }
        let texels = (region.last - region.first) + vec2<u32>(1u);
        if texels.y > OWN_ROWS || texels.x * texels.y > OWN_TEXELS {
            push(ROWS, face * numbers.triangles + triangle);
            continue;
        }
        behind += walk_rows(&region, face, triangle, 0u, 1u);
    }
    count_behind(behind);
}

// Rows first_row, first_row + row_step, ... of a queued caster, where its box holds no more than `most` texels for each such share.
fn walk_share(item: u32, first_row: u32, row_step: u32, most: u32) -> bool {
    let face = item / numbers.triangles;
    let triangle = item % numbers.triangles;
    var region = region_of(caster_of(triangle), face);
    let texels = (region.last - region.first) + vec2<u32>(1u);
    if (texels.y / row_step + 1u) * texels.x > most {
        return false;
    }
    count_behind(walk_rows(&region, face, triangle, first_row, row_step));
    return true;
}

// Eight invocations for each caster, which share out its rows, or all find it too large.
fn walk_row_queue(group: vec3<u32>, local: u32) {
    let place = (group.x + group.y * MAX_GROUPS) * (GROUP / ROW_LANES) + local / ROW_LANES;
    if place >= atomicLoad(&queued[ROWS]) {
        return;
    }
    let item = atomicLoad(&queue[place]);
    let lane = local % ROW_LANES;
    if !walk_share(item, lane, ROW_LANES, ROW_TEXELS) && lane == 0u {
        push(SHARES, item);
    }
}

// `shares` workgroups for each caster, which share out its rows.
fn walk_share_queue(group: vec3<u32>, local: u32) {
    let index = group.x + group.y * MAX_GROUPS;
    if index < atomicLoad(&queued[SHARES]) {
        let item = atomicLoad(&queue[numbers.faces * numbers.count + index]);
        walk_share(item, group.z * GROUP + local, GROUP * numbers.shares, 0xffffffffu);
    }
}
