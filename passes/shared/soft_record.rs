//! The recipe that passes of soft visibility share: the light's box, masks, the join, and what it leaves in doubt. Where
//! `penumbra_state` is connected it joins twice: what it sets apart with the first light sample, the rest with all.

use super::light_box_gpu::{BLOCK, record_light_box};
use super::segments::mask_words;
use super::share::{Queue, record_share};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const SPLIT: &[&str] = &[PRELUDE, include_str!("soft_split.wgsl")];
const SPREAD: &[&str] = &[PRELUDE, include_str!("soft_spread.wgsl")];

/// Casters that one invocation tests, at most; `OWN_CASTERS` in the kernel.
const OWN_CASTERS: usize = 640;
/// The same where pairs are decided in two-float arithmetic.
const DECIDED_CASTERS: usize = 12;
/// Queues of (view-sample, block).
const QUEUES: usize = 3;

/// How a pass joins.
#[derive(Clone)]
pub struct Join {
    /// `hidden_block` and what it needs, in order.
    pub pieces: &'static [&'static str],
    /// Bindings past the join's own.
    pub more: Vec<Bind>,
}

/// Records a pass of soft visibility.
///
/// # Errors
/// More (view-sample, block) than a queue can number.
pub fn record_soft(cx: &mut GpuCx, join: Join) -> Result<(), Problem> {
    let light_sample_count = cx.dim("light_samples", 0);
    let sample_count = cx.dim("position", 0);
    let blocks = light_sample_count.div_ceil(BLOCK);
    let words = mask_words(light_sample_count);
    let items = sample_count * blocks;
    if items >= 1 << 31 || sample_count * words >= 1 << 32 {
        return Err(Problem::new(Kind::Unsupported, "more (view-sample, light sample) than this recipe can number")
            .port("light_samples")
            .expected("fewer than 2^31 blocks of 128 light samples")
            .found(items.to_string())
            .remedy("take fewer light samples or pixels, or run this node on the CPU backend"));
    }
    if items == 0 {
        return Ok(());
    }
    let cells = cx.dim("list_offset", 0) - 1;
    let all = View { entries: Target::Port("list_entries"), total: Target::Port("list_offset"), total_at: cells };
    if !cx.is_connected("penumbra_state") {
        record_join(cx, join, light_sample_count, all, Target::Port("mask"));
        return Ok(());
    }
    // View-samples apart to which the whole light has one answer: the first light sample gives it, in the place of all.
    let [whole, partial] = ["whole_samples", "partial_samples"].map(|label| {
        let view = View { entries: cx.scratch(label, sample_count), total: cx.scratch(label, 1), total_at: 0 };
        cx.zero(view.total);
        view
    });
    let answer = cx.scratch("whole_mask", sample_count);
    let numbers = |at: usize| Bind::Uniform([sample_count, at, words, light_sample_count].map(|n| n as u32).to_vec());
    let lists = [all.total, all.entries, Target::Port("penumbra_state")];
    let split = [whole.entries, whole.total, partial.entries, partial.total];
    let bind = std::iter::once(numbers(cells)).chain(lists.map(Bind::Read)).chain(split.map(Bind::ReadWrite));
    cx.dispatch("soft_split", SPLIT, "soft_split", bind.collect(), sample_count, GROUP);
    record_join(cx, join.clone(), 1, whole, answer);
    record_join(cx, join, light_sample_count, partial, Target::Port("mask"));
    let bind = std::iter::once(numbers(0))
        .chain([whole.total, whole.entries, answer].map(Bind::Read))
        .chain([Bind::ReadWrite(Target::Port("mask"))]);
    cx.dispatch("soft_spread", SPREAD, "soft_spread", bind.collect(), sample_count * words, GROUP);
    Ok(())
}

/// View-samples to be asked about, in a list, and where its length stands.
#[derive(Clone, Copy)]
struct View {
    entries: Target,
    total: Target,
    total_at: usize,
}

/// Records the join of the view-samples of `view` with the first `light_sample_count` light samples into `mask`.
fn record_join(cx: &mut GpuCx, join: Join, light_sample_count: usize, view: View, mask: Target) {
    let sample_count = cx.dim("position", 0);
    let (blocks, words) = (light_sample_count.div_ceil(BLOCK), mask_words(light_sample_count));
    let items = sample_count * blocks;
    // A cell lists each triangle once.
    let shares = |casters: usize| cx.dim("triangles", 0).div_ceil(GROUP * casters).max(1) as u32;
    let (long, doubtful) = (shares(OWN_CASTERS), shares(DECIDED_CASTERS));
    let light = record_light_box(cx, light_sample_count);
    let queue = cx.scratch("soft_queue", QUEUES * items);
    let queued = cx.scratch("soft_queued", QUEUES);
    cx.zero(queued);
    let numbers = [sample_count, view.total_at, blocks, words, light_sample_count]
        .map(|number| number as u32)
        .into_iter()
        .chain([long, doubtful, 0]);
    let mut bind = vec![Bind::Uniform(numbers.collect())];
    let ports = ["triangles", "caster_state", "position", "triangle", "sample_state", "cell"];
    let casters = ["caster_offset", "caster_entries"].map(Target::Port);
    let lists = [view.total, view.entries].into_iter().chain(casters);
    bind.extend(ports.map(Target::Port).into_iter().chain(lists).map(Bind::Read));
    bind.push(Bind::Read(light));
    bind.push(Bind::ReadWrite(mask));
    bind.extend([queue, queued].map(Bind::ReadWrite));
    bind.extend(join.more);
    cx.dispatch("soft_start", join.pieces, "soft_start", bind.clone(), sample_count * words, GROUP);
    cx.dispatch("soft_join", join.pieces, "soft_join", bind.clone(), items, GROUP);
    let long = Queue { queued, word: 0, items: 1, groups: long };
    record_share(cx, "soft_long", join.pieces, "soft_long", bind.clone(), long);
    let short = Queue { word: 1, groups: 1, ..long };
    record_share(cx, "soft_doubts", join.pieces, "soft_doubts", bind.clone(), short);
    let doubtful = Queue { word: 2, groups: doubtful, ..long };
    record_share(cx, "soft_long_doubts", join.pieces, "soft_long_doubts", bind, doubtful);
}

#[test]
fn the_kernel_states_the_same_number_of_casters() {
    assert!(include_str!("soft_join.wgsl").contains(&format!("const OWN_CASTERS: u32 = {OWN_CASTERS}u;")));
}
