// One invocation a view-sample, and one a cell, which is counted. Joined after whole_side.wgsl.
struct Numbers {
    samples: u32,
    cells: u32,
    triangles: u32,
    // SUNK_ULPS units in the last place, as a share of the largest coordinate.
    step: f32,
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

fn corner_of(triangle: u32, corner: u32) -> vec3<f32> {
    let start = triangle * 9u + corner * 3u;
    return vec3<f32>(triangles[start], triangles[start + 1u], triangles[start + 2u]);
}

// Whether the triangle that a view-sample lies on may part the light for it.
fn own_parts(place: vec3<f32>, own: u32) -> bool {
    let a = corner_of(own, 0u);
    let b = corner_of(own, 1u);
    let c = corner_of(own, 2u);
    let side = whole_side(a, b, c);
    if side == 0.0 || whole_side(place, a, b) == 0.0 || whole_side(place, b, c) == 0.0 || whole_side(place, c, a) == 0.0 {
        return true;
    }
    // Further below its own plane than rounding leaves it.
    let plane = plane_of(a, b, c);
    let offset = place - a;
    let below = numbers.step * max(max(largest(a), largest(b)), max(largest(c), largest(place)));
    return side * dot(plane.normal, offset) < -below * sum_of_sizes(plane.normal) - plane.slack * sum_of_sizes(offset);
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
