// Joined after predicate and pyramid. First the planes of every caster, once; then the view-samples. Which of four ways a
// view-sample goes depends on the casters of its cell: tested by one invocation; by workgroups that share them out; and once
// more, likewise, where f32 left a doubt. So no invocation comes near the loop limit. Software rasterisers run both sides of
// every branch, so the costly decision is kept out of the common loop.
struct Numbers {
    triangles: u32,
    samples: u32,
    // Workgroups for a view-sample of a long cell.
    shares: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> light_samples: array<f32>;
@group(0) @binding(4) var<storage, read> position: array<f32>;
@group(0) @binding(5) var<storage, read> own_triangle: array<u32>;
@group(0) @binding(6) var<storage, read> sample_state: array<u32>;
@group(0) @binding(7) var<storage, read> cell: array<u32>;
@group(0) @binding(8) var<storage, read> caster_offset: array<u32>;
@group(0) @binding(9) var<storage, read> caster_entries: array<u32>;
@group(0) @binding(10) var<storage, read_write> mask: array<atomic<u32>>;
// View-samples left to other kernels: three queues of `samples` words. A view-sample is in each at most once.
@group(0) @binding(11) var<storage, read_write> queue: array<atomic<u32>>;
// View-samples in each queue.
@group(0) @binding(12) var<storage, read_write> queued: array<atomic<u32>, 3>;
// Number of doubtful pairs that were decided.
@group(0) @binding(13) var<storage, read_write> counters: array<atomic<u32>>;
// A `Pyramid` a triangle, in two rows so that neither outgrows a binding before `triangles` nearly does: its three sides; and its
// front, then distance and slack.
@group(0) @binding(14) var<storage, read_write> sides: array<vec4<f32>>;
@group(0) @binding(15) var<storage, read_write> fronts: array<vec4<f32>>;

const LONG: u32 = 0u;
const DOUBTS: u32 = 1u;
const LONG_DOUBTS: u32 = 2u;
// Casters that one invocation tests, at most.
const OWN_CASTERS: u32 = 2048u;
// Mark in the first queue: the view-sample is in the third too.
const IN_DOUBTS: u32 = 0x80000000u;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

fn light_sample() -> vec3<f32> {
    return vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
}

fn place_of(sample: u32) -> vec3<f32> {
    return vec3<f32>(position[sample * 3u], position[sample * 3u + 1u], position[sample * 3u + 2u]);
}

fn push(kind: u32, sample: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.samples + place], sample);
}

// First caster entry of a view-sample's cell, and one past the last.
fn casters_of(sample: u32) -> vec2<u32> {
    let at = cell[sample];
    if at == NO_CELL {
        return vec2<u32>(0u);
    }
    // Entries past the end were never written: the overflow is reported where it was counted.
    let end = arrayLength(&caster_entries);
    return min(vec2<u32>(caster_offset[at], caster_offset[at + 1u]), vec2<u32>(end));
}

// The planes of each triangle. One that casts nothing gets a front that lies behind everything, so that all verdicts are LIT.
@compute @workgroup_size(64)
fn planes_casters(@builtin(global_invocation_id) id: vec3<u32>) {
    let caster = linear_index(id);
    if caster >= numbers.triangles {
        return;
    }
    let a = triangle_corner(caster, 0u);
    let b = triangle_corner(caster, 1u);
    let c = triangle_corner(caster, 2u);
    var pyramid = pyramid_of(a, b, c, light_sample());
    if caster_state[caster] == 0u {
        pyramid = Pyramid(vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0), 1.0, 0.0, 0.0);
    }
    sides[3u * caster] = pyramid.side_0;
    sides[3u * caster + 1u] = pyramid.side_1;
    sides[3u * caster + 2u] = pyramid.side_2;
    fronts[2u * caster] = pyramid.front;
    fronts[2u * caster + 1u] = vec4<f32>(pyramid.distance, pyramid.slack, pyramid.winding, 0.0);
}

