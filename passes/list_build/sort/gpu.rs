//! Keys, one count-scan-scatter a digit, ranks.

use crate::list_build::{PLACE, SIZE};
use crate::ports;
use crate::shared::scan::record_scan;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::record::Target::{Counters, Port};
use shadowgraph_core::shared::{GROUP, PRELUDE};

/// Bits of a digit, `DIGIT_BITS` in the WGSL: as many counters as registers hold.
pub const DIGIT_BITS: u32 = 4;
/// Pairs one invocation counts and scatters in turn, which keeps the sort stable.
pub const RUN: usize = 32;

const KEYS: &[&str] = &[PLACE[0], PLACE[1], PLACE[2], include_str!("keys.wgsl")];
const DIGIT: &[&str] = &[PRELUDE, include_str!("digit.wgsl")];
const RANK: &[&str] = &[PRELUDE, include_str!("rank.wgsl")];

/// The recipe.
pub fn record(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim(ports::POSITION.name, 0);
    let (faces, side) = (cx.dim(ports::LIGHT_FRAME.name, 0), cx.params().u32(SIZE.name));
    let cells = cx.words(ports::LIST_LENGTH.name);
    let runs = count.div_ceil(RUN);
    let counters = runs << DIGIT_BITS;
    let (mut keys, mut keys_sorted) = (cx.scratch("sort_keys", count), cx.scratch("sort_keys_2", count));
    let (mut order, mut order_sorted) = (cx.scratch("sort_order", count), cx.scratch("sort_order_2", count));
    let digit_count = cx.scratch("sort_digit_count", counters);
    let digit_start = cx.scratch("sort_digit_start", counters + 1);
    let list_start = cx.scratch("sort_list_start", cells + 1);

    cx.zero(Port(ports::LIST_LENGTH.name));
    cx.zero(Port(ports::LIST_FAR.name));
    let bind = vec![
        Uniform(vec![count as u32, side, faces as u32, cells as u32]),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(ports::LIGHT_FRAME.name)),
        ReadWrite(Port(ports::CELL.name)),
        ReadWrite(keys),
        ReadWrite(Port(ports::LIST_FAR.name)),
        ReadWrite(Counters),
    ];
    cx.dispatch("list_build/sort keys", KEYS, "sort_keys", bind, count, GROUP);

    // The largest key is that of no cell, one past the last.
    let key_bits = u32::BITS - (cells as u32).leading_zeros();
    for shift in (0..key_bits).step_by(DIGIT_BITS as usize) {
        let bind = |counters| {
            vec![
                Uniform(vec![count as u32, RUN as u32, runs as u32, shift]),
                Read(keys),
                Read(order),
                ReadWrite(counters),
                ReadWrite(keys_sorted),
                ReadWrite(order_sorted),
            ]
        };
        cx.dispatch("list_build/sort count", DIGIT, "sort_count", bind(digit_count), runs, GROUP);
        record_scan(cx, digit_count, counters, digit_start);
        cx.dispatch("list_build/sort scatter", DIGIT, "sort_scatter", bind(digit_start), runs, GROUP);
        std::mem::swap(&mut keys, &mut keys_sorted);
        std::mem::swap(&mut order, &mut order_sorted);
    }

    let bind = || {
        vec![
            Uniform(vec![count as u32, cells as u32]),
            Read(keys),
            Read(order),
            ReadWrite(list_start),
            ReadWrite(Port(ports::LIST_LENGTH.name)),
            ReadWrite(Port(ports::SLOT.name)),
            ReadWrite(Counters),
        ]
    };
    cx.dispatch("list_build/sort bounds", RANK, "sort_bounds", bind(), count, GROUP);
    cx.dispatch("list_build/sort rank", RANK, "sort_rank", bind(), count, GROUP);
    Ok(())
}
