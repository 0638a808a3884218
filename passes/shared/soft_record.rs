//! The recipe that passes of soft visibility share: the light's box, masks, the join, and what it leaves in doubt.

use super::segments::mask_words;
use super::share::{Queue, record_share};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};

const LIGHT_BOX: &[&str] = &[PRELUDE, include_str!("light_box.wgsl")];

/// Light samples of a block.
const BLOCK: usize = 128;
/// Casters that one invocation tests, at most; `OWN_CASTERS` in the kernel.
const OWN_CASTERS: usize = 640;
/// The same where pairs are decided in two-float arithmetic.
const DECIDED_CASTERS: usize = 12;
/// Queues of (view-sample, block).
const QUEUES: usize = 3;

/// How a pass joins.
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
    // A cell lists each triangle once.
    let shares = |casters: usize| cx.dim("triangles", 0).div_ceil(GROUP * casters).max(1) as u32;
    let (long, doubtful) = (shares(OWN_CASTERS), shares(DECIDED_CASTERS));
    let light = cx.scratch("light_box", 4 * (2 + 3 * blocks * BLOCK / 4 + light_sample_count));
    let queue = cx.scratch("soft_queue", QUEUES * items);
    let queued = cx.scratch("soft_queued", QUEUES);
    cx.zero(queued);
    let light_box = vec![
        Bind::Uniform(vec![light_sample_count as u32]),
        Bind::Read(Target::Port("light_samples")),
        Bind::ReadWrite(light),
    ];
    cx.dispatch("light_box", LIGHT_BOX, "light_box", light_box, 1, GROUP);
    let cells = cx.dim("list_offset", 0) - 1;
    let numbers = [sample_count, cells, blocks, words, light_sample_count]
        .map(|number| number as u32)
        .into_iter()
        .chain([long, doubtful, 0]);
    let mut bind = vec![Bind::Uniform(numbers.collect())];
    let ports = ["triangles", "caster_state", "position", "triangle", "sample_state", "cell"];
    let lists = ["list_offset", "list_entries", "caster_offset", "caster_entries"];
    bind.extend(ports.into_iter().chain(lists).map(|port| Bind::Read(Target::Port(port))));
    bind.push(Bind::Read(light));
    bind.push(Bind::ReadWrite(Target::Port("mask")));
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
    Ok(())
}

#[test]
fn the_kernel_states_the_same_number_of_casters() {
    assert!(include_str!("soft_join.wgsl").contains(&format!("const OWN_CASTERS: u32 = {OWN_CASTERS}u;")));
}
