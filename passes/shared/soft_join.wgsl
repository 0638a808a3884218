// View-samples against the casters of their cells, 128 light samples at a time (a block of four mask words). Joined after
// soft_pair.wgsl; the pass defines `hidden_block`. One invocation takes a (view-sample, block); where a cell lists more casters than
// the loop limit allows, workgroups share them out. What f32 leaves in doubt is queued.
struct Numbers {
    samples: u32,
    cells: u32,
    // Blocks and words of a mask.
    blocks: u32,
    words: u32,
    light_samples: u32,
    // Workgroups for a (view-sample, block) with many casters, and with many casters and doubts.
    shares: u32,
    doubt_shares: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> caster_state: array<u32>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> own_triangle: array<u32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read> cell: array<u32>;
@group(0) @binding(7) var<storage, read> list_offset: array<u32>;
@group(0) @binding(8) var<storage, read> list_entries: array<u32>;
@group(0) @binding(9) var<storage, read> caster_offset: array<u32>;
@group(0) @binding(10) var<storage, read> caster_entries: array<u32>;
@group(0) @binding(11) var<storage, read> light_words: array<vec4<f32>>;
@group(0) @binding(12) var<storage, read_write> mask: array<atomic<u32>>;
// (view-sample, block) left to other kernels, as view-sample * blocks + block: three queues, each of one at most once.
@group(0) @binding(13) var<storage, read_write> queue: array<atomic<u32>>;
@group(0) @binding(14) var<storage, read_write> queued: array<atomic<u32>, 3>;

const LONG: u32 = 0u;
const DOUBTS: u32 = 1u;
const LONG_DOUBTS: u32 = 2u;
// Casters that one invocation tests, at most: each takes up to 42 loop steps.
const OWN_CASTERS: u32 = 640u;
// Mark in the first queue: the item is in the third too.
const IN_DOUBTS: u32 = 0x80000000u;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

// What a caster hides of a block.
struct Found {
    hidden: vec4<u32>,
    is_doubtful: bool,
}

fn the_light() -> Light {
    return Light(light_words[0].xyz, light_words[1].xyz, light_words[1].w, light_words[0].w);
}

fn place_of(sample: u32) -> vec3<f32> {
    return vec3<f32>(position[sample * 3u], position[sample * 3u + 1u], position[sample * 3u + 2u]);
}

fn push(kind: u32, item: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.samples * numbers.blocks + place], item);
}

// First caster entry of a view-sample's cell, and one past the last; all triangles for one in no cell.
fn casters_of(sample: u32) -> vec2<u32> {
    let at = cell[sample];
    if at == NO_CELL {
        return vec2<u32>(0u, arrayLength(&triangles) / 9u);
    }
    // Entries past the end were never written: the overflow is reported where it was counted.
    return min(vec2<u32>(caster_offset[at], caster_offset[at + 1u]), vec2<u32>(arrayLength(&caster_entries)));
}

fn caster_at(sample: u32, entry: u32) -> u32 {
    if cell[sample] == NO_CELL {
        return entry;
    }
    return caster_entries[entry];
}

// The bits of a block that stand for a light sample.
fn used_of(block: u32) -> vec4<u32> {
    let first = vec4<u32>(128u * block) + vec4<u32>(0u, 32u, 64u, 96u);
    let count = min(max(vec4<u32>(numbers.light_samples), first) - first, vec4<u32>(32u));
    return select(vec4<u32>(0u), vec4<u32>(0xffffffffu) >> (vec4<u32>(32u) - max(count, vec4<u32>(1u))), count > vec4<u32>(0u));
}

// What `caster` hides of `block` from the view-sample.
fn hides(caster: u32, block: u32, receiver: Receiver, light: Light) -> Found {
    let nothing = Found(vec4<u32>(0u), false);
    if caster == receiver.own || caster_state[caster] == 0u {
        return nothing;
    }
    let a = triangle_corner(caster, 0u);
    let b = triangle_corner(caster, 1u);
    let c = triangle_corner(caster, 2u);
    let pair = pair_of(a, b, c, receiver, light);
    if pair.kind == NOTHING {
        return nothing;
    }
    let rule = admitted(receiver, a, b, c);
    if rule == NOTHING {
        return nothing;
    }
    if rule == UNKNOWN {
        return Found(vec4<u32>(0u), true);
    }
    if pair.kind == ALL {
        return Found(used_of(block), false);
    }
    return hidden_block(pair, a, b, c, block, receiver, light);
}

// Every word of every mask.
@compute @workgroup_size(64)
fn soft_start(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    let words = numbers.words;
    if index >= numbers.samples * words {
        return;
    }
    let sample = index / words;
    let word = index % words;
    atomicStore(&mask[index], select(0u, 0xffffffffu, sample_state[sample] == FACING_AWAY));
    if sample_state[sample] == KEPT && cell[sample] == NO_CELL && word % 4u == 0u {
        push(LONG, sample * numbers.blocks + word / 4u);
    }
}

fn hide(sample: u32, block: u32, hidden: vec4<u32>) {
    let start = sample * numbers.words + 4u * block;
    for (var word = 0u; word < 4u; word++) {
        if hidden[word] != 0u {
            atomicOr(&mask[start + word], hidden[word]);
        }
    }
}

// View-samples in list order, so that neighbours walk the same casters.
@compute @workgroup_size(64)
fn soft_join(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    let block = index / numbers.samples;
    let place = index % numbers.samples;
    if block >= numbers.blocks || place >= list_offset[numbers.cells] {
        return;
    }
    let light = the_light();
    let sample = list_entries[place];
    var casters = casters_of(sample);
    let is_long = casters.y - casters.x > OWN_CASTERS;
    casters.y = select(casters.y, casters.x, is_long);
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let used = used_of(block);
    var hidden = vec4<u32>(0u);
    var is_doubtful = false;
    for (var entry = casters.x; entry < casters.y && any(hidden != used); entry++) {
        let found = hides(caster_entries[entry], block, receiver, light);
        hidden |= found.hidden & used;
        is_doubtful |= found.is_doubtful;
    }
    hide(sample, block, hidden);
    if is_long || (is_doubtful && any(hidden != used)) {
        push(select(DOUBTS, LONG, is_long), sample * numbers.blocks + block);
    }
}

// `shares` workgroups for each item of the first queue.
@compute @workgroup_size(64)
fn soft_long(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place >= atomicLoad(&queued[LONG]) {
        return;
    }
    let item = atomicLoad(&queue[place]) & ~IN_DOUBTS;
    let sample = item / numbers.blocks;
    let block = item % numbers.blocks;
    let light = the_light();
    let casters = casters_of(sample);
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let used = used_of(block);
    var hidden = vec4<u32>(0u);
    var is_doubtful = false;
    for (var entry = casters.x + group.z * GROUP + local; entry < casters.y && any(hidden != used);
        entry += GROUP * numbers.shares) {
        let found = hides(caster_at(sample, entry), block, receiver, light);
        hidden |= found.hidden & used;
        is_doubtful |= found.is_doubtful;
    }
    hide(sample, block, hidden);
    if is_doubtful && (atomicOr(&queue[place], IN_DOUBTS) & IN_DOUBTS) == 0u {
        push(LONG_DOUBTS, item);
    }
}
