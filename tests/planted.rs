//! Passes with a known fault, put in the place of a true one: what finds faults must find these, and name them.

use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::pass::{Catalogue, Contract, Pass};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::KEPT;
use shadowgraph_passes::caster_fill::direct;
use shadowgraph_passes::combine::popcount;
use shadowgraph_passes::visibility::{planes, shafts};
use std::time::Instant;

/// All passes, and those with faults.
pub fn catalogue() -> Catalogue {
    let mut catalogue = shadowgraph_passes::catalogue();
    for pass in [&ONE_WRONG_BIT, &ALL_LIT, &TENTH_SLOWER, &SAME_AGAIN, &ONE_LOST, &TWICE_LIT] {
        catalogue.register(pass);
    }
    catalogue
}

/// `planes` whose CPU function gets one bit wrong; the recipe is true.
static ONE_WRONG_BIT: Pass = Pass {
    name: "one_wrong_bit",
    doc: "Planes, and then one bit of the mask turned round.",
    contract: Contract::Exact,
    cpu: Some(one_wrong_bit),
    ..planes::PASS
};

/// `shafts` that forgets what it found.
static ALL_LIT: Pass =
    Pass { name: "all_lit", doc: "Nothing blocks anything.", cpu: Some(all_lit), gpu: None, ..shafts::PASS };

/// `planes` that takes a tenth longer.
static TENTH_SLOWER: Pass = Pass {
    name: "tenth_slower",
    doc: "Planes, and then a tenth of its time again.",
    cpu: Some(tenth_slower),
    gpu: None,
    ..planes::PASS
};

/// `planes` by the way that [`TENTH_SLOWER`] takes, without the tenth.
static SAME_AGAIN: Pass = Pass { name: "same_again", doc: "Planes.", cpu: Some(same_again), gpu: None, ..planes::PASS };

/// `direct` that loses one caster of a table.
static ONE_LOST: Pass =
    Pass { name: "one_lost", doc: "Direct, and then one entry lost.", cpu: Some(one_lost), gpu: None, ..direct::PASS };

/// `popcount` that answers with more than all of the light.
static TWICE_LIT: Pass = Pass {
    name: "twice_lit",
    doc: "Every view-sample gets twice the light.",
    cpu: Some(twice_lit),
    gpu: None,
    ..popcount::PASS
};

/// The mask that the CPU function of `pass` makes of the same inputs.
fn run_true(pass: &'static Pass, cx: &mut CpuCx) -> Result<Array, Problem> {
    output_true(pass, "mask", cx)
}

fn output_true(pass: &'static Pass, output: &str, cx: &mut CpuCx) -> Result<Array, Problem> {
    let inputs = pass.stage.inputs().filter_map(|port| Some((port.name, cx.optional(port.name)?))).collect();
    let mut inner = CpuCx::new(pass, cx.params(), cx.image(), inputs, cx.progress());
    let run = pass.cpu.unwrap_or(|_| unreachable!("a pass of the CPU"));
    run(&mut inner)?;
    let (outputs, _) = inner.finish();
    Ok(outputs.into_iter().find(|(port, _)| *port == output).map(|(_, array)| array).unwrap_or_else(|| unreachable!()))
}

fn one_lost(cx: &mut CpuCx) -> Result<(), Problem> {
    let entries = output_true(&direct::PASS, "caster_entries", cx)?;
    let mut words = entries.as_u32().to_vec();
    if let Some(first) = words.first_mut() {
        *first ^= 1;
    }
    cx.put("caster_entries", Array::u32([words.len()], words));
    Ok(())
}

fn one_wrong_bit(cx: &mut CpuCx) -> Result<(), Problem> {
    let mask = run_true(&planes::PASS, cx)?;
    let (shape, mut words) = (mask.shape().to_vec(), mask.as_u32().to_vec());
    let states = cx.input("sample_state").as_u32();
    let middle = states.len() / 2;
    if let Some(row) = (middle..states.len()).find(|row| states[*row] == KEPT) {
        words[row] ^= 1;
    }
    cx.put("mask", Array::u32([shape[0], shape[1]], words));
    Ok(())
}

fn all_lit(cx: &mut CpuCx) -> Result<(), Problem> {
    let mask = run_true(&shafts::PASS, cx)?;
    let shape = [mask.dim(0), mask.dim(1)];
    cx.put("mask", Array::u32(shape, vec![0; shape[0] * shape[1]]));
    Ok(())
}

fn tenth_slower(cx: &mut CpuCx) -> Result<(), Problem> {
    let start = Instant::now();
    same_again(cx)?;
    let end = start.elapsed().mul_f64(1.1);
    while start.elapsed() < end {
        std::hint::spin_loop();
    }
    Ok(())
}

fn same_again(cx: &mut CpuCx) -> Result<(), Problem> {
    let mask = run_true(&planes::PASS, cx)?;
    cx.put("mask", mask);
    Ok(())
}

fn twice_lit(cx: &mut CpuCx) -> Result<(), Problem> {
    let count = cx.input("sample_state").dim(0);
    cx.put("visible", Array::f32([count], vec![2.0; count]));
    cx.put("visible_color", Array::f32([0, 3], Vec::new()));
    Ok(())
}
