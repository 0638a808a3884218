// View-samples against the casters of their cells, one block of 256 light samples (eight mask words) a dispatch. Joined after
// soft_pair.wgsl; soft_each.wgsl or soft_batch.wgsl has the walk over casters. One invocation takes a view-sample; where a cell lists more
// casters than the loop limit allows, workgroups share them out. What f32 leaves in doubt is queued.
//
// Software drivers run every branch, and read memory lane by lane: so casters come in three vectors, and the loop looks for casters that cut
// the light before any lane tests its own.
struct Numbers {
    samples: u32,
    cells: u32,
    // Which block.
    block: u32,
    // Words of a mask.
    words: u32,
    light_samples: u32,
    // Workgroups for a view-sample with many casters, and with many casters and doubts.
    shares: u32,
    doubt_shares: u32,
    zero: u32,
}
@group(0) @binding(0) var<uniform> numbers: Numbers;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
// Corners of every triangle; w of the first: 1 where it casts.
@group(0) @binding(2) var<storage, read> casters: array<vec4<f32>>;
@group(0) @binding(3) var<storage, read> position: array<f32>;
@group(0) @binding(4) var<storage, read> own_triangle: array<u32>;
@group(0) @binding(5) var<storage, read> sample_state: array<u32>;
@group(0) @binding(6) var<storage, read> cell: array<u32>;
@group(0) @binding(7) var<storage, read> list_offset: array<u32>;
@group(0) @binding(8) var<storage, read> list_entries: array<u32>;
@group(0) @binding(9) var<storage, read> caster_offset: array<u32>;
@group(0) @binding(10) var<storage, read> caster_entries: array<u32>;
// Light samples as they are.
@group(0) @binding(11) var<storage, read> light_samples: array<f32>;
@group(0) @binding(12) var<storage, read_write> mask: array<atomic<u32>>;
// View-samples left to other kernels: three queues, in each of which one is at most once.
@group(0) @binding(13) var<storage, read_write> queue: array<atomic<u32>>;
@group(0) @binding(14) var<storage, read_write> queued: array<atomic<u32>, 4>;
// See light_box.wgsl.
@group(0) @binding(15) var<uniform> light_block: array<vec4<f32>, 194>;
// (view-sample, caster) in doubt, so many as fit; others wait for their view-sample's turn.
@group(0) @binding(16) var<storage, read_write> doubtful_pairs: array<vec2<u32>>;

const LONG: u32 = 0u;
const DOUBTS: u32 = 1u;
const LONG_DOUBTS: u32 = 2u;
const PAIRS: u32 = 3u;
// Casters that one invocation tests, at most: each takes up to 72 loop steps.
const OWN_CASTERS: u32 = 400u;
// Mark in the first queue: the item is in the third too.
const IN_DOUBTS: u32 = 0x80000000u;

fn opaque_zero() -> u32 {
    return numbers.zero;
}

// Light samples of the block that are surely hidden, and that may be.
struct Found {
    sure: Bits,
    may: Bits,
}

// A bit for each light sample of the block, in eight words.
struct Bits {
    first: vec4<u32>,
    second: vec4<u32>,
}

const NO_BITS: Bits = Bits(vec4<u32>(0u), vec4<u32>(0u));
const ALL_BITS: Bits = Bits(vec4<u32>(0xffffffffu), vec4<u32>(0xffffffffu));

fn both(a: Bits, b: Bits) -> Bits {
    return Bits(a.first & b.first, a.second & b.second);
}

fn either(a: Bits, b: Bits) -> Bits {
    return Bits(a.first | b.first, a.second | b.second);
}

fn without(a: Bits, b: Bits) -> Bits {
    return Bits(a.first & ~b.first, a.second & ~b.second);
}

// `a` where `which`, else `b`.
fn choose(b: Bits, a: Bits, which: bool) -> Bits {
    return Bits(select(b.first, a.first, which), select(b.second, a.second, which));
}

fn is_any(a: Bits) -> bool {
    return any((a.first | a.second) != vec4<u32>(0u));
}

fn word_of(a: Bits, word: u32) -> u32 {
    return select(a.first[word % 4u], a.second[word % 4u], word >= 4u);
}

// The first word that has some.
fn first_word(a: Bits) -> u32 {
    let words = bits_of(a.first != vec4<u32>(0u)) | bits_of(a.second != vec4<u32>(0u)) << 4u;
    return firstTrailingBit(words) & 7u;
}

// `a` with `bits` in a word that had none.
fn with_word(a: Bits, word: u32, bits: u32) -> Bits {
    let places = vec4<u32>(0u, 1u, 2u, 3u);
    return Bits(
        a.first | select(vec4<u32>(0u), vec4<u32>(bits), places == vec4<u32>(word)),
        a.second | select(vec4<u32>(0u), vec4<u32>(bits), places + 4u == vec4<u32>(word)),
    );
}

// Words of the block that stand for light samples.
fn word_count() -> u32 {
    return min(numbers.words - 8u * numbers.block, 8u);
}

fn the_light() -> Light {
    return Light(light_block[0].xyz, light_block[1].xyz, light_block[1].w, light_block[0].w);
}

