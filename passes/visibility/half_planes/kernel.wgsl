// Joined after soft_join.wgsl.

// Number of (view-sample, caster, light sample) that were decided in two-float arithmetic.
@group(0) @binding(17) var<storage, read_write> counters: array<atomic<u32>>;

// All planes at every light sample of the block, with closer bounds.
fn closer_block(pair: Pair, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, receiver: Receiver, light: Light) -> Found {
    let sides = sides_of(pair, a, b, c, receiver, light);
    if sides.is_nothing {
        return Found(NO_BITS, NO_BITS);
    }
    return block_found(sides);
}
