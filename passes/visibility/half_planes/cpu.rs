//! The planes of a pair scaled so that rounding moves no value by more than 1, against sixteen light samples at a time.

use crate::shared::light_box::LightBox;
use crate::shared::light_sides::{Sides, sides};
use crate::shared::soft::{Pair, PairTest, Soft};
use crate::shared::view_planes::Planes;
use fearless_simd::Simd;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::problem::Problem;

/// The test.
struct HalfPlanes;

impl PairTest for HalfPlanes {
    type Ready = Sides;

    #[inline(always)]
    fn ready(&self, planes: &Planes, light: &LightBox) -> Sides {
        Sides::new(planes, light)
    }

    #[inline(always)]
    fn bits<S: Simd>(&self, simd: S, pair: &mut Pair, ready: &mut Sides, word: usize, open: u32) -> u32 {
        let [inside, doubtful] = sides(simd, ready, pair.light, word);
        let doubts = doubtful & open;
        if doubts == 0 { inside } else { inside | pair.decide(word, doubts) }
    }
}

/// The CPU function.
pub fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let (mask, counts) =
        Soft::new(cx, LightBox::clustered(cx.input("light_samples").as_vec3())).masks(&HalfPlanes, cx.progress());
    cx.put("mask", mask);
    cx.count("pairs", counts.pairs);
    cx.count("cut_pairs", counts.cut_pairs);
    cx.count("exact_bits", counts.exact);
    Ok(())
}
