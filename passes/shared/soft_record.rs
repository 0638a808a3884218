//! The recipe that passes of soft visibility share: the light's box, masks, the join, and what it leaves in doubt. Where
//! `penumbra_state` is connected it joins twice: what it sets apart with the first light sample, the rest with all.

use super::light_box_gpu::{BLOCK, block_of, record_light_box};
use super::segments::mask_words;
use super::share::{Queue, record_share};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const CASTERS: &[&str] = &[PRELUDE, include_str!("soft_casters.wgsl")];
const SPLIT: &[&str] = &[PRELUDE, include_str!("soft_split.wgsl")];
const SPREAD: &[&str] = &[PRELUDE, include_str!("soft_spread.wgsl")];

/// Casters that one invocation tests, at most; `OWN_CASTERS` in the kernel.
const OWN_CASTERS: usize = 400;
/// The same where pairs are decided in two-float arithmetic.
const DECIDED_CASTERS: usize = 6;
/// Queues of view-samples.
const QUEUES: usize = 3;
/// Words of a triangle as the join reads it.
const CASTER_WORDS: usize = 12;
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
    if sample_count >= 1 << 31 || sample_count * words >= 1 << 32 {
        return Err(Problem::new(Kind::Unsupported, "more (view-sample, light sample) than this recipe can number")
            .port("light_samples")
            .expected("fewer than 2^31 view-samples and 2^32 mask words")
            .found(format!("{sample_count} view-samples of {words} words"))
            .remedy("take fewer light samples or pixels, or run this node on the CPU backend"));
    }
    if sample_count == 0 || blocks == 0 {
        return Ok(());
    }
    let cells = cx.dim("list_offset", 0) - 1;
    let all = View {
        entries: Target::Port("list_entries"),
        total: Target::Port("list_offset"),
        total_at: cells,
        and_unlisted: true,
    };
    let room = Room::new(cx);
    if !cx.is_connected("penumbra_state") {
        record_join(cx, join, room, light_sample_count, all, Target::Port("mask"));
        return Ok(());
    }
    // View-samples apart to which the whole light has one answer: the first light sample gives it, in the place of all.
    let [whole, partial] = [("whole_samples", false), ("partial_samples", true)].map(|(label, and_unlisted)| {
        let (entries, total) = (cx.scratch(label, sample_count), cx.scratch(label, 1));
        let view = View { entries, total, total_at: 0, and_unlisted };
        cx.zero(view.total);
        view
    });
    let answer = cx.scratch("whole_mask", sample_count);
    let numbers = |at: usize| Bind::Uniform([sample_count, at, words, light_sample_count].map(|n| n as u32).to_vec());
    let lists = [all.total, all.entries, Target::Port("penumbra_state")];
    let split = [whole.entries, whole.total, partial.entries, partial.total];
    let bind = std::iter::once(numbers(cells)).chain(lists.map(Bind::Read)).chain(split.map(Bind::ReadWrite));
    cx.dispatch("soft_split", SPLIT, "soft_split", bind.collect(), sample_count, GROUP);
    record_join(cx, join.clone(), room, 1, whole, answer);
    record_join(cx, join, room, light_sample_count, partial, Target::Port("mask"));
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
    /// Whether those of no cell are asked too.
    and_unlisted: bool,
}

/// Memory of the joins.
#[derive(Clone, Copy)]
struct Room {
    /// Triangles as the join reads them.
    casters: Target,
    queue: Target,
    queued: Target,
    /// (view-sample, caster) in doubt.
    pairs: Target,
}

impl Room {
    /// Makes it, and packs the casters.
    fn new(cx: &mut GpuCx) -> Self {
        let (sample_count, triangle_count) = (cx.dim("position", 0), cx.dim("triangles", 0));
        let casters = cx.scratch("soft_casters", CASTER_WORDS * triangle_count.max(1));
        let pack = vec![
            Bind::Uniform(vec![triangle_count as u32]),
            Bind::Read(Target::Port("triangles")),
            Bind::Read(Target::Port("caster_state")),
            Bind::ReadWrite(casters),
        ];
        cx.dispatch("soft_casters", CASTERS, "soft_casters", pack, triangle_count, GROUP);
        Self {
            casters,
            queue: cx.scratch("soft_queue", QUEUES * sample_count),
            queued: cx.scratch("soft_queued", QUEUES + 1),
            pairs: cx.scratch("soft_doubtful_pairs", 2 * sample_count),
        }
    }
}

/// Records the join of the view-samples of `view` with the first `light_sample_count` light samples into `mask`.
fn record_join(cx: &mut GpuCx, join: Join, room: Room, light_sample_count: usize, view: View, mask: Target) {
    let sample_count = cx.dim("position", 0);
    let words = mask_words(light_sample_count);
    // A cell lists each triangle once.
    let shares = |casters: usize| cx.dim("triangles", 0).div_ceil(GROUP * casters).max(1) as u32;
    let (long, doubtful) = (shares(OWN_CASTERS), shares(DECIDED_CASTERS));
    let light = record_light_box(cx, light_sample_count);
    let Room { casters, queue, queued, pairs } = room;
    let port = Target::Port;
    let of_samples = ["position", "triangle", "sample_state", "cell"].map(port);
    let of_casters = ["caster_offset", "caster_entries", "light_samples"].map(port);
    let read = [port("triangles"), casters].into_iter().chain(of_samples);
    let read: Vec<Target> = read.chain([view.total, view.entries]).chain(of_casters).collect();
    for block in 0..light_sample_count.div_ceil(BLOCK) {
        cx.zero(queued);
        let numbers = [sample_count, view.total_at, block, words, light_sample_count].map(|number| number as u32);
        let mut bind = vec![Bind::Uniform(numbers.into_iter().chain([long, doubtful, 0]).collect())];
        bind.extend(read.iter().copied().map(Bind::Read));
        bind.extend([mask, queue, queued].map(Bind::ReadWrite));
        bind.push(block_of(light, block));
        bind.push(Bind::ReadWrite(pairs));
        bind.extend(join.more.clone());
        if block == 0 {
            cx.dispatch("soft_start", join.pieces, "soft_start", bind.clone(), sample_count * words, GROUP);
        }
        if view.and_unlisted {
            cx.dispatch("soft_unlisted", join.pieces, "soft_unlisted", bind.clone(), sample_count, GROUP);
        }
        cx.dispatch("soft_join", join.pieces, "soft_join", bind.clone(), sample_count, GROUP);
        let long = Queue { queued, word: 0, items: 1, groups: long };
        record_share(cx, "soft_long", join.pieces, "soft_long", bind.clone(), long);
        let in_doubt = Queue { word: 3, items: GROUP as u32, groups: 1, ..long };
        record_share(cx, "soft_pairs", join.pieces, "soft_pairs", bind.clone(), in_doubt);
        let short = Queue { word: 1, groups: 1, ..long };
        record_share(cx, "soft_doubts", join.pieces, "soft_doubts", bind.clone(), short);
        let doubtful = Queue { word: 2, groups: doubtful, ..long };
        record_share(cx, "soft_long_doubts", join.pieces, "soft_long_doubts", bind, doubtful);
    }
}

#[test]
fn the_kernel_states_the_same_number_of_casters() {
    assert!(include_str!("soft_join.wgsl").contains(&format!("const OWN_CASTERS: u32 = {OWN_CASTERS}u;")));
}
