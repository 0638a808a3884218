// One invocation a view-sample, and one a cell, which is counted. Joined after predicate.wgsl and whole_side.wgsl.
struct Numbers {
    samples: u32,
    cells: u32,
    triangles: u32,
    // SUNK_ULPS units in the last place, as a share of the largest coordinate.
    step: f32,
    // See predicate.wgsl.
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> position: array<f32>;
@group(0) @binding(3) var<storage, read> own_triangle: array<u32>;
@group(0) @binding(4) var<storage, read> sample_state: array<u32>;
@group(0) @binding(5) var<storage, read> cell: array<u32>;
@group(0) @binding(6) var<storage, read> list_length: array<u32>;
// Borders whose regions touch each cell.
@group(0) @binding(7) var<storage, read> borders: array<u32>;
@group(0) @binding(8) var<storage, read> light_box: array<vec4<f32>>;
@group(0) @binding(9) var<storage, read_write> penumbra_state: array<u32>;
// Others' counts; from the fourth on cells, penumbra cells and partial view-samples.
@group(0) @binding(10) var<storage, read_write> counters: array<atomic<u32>, 6>;

fn sum_of_sizes(a: vec3<f32>) -> f32 {
    return abs(a.x) + abs(a.y) + abs(a.z);
}

fn largest(a: vec3<f32>) -> f32 {
    return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

fn opaque_zero() -> u32 {
    return numbers.zero;
}

// Whether a view-sample is further below its own plane (a, b, c) than rounding leaves it; `side` as of `whole_side`. A step along every
// axis raises it by no more than the step that leaves it be, so what is below the plane even then is: all that is_sunk of cpu.rs
// finds is found. A quarter of the step is left to rounding of the sums.
fn is_sunk(place: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, side: f32) -> bool {
    let plane = plane_of(a, b, c);
    let offset = place - a;
    let below = 0.75 * numbers.step * max(max(largest(a), largest(b)), max(largest(c), largest(place)));
    // Each coordinate of the normal errs by the slack.
    let least = max(sum_of_sizes(plane.normal) - 3.0 * plane.slack, 0.0);
    if side * dot(plane.normal, offset) - plane.slack * sum_of_sizes(offset) >= -below * least {
        return false;
    }
    return side * orientation(a, b, c, place + side * below * sign(plane.normal)) > 0.0;
}

// Whether the triangle that a view-sample lies on may part the light for it.
fn own_parts(place: vec3<f32>, own: u32) -> bool {
    let a = triangle_corner(own, 0u);
    let b = triangle_corner(own, 1u);
    let c = triangle_corner(own, 2u);
    let side = whole_side(a, b, c);
    if side == 0.0 || whole_side(place, a, b) == 0.0 || whole_side(place, b, c) == 0.0 || whole_side(place, c, a) == 0.0 {
        return true;
    }
    return is_sunk(place, a, b, c, side);
}

fn is_partial(sample: u32) -> bool {
    if sample_state[sample] != KEPT {
        return false;
    }
    let at = cell[sample];
    if at == NO_CELL {
        return true;
    }
    if borders[at] != 0u {
        return true;
    }
    let own = own_triangle[sample];
    if own >= numbers.triangles {
        return false;
    }
    return own_parts(vec3<f32>(position[3u * sample], position[3u * sample + 1u], position[3u * sample + 2u]), own);
}

@compute @workgroup_size(64)
fn silhouettes(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index < numbers.cells && list_length[index] > 0u {
        atomicAdd(&counters[3], 1u);
        if borders[index] != 0u {
            atomicAdd(&counters[4], 1u);
        }
    }
    if index < numbers.samples {
        let partial = is_partial(index);
        penumbra_state[index] = u32(partial);
        if partial {
            atomicAdd(&counters[5], 1u);
        }
    }
}
