//! Is B slower than A, by how much, and is that certain? Blocks of four timings, in an order that chance decides.
//!
//! **A block** times A B B A or B A A B, as a fair coin says, and gives one number: the logarithm of the smaller time of B over the
//! smaller time of A. Other work makes a frame longer, never shorter, so the smaller of two is the one less disturbed: on a machine
//! with four jobs for each core it made the median over blocks surer than means of two did, 1.4 to 6 times in most of the long runs
//! and not at all in the short ones. Whatever slows the machine over a whole block cancels. The
//! result is the median over blocks, turned back into a ratio: a block that a burst hit all the same is one outlier, not a shifted
//! mean. Both make it a ratio of usual frames; how long the rare slow ones take is a question for a percentile
//! of all frames.
//!
//! **Why the coin.** Other work may come in time with the blocks, last for many of them, grow or shrink. If A and B are the same, a
//! block's number has the size that the moment gives it, and a sign that only the coin decides. So signs are independent and fair
//! whatever the noise, and a [sign test](crate::statistics::sign_test) over blocks is exact, which no assumption about noise could
//! make it. It also makes the bootstrap over blocks right although the moments are not independent. What the coin cannot take
//! away is a lasting difference between two equal graphs, as of where their memory happens to lie: the threshold is for that.
//!
//! **The verdict** at a threshold `t`: B is [`Verdict::Slower`] when at the verdict's confidence
//! 1. the bootstrap interval of the median ratio lies wholly above `1 + t`;
//! 2. the sign test rejects that half of the blocks or more lie at or below `1 + t`;
//! 3. the geometric mean of two medians lies above `1 + t`: of the blocks A B B A alone, and of the blocks B A A B alone. What comes in
//!    step with the blocks turns its sign with their order, and cancels there.
//!
//! [`Verdict::Faster`] is the same with A and B swapped (below `1 / (1 + t)`), everything else [`Verdict::Undecided`]. Two graphs are
//! [equivalent](Summary::equivalent) when the interval reported lies wholly between `1 / (1 + t)` and `1 + t`. Undecided and not equivalent
//! means: not measured long enough.
//!
//! **How many blocks.** After a pilot the interval says how many blocks would make it as narrow as asked for (its width falls with
//! the root of their number); then it is looked at again. The verdict's interval, the one that the sign test would leave, has to be
//! narrow enough too: a median may be sure while a tenth of the blocks still stand against it. Only the width decides when to stop, never where the interval lies:
//! measuring until a difference shows would find one sooner or later.
//!
//! Time both sides alike: the same work before each timing, such as one frame of the same side that is not timed. What a side's
//! first frame after the other's costs more would otherwise fall on both by the coin, and widen the interval.
//!
//! ```
//! use shadowgraph_measure::paired::{Paired, Settings, Side, Verdict};
//! # fn frame_millis(side: Side) -> f64 { if side == Side::A { 10.0 } else { 11.0 } }
//! let mut paired = Paired::new(Settings::default())?;
//! while let Some(order) = paired.next_block() {
//!     paired.push(order.map(frame_millis))?;
//! }
//! let summary = paired.summary()?;
//! assert_eq!(summary.verdict, Verdict::Slower);
//! # Ok::<(), shadowgraph_core::problem::Problem>(())
//! ```

mod block;
mod plan;
mod settings;
mod summary;

pub use block::{Block, Side};
pub use plan::{Paired, Stop};
pub use settings::Settings;
pub use summary::{SideMillis, Summary, Verdict, summarise};

#[cfg(test)]
mod noise;
#[cfg(test)]
mod tests;
