//! What passes of stage `visibility` that look planes up share: the test of a pair on the CPU, and the recipe.

use super::light_box::LightBox;
use super::lu::{Bins, Form, Layout, Table, missing_layout};
use super::soft::{Pair, PairTest, Soft};
use super::soft_record::{Join, record_soft};
use super::view_planes::Planes;
use fearless_simd::Simd;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::PRELUDE;

/// Four look-ups a pair, at most, and their AND; `locate` gives the bins of a pair's planes in a table of so many bins a side.
struct LookUp<'a, F> {
    table: Table<'a>,
    locate: F,
}

impl<F: Fn(&Planes, &Layout, usize) -> Bins + Sync> PairTest for LookUp<'_, F> {
    type Ready = Bins;

    #[inline(always)]
    fn ready(&self, planes: &Planes, _: &LightBox) -> Bins {
        (self.locate)(planes, &self.table.layout, self.table.size)
    }

    #[inline(always)]
    fn bits<S: Simd>(&self, _: S, _: &mut Pair, bins: &mut Bins, word: usize, _: u32) -> u32 {
        if bins.is_outside {
            return 0;
        }
        let bits = |k: usize| self.table.words[self.table.place(bins.bin[k], word)] ^ bins.turned[k];
        (0..bins.count).map(bits).fold(u32::MAX, |all, bits| all & bits)
    }
}

/// The CPU function of a pass whose answer is the table's alone.
///
/// # Errors
/// As [`Table::new`].
pub fn look_up(
    cx: &mut CpuCx,
    form: Form,
    locate: impl Fn(&Planes, &Layout, usize) -> Bins + Sync,
) -> Result<(), Problem> {
    let count = cx.input("light_samples").dim(0);
    let table = Table::new(form, cx.optional("lu"), cx.optional("lu_layout"), count)?;
    let light = LightBox::new(cx.input("light_samples").as_vec3());
    let (mask, counts) = Soft::new(cx, light).masks(&LookUp { table, locate }, cx.progress());
    cx.put("mask", mask);
    cx.count("pairs", counts.pairs);
    cx.count("cut_pairs", counts.cut_pairs);
    Ok(())
}

/// The kernel's text around `kernel`, which defines `hidden_block` and declares the counters at binding 18.
pub const fn pieces(kernel: &'static str) -> [&'static str; 10] {
    [
        PRELUDE,
        include_str!("predicate.wgsl"),
        include_str!("pyramid.wgsl"),
        include_str!("soft_pair.wgsl"),
        include_str!("soft_sides.wgsl"),
        include_str!("soft_join.wgsl"),
        include_str!("soft_each.wgsl"),
        include_str!("lu.wgsl"),
        kernel,
        include_str!("soft_doubts.wgsl"),
    ]
}

/// Records the join with look-ups in a table of `form`.
///
/// # Errors
/// As [`Form::check`]; a table without its layout.
pub fn record_look_up(cx: &mut GpuCx, form: Form, pieces: &'static [&'static str]) -> Result<(), Problem> {
    let shape = cx.is_connected("lu").then(|| cx.shape("lu").to_vec());
    form.check(shape.as_deref())?;
    if !cx.is_connected("lu_layout") {
        return Err(missing_layout());
    }
    let size = cx.dim("lu", 1) as u32;
    let more = vec![
        Bind::Read(Target::Port("lu")),
        Bind::Read(Target::Port("lu_layout")),
        Bind::Uniform(vec![size]),
        Bind::ReadWrite(Target::Counters),
    ];
    record_soft(cx, Join { pieces, more })
}
