//! What blocks say.

use super::{Block, Settings, Side};
use crate::statistics::{Interval, bootstrap_interval, median, order_interval, sign_test};
use shadowgraph_core::problem::{Kind, Problem};

/// B against A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// B takes less time, certainly and by more than the threshold.
    Faster,
    /// B takes more time, certainly and by more than the threshold.
    Slower,
    /// Neither is certain.
    Undecided,
}

/// Times of one side over all blocks.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct SideMillis {
    /// Median, milliseconds.
    pub median: f64,
    /// Its interval by order at the confidence reported; `None` with too few timings. Too narrow where the machine's pace wanders:
    /// compare sides by the ratio, not by these.
    pub interval: Option<Interval>,
}

impl SideMillis {
    fn of(side: Side, blocks: &[Block], confidence: f64) -> Result<Self, Problem> {
        let millis: Vec<f64> = blocks.iter().flat_map(|block| block.of(side)).collect();
        Ok(Self { median: median(&millis)?, interval: order_interval(&millis, confidence)? })
    }
}

/// A paired comparison in figures. Ratios are time of B over time of A.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Summary {
    /// Blocks it is of, at least one.
    pub blocks_count: u64,
    /// Median over blocks of the ratio.
    pub ratio: f64,
    /// Bootstrap interval of that median at `confidence`.
    pub interval: Interval,
    /// Confidence of `interval` and of `equivalent`.
    pub confidence: f64,
    /// Whether B is faster or slower.
    pub verdict: Verdict,
    /// Whether `interval` lies wholly within the threshold: if there is a difference, it does not count.
    pub equivalent: bool,
    /// Difference that does not count, as a share.
    pub threshold: f64,
    /// Confidence of `verdict`.
    pub verdict_confidence: f64,
    /// Bootstrap interval of the median ratio at `verdict_confidence`.
    pub verdict_interval: Interval,
    /// Blocks beyond the threshold on the side where the ratio lies.
    pub beyond_count: u64,
    /// Chance of so many of them, or more, if half of all blocks would lie there: the sign test, one-sided.
    pub beyond_chance: f64,
    /// Median ratio of the blocks A B B A alone and of the blocks B A A B alone, each `None` without such blocks. Far apart, they
    /// tell of something that comes in step with the blocks, such as a first frame that is always slow.
    pub ratio_by_order: [Option<f64>; 2],
    /// Spread of the blocks: 1.4826 times the median distance of their log ratios from the median, which for a normal distribution is
    /// its standard deviation. As a share of the ratio.
    pub spread: f64,
    /// Times of A.
    pub a_millis: SideMillis,
    /// Times of B.
    pub b_millis: SideMillis,
}

/// Judges blocks by the settings' threshold and confidences: those of a whole frame, or of one node in the same blocks.
///
/// # Errors
/// A setting or a block is wrong, or there is no block.
pub fn summarise(blocks: &[Block], settings: &Settings) -> Result<Summary, Problem> {
    settings.check()?;
    if blocks.is_empty() {
        return Err(Problem::new(Kind::Missing, "nothing was timed").expected("at least one block"));
    }
    blocks.iter().try_for_each(Block::check)?;
    let ratios: Vec<f64> = blocks.iter().map(Block::log_ratio).collect();
    let middle = median(&ratios)?;
    let interval = bootstrap_interval(&ratios, settings.confidence)?;
    let verdict_interval = bootstrap_interval(&ratios, settings.verdict_confidence)?;
    let edge = settings.threshold.ln_1p();
    // As if B were the slower one: where it is not, both sides change places.
    let turn = if middle < 0.0 { -1.0 } else { 1.0 };
    let beyond = ratios.iter().filter(|ratio| **ratio * turn > edge).count() as u64;
    let beyond_chance = sign_test(beyond, ratios.len() as u64);
    let nearest = if turn < 0.0 { -verdict_interval.high } else { verdict_interval.low };
    let by_order = Block::ORDERS.map(|order| {
        let of_order = blocks.iter().zip(&ratios).filter(|(block, _)| block.order == order);
        median(&of_order.map(|(_, ratio)| *ratio).collect::<Vec<_>>()).ok()
    });
    let balanced = by_order[0].zip(by_order[1]).map(|(first, second)| (first + second) / 2.0);
    let certain = nearest > edge
        && beyond_chance <= (1.0 - settings.verdict_confidence) / 2.0
        && balanced.is_some_and(|ratio| ratio * turn > edge);
    let distances: Vec<f64> = ratios.iter().map(|ratio| (ratio - middle).abs()).collect();
    Ok(Summary {
        blocks_count: blocks.len() as u64,
        ratio: middle.exp(),
        interval: interval.map(f64::exp),
        confidence: settings.confidence,
        verdict: match (certain, turn < 0.0) {
            (true, true) => Verdict::Faster,
            (true, false) => Verdict::Slower,
            (false, _) => Verdict::Undecided,
        },
        equivalent: interval.low >= -edge && interval.high <= edge,
        threshold: settings.threshold,
        verdict_confidence: settings.verdict_confidence,
        verdict_interval: verdict_interval.map(f64::exp),
        beyond_count: beyond,
        beyond_chance,
        ratio_by_order: by_order.map(|ratio| ratio.map(f64::exp)),
        // That of a normal distribution: 1 over the upper quartile of the standard one.
        spread: 1.482_602_218_505_602 * median(&distances)?,
        a_millis: SideMillis::of(Side::A, blocks, settings.confidence)?,
        b_millis: SideMillis::of(Side::B, blocks, settings.confidence)?,
    })
}
