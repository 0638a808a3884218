//! Simulated machines: how long a frame takes on one that is shared, drifts and hiccups.

use super::Side::A;
use super::{Block, Paired, Settings, Side, Stop, Summary, summarise};
use fastrand::Rng;

/// Milliseconds of a frame on a quiet machine.
const FRAME_MILLIS: f64 = 20.0;

/// What disturbs a frame, as a factor on its time.
#[derive(Clone, Copy, Debug)]
pub enum Noise {
    /// Log-normal, 2 %.
    Calm,
    /// Log-normal, 12 %.
    Loud,
    /// Student's t of 2 degrees of freedom, one-sided: no variance, now and then many times the time.
    HeavyTails,
    /// Other work comes for about 12 frames, goes for about 60, and costs a half to twice the time.
    Bursts,
    /// Slower by half over the run, on a wave of a random length and 20 %.
    Drift,
    /// First-order autocorrelated, 15 %, over about 50 frames.
    Wandering,
    /// The middle two frames of each block, both of one side, cost 30 % more.
    InStep,
    /// Two paces 25 % apart that change every 40 frames or so.
    TwoPaces,
    /// The first frame after one of the other side costs 8 % more.
    Switching,
    /// Work of another process in turns of 9 frames, each of them 40 % longer, and single frames of thrice the time.
    Shared,
}

/// All of them.
pub const ALL: [Noise; 10] = [
    Noise::Calm,
    Noise::Loud,
    Noise::HeavyTails,
    Noise::Bursts,
    Noise::Drift,
    Noise::Wandering,
    Noise::InStep,
    Noise::TwoPaces,
    Noise::Switching,
    Noise::Shared,
];

/// Standard normal by Box and Muller.
fn normal(random: &mut Rng) -> f64 {
    (-2.0 * (1.0 - random.f64()).ln()).sqrt() * (std::f64::consts::TAU * random.f64()).cos()
}

/// A machine in some state.
pub struct Machine {
    noise: Noise,
    random: Rng,
    frame: u64,
    busy: bool,
    wander: f64,
    wave_frames: f64,
    phase: f64,
    last: Side,
    /// How much longer B takes than A, as a factor.
    b_factor: f64,
}

impl Machine {
    pub fn new(noise: Noise, b_factor: f64, seed: u64) -> Self {
        let mut random = Rng::with_seed(seed);
        let wave_frames = 10.0 + 300.0 * random.f64();
        let phase = random.f64();
        Self { noise, busy: false, wander: 0.0, wave_frames, phase, random, frame: 0, last: A, b_factor }
    }

    /// Times a frame.
    pub fn frame(&mut self, side: Side) -> f64 {
        let random = &mut self.random;
        let frame = self.frame as f64;
        let jitter = (0.01 * normal(random)).exp();
        let factor = match self.noise {
            Noise::Calm => jitter * (0.02 * normal(random)).exp(),
            Noise::Loud => (0.12 * normal(random)).exp(),
            Noise::HeavyTails => {
                let t = normal(random) / ((normal(random).powi(2) + normal(random).powi(2)) / 2.0).sqrt();
                jitter * (1.0 + 0.05 * t.abs())
            }
            Noise::Bursts => {
                self.busy = if self.busy { random.f64() > 1.0 / 12.0 } else { random.f64() < 1.0 / 60.0 };
                jitter * if self.busy { 1.5 + 0.5 * random.f64() } else { 1.0 }
            }
            Noise::Drift => {
                let wave = (std::f64::consts::TAU * (frame / self.wave_frames + self.phase)).sin();
                jitter * (1.0 + 0.5 * frame / 400.0) * (1.0 + 0.2 * wave)
            }
            Noise::Wandering => {
                self.wander = 0.98 * self.wander + 0.15 * (1.0 - 0.98f64.powi(2)).sqrt() * normal(random);
                jitter * self.wander.exp()
            }
            Noise::InStep => jitter * if matches!(self.frame % 4, 1 | 2) { 1.3 } else { 1.0 },
            Noise::TwoPaces => {
                self.busy ^= random.f64() < 1.0 / 40.0;
                jitter * if self.busy { 1.25 } else { 1.0 }
            }
            Noise::Switching => jitter * if side == self.last { 1.0 } else { 1.08 },
            Noise::Shared => {
                let turn = if (self.frame / 9).is_multiple_of(2) { 1.4 } else { 1.0 };
                let hiccup = if random.f64() < 0.03 { 3.0 } else { 1.0 };
                jitter * jitter * turn * hiccup
            }
        };
        self.frame += 1;
        self.last = side;
        FRAME_MILLIS * factor * if side == A { 1.0 } else { self.b_factor }
    }
}

/// A whole comparison of B against A.
pub fn run(noise: Noise, b_factor: f64, settings: Settings) -> (Summary, Stop) {
    let mut machine = Machine::new(noise, b_factor, settings.seed.wrapping_mul(0x9e37_79b9) ^ 0x5bd1);
    let mut paired = Paired::new(settings).unwrap();
    while let Some(order) = paired.next_block() {
        paired.push(order.map(|side| machine.frame(side))).unwrap();
    }
    (paired.summary().unwrap(), paired.stop().unwrap())
}

/// A comparison as it should not be: `orders` come in turn instead of by a coin. Whether the interval and the sign test of its verdict
/// would call the same graph different.
pub fn differs_in_turn(noise: Noise, orders: &[[Side; 4]], blocks: usize, settings: Settings) -> bool {
    let mut machine = Machine::new(noise, 1.0, settings.seed);
    let block = |order: &[Side; 4]| Block { order: *order, millis: order.map(|side| machine.frame(side)) };
    let blocks: Vec<Block> = orders.iter().cycle().take(blocks).map(block).collect();
    let found = summarise(&blocks, &settings).unwrap();
    let outside = found.verdict_interval.low > 1.0 + settings.threshold;
    outside && found.beyond_chance <= (1.0 - settings.verdict_confidence) / 2.0
}