fn verdict(sample: Sample, entry: u32) -> u32 {
    let caster = caster_entries[entry];
    let last = fronts[2u * caster + 1u];
    let pyramid = Pyramid(
        sides[3u * caster],
        sides[3u * caster + 1u],
        sides[3u * caster + 2u],
        fronts[2u * caster],
        last.x,
        last.y,
        last.z,
    );
    return pyramid_verdict(pyramid, caster, sample);
}

@compute @workgroup_size(64)
fn planes(@builtin(global_invocation_id) id: vec3<u32>) {
    let light = light_sample();
    let index = linear_index(id);
    if index >= numbers.samples {
        return;
    }
    let state = sample_state[index];
    var casters = vec2<u32>(0u);
    if state == KEPT {
        casters = casters_of(index);
    }
    let long = casters.y - casters.x > OWN_CASTERS;
    casters.y = select(casters.y, casters.x, long);
    let sample = sample_of(place_of(index), own_triangle[index], light);
    var found = LIT;
    for (var entry = casters.x; entry < casters.y && found != BLOCKED; entry++) {
        found = max(found, verdict(sample, entry));
    }
    let blocked = found == BLOCKED;
    atomicStore(&mask[index], select(select(0u, 1u, blocked), 0xffffffffu, state == FACING_AWAY));
    if long || found == DOUBTFUL {
        push(select(DOUBTS, LONG, long), index);
    }
}

// `shares` workgroups for each view-sample of a long cell.
@compute @workgroup_size(64)
fn planes_long(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let light = light_sample();
    let place = group.x + group.y * MAX_GROUPS;
    if place >= atomicLoad(&queued[LONG]) {
        return;
    }
    let index = atomicLoad(&queue[place]) & ~IN_DOUBTS;
    let casters = casters_of(index);
    let sample = sample_of(place_of(index), own_triangle[index], light);
    var found = LIT;
    for (var entry = casters.x + group.z * GROUP + local; entry < casters.y && found != BLOCKED;
        entry += GROUP * numbers.shares) {
        found = max(found, verdict(sample, entry));
    }
    if found == BLOCKED {
        atomicStore(&mask[index], 1u);
    }
    if found == DOUBTFUL && (atomicOr(&queue[place], IN_DOUBTS) & IN_DOUBTS) == 0u {
        push(LONG_DOUBTS, index);
    }
}

// Decides the doubtful among a view-sample's casters from the first on in steps, until one blocks it. One loop finds the next
// doubtful caster, so that all invocations of a SIMD group decide theirs at the same time.
fn decide(index: u32, first: u32, entry_step: u32) {
    let light = light_sample();
    let place = place_of(index);
    let own = own_triangle[index];
    let sample = sample_of(place, own, light);
    let casters = casters_of(index);
    var entry = casters.x + first;
    var blocked = atomicLoad(&mask[index]) != 0u;
    while !blocked {
        var found = NO_CELL;
        while found == NO_CELL && entry < casters.y {
            found = select(NO_CELL, entry, verdict(sample, entry) == DOUBTFUL);
            entry += entry_step;
        }
        if found == NO_CELL {
            break;
        }
        atomicAdd(&counters[0], 1u);
        blocked = pyramid_decide(caster_entries[found], place, own, light);
    }
    if blocked {
        atomicStore(&mask[index], 1u);
    }
}

@compute @workgroup_size(64)
fn planes_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = (group.x + group.y * MAX_GROUPS) * GROUP + local;
    if place < atomicLoad(&queued[DOUBTS]) {
        decide(atomicLoad(&queue[numbers.samples + place]), 0u, 1u);
    }
}

// As `planes_long`.
@compute @workgroup_size(64)
fn planes_long_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place < atomicLoad(&queued[LONG_DOUBTS]) {
        let index = atomicLoad(&queue[LONG_DOUBTS * numbers.samples + place]);
        decide(index, group.z * GROUP + local, GROUP * numbers.shares);
    }
}
