// Decides what soft_join.wgsl left in doubt, in two-float arithmetic: workgroups for each (view-sample, block), casters shared out so
// thin that no invocation comes near the loop limit even where every light sample is in doubt: 12 casters of 128 decisions of 9 steps.
// Joined last; needs soft_sides.wgsl and `counters`.

fn light_sample(index: u32) -> vec3<f32> {
    return light_words[2u + 96u * numbers.blocks + index].xyz;
}

// All of `block` that `caster` hides.
fn decide_block(caster: u32, block: u32, receiver: Receiver, light: Light) -> vec4<u32> {
    let a = triangle_corner(caster, 0u);
    let b = triangle_corner(caster, 1u);
    let c = triangle_corner(caster, 2u);
    let pair = pair_of(a, b, c, receiver, light);
    let rule = admitted(receiver, a, b, c);
    let sides = sides_of(pair, a, b, c, receiver, light);
    if sides.is_nothing {
        return vec4<u32>(0u);
    }
    var hidden = vec4<u32>(0u);
    var doubts = vec4<u32>(0u);
    for (var four = 0u; four < 32u; four++) {
        let least = least_of(sides, 32u * block + four);
        let sure = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), least > vec4<f32>(1.0));
        let may = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), least >= vec4<f32>(-1.0));
        let shift = 4u * (four % 8u);
        hidden[four / 8u] |= (sure.x | sure.y | sure.z | sure.w) << shift;
        doubts[four / 8u] |= (may.x | may.y | may.z | may.w) << shift;
    }
    let used = used_of(block);
    // Where the coplanar rule is open, all that may be hidden is asked about.
    doubts = select(doubts & ~hidden, doubts, rule == UNKNOWN) & used;
    hidden = select(hidden, vec4<u32>(0u), rule == UNKNOWN) & used;
    let start = 128u * block;
    for (var bit = 0u; bit < 128u && any(doubts != vec4<u32>(0u)); bit++) {
        let word = bit / 32u;
        if (doubts[word] >> (bit % 32u) & 1u) == 0u {
            continue;
        }
        doubts[word] ^= 1u << (bit % 32u);
        atomicAdd(&counters[0], 1u);
        if pyramid_decide(caster, receiver.place, select(NO_TRIANGLE, receiver.own, receiver.has_plane), light_sample(start + bit)) {
            hidden[word] |= 1u << (bit % 32u);
        }
    }
    return hidden;
}

fn decide(item: u32, first: u32, entry_step: u32) {
    let sample = item / numbers.blocks;
    let block = item % numbers.blocks;
    let light = the_light();
    let receiver = receiver_of(place_of(sample), own_triangle[sample], light);
    let casters = casters_of(sample);
    var hidden = vec4<u32>(0u);
    for (var entry = casters.x + first; entry < casters.y; entry += entry_step) {
        let caster = caster_at(sample, entry);
        if hides(caster, block, receiver, light).is_doubtful {
            hidden |= decide_block(caster, block, receiver, light);
        }
    }
    hide(sample, block, hidden);
}

@compute @workgroup_size(64)
fn soft_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place < atomicLoad(&queued[DOUBTS]) {
        decide(atomicLoad(&queue[DOUBTS * numbers.samples * numbers.blocks + place]), local, GROUP);
    }
}

@compute @workgroup_size(64)
fn soft_long_doubts(@builtin(workgroup_id) group: vec3<u32>, @builtin(local_invocation_index) local: u32) {
    let place = group.x + group.y * MAX_GROUPS;
    if place < atomicLoad(&queued[LONG_DOUBTS]) {
        let item = atomicLoad(&queue[LONG_DOUBTS * numbers.samples * numbers.blocks + place]);
        decide(item, group.z * GROUP + local, GROUP * numbers.doubt_shares);
    }
}
