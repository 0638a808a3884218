// Decides what soft_join.wgsl left in doubt, with closer bounds and then in two-float arithmetic: pairs one by one; and view-samples whose
// pairs found no room, with workgroups for each, casters shared out so thin that no invocation comes near the loop limit even where every
// light sample is in doubt: 6 casters of 256 decisions of 9 steps. Joined last; needs `counters` and `closer_block`.

fn light_sample(index: u32) -> vec3<f32> {
    return vec3<f32>(light_samples[3u * index], light_samples[3u * index + 1u], light_samples[3u * index + 2u]);
}

// What is known to be hidden of the block.
fn hidden_from(sample: u32) -> Bits {
    var hidden = NO_BITS;
    for (var word = 0u; word < word_count(); word++) {
        hidden = with_word(hidden, word, atomicLoad(&mask[sample * numbers.words + 8u * numbers.block + word]));
    }
    return hidden;
}

// Light samples of the block that the coplanar rule lets a caster hide: surely, and perhaps.
fn admitted_block(met: Met, receiver: Receiver, light: Light) -> Found {
    if met.rule == ALL {
        return Found(ALL_BITS, ALL_BITS);
    }
    let offset = light.middle - receiver.base;
    let slack = receiver.plane.w * (sum_of_sizes(offset) + light.reach);
    let height = vec4<f32>(receiver.plane.xyz * light.half, dot(receiver.plane.xyz, offset));
    let sides = sides_of_corner(receiver, met.a) | sides_of_corner(receiver, met.b) | sides_of_corner(receiver, met.c);
    let masks = select(vec4<u32>(0u), vec4<u32>(0xffffffffu), sides);
    var found = Found(NO_BITS, NO_BITS);
    for (var word = 0u; word < word_count(); word++) {
        var bits = vec2<u32>(0u);
        for (var four = 0u; four < 8u; four++) {
            let heights = values_at(height, places_of(8u * word + four));
            bits |= vec2<u32>(bits_of(heights < vec4<f32>(-slack)), bits_of(heights > vec4<f32>(slack))) << vec2<u32>(4u * four);
        }
        let open = ~(bits.x | bits.y);
        found.sure = with_word(found.sure, word, (bits.x & masks.x) | (bits.y & masks.y) | (open & masks.x & masks.y));
        found.may = with_word(found.may, word, (bits.x & masks.z) | (bits.y & masks.w) | open);
    }
    return found;
}

// What `caster` hides of the block, beyond `hidden`.
fn decide(caster: u32, receiver: Receiver, light: Light, hidden: Bits) -> Bits {
    let met = meet(caster, receiver, light);
    if met.pair.kind == NOTHING {
        return NO_BITS;
    }
    let found = closer_block(met.pair, met.a, met.b, met.c, receiver, light);
    let rule = admitted_block(met, receiver, light);
    let used = used_bits();
    var decided = both(both(found.sure, rule.sure), used);
    let doubts = without(both(both(found.may, rule.may), used), either(decided, hidden));
    for (var word = 0u; word < word_count(); word++) {
        var rest = word_of(doubts, word);
        var bits = 0u;
        while rest != 0u {
            let bit = firstTrailingBit(rest);
            rest &= rest - 1u;
            atomicAdd(&counters[0], 1u);
            let own = select(NO_TRIANGLE, receiver.own, receiver.has_plane);
            if pyramid_decide(caster, receiver.place, own, light_sample(256u * numbers.block + 32u * word + bit)) {
                bits |= 1u << bit;
            }
        }
        decided = either(decided, with_word(NO_BITS, word, bits));
    }
    return decided;
}

@compute @workgroup_size(64)
fn soft_pairs(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = (group.x + group.y * MAX_GROUPS) * GROUP + local;
    if place >= min(atomicLoad(&queued[PAIRS]), arrayLength(&doubtful_pairs)) {
        return;
    }
    let light = the_light();
    let sample = doubtful_pairs[place].x;
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    hide(sample, decide(doubtful_pairs[place].y, receiver, light, hidden_from(sample)));
}

// Entries first, first + step, ... of the casters of `sample`.
fn decide_all(sample: u32, first: u32, entry_step: u32) {
    let light = the_light();
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let entries = casters_of(sample);
    var course = Course(entries.x + first, entries.y, entry_step, cell[sample] != NO_CELL);
    var hidden = hidden_from(sample);
    for (; course.next < course.end; course.next += course.step) {
        hidden = either(hidden, decide(caster_at(course), receiver, light, hidden));
    }
    hide(sample, hidden);
}

@compute @workgroup_size(64)
fn soft_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place < atomicLoad(&queued[DOUBTS]) {
        decide_all(atomicLoad(&queue[DOUBTS * numbers.samples + place]), local, GROUP);
    }
}

@compute @workgroup_size(64)
fn soft_long_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place < atomicLoad(&queued[LONG_DOUBTS]) {
        let sample = atomicLoad(&queue[LONG_DOUBTS * numbers.samples + place]);
        decide_all(sample, group.z * GROUP + local, GROUP * numbers.doubt_shares);
    }
}
