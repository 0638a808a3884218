// Joined after lu.wgsl.

// Number of (view-sample, caster, light sample) that were decided in two-float arithmetic.
@group(0) @binding(18) var<storage, read_write> counters: array<atomic<u32>>;

// Largest error of a direction, and of a distance over R, that is looked up; the table's slack is above it by far.
const FIRM: f32 = 3e-5;

// What the table is sure of, and by arithmetic what it leaves open. Where a light sample comes within rounding of a plane, the
// pair is left to another kernel.
fn hidden_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, block: u32, receiver: Receiver, light: Light) -> Found {
    let sides = sides_of(pair, a, b, c, receiver, light);
    if sides.is_nothing {
        return Found(vec4<u32>(0u), false);
    }
    var certain = vec4<u32>(0xffffffffu);
    var possible = vec4<u32>(0xffffffffu);
    for (var k = 0u; k < 4u; k++) {
        let scaled = select(select(select(sides.front, sides.third, k == 2u), sides.second, k == 1u), sides.first, k == 0u);
        // Scaled to places in the light's box; back to offsets. Flat boxes have no normal along their short axes.
        let normal = select(vec3<f32>(0.0), scaled.xyz / light.half, light.half > vec3<f32>(0.0));
        if all(scaled.xyz == vec3<f32>(0.0)) {
            // The same all over the light: 2 where it does not cut, at most 1 where rounding hides its sign.
            certain = select(certain, vec4<u32>(0u), scaled.w <= 1.0);
            continue;
        }
        let size = length(normal);
        let reach = size * lu_layout[3];
        // A value errs by 1 at most, which is this share of the range that the bins divide.
        if !(FIRM * reach >= 1.0) {
            certain = vec4<u32>(0u);
            continue;
        }
        if abs(scaled.w) >= reach * (1.0 + 3.0 * FIRM) {
            possible = select(vec4<u32>(0u), possible, scaled.w > 0.0);
            continue;
        }
        let row = direction_row(normal / size);
        let bin = (block * lu_size * lu_size + row) * lu_size + bin_of(0.5 + 0.5 * scaled.w / reach);
        certain &= lu[2u * bin];
        possible &= lu[2u * bin + 1u];
    }
    var left = possible & ~certain & used_of(block);
    // A plane that has all of the light outside says so in `possible` alone.
    var hidden = certain & possible;
    var is_doubtful = false;
    for (var word = 0u; word < 4u; word++) {
        var rest = left[word];
        // Eight times at most: four light samples at a time.
        while rest != 0u {
            let four = firstTrailingBit(rest) / 4u;
            let group = 15u << (4u * four);
            let least = least_of(sides, 32u * block + 8u * word + four);
            let inside = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), least > vec4<f32>(0.0));
            let near = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), abs(least) <= vec4<f32>(1.0));
            hidden[word] |= ((inside.x | inside.y | inside.z | inside.w) << (4u * four)) & rest;
            is_doubtful |= (((near.x | near.y | near.z | near.w) << (4u * four)) & rest) != 0u;
            rest &= ~group;
        }
    }
    return Found(select(hidden, vec4<u32>(0u), is_doubtful), is_doubtful);
}
