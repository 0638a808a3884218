// The shadow map's depth; the same operations in the same order as shadow_map.rs.

const NEAR_SHARE: f32 = 0.0009765625;
const SECOND_STEP: f32 = 0.00000023841858;
// The largest finite number: further than anything.
const NOTHING_SEEN: f32 = 3.4028234e38;

fn linear_from_depth(depth: f32, far: f32) -> f32 {
    if depth >= 1.0 {
        return NOTHING_SEEN;
    }
    let near = far * NEAR_SHARE;
    return near * far / (far - depth * (far - near));
}

fn depth_step(w: f32, far: f32) -> f32 {
    return w * w / (far * NEAR_SHARE) * 0.00000023841858;
}
