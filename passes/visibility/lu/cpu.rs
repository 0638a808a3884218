//! Four look-ups a pair, at most, and their AND.

use super::FORM;
use crate::shared::light_box::LightBox;
use crate::shared::lu::{Bins, Table};
use crate::shared::soft::{Pair, PairTest, Soft};
use crate::shared::view_planes::Planes;
use fearless_simd::Simd;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The test.
struct LookUp<'a>(Table<'a>);

impl PairTest for LookUp<'_> {
    type Ready = Bins;

    #[inline(always)]
    fn ready(&self, planes: &Planes, _: &LightBox) -> Bins {
        Bins::angles_distance(planes, self.0.layout.radius, self.0.size)
    }

    #[inline(always)]
    fn bits<S: Simd>(&self, _: S, _: &mut Pair, bins: &mut Bins, word: usize, _: u32) -> u32 {
        if bins.is_outside {
            return 0;
        }
        let bits = |k: usize| self.0.words[self.0.place(bins.bin[k], word)] ^ bins.turned[k];
        (0..bins.count).map(bits).fold(u32::MAX, |all, bits| all & bits)
    }
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let count = cx.input("light_samples").dim(0);
    let table = Table::new(FORM, cx.optional("lu"), cx.optional("lu_layout"), count)?;
    let (mask, counts) =
        Soft::new(cx, LightBox::new(cx.input("light_samples").as_vec3())).masks(&LookUp(table), cx.progress());
    cx.put("mask", mask);
    cx.count("pairs", counts.pairs);
    cx.count("cut_pairs", counts.cut_pairs);
    Ok(())
}
