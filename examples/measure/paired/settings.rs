//! What is asked of a comparison.

use shadowgraph_core::problem::{Kind, Problem};

/// How sure, how narrow, how long.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Settings {
    /// Difference that does not count, as a share, above 0: 0.02 stands for ratios from 1/1.02 to 1.02.
    pub threshold: f64,
    /// Confidence of the interval reported and of equivalence, between 0 and 1.
    pub confidence: f64,
    /// Confidence of a verdict, between 0 and 1: the chance that equal graphs are called different is at most what it leaves over.
    pub verdict_confidence: f64,
    /// Half width of the interval reported at which measuring stops, as a share of the ratio, above 0.
    pub half_width: f64,
    /// Blocks before the first look, at least one. Fewer than 15 cannot give a verdict at 0.9999.
    pub pilot_blocks: u32,
    /// Most blocks, at least the pilot.
    pub most_blocks: u32,
    /// Most time, milliseconds, above 0; no block is begun that would go past it, but for the first. `None` for no limit.
    pub budget_millis: Option<f64>,
    /// What the coin starts from; equal seeds give equal orders.
    pub seed: u64,
}

impl Default for Settings {
    /// A difference of 2 % counts, at 99.99 %; 1 % either way at 95 %; 20 to 4000 blocks, two minutes.
    fn default() -> Self {
        Self {
            threshold: 0.02,
            confidence: 0.95,
            verdict_confidence: 0.9999,
            half_width: 0.01,
            pilot_blocks: 20,
            most_blocks: 4000,
            budget_millis: Some(120_000.0),
            seed: 1,
        }
    }
}

impl Settings {
    /// # Errors
    /// A setting lies outside its range.
    pub fn check(&self) -> Result<(), Problem> {
        let share = |value: f64| value > 0.0 && value < 1.0;
        let above = |value: f64| value > 0.0 && value.is_finite();
        let wrong = [
            ("threshold", above(self.threshold), "a share above 0", self.threshold.to_string()),
            ("confidence", share(self.confidence), "between 0 and 1", self.confidence.to_string()),
            (
                "verdict_confidence",
                share(self.verdict_confidence),
                "between 0 and 1",
                self.verdict_confidence.to_string(),
            ),
            ("half_width", above(self.half_width), "a share above 0", self.half_width.to_string()),
            ("pilot_blocks", self.pilot_blocks > 0, "1 or more", self.pilot_blocks.to_string()),
            (
                "most_blocks",
                self.most_blocks >= self.pilot_blocks,
                "at least pilot_blocks",
                format!("{} for {} of the pilot", self.most_blocks, self.pilot_blocks),
            ),
            (
                "budget_millis",
                self.budget_millis.is_none_or(above),
                "milliseconds above 0",
                format!("{:?}", self.budget_millis),
            ),
        ];
        match wrong.into_iter().find(|(_, holds, ..)| !holds) {
            None => Ok(()),
            Some((name, _, expected, found)) => Err(Problem::new(Kind::BadValue, "a paired comparison cannot run so")
                .port(name)
                .expected(expected)
                .found(found)),
        }
    }
}
