//! CPU function against GPU recipe, node by node on equal inputs: a graph runs on the CPU with every value kept, then each node's
//! recipe runs on the values its CPU function read, and the outputs are compared as the pass's contract says.

use crate::bench::{graph_file, job, job_lit, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::job::Job;
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::metric::mask_difference;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::{Backend, Node};
use shadowgraph_core::shared::NO_CELL;
use shadowgraph_graph::Keep;
use shadowgraph_wgpu::Session;

/// Graphs that together mention every pass with both a CPU function and a recipe.
const GRAPHS: &[(&str, &[&str])] = &[
    ("hard", &[]),
    (
        "hard",
        &["list_build=sort", "list_scan=serial", "casters=light_back_facing", "light_frame=whole", "sample_filter=all"],
    ),
    ("hard", &["visibility=fused", "light_frame=six_faces", "combine=threshold", "bent_light=own_face", "shade=phong"]),
    ("hard", &["conservative_raster=influence"]),
    ("shadow_map", &["light_depth=second_surface"]),
    ("pcf", &[]),
    ("soft", &[]),
    ("soft_lu", &[]),
    ("soft_lu_planar", &[]),
    ("soft_certain", &[]),
    ("soft_penumbra", &[]),
    ("rays", &[]),
    ("pcss", &[]),
    ("multi_shadow_map", &[]),
];

/// Graphs for any number of light samples, which run with some, too: 33 are two words of mask, the second nearly empty.
const SOFT: &[(&str, &[&str])] = &[
    ("truth_soft", &["combine=weighted", "bent_light=bounding_box", "shade=full_sum"]),
    ("soft_penumbra", &[]),
    ("rays_soft", &[]),
    ("pcss", &[]),
    ("multi_shadow_map", &[]),
];
/// Files of `graphs/`, likewise.
const FILES: &[&str] = &["penumbra_certain", "penumbra_lu"];
const LIGHT: &[&str] = &["--light-samples", "33", "--light-radius", "0.3"];

const SCENES: &[(&str, &str)] = &[
    ("builtin:columns", "65x63"),
    ("builtin:random-triangles?count=3000", "130x97"),
    ("builtin:one-triangle", "1x1"),
    ("builtin:empty", "8x8"),
];

/// A trial a graph and scene.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    let name_of = |graph: &str, swaps: &[&str], light: &str, scene: &str, size: &str| {
        let swaps = swaps.iter().map(|swap| format!("+{swap}")).collect::<String>();
        format!("twins/{graph}{swaps}{light}/{scene}@{size}")
    };
    for (graph, swaps) in GRAPHS {
        for (scene, size) in SCENES {
            let name = name_of(graph, swaps, "", scene, size);
            trials.push(gpu::trial(name, move |session| twins(session, graph, swaps, &job(scene, size))));
        }
    }
    for (graph, swaps) in SOFT {
        for (scene, size) in SCENES.iter().chain([&("builtin:light-inside", "40x30")]) {
            let name = name_of(graph, swaps, "/33 light samples", scene, size);
            trials.push(gpu::trial(name, move |session| twins(session, graph, swaps, &job_lit(scene, size, LIGHT))));
        }
    }
    for graph in FILES {
        for (scene, size) in SCENES.iter().chain([&("builtin:light-inside", "40x30")]) {
            let name = name_of(graph, &[], "/33 light samples", scene, size);
            let run = move |session: &_| twins(session, &graph_file(graph), &[], &job_lit(scene, size, LIGHT));
            trials.push(gpu::trial(name, run));
        }
    }
    trials
}

fn twins(session: &Session, graph: &str, swaps: &[&str], job: &Job) -> Result<(), Failed> {
    let words: Vec<String> = std::iter::once(graph.to_string())
        .chain(swaps.iter().flat_map(|swap| ["--swap".to_string(), swap.to_string()]))
        .collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let choice = render_args(&words).graph;
    let catalogue = shadowgraph_passes::catalogue();
    let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)
        .map_err(|problems| problems.to_string())?;
    let machine = Machine::new(BackendChoice::Cpu).map_err(|problem| problem.to_string())?;
    let outcome = machine.run(&plan, job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    let mut faults = Vec::new();
    for node in plan.nodes.iter().filter(|node| node.pass.gpu.is_some()) {
        let inputs: Vec<_> =
            node.inputs.iter().map(|(port, slot)| (*port, outcome.values.get(*slot).clone())).collect();
        let (outputs, _) = match session.run_node(node.pass, &node.params, job.image, &inputs) {
            Ok(done) => done,
            Err(problem) => {
                faults.push(format!("{}: {problem}", node.id));
                continue;
            }
        };
        let cpu: Vec<_> = node.outputs.iter().map(|(port, slot)| (*port, outcome.values.get(*slot))).collect();
        faults.extend(node_faults(node, &inputs, &cpu, &outputs));
    }
    if faults.is_empty() { Ok(()) } else { Err(faults.join("\n").into()) }
}