// Four light samples in the light's box.
struct Places {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

// Light samples 4 * four to 4 * four + 3 of the block.
fn places_of(four: u32) -> Places {
    return Places(light_block[2u + 3u * four], light_block[3u + 3u * four], light_block[4u + 3u * four]);
}

// A value linear over the light; xyz for places in the light's box.
fn values_at(value: vec4<f32>, at: Places) -> vec4<f32> {
    return value.x * at.x + (value.y * at.y + (value.z * at.z + value.w));
}

fn place_of(sample: u32) -> vec3<f32> {
    return vec3<f32>(position[sample * 3u], position[sample * 3u + 1u], position[sample * 3u + 2u]);
}

fn push(kind: u32, sample: u32) {
    let place = atomicAdd(&queued[kind], 1u);
    atomicStore(&queue[kind * numbers.samples + place], sample);
}

// Casters that a view-sample leaves in doubt. They wait, for it costs a software driver as much to queue none as to queue some.
struct Doubts {
    count: u32,
    // The last four, and the four before.
    casters: vec4<u32>,
    older: vec4<u32>,
    // Some found no room.
    is_open: bool,
}

// Doubts that leave room for four more.
const MOST_DOUBTS: u32 = 4u;

fn add_doubt(doubts: ptr<function, Doubts>, caster: u32, is_doubtful: bool) {
    let last = (*doubts).casters;
    (*doubts).older = select((*doubts).older, vec4<u32>(last.w, (*doubts).older.xyz), is_doubtful);
    (*doubts).casters = select(last, vec4<u32>(caster, last.xyz), is_doubtful);
    (*doubts).count += u32(is_doubtful);
}

fn queue_doubts(doubts: ptr<function, Doubts>, sample: u32) {
    while (*doubts).count > 0u {
        (*doubts).count -= 1u;
        let place = atomicAdd(&queued[PAIRS], 1u);
        if place < arrayLength(&doubtful_pairs) {
            doubtful_pairs[place] = vec2<u32>(sample, (*doubts).casters.x);
        } else {
            (*doubts).is_open = true;
        }
        (*doubts).casters = vec4<u32>((*doubts).casters.yzw, (*doubts).older.x);
        (*doubts).older = (*doubts).older.yzwx;
    }
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

// Casters still to be met: every `step`th entry from `next` on, before `end`.
struct Course {
    next: u32,
    end: u32,
    step: u32,
    // Entries of a list; or triangles.
    is_listed: bool,
}

fn caster_at(course: Course) -> u32 {
    return select(course.next, caster_entries[course.next], course.is_listed);
}

// What the casters of a course hide of the block; whether some are in doubt that found no room.
struct Outcome {
    hidden: Bits,
    is_open: bool,
}

// The bits of the block that stand for a light sample.
fn used_bits() -> Bits {
    var used = NO_BITS;
    for (var word = 0u; word < word_count(); word++) {
        let left = min(numbers.light_samples - 256u * numbers.block - 32u * word, 32u);
        used = with_word(used, word, 0xffffffffu >> (32u - left));
    }
    return used;
}

// A caster that a view-sample met.
struct Met {
    caster: u32,
    a: vec3<f32>,
    b: vec3<f32>,
    c: vec3<f32>,
    pair: Pair,
    // What the coplanar rule says.
    rule: u32,
}

fn meet(caster: u32, receiver: Receiver, light: Light) -> Met {
    let a = casters[3u * caster];
    let b = casters[3u * caster + 1u].xyz;
    let c = casters[3u * caster + 2u].xyz;
    var met = Met(caster, a.xyz, b, c, pair_of(a.xyz, b, c, receiver, light), admitted(receiver, a.xyz, b, c));
    if caster == receiver.own || a.w == 0.0 || met.rule == NOTHING {
        met.pair.kind = NOTHING;
    }
    return met;
}

// Every word of every mask, before the first block.
@compute @workgroup_size(64)
fn soft_start(@builtin(global_invocation_id) id: vec3<u32>) {
    let index = linear_index(id);
    if index >= numbers.samples * numbers.words {
        return;
    }
    atomicStore(&mask[index], select(0u, 0xffffffffu, sample_state[index / numbers.words] == FACING_AWAY));
}

// Queues the view-samples of no cell.
@compute @workgroup_size(64)
fn soft_unlisted(@builtin(global_invocation_id) id: vec3<u32>) {
    let sample = linear_index(id);
    if sample < numbers.samples && sample_state[sample] == KEPT && cell[sample] == NO_CELL {
        push(LONG, sample);
    }
}

fn hide(sample: u32, hidden: Bits) {
    for (var word = 0u; word < word_count(); word++) {
        let bits = word_of(hidden, word);
        if bits != 0u {
            atomicOr(&mask[sample * numbers.words + 8u * numbers.block + word], bits);
        }
    }
}

// View-samples in list order, so that neighbours walk the same casters.
@compute @workgroup_size(64)
fn soft_join(@builtin(global_invocation_id) id: vec3<u32>) {
    let place = linear_index(id);
    if place >= list_offset[numbers.cells] {
        return;
    }
    let light = the_light();
    let sample = list_entries[place];
    let entries = casters_of(sample);
    if entries.y - entries.x > OWN_CASTERS {
        push(LONG, sample);
        return;
    }
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let outcome = walk(Course(entries.x, entries.y, 1u, true), sample, receiver, light);
    hide(sample, outcome.hidden);
    if outcome.is_open {
        push(DOUBTS, sample);
    }
}

// `shares` workgroups for each view-sample of the first queue.
@compute @workgroup_size(64)
fn soft_long(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place >= atomicLoad(&queued[LONG]) {
        return;
    }
    let sample = atomicLoad(&queue[place]) & ~IN_DOUBTS;
    let light = the_light();
    let entries = casters_of(sample);
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let first = entries.x + group.z * GROUP + local;
    let course = Course(first, entries.y, GROUP * numbers.shares, cell[sample] != NO_CELL);
    let outcome = walk(course, sample, receiver, light);
    hide(sample, outcome.hidden);
    if outcome.is_open && (atomicOr(&queue[place], IN_DOUBTS) & IN_DOUBTS) == 0u {
        push(LONG_DOUBTS, sample);
    }
}
