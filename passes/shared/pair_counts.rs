//! What passes that test (view-sample, caster) pairs by planes count of them.

use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::pass::{Counter, CounterKind};

/// (view-sample, caster) pairs of some work.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PairCounts {
    /// Pairs whose view-sample was open when its caster came, tested by planes.
    pub tested: u64,
    /// Pairs that blocked their view-sample first.
    pub blocking: u64,
    /// Pairs that went to the exact predicate.
    pub exact: u64,
}

impl PairCounts {
    /// Puts them as the counters [`PAIR_COUNTERS`].
    pub fn count(self, cx: &mut CpuCx) {
        for (counter, count) in PAIR_COUNTERS.iter().zip([self.exact, self.tested, self.blocking]) {
            cx.count(counter.name, count);
        }
    }
}

impl std::ops::AddAssign for PairCounts {
    fn add_assign(&mut self, other: Self) {
        self.tested += other.tested;
        self.blocking += other.blocking;
        self.exact += other.exact;
    }
}

impl std::iter::Sum for PairCounts {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |mut sum, one| {
            sum += one;
            sum
        })
    }
}

/// Counters of the passes that test pairs so. The first is the one that kernels keep too.
pub const PAIR_COUNTERS: &[Counter] = &[
    Counter {
        name: "exact_pairs",
        doc: "(view-sample, caster) pairs that only exact arithmetic, on a GPU that of two floats, could decide",
        kind: CounterKind::Info,
    },
    Counter {
        name: "pairs",
        doc: "(view-sample, caster) pairs that were tested: the view-sample was not in shadow yet",
        kind: CounterKind::OnCpu,
    },
    Counter { name: "blocking_pairs", doc: "pairs that put their view-sample into shadow", kind: CounterKind::OnCpu },
];
