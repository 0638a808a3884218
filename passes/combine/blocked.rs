//! How many light samples a mask blocks: what the passes that count start from.

use crate::ports;
use rayon::prelude::*;
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{GpuCx, Target::Port};
use shadowgraph_core::shared::{BACKGROUND, GROUP, LOOP_STEPS};

/// The same in WGSL, joined after `shared::PRELUDE`; declares all bindings.
pub const WGSL: &str = include_str!("blocked.wgsl");

/// View-samples one task takes.
const CHUNK: usize = 1 << 14;

/// Bits set among the first `samples` of `mask`, which has no word without one of them.
pub fn blocked_count(mask: &[u32], samples: u32) -> u32 {
    let bits = |(word, mask): (u32, &u32)| {
        let past = (32 * (word + 1)).saturating_sub(samples);
        (mask & (u32::MAX >> past)).count_ones()
    };
    (0..).zip(mask).map(bits).sum()
}

/// Puts `visible` from the blocked and all light samples of every view-sample that is not background.
pub fn combine(cx: &mut CpuCx, visible: impl Fn(u32, u32) -> f32 + Sync) {
    let (mask, states) = (cx.input(ports::MASK.name), cx.input(ports::SAMPLE_STATE.name).as_u32());
    let samples = cx.input(input::LIGHT_SAMPLES.name).dim(0) as u32;
    let (masks, words) = (mask.as_u32(), mask.dim(1));
    let fraction = |(index, state): (usize, &u32)| {
        if *state == BACKGROUND || samples == 0 {
            return 1.0;
        }
        visible(blocked_count(&masks[index * words..(index + 1) * words], samples), samples)
    };
    let fractions: Vec<f32> = states.par_iter().enumerate().with_min_len(CHUNK).map(fraction).collect();
    cx.put(ports::VISIBLE.name, Array::f32([fractions.len()], fractions));
    cx.put(ports::VISIBLE_COLOR.name, Array::zeros(Element::F32, [0, 3]));
}

/// Refuses masks that one invocation cannot walk in `steps` loop steps.
///
/// # Errors
/// Names the mask, what is allowed and the remedy.
pub fn check_steps(steps: usize) -> Result<(), Problem> {
    if steps <= LOOP_STEPS {
        return Ok(());
    }
    Err(Problem::new(Kind::Unsupported, "too many light samples for one invocation")
        .port(ports::MASK.name)
        .expected(format!("at most {LOOP_STEPS} loop steps"))
        .found(steps.to_string())
        .remedy("set `on: Cpu`, or take fewer light samples"))
}

/// Records the one dispatch of a pass that counts.
pub fn record_combine(
    cx: &mut GpuCx,
    label: &'static str,
    pieces: &'static [&'static str],
    entry: &'static str,
) -> Result<(), Problem> {
    let (count, words) = (cx.dim(ports::SAMPLE_STATE.name, 0), cx.dim(ports::MASK.name, 1));
    check_steps(words)?;
    let samples = cx.dim(input::LIGHT_SAMPLES.name, 0);
    let bind = vec![
        Uniform(vec![count as u32, words as u32, samples as u32]),
        Read(Port(ports::MASK.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        ReadWrite(Port(ports::VISIBLE.name)),
    ];
    cx.dispatch(label, pieces, entry, bind, count, GROUP);
    Ok(())
}

#[cfg(test)]
pub mod tests {
    use shadowgraph_core::array::{Array, Element};
    use shadowgraph_core::cpu::CpuCx;
    use shadowgraph_core::param::Params;
    use shadowgraph_core::pass::Pass;

    /// What `pass` makes of these masks.
    pub fn visible(pass: &'static Pass, masks: &[&[u32]], states: &[u32], samples: usize) -> Vec<f32> {
        let mask = Array::u32([masks.len(), samples.div_ceil(32)], masks.concat());
        let states = Array::u32([states.len()], states.to_vec());
        let light = Array::zeros(Element::F32, [samples, 3]);
        let params = Params::default();
        let inputs = vec![("mask", &mask), ("sample_state", &states), ("light_samples", &light)];
        let mut cx = CpuCx::new(pass, &params, [1, 1], inputs, &|_, _| {});
        pass.cpu.expect("has a CPU function")(&mut cx).expect("combines");
        cx.finish().0[0].1.as_f32().to_vec()
    }

    #[test]
    fn bits_past_the_last_light_sample_are_not_counted() {
        assert_eq!(super::blocked_count(&[u32::MAX], 1), 1);
        assert_eq!(super::blocked_count(&[u32::MAX, u32::MAX], 33), 33);
        assert_eq!(super::blocked_count(&[u32::MAX, u32::MAX], 64), 64);
        assert_eq!(super::blocked_count(&[0b1010, 0b10], 33), 2);
    }
}
