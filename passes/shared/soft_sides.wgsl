// Light samples against the planes of a pair, by arithmetic: light_sides.rs and the f64 of view_planes.rs in two-float numbers.
// Joined after soft_pair.wgsl.

// Planes scaled so that rounding moves no value by more than 1: xyz for places in the light's box, w the constant. Planes that do not
// cut the light are 2 everywhere.
struct Sides {
    first: vec4<f32>,
    second: vec4<f32>,
    third: vec4<f32>,
    front: vec4<f32>,
    // The caster is seen edge-on, or all of the light is outside after all.
    is_nothing: bool,
}

// What rounding may do to a value in f32, of its range over the light's box and its constant: sixteen roundings with room.
const EVALUATED: f32 = 2e-6;
// And in two-float numbers, of the product of three lengths: 2^-40.
const WIDE_ERROR: f32 = 9.1e-13;

// The planes of a pair in f32 alone: a quick look, which leaves more in doubt. Without a winding it says nothing.
fn quick_sides(pair: Pair, light: Light) -> Sides {
    var scaled: array<vec4<f32>, 4>;
    for (var k = 0u; k < 4u; k++) {
        let range = dot(abs(pair.normals[k]), light.half);
        let slack = pair.slack[k] + EVALUATED * (range + abs(pair.value[k]));
        let scale = select(pair.winding / slack, 0.0, slack == 0.0);
        let plane = vec4<f32>(pair.normals[k] * light.half, pair.value[k]) * scale;
        scaled[k] = select(vec4<f32>(0.0, 0.0, 0.0, 2.0), plane, pair.cut[k]);
    }
    return Sides(scaled[0], scaled[1], scaled[2], scaled[3], false);
}

fn sides_of(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Sides {
    var sides = Sides(vec4<f32>(0.0, 0.0, 0.0, 2.0), vec4<f32>(0.0, 0.0, 0.0, 2.0), vec4<f32>(0.0, 0.0, 0.0, 2.0),
        vec4<f32>(0.0, 0.0, 0.0, 2.0), false);
    var winding = pair.winding;
    // Step 0 is the winding; 1 to 3 the edges; 4 the supporting plane. One call site of `determinant`: compilers copy it into every one.
    for (var step = 0u; step < 5u; step++) {
        if step == 0u && winding != 0.0 {
            continue;
        }
        if step > 0u && winding != 0.0 && !pair.cut[step - 1u] && pair.winding != 0.0 {
            continue;
        }
        let is_edge = step >= 1u && step <= 3u;
        let tail = select(select(a, b, step == 2u), c, step == 3u);
        let tip = select(select(b, c, step == 2u), a, step == 3u);
        let line = exact_sum(tip, -tail);
        // Offsets of the light's middle, or for the winding of a corner, from where the plane is held.
        let held_at = select(tail, receiver.place, is_edge || step == 0u);
        let seen = exact_sum(select(light.middle, a, step == 0u), -held_at);
        let other_end = select(c, tail, is_edge);
        let other = exact_sum(other_end, -select(tail, receiver.place, is_edge));
        // Edges: det(M - P, v, line); the others: det(M - A or A - P, B - A, C - A).
        let first = Wide3(select(line.high, other.high, is_edge), select(line.low, other.low, is_edge));
        let second = Wide3(select(other.high, line.high, is_edge), select(other.low, line.low, is_edge));
        let value = determinant(seen, first, second);
        if step == 0u {
            winding = select(sign(value.x), sign(value.y), value.x == 0.0);
            if winding == 0.0 {
                sides.is_nothing = true;
                return sides;
            }
            continue;
        }
        let plane = plane_through(first.high, second.high);
        let range = dot(abs(plane.xyz), light.half);
        let wide = WIDE_ERROR * sum_of_sizes(seen.high) * sum_of_sizes(first.high) * sum_of_sizes(second.high);
        let slack = EVALUATED * (range + abs(value.x)) + wide + plane.w * light.reach;
        let turned = winding * value.x;
        let width = spread_of(plane.xyz, light) + slack;
        if turned < -width {
            sides.is_nothing = true;
            return sides;
        }
        if turned <= width {
            // Slack is above zero but where an edge or an offset has no length: then the value is zero everywhere, which is inside.
            let scale = select(winding / slack, 0.0, slack == 0.0);
            let scaled = vec4<f32>(plane.xyz * light.half * scale, select(value.x * scale, 2.0, slack == 0.0));
            switch step {
                case 1u: { sides.first = scaled; }
                case 2u: { sides.second = scaled; }
                case 3u: { sides.third = scaled; }
                default: { sides.front = scaled; }
            }
        }
    }
    return sides;
}

fn lesser(a: vec4<f32>, b: vec4<f32>) -> vec4<f32> {
    return select(b, a, a < b);
}

// The smallest value over the planes at four light samples: above 1 surely inside, below -1 surely outside.
fn least_of(sides: Sides, at: Places) -> vec4<f32> {
    return lesser(
        lesser(values_at(sides.first, at), values_at(sides.second, at)),
        lesser(values_at(sides.third, at), values_at(sides.front, at)),
    );
}

// Light samples 4 * four to 4 * four + 3 surely, and perhaps inside.
fn four_found(sides: Sides, four: u32) -> vec2<u32> {
    let least = least_of(sides, places_of(four));
    return vec2<u32>(bits_of(least > vec4<f32>(1.0)), bits_of(least >= vec4<f32>(-1.0)));
}

// All planes at every light sample of the block.
fn block_found(sides: Sides) -> Found {
    var found = Found(NO_BITS, NO_BITS);
    for (var word = 0u; word < word_count(); word++) {
        var bits = vec2<u32>(0u);
        for (var four = 0u; four < 8u; four++) {
            bits |= four_found(sides, 8u * word + four) << vec2<u32>(4u * four);
        }
        found = Found(with_word(found.sure, word, bits.x), with_word(found.may, word, bits.y));
    }
    return found;
}
