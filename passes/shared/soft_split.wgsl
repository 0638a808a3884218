// Listed view-samples into two lists, both in the order of the one: those to which the whole light has one answer, and the others.
// Order is kept within a workgroup, so that neighbours still walk the same casters. Joined after the prelude.
struct Numbers {
    samples: u32,
    // Where the number of listed view-samples stands.
    total_at: u32,
    words: u32,
    light_samples: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> list_offset: array<u32>;
@group(0) @binding(2) var<storage, read> list_entries: array<u32>;
@group(0) @binding(3) var<storage, read> penumbra_state: array<u32>;
@group(0) @binding(4) var<storage, read_write> whole_entries: array<u32>;
@group(0) @binding(5) var<storage, read_write> whole_total: atomic<u32>;
@group(0) @binding(6) var<storage, read_write> partial_entries: array<u32>;
@group(0) @binding(7) var<storage, read_write> partial_total: atomic<u32>;

const NEITHER: u32 = 2u;

var<workgroup> kinds: array<u32, GROUP>;
var<workgroup> starts: array<u32, 2>;

@compute @workgroup_size(64)
fn soft_split(@builtin(global_invocation_id) id: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = linear_index(id);
    var sample = 0u;
    var kind = NEITHER;
    if place < numbers.samples && place < list_offset[numbers.total_at] {
        sample = list_entries[place];
        kind = select(0u, 1u, penumbra_state[sample] != 0u);
    }
    kinds[local] = kind;
    // Everyone's kind is in.
    workgroupBarrier();
    var counts = vec2<u32>(0u);
    var before = 0u;
    for (var other = 0u; other < GROUP; other++) {
        counts += vec2<u32>(u32(kinds[other] == 0u), u32(kinds[other] == 1u));
        before += u32(other < local && kinds[other] == kind);
    }
    if local == 0u {
        starts[0] = atomicAdd(&whole_total, counts.x);
        starts[1] = atomicAdd(&partial_total, counts.y);
    }
    // The starts are in.
    workgroupBarrier();
    if kind == 0u {
        whole_entries[starts[0] + before] = sample;
    } else if kind == 1u {
        partial_entries[starts[1] + before] = sample;
    }
}
