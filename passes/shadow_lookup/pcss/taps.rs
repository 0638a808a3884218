//! Where the taps lie: a spiral that puts one tap in each of so many equal areas of the unit disc (Vogel 1979).

/// Most taps of one disc; the kernel's uniforms hold two discs of them.
pub const MOST_TAPS: usize = 256;

/// The golden angle, radians.
const TURN: f64 = 2.399_963_229_728_653;

/// `count` points of the unit disc, from the middle out.
pub fn spiral(count: usize) -> Vec<[f32; 2]> {
    (0..count)
        .map(|tap| {
            let radius = ((tap as f64 + 0.5) / count as f64).sqrt();
            let angle = TURN * tap as f64;
            [radius * angle.cos(), radius * angle.sin()].map(|x| x as f32)
        })
        .collect()
}
