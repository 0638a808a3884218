// Four casters at a time, by arithmetic: light samples are read once for all four. Joined after soft_join.wgsl and soft_sides.wgsl.

const BATCH: u32 = 4u;

// Casters that cut the light, waiting for their test.
struct Batch {
    count: u32,
    sides: array<Sides, 4>,
    casters: vec4<u32>,
}

// Planes that have all of the light outside.
fn empty_batch() -> Batch {
    let nothing = Sides(vec4<f32>(0.0, 0.0, 0.0, -2.0), vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0), true);
    return Batch(0u, array<Sides, 4>(nothing, nothing, nothing, nothing), vec4<u32>(0u));
}

// What a batch hides of the block, and which of its casters come within rounding of a light sample.
struct BatchFound {
    sure: Bits,
    is_near: vec4<bool>,
}

fn near_in(least: vec4<f32>) -> vec4<bool> {
    return (least >= vec4<f32>(-1.0)) & (least <= vec4<f32>(1.0));
}

fn batch_found(batch: Batch) -> BatchFound {
    var found = BatchFound(NO_BITS, vec4<bool>(false));
    var near_0 = vec4<bool>(false);
    var near_1 = vec4<bool>(false);
    var near_2 = vec4<bool>(false);
    var near_3 = vec4<bool>(false);
    for (var word = 0u; word < word_count(); word++) {
        var bits = 0u;
        for (var four = 0u; four < 8u; four++) {
            let at = places_of(8u * word + four);
            let least_0 = least_of(batch.sides[0], at);
            let least_1 = least_of(batch.sides[1], at);
            let least_2 = least_of(batch.sides[2], at);
            let least_3 = least_of(batch.sides[3], at);
            near_0 |= near_in(least_0);
            near_1 |= near_in(least_1);
            near_2 |= near_in(least_2);
            near_3 |= near_in(least_3);
            let one = vec4<f32>(1.0);
            bits |= bits_of((least_0 > one) | (least_1 > one) | (least_2 > one) | (least_3 > one)) << (4u * four);
        }
        found.sure = with_word(found.sure, word, bits);
    }
    found.is_near = vec4<bool>(any(near_0), any(near_1), any(near_2), any(near_3));
    return found;
}

// Puts `met` into the batch where it cuts the light or is in doubt; whether it hides the whole light.
fn take(met: Met, light: Light, batch: ptr<function, Batch>) -> bool {
    let is_doubtful = met.rule == WITHIN || met.pair.winding == 0.0;
    if met.pair.kind == WITHIN || (met.pair.kind == ALL && is_doubtful) {
        // What is in doubt is zero all over the light.
        var sides = quick_sides(met.pair, light);
        let scale = select(1.0, 0.0, is_doubtful);
        sides = Sides(sides.first * scale, sides.second * scale, sides.third * scale, sides.front * scale, false);
        (*batch).sides = array<Sides, 4>(sides, (*batch).sides[0], (*batch).sides[1], (*batch).sides[2]);
        (*batch).casters = vec4<u32>(met.caster, (*batch).casters.xyz);
        (*batch).count += 1u;
    }
    return met.pair.kind == ALL && !is_doubtful;
}

// Tests the batch, and empties it.
fn settle(used: Bits, batch: ptr<function, Batch>, hidden: ptr<function, Bits>, doubts: ptr<function, Doubts>) {
    let found = batch_found(*batch);
    *hidden = either(*hidden, both(found.sure, used));
    let is_open = is_any(without(used, *hidden));
    add_doubt(doubts, (*batch).casters.x, found.is_near.x && is_open);
    add_doubt(doubts, (*batch).casters.y, found.is_near.y && is_open);
    add_doubt(doubts, (*batch).casters.z, found.is_near.z && is_open);
    add_doubt(doubts, (*batch).casters.w, found.is_near.w && is_open);
    *batch = empty_batch();
}

fn walk(all: Course, sample: u32, receiver: Receiver, light: Light) -> Outcome {
    let used = used_bits();
    var course = all;
    var hidden = NO_BITS;
    var doubts: Doubts;
    var batch = empty_batch();
    while course.next < course.end && is_any(without(used, hidden)) {
        while course.next < course.end && is_any(without(used, hidden)) && doubts.count <= MOST_DOUBTS {
            while course.next < course.end && batch.count < BATCH && is_any(without(used, hidden)) {
                hidden = choose(hidden, used, take(meet(caster_at(course), receiver, light), light, &batch));
                course.next += course.step;
            }
            settle(used, &batch, &hidden, &doubts);
        }
        queue_doubts(&doubts, sample);
    }
    return Outcome(hidden, doubts.is_open);
}
