//! `pcf`: percentage-closer filtering, k x k comparisons with the shadow map about the view-sample's texel (Reeves, Salesin,
//! Cook 1987).
//!
//! In: `depth [F D D]`, `light_frame [F 20]`, `position [P 3]` world, `normal [P 3]` world, `sample_state [P]`, one light sample.
//! Out: `visible [P]`, the share of taps that are lit; `mask [P 1]`, bit 0 set where that is below a half. A view-sample facing
//! away has all bits set and sees nothing; background has none and sees all. Taps outside the map, and beyond a face's edge,
//! are lit.
//!
//! A blur of constant width: it hides steps, and hardens no contact. Biases and their units are told in
//! [`crate::shared::shadow_lookup`]; the slope bias grows with the kernel, or wide ones would shadow planes by themselves.

mod gpu;
#[cfg(test)]
mod tests;

use crate::shared::shadow_lookup::{BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::{Kind, Problem};

const KERNEL: ParamSpec = ParamSpec {
    name: "kernel",
    range: Range::U32 { min: 1, max: 15, default: 3 },
    unit: "texels a side, odd",
    doc: "smoother and wider shadow borders as it grows, time as its square, and more slope bias",
};

/// The pass.
pub static PASS: Pass = Pass {
    name: "pcf",
    stage: &super::STAGE,
    doc: "The share of k x k comparisons with the shadow map that are lit.",
    source: "Reeves, Salesin, Cook 1987",
    ignores: &["light"],
    params: &[KERNEL, BIAS_CONSTANT, BIAS_SLOPE, NORMAL_OFFSET],
    counters: &[],
    contract: Contract::Approximate,
    features: &[],
    size: super::size,
    cpu: Some(run),
    gpu: Some(gpu::record),
};

/// Texels a side.
///
/// # Errors
/// An even number: it has no middle.
fn kernel(params: &Params) -> Result<u32, Problem> {
    let kernel = params.u32(KERNEL.name);
    if kernel % 2 == 1 {
        return Ok(kernel);
    }
    Err(Problem::new(Kind::BadValue, "parameter value not allowed")
        .port(KERNEL.name)
        .expected("odd whole number 1..=15")
        .found(kernel.to_string())
        .remedy(format!("use {} or {}", kernel - 1, kernel + 1)))
}

fn run(cx: &mut CpuCx) -> Result<(), Problem> {
    let kernel = kernel(cx.params())?;
    super::look_up(cx, kernel)
}
