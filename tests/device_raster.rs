//! `conservative_raster/device` where no device at hand rasterises conservatively: everything but the device's rule. The same recipe
//! with the rule off must list hardly a pair that the binned table lacks, and every pair whose texel centre lies well inside the
//! caster; and the pass itself must ask for the feature by name.

use crate::bench::{job, render_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::{Feature, Pass};
use shadowgraph_core::plan::Backend;
use shadowgraph_graph::Keep;
use shadowgraph_passes::conservative_raster::{binning, device};
use shadowgraph_passes::shared::expand::record_pairs;
use shadowgraph_passes::shared::light_frame::{Face, faces};
use shadowgraph_wgpu::Session;
use std::collections::HashSet;

/// The pass with the device's rule off.
static RULE_OFF: Pass = Pass {
    name: "device_rule_off",
    features: &[Feature::FragmentWritableStorage],
    gpu: Some(|cx| record_pairs(cx, "device", 0.0, false)),
    ..device::PASS
};

/// A trial a scene.
pub fn trials() -> Vec<Trial> {
    ["builtin:columns", "builtin:torus-knot", "builtin:light-inside"]
        .into_iter()
        .map(|scene| gpu::trial(format!("device_raster/{scene}"), move |session| draws_insides(session, scene)))
        .collect()
}

type Pairs = HashSet<(u32, u32)>;

fn pairs(outputs: &[(&'static str, Array)], count: usize) -> Pairs {
    let column =
        |name| outputs.iter().find(|(port, _)| *port == name).map_or(&[] as &[u32], |(_, array)| array.as_u32());
    column("pair_cell").iter().zip(column("pair_caster")).take(count).map(|(cell, caster)| (*cell, *caster)).collect()
}

fn draws_insides(session: &Session, scene: &str) -> Result<(), Failed> {
    let job = job(scene, "96x72");
    let choice = render_args(&["hard", "--set", "list_build.size=64"]).graph;
    let plan = graph_choice::plan(
        &choice,
        &shadowgraph_passes::catalogue(),
        Some(&job.facts),
        Backend::Cpu,
        Keep::AllLivePorts,
    )
    .map_err(|problems| problems.to_string())?;
    let machine = Machine::new(BackendChoice::Cpu).map_err(|problem| problem.to_string())?;
    let outcome = machine.run(&plan, &job, 1, &|_, _, _| {}).map_err(|problem| problem.to_string())?;
    let node = plan.nodes.iter().find(|node| node.id == "conservative_raster").ok_or("no such node")?;
    let inputs: Vec<_> = node.inputs.iter().map(|(port, slot)| (*port, outcome.values.get(*slot).clone())).collect();
    let run = |pass: &'static Pass| -> Result<Pairs, Failed> {
        let (outputs, counts) =
            session.run_node(pass, &node.params, job.image, &inputs).map_err(|problem| problem.to_string())?;
        Ok(pairs(&outputs, counts[0] as usize))
    };
    let (table, drawn) = (run(&binning::PASS)?, run(&RULE_OFF)?);
    // The table knows more of where view-samples are: border texels of cube faces may be drawn beyond it.
    let beyond = drawn.difference(&table).count();
    if beyond * 50 > table.len() {
        return Err(format!("{beyond} pairs are drawn that are not among the {} of the table", table.len()).into());
    }
    let input = |name| inputs.iter().find(|(port, _)| *port == name).map(|(_, array)| array).ok_or("no such port");
    let faces = faces(input("light_frame")?.as_f32());
    let (triangles, _) = input("triangles")?.as_vec3().as_chunks::<3>();
    let side = input("list_length")?.dim(1);
    let inside =
        table.iter().filter(|(cell, caster)| holds_centre(&faces, side, *cell as usize, &triangles[*caster as usize]));
    let (mut count, mut missing) = (0, 0);
    for pair in inside {
        count += 1;
        missing += usize::from(!drawn.contains(pair));
    }
    match (count, missing) {
        (100.., 0) => Ok(()),
        _ => Err(format!("{missing} of {count} texel centres inside a caster are not drawn").into()),
    }
}

/// Whether the direction of the cell's centre passes the triangle's inside, by a hundredth of a texel at least, before the light.
fn holds_centre(faces: &[Face], side: usize, cell: usize, corners: &[[f32; 3]; 3]) -> bool {
    let face = &faces[cell / (side * side)];
    let place = [cell % side, cell / side % side];
    let centre = [0, 1].map(|axis| {
        let share = (place[axis] as f64 + 0.5) / side as f64;
        f64::from(face.window_low[axis]) + share * f64::from(face.window_size[axis])
    });
    let margin = 0.01 * f64::from(face.window_size[0].min(face.window_size[1])) / side as f64;
    let points = corners.map(|corner| {
        let offset = [0, 1, 2].map(|axis| f64::from(corner[axis]) - f64::from(face.origin[axis]));
        let along = |axis: [f32; 3]| (0..3).map(|k| f64::from(axis[k]) * offset[k]).sum::<f64>();
        let depth = along(face.axis_z.to_array());
        (depth, [along(face.axis_x.to_array()) / depth, along(face.axis_y.to_array()) / depth])
    });
    // What passes the plane beside the light is drawn as a box: its inside is not looked at here.
    if points.iter().any(|(depth, _)| *depth < 0.1 * f64::from(face.near)) {
        return false;
    }
    let distance = |index: usize| {
        let ([ax, ay], [bx, by]) = (points[index].1, points[(index + 1) % 3].1);
        ((bx - ax) * (centre[1] - ay) - (by - ay) * (centre[0] - ax)) / (bx - ax).hypot(by - ay).max(1e-30)
    };
    let distances = [0, 1, 2].map(distance);
    distances.iter().all(|distance| *distance > margin) || distances.iter().all(|distance| *distance < -margin)
}
