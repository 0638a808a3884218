//! What the counters of a run say: nothing, what was too small, or what must not have been.

use crate::prepare::Prepared;
use shadowgraph_core::pass::CounterKind;
use shadowgraph_core::plan::Grown;
use shadowgraph_core::problem::{Kind, Problem};

/// What the counts of a run mean for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Empty, or every slot that was ever too small with the rows to give it: prepare again with these and the run will fit,
    /// or show what comes after.
    pub grown: Grown,
    /// The first thing that is wrong with the run's outputs: an overflow, else a count that had to be zero.
    pub problem: Option<Problem>,
}

impl Prepared {
    /// Words that [`Prepared::record_status`] writes: all counters of all wgpu nodes.
    pub fn status_words(&self) -> usize {
        self.counted().map(|(_, count)| count).sum()
    }

    /// Records a copy of all counters to the start of `status`, which the host maps once its submission is done.
    pub fn record_status(&self, encoder: &mut wgpu::CommandEncoder, status: &wgpu::Buffer) {
        let bound = crate::externals::Bound::none(self);
        let mut word = 0;
        for (node, count) in self.counted() {
            if let Some(part) = self.layout.counters(node) {
                let (buffer, offset) = bound.buffer(part);
                encoder.copy_buffer_to_buffer(buffer, offset, status, word * 4, count as u64 * 4);
                word += count as u64;
            }
        }
    }

    /// Counts of every node, in the order of its pass's counters, from the words of [`Prepared::record_status`].
    pub fn counts(&self, status: &[u32]) -> Vec<Vec<u64>> {
        let mut counts = vec![Vec::new(); self.nodes.len()];
        let mut words = status.iter().map(|word| u64::from(*word));
        for (node, count) in self.counted() {
            counts[node] = words.by_ref().take(count).collect();
        }
        counts
    }

    /// What the words of [`Prepared::record_status`] say about the run.
    pub fn judge(&self, status: &[u32]) -> Verdict {
        let (mut grown, mut overflow, mut wrong) = (Grown::new(), None, None);
        for (node, counts) in self.plan.nodes.iter().zip(self.counts(status)) {
            for (counter, count) in node.pass.counters.iter().zip(counts) {
                match counter.kind {
                    CounterKind::Rows(port) => {
                        let Some((_, slot)) = node.outputs.iter().find(|(name, _)| *name == port) else {
                            unreachable!("{:?} counts rows of {port}, which is not an output", node.pass)
                        };
                        let capacity = self.shapes.0[*slot].first().copied().unwrap_or(1) as u64;
                        if count > capacity {
                            // A little more: atomics may count a little more next time, or what comes before may.
                            grown.push((format!("{}.{port}", node.id), (count + count / 16) as usize));
                            let problem = Problem::new(Kind::Overflow, counter.doc)
                                .node(&node.id)
                                .port(port)
                                .expected(format!("at most {capacity} rows"))
                                .found(count.to_string())
                                .remedy("let the run grow it, or raise the capacity");
                            overflow.get_or_insert(problem);
                        }
                    }
                    CounterKind::MustBeZero(remedy) if count > 0 => {
                        let problem = Problem::new(Kind::Overflow, counter.doc)
                            .node(&node.id)
                            .expected("0")
                            .found(count.to_string())
                            .remedy(remedy);
                        wrong.get_or_insert(problem);
                    }
                    CounterKind::MustBeZero(_) | CounterKind::Info | CounterKind::OnCpu | CounterKind::Most => {}
                }
            }
        }
        if !grown.is_empty() {
            let still = self.grown.iter().filter(|(name, _)| !grown.iter().any(|(new, _)| new == name)).cloned();
            grown = still.chain(grown.iter().cloned()).collect();
        }
        // What follows an overflow worked on a cut list, so its counts say nothing.
        Verdict { grown, problem: overflow.or(wrong) }
    }

    fn counted(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.nodes.len()).filter_map(|node| self.layout.counters(node).map(|part| (node, part.words())))
    }
}
