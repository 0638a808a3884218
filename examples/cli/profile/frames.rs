//! Whole frames, with node timers and without, in turn.

use super::{MeasuredFrame, Settings};
use crate::outcome::Outcome;
use crate::trial::Trial;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;
use shadowgraph_cpu::Progress;
use std::time::Instant;

/// What whole frames gave.
pub struct Measured {
    /// In order. Where there are frames with timers and without, the n-th of one kind ran beside the n-th of the other.
    pub frames: Vec<MeasuredFrame>,
    /// Bytes, clocks and counts of the last frame.
    pub last: Outcome,
}

impl Measured {
    /// Frames with timers on.
    pub fn timed(&self) -> impl Iterator<Item = &MeasuredFrame> {
        self.frames.iter().filter(|frame| frame.timers)
    }

    /// How long frames with timers on, or off, took.
    pub fn millis(&self, timers: bool) -> Vec<f64> {
        self.frames.iter().filter(|frame| frame.timers == timers).map(|frame| frame.millis).collect()
    }
}

/// Runs the warm-up and the measured frames. Frames with and without timers run in the order on, off, off, on, so that a drift of the
/// machine weighs on both alike.
///
/// # Errors
/// As [`Trial::frame`].
pub fn measure(trial: &mut Trial, settings: &Settings, progress: &Progress) -> Result<Measured, Problem> {
    let plan = trial.plan();
    // On the CPU a frame is the same with timers and without.
    let has_device = plan.nodes.iter().any(|node| node.on == Backend::Wgpu);
    let frames = u64::from(settings.frames);
    for frame in 0..settings.warm_up {
        progress("warm-up", u64::from(frame), u64::from(settings.warm_up));
        trial.frame(settings.timers)?;
    }
    let from = Instant::now();
    let mut measured = Measured { frames: Vec::new(), last: Outcome::new(plan) };
    for index in 0..frames {
        progress("frames", index, frames);
        let both = if index % 2 == 0 { [true, false] } else { [false, true] };
        let wanted = |timers: &bool| if *timers { settings.timers } else { has_device || !settings.timers };
        for timers in both.into_iter().filter(wanted) {
            let begin_millis = from.elapsed().as_secs_f64() * 1e3;
            let frame = trial.frame(timers)?;
            let mut pieces = frame.pieces.clone();
            if !timers {
                pieces.retain(|(_, reading)| *reading != Reading::Untimed);
            }
            measured.frames.push(MeasuredFrame { timers, begin_millis, millis: frame.millis, pieces });
            // A frame without timers knows no clock: what is kept is of the timed one, if there is one.
            if timers || !settings.timers {
                frame.record(plan, &mut measured.last, false);
            }
        }
    }
    Ok(measured)
}
