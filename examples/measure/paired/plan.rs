//! Which block comes next, and whether one does.

use super::{Block, Settings, Side, Summary, summarise};
use crate::statistics::{bootstrap_interval, order_interval};
use shadowgraph_core::problem::{Kind, Problem};

/// Half widths of the interval reported that the verdict's may have: for a normal distribution 99.99 % is twice as wide as 95 %, and
/// an interval by order wider than one by bootstrap.
const VERDICT_WIDTHS: f64 = 2.5;

/// Why measuring ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stop {
    /// The interval is as narrow as asked for.
    Precise,
    /// As many blocks as allowed.
    MostBlocks,
    /// Another block would have gone past the budget.
    Budget,
}

/// A paired comparison as it goes: ask for a block, time it, push the times.
#[derive(Clone, Debug)]
pub struct Paired {
    settings: Settings,
    coin: fastrand::Rng,
    pending: Option<[Side; 4]>,
    blocks: Vec<Block>,
    /// Blocks until the next look at the interval.
    planned: usize,
    spent_millis: f64,
    stop: Option<Stop>,
}

impl Paired {
    /// Nothing timed yet.
    ///
    /// # Errors
    /// A setting lies outside its range.
    pub fn new(settings: Settings) -> Result<Self, Problem> {
        settings.check()?;
        Ok(Self {
            settings,
            coin: fastrand::Rng::with_seed(settings.seed),
            pending: None,
            blocks: Vec::new(),
            planned: settings.pilot_blocks as usize,
            spent_millis: 0.0,
            stop: None,
        })
    }

    /// What to time next, in this order; the same until [`Paired::push`] has the times. `None` when measuring is over.
    pub fn next_block(&mut self) -> Option<[Side; 4]> {
        if self.stop.is_some() {
            return None;
        }
        let coin = &mut self.coin;
        Some(*self.pending.get_or_insert_with(|| Block::ORDERS[usize::from(coin.bool())]))
    }

    /// Takes in the times of the block that [`Paired::next_block`] gave, milliseconds in its order.
    ///
    /// # Errors
    /// No block was asked for, or a time is not a number above 0; the same block can then be timed again.
    pub fn push(&mut self, millis: [f64; 4]) -> Result<(), Problem> {
        let Some(order) = self.pending else {
            return Err(Problem::new(Kind::Missing, "times of a block that nothing asked for")
                .expected("next_block before each push"));
        };
        let block = Block { order, millis };
        block.check()?;
        self.pending = None;
        self.blocks.push(block);
        self.spend(millis.iter().sum());
        self.stop = self.look()?;
        Ok(())
    }

    /// Counts time against the budget that is in no block: warm-up, frames that are not timed. Milliseconds; what is not above 0 costs
    /// nothing.
    pub fn spend(&mut self, millis: f64) {
        self.spent_millis += millis.max(0.0);
    }

    /// Whether this was the last block, and if not, how many are planned.
    fn look(&mut self) -> Result<Option<Stop>, Problem> {
        let count = self.blocks.len();
        let most = self.settings.most_blocks as usize;
        if count >= self.planned {
            let needed = self.needed()?;
            if needed <= count as f64 {
                return Ok(Some(Stop::Precise));
            }
            // Widths of few blocks say little: never more than thrice as many at once, and enough to matter.
            self.planned = (needed.ceil() as usize).clamp(count + 4, count * 3 + 4).min(most);
        }
        if count >= most {
            return Ok(Some(Stop::MostBlocks));
        }
        let after_next = self.spent_millis * (count + 1) as f64 / count as f64;
        Ok(self.settings.budget_millis.is_some_and(|budget| after_next > budget).then_some(Stop::Budget))
    }

    /// How many blocks would make both intervals narrow enough, as the blocks so far have it; their widths fall with the root of the
    /// number of blocks. The verdict's is the one by order, which is what its sign test looks at.
    fn needed(&self) -> Result<f64, Problem> {
        let ratios: Vec<f64> = self.blocks.iter().map(Block::log_ratio).collect();
        let asked = self.settings.half_width.ln_1p();
        let count = ratios.len() as f64;
        let reported = bootstrap_interval(&ratios, self.settings.confidence)?.half_width() / asked;
        let Some(verdict) = order_interval(&ratios, self.settings.verdict_confidence)? else {
            return Ok(count + 1.0);
        };
        Ok(count * reported.max(verdict.half_width() / (VERDICT_WIDTHS * asked)).powi(2))
    }

    /// Why measuring ended; `None` while it goes on.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// Blocks so far.
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }

    /// Blocks until the interval is looked at again: how far progress is known.
    pub fn planned_count(&self) -> usize {
        self.planned
    }

    /// What the blocks so far say. It counts when [`Paired::stop`] has an answer: whoever looks after every block and stops at a
    /// verdict that pleases has no confidence left.
    ///
    /// # Errors
    /// No block was timed.
    pub fn summary(&self) -> Result<Summary, Problem> {
        summarise(&self.blocks, &self.settings)
    }
}
