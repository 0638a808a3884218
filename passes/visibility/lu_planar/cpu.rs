//! Four look-ups of lines a pair, at most, and their AND.

use super::FORM;
use crate::shared::light_box::LightBox;
use crate::shared::lu::{Bins, Table, line_bin};
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
        let Table { layout, size, .. } = &self.0;
        Bins::of(planes, layout.radius, *size, |normal| {
            let along = |axis: [f32; 3]| {
                normal[0] * f64::from(axis[0]) + normal[1] * f64::from(axis[1]) + normal[2] * f64::from(axis[2])
            };
            let (x, y) = (along(layout.axes[0]), along(layout.axes[1]));
            let length = (x * x + y * y).sqrt();
            let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
            (line_bin([x, y].map(|x| (x * inverse) as f32), *size), length)
        })
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
