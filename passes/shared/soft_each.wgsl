// One caster at a time. Joined after soft_join.wgsl; the pass defines `hidden_block`.

// What a caster hides of the block.
fn hides(met: Met, receiver: Receiver, light: Light) -> Found {
    let found = hidden_block(met.pair, met.a, met.b, met.c, receiver, light);
    return Found(choose(found.sure, NO_BITS, met.rule == WITHIN), found.may);
}

// The next caster that hides some of the block, from `entry` on: what hides all of it fills `hidden`. NOTHING at the end.
fn next_caster(entry: ptr<function, u32>, end: u32, hidden: ptr<function, Bits>, used: Bits, receiver: Receiver, light: Light) -> Met {
    var met: Met;
    loop {
        met.pair.kind = NOTHING;
        if *entry >= end || !is_any(without(used, *hidden)) {
            break;
        }
        met = meet(caster_entries[*entry], receiver, light);
        *entry += 1u;
        if met.pair.kind == ALL && met.rule == ALL {
            *hidden = used;
        } else if met.pair.kind != NOTHING {
            break;
        }
    }
    return met;
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
    let used = used_bits();
    var hidden = NO_BITS;
    var entry = entries.x;
    var doubts: Doubts;
    while entry < entries.y && is_any(without(used, hidden)) {
        while doubts.count <= MOST_DOUBTS {
            let met = next_caster(&entry, entries.y, &hidden, used, receiver, light);
            if met.pair.kind == NOTHING {
                break;
            }
            let found = hides(met, receiver, light);
            hidden = either(hidden, both(found.sure, used));
            add_doubt(&doubts, met.caster, is_any(without(both(found.may, used), hidden)));
        }
        queue_doubts(&doubts, sample);
    }
    hide(sample, hidden);
    if doubts.is_open {
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
    let used = used_bits();
    var hidden = NO_BITS;
    var may = NO_BITS;
    for (var entry = entries.x + group.z * GROUP + local; entry < entries.y && is_any(without(used, hidden));
        entry += GROUP * numbers.shares) {
        let met = meet(caster_at(sample, entry), receiver, light);
        if met.pair.kind != NOTHING {
            let found = hides(met, receiver, light);
            hidden = either(hidden, both(found.sure, used));
            may = either(may, both(found.may, used));
        }
    }
    hide(sample, hidden);
    if is_any(without(may, hidden)) && (atomicOr(&queue[place], IN_DOUBTS) & IN_DOUBTS) == 0u {
        push(LONG_DOUBTS, sample);
    }
}