type Named<'a> = &'a [(&'static str, Array)];

fn node_faults(node: &Node, inputs: Named, cpu: &[(&'static str, &Array)], gpu: Named) -> Vec<String> {
    let port = |name: &str| gpu.iter().find(|(port, _)| *port == name).map(|(_, array)| array);
    let twin = |name: &str| cpu.iter().find(|(port, _)| *port == name).map(|(_, array)| *array);
    match node.pass.stage.name {
        // Lists are sets: compared by what each cell holds.
        "list_build" => list_faults(port("cell"), port("slot"), port("list_length"), twin("cell")),
        "list_fill" => sets_faults(inputs, "list_offset", twin("list_entries"), port("list_entries")),
        "caster_fill" => sets_faults(inputs, "caster_offset", twin("caster_entries"), port("caster_entries")),
        // Judged by the masks that come of it: `truth` and `pairs` hold that nothing that matters is missing.
        "conservative_raster" => Vec::new(),
        _ => cpu
            .iter()
            .filter_map(|(name, wanted)| {
                let found = port(name)?;
                // A pixel centre within rounding of an edge may see either triangle; the rasteriser snaps corners to a grid.
                let one_in = if node.pass.stage.name == "view_samples" { 200 } else { 1000 };
                if *name == "penumbra_state" {
                    return states_fault(wanted, found).map(|fault| format!("{}.{name}: {fault}", node.id));
                }
                let lights =
                    inputs.iter().find(|(port, _)| *port == "light_samples").map_or(0, |(_, array)| array.dim(0));
                if *name == "mask" && lights > 1 {
                    return mask_fault(wanted, found, lights, node.pass.contract, one_in as u64);
                }
                value_fault(wanted, found, node.pass.contract, one_in)
                    .map(|fault| format!("{}.{name}: {fault}", node.id))
            })
            .collect(),
    }
}

/// Floats within the contract's bound relative to the larger of 1 and the value; whole numbers equal but for one in
/// `one_in` where two roundings may choose neighbouring triangles or texels.
fn value_fault(wanted: &Array, found: &Array, contract: Contract, one_in: usize) -> Option<String> {
    if wanted.shape() != found.shape() {
        return Some(format!("shape {:?}, not {:?}", found.shape(), wanted.shape()));
    }
    let bound = match contract {
        Contract::Exact => 0.0,
        Contract::Within(bound) => bound,
        _ => 1e-4,
    };
    let differs = |index: &usize| match wanted.element() {
        Element::U32 => wanted.words()[*index] != found.words()[*index],
        Element::F32 => {
            let (want, got) = (wanted.as_f32()[*index], found.as_f32()[*index]);
            want.to_bits() != got.to_bits() && (want - got).abs() > bound * want.abs().max(1.0)
        }
    };
    let count = (0..wanted.words().len()).filter(differs).count();
    let allowed = if bound == 0.0 { 0 } else { wanted.words().len() / one_in + 1 };
    (count > allowed).then(|| {
        let first = (0..wanted.words().len()).find(|index| differs(index)).unwrap_or(0);
        format!("{count} of {} words differ, first word {first}", wanted.words().len())
    })
}

/// States of which `found` holds all that `wanted` holds, by looser bounds on rounding: one in 20 more, and none less.
fn states_fault(wanted: &Array, found: &Array) -> Option<String> {
    if wanted.shape() != found.shape() {
        return Some(format!("shape {:?}, not {:?}", found.shape(), wanted.shape()));
    }
    let count = |pair: [u32; 2]| wanted.as_u32().iter().zip(found.as_u32()).filter(|(a, b)| [**a, **b] == pair).count();
    let (missed, added) = (count([1, 0]), count([0, 1]));
    let all = wanted.as_u32().len();
    (missed > 0 || added > all / 20 + 1)
        .then(|| format!("of {all} view-samples {missed} have state 0 in place of 1, {added} state 1 in place of 0"))
}

/// Masks of many light samples, bit by bit: words with one bit in doubt each would be no measure.
fn mask_fault(wanted: &Array, found: &Array, lights: usize, contract: Contract, one_in: u64) -> Option<String> {
    if wanted.shape() != found.shape() {
        return Some(format!("shape {:?}, not {:?}", found.shape(), wanted.shape()));
    }
    let difference = mask_difference(found.as_u32(), wanted.as_u32(), wanted.dim(1), lights, |_| true);
    let allowed = if contract == Contract::Exact { 0 } else { difference.bits_count / one_in + 1 };
    let (count, all) = (difference.wrong_count(), difference.bits_count);
    (count > allowed).then(|| format!("mask: {count} of {all} bits differ, first row {}", difference.wrong_rows[0]))
}

fn list_faults(
    cell: Option<&Array>,
    slot: Option<&Array>,
    length: Option<&Array>,
    twin: Option<&Array>,
) -> Vec<String> {
    let (Some(cell), Some(slot), Some(length), Some(twin)) = (cell, slot, length, twin) else {
        return vec!["no lists".into()];
    };
    let mut seen: Vec<Vec<u32>> = vec![Vec::new(); length.words().len()];
    for (cell, slot) in cell.as_u32().iter().zip(slot.as_u32()).filter(|(cell, _)| **cell != NO_CELL) {
        seen[*cell as usize].push(*slot);
    }
    let mut faults = Vec::new();
    for (slots, length) in seen.iter_mut().zip(length.as_u32()) {
        slots.sort_unstable();
        if !slots.iter().copied().eq(0..*length) {
            faults.push(format!("a list of length {length} has places {slots:?}"));
        }
    }
    let moved = cell.as_u32().iter().zip(twin.as_u32()).filter(|(one, other)| one != other).count();
    if moved > cell.words().len() / 1000 + 1 {
        faults.push(format!("{moved} of {} view-samples are in another cell", cell.words().len()));
    }
    faults
}

fn sets_faults(inputs: Named, offset: &str, wanted: Option<&Array>, found: Option<&Array>) -> Vec<String> {
    let offsets = inputs.iter().find(|(port, _)| *port == offset).map_or(&[] as &[u32], |(_, array)| array.as_u32());
    let (Some(wanted), Some(found)) = (wanted, found) else { return vec!["no entries".into()] };
    let set = |array: &Array, range: std::ops::Range<usize>| {
        let mut set = array.as_u32()[range].to_vec();
        set.sort_unstable();
        set
    };
    let differs = |pair: &[u32]| {
        let range = pair[0] as usize..pair[1] as usize;
        set(wanted, range.clone()) != set(found, range)
    };
    let count = offsets.windows(2).filter(|pair| differs(pair)).count();
    if count == 0 { Vec::new() } else { vec![format!("{count} cells hold other entries")] }
}

/// A planted fault must be found.
pub fn controls() -> Vec<Trial> {
    vec![Trial::test("twins/control/a_planted_difference_is_found", || {
        let wanted = Array::f32([4], vec![1.0, 2.0, 3.0, 4.0]);
        let found = Array::f32([4], vec![1.0, 2.5, 3.0, 4.5]);
        let whole = Array::u32([2], vec![1, 2]);
        assert!(value_fault(&wanted, &wanted, Contract::Exact, 1000).is_none());
        assert!(value_fault(&wanted, &found, Contract::Within(0.1), 1000).is_some());
        assert!(value_fault(&whole, &Array::u32([2], vec![1, 3]), Contract::Exact, 1000).is_some());
        assert!(value_fault(&whole, &Array::u32([1], vec![1]), Contract::Exact, 1000).is_some());
        let masks = |word: u32| Array::u32([2, 2], vec![word, 0, 5, 1 << 7]);
        assert!(mask_fault(&masks(0), &masks(0), 39, Contract::Exact, 1000).is_none());
        assert!(mask_fault(&masks(0), &masks(8), 39, Contract::Exact, 1000).is_some());
        assert!(mask_fault(&masks(0), &masks(8), 39, Contract::Approximate, 1000).is_none());
        assert!(mask_fault(&masks(0), &masks(12), 39, Contract::Approximate, 1000).is_some());
        let states =
            |ones: std::ops::Range<u32>| Array::u32([60], (0..60).map(|at| u32::from(ones.contains(&at))).collect());
        assert!(states_fault(&states(9..20), &states(9..20)).is_none());
        assert!(states_fault(&states(9..20), &states(5..20)).is_none(), "a few more");
        assert!(states_fault(&states(9..20), &states(4..20)).is_some(), "too many more");
        assert!(states_fault(&states(9..20), &states(8..19)).is_some(), "one less");
        let offsets = [("list_offset", Array::u32([3], vec![0, 2, 3]))];
        let (one, same, other) =
            (Array::u32([3], vec![5, 6, 7]), Array::u32([3], vec![6, 5, 7]), Array::u32([3], vec![6, 7, 5]));
        assert!(sets_faults(&offsets, "list_offset", Some(&one), Some(&same)).is_empty());
        assert_eq!(sets_faults(&offsets, "list_offset", Some(&one), Some(&other)).len(), 1);
        Ok(())
    })]
}
