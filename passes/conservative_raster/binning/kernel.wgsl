// Joined after light_frame, predicate, pyramid and footprint. Which of three ways a caster goes depends on the texels under it: walked
// by one invocation; by eight that share out its rows; by workgroups that do. So no invocation comes near the loop limit, and neighbours in a SIMD group do like work.
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
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read> light_frame: array<f32>;
@group(0) @binding(5) var<storage, read> list_length: array<u32>;
@group(0) @binding(6) var<storage, read> list_far: array<f32>;
@group(0) @binding(7) var<storage, read_write> pair_cell: array<u32>;
@group(0) @binding(8) var<storage, read_write> pair_slot: array<u32>;
@group(0) @binding(9) var<storage, read_write> pair_caster: array<u32>;
@group(0) @binding(10) var<storage, read_write> caster_length: array<atomic<u32>>;
// Pairs, and pairs left out because the caster is behind.
@group(0) @binding(11) var<storage, read_write> counters: array<atomic<u32>, 2>;
// Casters left to other kernels, as face * triangles + triangle: two queues of faces * triangles words. A caster is in each at most
// once for each face.
@group(0) @binding(12) var<storage, read_write> queue: array<atomic<u32>>;
// Casters in each queue.
@group(0) @binding(13) var<storage, read_write> queued: array<atomic<u32>, 2>;

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

fn light_sample() -> vec3<f32> {
    return vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
}

fn push(kind: u32, item: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.faces * numbers.triangles + place], item);
}

// Pairs the caster with a cell that has view-samples, some of which may lie behind it. 1 if none does.
fn pair(cell: u32, triangle: u32, near: f32) -> u32 {
    let listed = list_length[cell] != 0u;
    let behind = near > list_far[cell];
    if listed && !behind {
        let slot = atomicAdd(&caster_length[cell], 1u);
        // The count goes on past the capacity: it is what would have been needed.
        let place = atomicAdd(&counters[0], 1u);
        if place < arrayLength(&pair_cell) {
            pair_cell[place] = cell;
            pair_slot[place] = slot;
            pair_caster[place] = triangle;
        }
    }
    return select(0u, 1u, listed && behind);
}

@compute @workgroup_size(64)
fn binning(@builtin(global_invocation_id) id: vec3<u32>) {
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
    var behind = 0u;
    for (var face = 0u; face < numbers.faces; face++) {
        if !light_valid(face) {
            continue;
        }
        let print = footprint_of(pyramid, a - light, b - light, c - light, face, numbers.side, true);
        if !print.touched {
            continue;
        }
        let texels = (print.last - print.first) + vec2<u32>(1u);
        if texels.y > OWN_ROWS || texels.x * texels.y > OWN_TEXELS {
            push(ROWS, face * numbers.triangles + triangle);
            continue;
        }
        for (var row = print.first.y; row <= print.last.y; row++) {
            let columns = footprint_columns(print, row, numbers.side);
            let start = (face * numbers.side + row) * numbers.side;
            for (var column = columns.x; column < columns.y; column++) {
                behind += pair(start + column, triangle, print.near);
            }
        }
    }
    if behind > 0u {
        atomicAdd(&counters[1], behind);
    }
}

// Walks rows first_row, first_row + row_step, ... of a caster, where its box holds no more than `most` texels for each such share.
fn walk_rows(item: u32, first_row: u32, row_step: u32, most: u32) -> bool {
    let face = item / numbers.triangles;
    let triangle = item % numbers.triangles;
    let light = light_sample();
    let a = triangle_corner(triangle, 0u);
    let b = triangle_corner(triangle, 1u);
    let c = triangle_corner(triangle, 2u);
    let pyramid = pyramid_of(a, b, c, light);
    let print = footprint_of(pyramid, a - light, b - light, c - light, face, numbers.side, true);
    let texels = (print.last - print.first) + vec2<u32>(1u);
    if (texels.y / row_step + 1u) * texels.x > most {
        return false;
    }
    var behind = 0u;
    for (var row = print.first.y + first_row; row <= print.last.y; row += row_step) {
        let columns = footprint_columns(print, row, numbers.side);
        let start = (face * numbers.side + row) * numbers.side;
        for (var column = columns.x; column < columns.y; column++) {
            behind += pair(start + column, triangle, print.near);
        }
    }
    if behind > 0u {
        atomicAdd(&counters[1], behind);
    }
    return true;
}

// Eight invocations for each caster, which share out its rows, or all find it too large.
@compute @workgroup_size(64)
fn binning_rows(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = (group.x + group.y * MAX_GROUPS) * (GROUP / ROW_LANES) + local / ROW_LANES;
    if place >= atomicLoad(&queued[ROWS]) {
        return;
    }
    let item = atomicLoad(&queue[place]);
    let lane = local % ROW_LANES;
    if !walk_rows(item, lane, ROW_LANES, ROW_TEXELS) && lane == 0u {
        push(SHARES, item);
    }
}

// `shares` workgroups for each caster, which share out its rows.
@compute @workgroup_size(64)
fn binning_shares(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let index = group.x + group.y * MAX_GROUPS;
    if index < atomicLoad(&queued[SHARES]) {
        let item = atomicLoad(&queue[numbers.faces * numbers.triangles + index]);
        walk_rows(item, group.z * GROUP + local, GROUP * numbers.shares, 0xffffffffu);
    }
}
