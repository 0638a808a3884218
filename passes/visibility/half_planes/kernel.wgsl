// Joined after soft_join.wgsl.

// Number of (view-sample, caster, light sample) that were decided in two-float arithmetic.
@group(0) @binding(15) var<storage, read_write> counters: array<atomic<u32>>;

// All planes at every light sample of the block. Where one comes within rounding of a plane, the pair is left to another kernel.
fn hidden_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, block: u32, receiver: Receiver, light: Light) -> Found {
    let sides = sides_of(pair, a, b, c, receiver, light);
    if sides.is_nothing {
        return Found(vec4<u32>(0u), false);
    }
    var hidden = vec4<u32>(0u);
    var nearest = vec4<f32>(2.0);
    for (var word = 0u; word < 4u; word++) {
        var bits = 0u;
        for (var four = 0u; four < 8u; four++) {
            let least = least_of(sides, 32u * block + 8u * word + four);
            nearest = min(nearest, abs(least));
            let inside = select(vec4<u32>(0u), vec4<u32>(1u, 2u, 4u, 8u), least > vec4<f32>(0.0));
            bits |= (inside.x | inside.y | inside.z | inside.w) << (4u * four);
        }
        hidden[word] = bits;
    }
    let is_doubtful = min(min(nearest.x, nearest.y), min(nearest.z, nearest.w)) <= 1.0;
    return Found(select(hidden, vec4<u32>(0u), is_doubtful), is_doubtful);
}
