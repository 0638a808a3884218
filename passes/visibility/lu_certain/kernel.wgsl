// Joined after lu.wgsl.

// Number of (view-sample, caster, light sample) that were decided in two-float arithmetic.
@group(0) @binding(20) var<storage, read_write> counters: array<atomic<u32>>;

// Largest error of a direction, and of a distance over R, that is looked up; the table's slack is above it by far.
const FIRM: f32 = 1e-4;

// What the table is sure of, and by arithmetic what it leaves open. Where a light sample comes within rounding of a plane, the
// pair is left to another kernel.
fn hidden_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Found {
    let sides = quick_sides(pair, light);
    var certain = ALL_BITS;
    var possible = ALL_BITS;
    var planes = planes_to_look_up(pair);
    while planes != 0u {
        let k = firstTrailingBit(planes);
        planes &= planes - 1u;
        let scaled = select(select(select(sides.front, sides.third, k == 2u), sides.second, k == 1u), sides.first, k == 0u);
        // Scaled to places in the light's box; back to offsets. Flat boxes have no normal along their short axes.
        let normal = select(vec3<f32>(0.0), scaled.xyz / light.half, light.half > vec3<f32>(0.0));
        if all(scaled.xyz == vec3<f32>(0.0)) {
            // The same all over the light: 2 where it does not cut, at most 1 where rounding hides its sign.
            certain = choose(certain, NO_BITS, scaled.w <= 1.0);
            continue;
        }
        let size = length(normal);
        let reach = size * lu_layout[3];
        // A value errs by 1 at most, which is this share of the range that the bins divide.
        if !(FIRM * reach >= 1.0) {
            certain = NO_BITS;
            continue;
        }
        if abs(scaled.w) >= reach * (1.0 + 3.0 * FIRM) {
            possible = choose(NO_BITS, possible, scaled.w > 0.0);
            continue;
        }
        let row = direction_row(normal / size);
        let bins = 2u * ((tables_of_block() * (lu_size * lu_size) + row) * lu_size + bin_of(0.5 + 0.5 * scaled.w / reach));
        certain = both(certain, Bits(lu[bins.x], lu[bins.y]));
        possible = both(possible, Bits(lu[bins.x + 1u], lu[bins.y + 1u]));
    }
    // A plane that has all of the light outside says so in `possible` alone.
    var sure = both(certain, possible);
    var may = sure;
    var left = both(without(possible, certain), used_bits());
    // Four light samples at a time, at most 64 times.
    while is_any(left) {
        let word = first_word(left);
        let rest = word_of(left, word);
        let shift = firstTrailingBit(rest) & ~3u;
        let found = (four_found(sides, 8u * word + shift / 4u) << vec2<u32>(shift)) & vec2<u32>(rest);
        sure = either(sure, with_word(NO_BITS, word, found.x));
        may = either(may, with_word(NO_BITS, word, found.y));
        left = without(left, with_word(NO_BITS, word, 15u << shift));
    }
    return Found(choose(sure, NO_BITS, pair.winding == 0.0), choose(may, ALL_BITS, pair.winding == 0.0));
}

// The same by arithmetic alone, looked at more closely.
fn closer_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Found {
    let sides = sides_of(pair, a, b, c, receiver, light);
    if sides.is_nothing {
        return Found(NO_BITS, NO_BITS);
    }
    return block_found(sides);
}
