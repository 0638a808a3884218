//! Four look-ups a pair, at most, and sixteen light samples at a time where the table leaves one open.

use super::FORM;
use crate::shared::light_box::LightBox;
use crate::shared::light_sides::{Sides, sides};
use crate::shared::lu::{Bins, Table};
use crate::shared::soft::{Pair, PairTest, Soft};
use crate::shared::view_planes::Planes;
use fearless_simd::Simd;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// Largest error of a plane that is looked up, of its range over the light; the table's slack is above it by far.
const FIRM: f64 = 1e-5;

/// The test.
struct LookUp<'a>(Table<'a>);

impl PairTest for LookUp<'_> {
    type Ready = (Bins, Sides);

    #[inline(always)]
    fn ready(&self, planes: &Planes, light: &LightBox) -> (Bins, Sides) {
        // Rounding that may leave the bin: the plane is not looked up.
        let mut firm = *planes;
        for k in 0..4 {
            firm.cut[k] &= planes.slack[k] <= FIRM * planes.range[k];
        }
        (Bins::angles_distance(&firm, &self.0.layout, self.0.size), Sides::new(planes, light))
    }

    #[inline(always)]
    fn bits<S: Simd>(
        &self,
        simd: S,
        pair: &mut Pair,
        (bins, ready): &mut (Bins, Sides),
        word: usize,
        open: u32,
    ) -> u32 {
        if bins.is_outside {
            return 0;
        }
        let (mut certain, mut possible) = (u32::MAX, u32::MAX);
        let is_looked_up = bins.count == ready.count();
        for k in 0..bins.count {
            let place = self.0.place(bins.bin[k], word);
            let (sure, may) = (self.0.words[place], self.0.words[place + 4]);
            // The opposite plane has behind it for certain what is not possibly behind this one.
            let is_turned = bins.turned[k] != 0;
            certain &= if is_turned { !may } else { sure };
            possible &= if is_turned { !sure } else { may };
        }
        if !is_looked_up {
            certain = 0;
        }
        let left = possible & !certain & open;
        if left == 0 {
            return certain;
        }
        let [inside, doubtful] = sides(simd, ready, pair.light, word);
        let doubts = doubtful & left;
        let decided = inside & left;
        certain | if doubts == 0 { decided } else { decided | pair.decide(word, doubts) }
    }
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let count = cx.input("light_samples").dim(0);
    let table = Table::new(FORM, cx.optional("lu"), cx.optional("lu_layout"), count)?;
    let (mask, counts) =
        Soft::new(cx, LightBox::new(cx.input("light_samples").as_vec3())).masks(&LookUp(table), cx.progress());
    cx.put("mask", mask);
    cx.count("exact_bits", counts.exact);
    cx.count("pairs", counts.pairs);
    cx.count("cut_pairs", counts.cut_pairs);
    Ok(())
}
