// Joined after predicate, pyramid and fan.
struct Numbers {
    face: u32,
    side: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> fans: array<f32>;
@group(0) @binding(2) var<storage, read> triangles: array<f32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read> list_far: array<f32>;
@group(0) @binding(5) var<storage, read> list_offset: array<u32>;
@group(0) @binding(6) var<storage, read> list_entries: array<u32>;
@group(0) @binding(7) var<storage, read> position: array<f32>;
@group(0) @binding(8) var<storage, read> own_triangle: array<u32>;
// In list order: a `Sample`.
@group(0) @binding(9) var<storage, read> packed: array<vec4<u32>>;
@group(0) @binding(10) var<storage, read_write> mask: array<atomic<u32>>;
// Doubtful pairs that were decided, and fragments whose list is too long.
@group(0) @binding(11) var<storage, read_write> counters: array<atomic<u32>, 2>;

// View-samples that a fragment tests, at most. Each may take eleven steps.
const FRAGMENT_SAMPLES: u32 = 2048u;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

@fragment
fn fused_draw(vertex: Vertex) {
    let light = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    let cell = fragment_cell(vertex, numbers.face, numbers.side);
    var entry = list_offset[cell];
    let end = list_offset[cell + 1u];
    if entry == end || !fragment_counts(vertex, numbers.side, list_far[cell]) {
        return;
    }
    if end - entry > FRAGMENT_SAMPLES {
        atomicAdd(&counters[1], 1u);
        return;
    }
    let a = triangle_corner(vertex.triangle, 0u);
    let b = triangle_corner(vertex.triangle, 1u);
    let c = triangle_corner(vertex.triangle, 2u);
    let pyramid = pyramid_of(a, b, c, light);
    loop {
        // The next doubtful view-sample, so that all fragments of a SIMD group decide theirs at the same time.
        var found = NO_CELL;
        while found == NO_CELL && entry < end {
            let words = packed[entry];
            let verdict = pyramid_verdict(pyramid, vertex.triangle, Sample(bitcast<vec3<f32>>(words.xyz), words.w));
            if verdict == BLOCKED {
                // Casters combine by OR.
                atomicOr(&mask[list_entries[entry]], 1u);
            }
            found = select(NO_CELL, entry, verdict == DOUBTFUL);
            entry += 1u;
        }
        if found == NO_CELL {
            break;
        }
        atomicAdd(&counters[0], 1u);
        let sample = list_entries[found];
        let place = vec3<f32>(position[sample * 3u], position[sample * 3u + 1u], position[sample * 3u + 2u]);
        if pyramid_decide(vertex.triangle, place, own_triangle[sample], light) {
            atomicOr(&mask[sample], 1u);
        }
    }
}
