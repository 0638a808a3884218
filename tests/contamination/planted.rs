//! Passes that do what a pass must not, and the check that finds each.

use super::{found, report_of};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::{CpuCx, CpuFn};
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::{Bind, GpuCx, GpuFn, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};
use shadowgraph_core::size::SizeCx;
use shadowgraph_core::stage::Stage;
use shadowgraph_passes::{casters, combine, sample_filter};
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// A trial for each fault.
pub fn trials() -> Vec<Trial> {
    let cpu = |name: &str, run: fn() -> Result<(), Failed>| Trial::test(format!("contamination/planted/{name}"), run);
    let wgpu = |name: &str, run: fn() -> Result<(), Failed>| {
        gpu::trial(format!("contamination/planted/{name}"), move |_| run())
    };
    vec![
        cpu("a_pass_that_counts_threads_is_named", || on_cpu(&BY_THREADS, &["threads"])),
        cpu("a_pass_that_keeps_a_static_is_named", || on_cpu(&KEEPS_A_STATIC, &["frames", "again"])),
        cpu("a_pass_that_counts_view_samples_is_named", || on_cpu(&COUNTS_ROWS, &["ranges"])),
        cpu("passes_with_a_back_channel_are_named", back_channel),
        wgpu("a_pass_that_reads_what_memory_held_is_named", || on_wgpu(&READS_SCRATCH, &["poison"])),
        wgpu("a_pass_that_adds_to_its_last_frame_is_named", || on_wgpu(&ADDS_UP, &["poison", "frames"])),
    ]
}

const fn pass(name: &'static str, stage: &'static Stage, cpu: Option<CpuFn>, gpu: Option<GpuFn>) -> Pass {
    Pass {
        name,
        stage,
        doc: "a planted fault",
        source: "none",
        ignores: &[],
        params: &[],
        counters: &[],
        contract: Contract::Exact,
        features: &[],
        size: visible_size,
        cpu,
        gpu,
    }
}

fn visible_size(cx: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![("visible", vec![cx.dim("sample_state", 0)]), ("visible_color", vec![0, 3])]
}

static BY_THREADS: Pass =
    pass("planted", &combine::STAGE, Some(|cx| put(cx, 1.0 / rayon::current_num_threads() as f32)), None);

static RUNS: AtomicU32 = AtomicU32::new(0);
static KEEPS_A_STATIC: Pass =
    pass("planted", &combine::STAGE, Some(|cx| put(cx, RUNS.fetch_add(1, Relaxed) as f32)), None);

static COUNTS_ROWS: Pass =
    pass("planted", &combine::STAGE, Some(|cx| put(cx, cx.input("sample_state").dim(0) as f32)), None);

static READS_SCRATCH: Pass = pass("planted", &combine::STAGE, None, Some(read_scratch));
static ADDS_UP: Pass = pass("planted", &combine::STAGE, None, Some(add_up));

/// The same value for every view-sample.
fn put(cx: &mut CpuCx, value: f32) -> Result<(), Problem> {
    let rows = cx.input("sample_state").dim(0);
    cx.put("visible", Array::f32([rows], vec![value; rows]));
    cx.put("visible_color", Array::f32([0, 3], Vec::new()));
    Ok(())
}

/// More than any other node of the graph has, so that none has written the last word.
const SCRATCH_WORDS: usize = 1 << 22;

fn read_scratch(cx: &mut GpuCx) -> Result<(), Problem> {
    const KERNEL: &str = "
@group(0) @binding(0) var<uniform> size: vec4<u32>;
@group(0) @binding(1) var<storage, read> scratch: array<u32>;
@group(0) @binding(2) var<storage, read_write> visible: array<f32>;
@compute @workgroup_size(64)
fn planted(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row < size.x { visible[row] = f32(scratch[size.y] & 1u); }
}";
    let rows = cx.dim("sample_state", 0);
    let scratch = cx.scratch("unwritten", SCRATCH_WORDS);
    let bind = vec![
        Bind::Uniform(vec![rows as u32, SCRATCH_WORDS as u32 - 1]),
        Bind::Read(scratch),
        Bind::ReadWrite(Target::Port("visible")),
    ];
    cx.dispatch("planted", &[PRELUDE, KERNEL], "planted", bind, rows, GROUP);
    Ok(())
}

