// Joined after lu.wgsl.

// Number of (view-sample, caster, light sample) that were decided in two-float arithmetic: where the coplanar rule is in doubt.
@group(0) @binding(20) var<storage, read_write> counters: array<atomic<u32>>;

fn axis(start: u32) -> vec3<f32> {
    return vec3<f32>(lu_layout[start], lu_layout[start + 1u], lu_layout[start + 2u]);
}

// The AND of what the table has for the lines in which the planes meet the light's.
fn hidden_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Found {
    let winding = winding_of(pair, a, b, c, receiver);
    var hidden = choose(NO_BITS, ALL_BITS, winding != 0.0);
    var rest = planes_to_look_up(pair);
    while rest != 0u {
        let k = firstTrailingBit(rest);
        rest &= rest - 1u;
        var plane = ordered_plane(k, winding, a, b, c, receiver, light);
        // The table counts from the light's plane.
        plane.constant += dot(plane.normal, axis(12u)) * lu_layout[15];
        let line = vec2<f32>(dot(plane.normal, axis(4u)), dot(plane.normal, axis(8u)));
        let reach = length(line) * lu_layout[3];
        let side = whole_side(plane, reach);
        if side != 0.0 {
            hidden = choose(hidden, NO_BITS, side < 0.0);
            continue;
        }
        let row = bin_of(angle(line.y, line.x) / (2.0 * PI) + 0.5);
        let places = (tables_of_block() * lu_size + row) * lu_size + bin_of(0.5 + 0.5 * plane.constant / reach);
        let bits = Bits(lu[places.x], lu[places.y]);
        hidden = both(hidden, choose(bits, without(ALL_BITS, bits), plane.is_turned));
    }
    return Found(hidden, hidden);
}

// The table has no closer look.
fn closer_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Found {
    return hidden_block(pair, a, b, c, receiver, light);
}
