// One caster at a time. Joined after soft_join.wgsl; the pass defines `hidden_block`.

// What a caster hides of the block.
fn hides(met: Met, receiver: Receiver, light: Light) -> Found {
    let found = hidden_block(met.pair, met.a, met.b, met.c, receiver, light);
    return Found(choose(found.sure, NO_BITS, met.rule == WITHIN), found.may);
}

// The next caster that hides some of the block: what hides all of it fills `hidden`. NOTHING at the end.
fn next_caster(course: ptr<function, Course>, hidden: ptr<function, Bits>, used: Bits, receiver: Receiver, light: Light) -> Met {
    var met: Met;
    loop {
        met.pair.kind = NOTHING;
        if (*course).next >= (*course).end || !is_any(without(used, *hidden)) {
            break;
        }
        met = meet(caster_at(*course), receiver, light);
        (*course).next += (*course).step;
        if met.pair.kind == ALL && met.rule == ALL {
            *hidden = used;
        } else if met.pair.kind != NOTHING {
            break;
        }
    }
    return met;
}

fn walk(all: Course, sample: u32, receiver: Receiver, light: Light) -> Outcome {
    let used = used_bits();
    var course = all;
    var hidden = NO_BITS;
    var doubts: Doubts;
    while course.next < course.end && is_any(without(used, hidden)) {
        while doubts.count <= MOST_DOUBTS {
            let met = next_caster(&course, &hidden, used, receiver, light);
            if met.pair.kind == NOTHING {
                break;
            }
            let found = hides(met, receiver, light);
            hidden = either(hidden, both(found.sure, used));
            add_doubt(&doubts, met.caster, is_any(without(both(found.may, used), hidden)));
        }
        queue_doubts(&doubts, sample);
    }
    return Outcome(hidden, doubts.is_open);
}