fn add_up(cx: &mut GpuCx) -> Result<(), Problem> {
    const KERNEL: &str = "
@group(0) @binding(0) var<uniform> size: vec4<u32>;
@group(0) @binding(1) var<storage, read_write> visible: array<f32>;
@compute @workgroup_size(64)
fn planted(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = linear_index(id);
    if row < size.x { visible[row] += 1.0; }
}";
    let rows = cx.dim("sample_state", 0);
    let bind = vec![Bind::Uniform(vec![rows as u32]), Bind::ReadWrite(Target::Port("visible"))];
    cx.dispatch("planted", &[PRELUDE, KERNEL], "planted", bind, rows, GROUP);
    Ok(())
}

fn on_cpu(fault: &'static Pass, checks: &[&str]) -> Result<(), Failed> {
    named(fault, checks, BackendChoice::Cpu)
}

fn on_wgpu(fault: &'static Pass, checks: &[&str]) -> Result<(), Failed> {
    named(fault, checks, BackendChoice::Wgpu)
}

/// Each of `checks` names the fault, and whatever else finds a difference names it too.
fn named(fault: &'static Pass, checks: &[&str], choice: BackendChoice) -> Result<(), Failed> {
    let mut catalogue = shadowgraph_passes::catalogue();
    catalogue.register(fault);
    let graph = r#"(version: 1, base: "hard", replace: [(id: "combine", pass: "planted")])"#;
    let found = found(&report_of(&catalogue, graph, choice)?);
    let silent: Vec<_> = checks.iter().filter(|check| !found.iter().any(|(other, _)| other == *check)).collect();
    let elsewhere = found.iter().any(|(_, begins)| begins != "combine.visible");
    if silent.is_empty() && !elsewhere { Ok(()) } else { Err(format!("{silent:?} found nothing; {found:?}").into()) }
}

static NOTE: AtomicU32 = AtomicU32::new(0);

fn as_usual(cx: &mut CpuCx, usual: &Pass) -> Result<(), Problem> {
    match usual.cpu {
        Some(run) => run(cx),
        None => unreachable!("{usual:?} runs on the CPU"),
    }
}

/// Leaves a note; what comes later may find it.
static LEAVES_A_NOTE: Pass = Pass {
    size: |cx| vec![("caster_state", vec![cx.dim("triangles", 0)])],
    ..pass(
        "leaves_a_note",
        &casters::STAGE,
        Some(|cx| {
            NOTE.store(1, Relaxed);
            as_usual(cx, &casters::all::PASS)
        }),
        None,
    )
};

/// Drops all view-samples when there is a note.
static READS_THE_NOTE: Pass = Pass {
    size: |cx| vec![("sample_state", vec![cx.dim("position", 0)])],
    ..pass(
        "reads_the_note",
        &sample_filter::STAGE,
        Some(|cx| match NOTE.load(Relaxed) {
            0 => as_usual(cx, &sample_filter::light_facing::PASS),
            _ => {
                let rows = cx.input("position").dim(0);
                cx.put("sample_state", Array::u32([rows], vec![0; rows]));
                Ok(())
            }
        }),
        None,
    )
};

/// So that no note outlives its frame.
static TAKES_THE_NOTE: Pass = pass(
    "takes_the_note",
    &combine::STAGE,
    Some(|cx| {
        NOTE.store(0, Relaxed);
        as_usual(cx, &combine::popcount::PASS)
    }),
    None,
);

/// Two nodes that talk past the graph: only the order of nodes shows it, at the one that listens.
fn back_channel() -> Result<(), Failed> {
    let mut catalogue = shadowgraph_passes::catalogue();
    for pass in [&LEAVES_A_NOTE, &READS_THE_NOTE, &TAKES_THE_NOTE] {
        catalogue.register(pass);
    }
    let graph = r#"(version: 1, base: "hard", replace: [
        (id: "casters", pass: "leaves_a_note"),
        (id: "sample_filter", pass: "reads_the_note"),
        (id: "combine", pass: "takes_the_note"),
    ])"#;
    let found = found(&report_of(&catalogue, graph, BackendChoice::Cpu)?);
    let wanted = ("order", "sample_filter.sample_state".to_string());
    if found == [wanted] { Ok(()) } else { Err(format!("{found:?}").into()) }
}
