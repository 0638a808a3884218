//! `shadowgraph verify`.

use crate::args::{GraphChoice, VerifyArgs};
use crate::engine::Machine;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::report::{Bar, align_right, table};
use crate::verify::{Answer, Verdict, judge};
use crate::{file_problem, graph_choice, picture};
use serde::Serialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::{Backend, Plan, Producer, Slot};
use shadowgraph_core::problem::Problems;
use shadowgraph_graph::Keep;
use shadowgraph_passes::shared::contact::contact_band;
use std::path::Path;

/// One view's verdict.
#[derive(Debug, Serialize)]
pub struct Row {
    /// Name of the view.
    pub view: String,
    /// Where nodes ran that were not pinned.
    pub backend: Backend,
    /// The value that was judged, `node.port`, and the stage and pass that made it.
    pub judged: [String; 2],
    /// Time of the graph, milliseconds.
    pub millis: f64,
    /// Time of the truth, milliseconds.
    pub truth_millis: f64,
    /// What differs.
    pub verdict: Verdict,
}

/// What to print, and whether every view is within the accepted share.
///
/// # Errors
/// What is wrong with scene, graph or flags; what a node reports.
pub fn text(catalogue: &Catalogue, args: &VerifyArgs) -> Result<(String, bool), Problems> {
    let scene_choice = args.scene.for_graph(graph_choice::light_samples(&args.graph)?);
    let first = Job::load(&scene_choice)?;
    let mut jobs = Vec::new();
    if args.all_views {
        for name in shadowgraph_scenes::view_names(&first.scene, &args.scene.scene, args.scene.views.as_deref())? {
            let mut choice = scene_choice.clone();
            choice.view = Some(name.clone());
            let view = shadowgraph_scenes::choose_view(
                &first.scene,
                &choice.scene,
                choice.views.as_deref(),
                choice.view.as_deref(),
            )?;
            jobs.push((name, Job::with_view(first.scene.clone(), view, &choice)?));
        }
    } else {
        jobs.push((first.camera.name.clone(), first));
    }
    let mut machine = Machine::new(args.run.backend)?.in_ranges(args.run.ranges);
    let mut rows = Vec::new();
    for (name, job) in jobs {
        rows.push(verify(catalogue, args, &mut machine, name, &job)?);
    }
    let is_right = rows.iter().all(|row| row.verdict.wrong_outside_share <= args.accept);
    let text = if args.run.json {
        serde_json::to_string_pretty(&rows).unwrap_or_default() + "\n"
    } else {
        rows_text(args, &rows, is_right)
    };
    Ok((text, is_right))
}

/// Runs the graph and the truth on one job.
///
/// # Errors
/// What is wrong with the graph; what a node reports.
pub fn verify(
    catalogue: &Catalogue,
    args: &VerifyArgs,
    machine: &mut Machine,
    view: String,
    job: &Job,
) -> Result<Row, Problems> {
    let plan =
        graph_choice::plan(&args.graph, catalogue, Some(&job.facts), machine.default_backend, Keep::AllLivePorts)?;
    machine.ready_for(&plan)?;
    let bar = Bar::new(args.run.quiet);
    let progress = |node: &str, done, total| bar.set(node, done, total);
    let outcome = machine.run(&plan, job, args.run.repeat, &progress)?;
    let answer = Answer::of(&plan, &outcome)?;

    let truth_choice =
        GraphChoice { graph: args.truth.clone(), swap: Vec::new(), set: Vec::new(), on: Vec::new(), no_alias: false };
    let truth_job = job.importing(answer.imports());
    let truth_plan =
        graph_choice::plan(&truth_choice, catalogue, Some(&truth_job.facts), Backend::Cpu, Keep::AllLivePorts)?;
    let truth_outcome = machine.run(&truth_plan, &truth_job, 1, &progress)?;
    let truth = Answer::of(&truth_plan, &truth_outcome)?;

    let casts = caster_state(&truth_plan, &truth_outcome, job.scene.triangle_count());
    let contact = |rows: &[u32]| {
        let rows: Vec<usize> = rows.iter().map(|row| *row as usize).collect();
        contact_band(
            &job.scene.positions,
            &casts,
            &job.samples,
            answer.position.as_vec3(),
            answer.triangle.as_u32(),
            &rows,
            args.contact_ulps,
        )
    };
    let filters_facing =
        plan.nodes.iter().any(|node| node.pass.stage.name == "sample_filter" && node.pass.name != "all");
    let verdict =
        judge(&answer, truth.mask, truth.state, job.light_samples_count(), filters_facing, job.image[0], contact);
    if let Some(folder) = &args.out {
        std::fs::create_dir_all(folder).map_err(|error| file_problem(folder, &error))?;
        let name = if view.is_empty() { "wrong.png".to_string() } else { format!("wrong-{view}.png") };
        write_wrong(&folder.join(name), job.image, answer.pixel, truth.mask, &verdict)?;
    }
    Ok(Row {
        view,
        backend: ran_on(&plan),
        judged: judged(&plan),
        millis: outcome.frames_millis.iter().sum::<f64>() / outcome.frames_millis.len().max(1) as f64,
        truth_millis: truth_outcome.frames_millis.iter().sum(),
        verdict,
    })
}

/// Which triangles cast in the truth; all where it does not say.
fn caster_state(plan: &Plan, outcome: &Outcome, triangles: usize) -> Vec<u32> {
    let slot = plan.slots.iter().position(|slot| slot.port.quantity == "caster_state");
    slot.and_then(|slot| outcome.values.try_get(slot))
        .map_or_else(|| vec![1; triangles], |array| array.as_u32().to_vec())
}

/// The mask that [`Answer::of`] finds.
fn judged(plan: &Plan) -> [String; 2] {
    let made = |slot: &&Slot| slot.port.quantity == "mask" && matches!(slot.producer, Producer::Node(_));
    let maker = plan.slots.iter().find(made).map(|slot| match slot.producer {
        Producer::Node(node) => [slot.name.clone(), format!("{:?}", plan.nodes[node].pass)],
        Producer::Input => [slot.name.clone(), String::new()],
    });
    maker.unwrap_or_default()
}

fn ran_on(plan: &Plan) -> Backend {
    if plan.nodes.iter().any(|node| node.on == Backend::Wgpu) { Backend::Wgpu } else { Backend::Cpu }
}

/// Truth in grey, wrong view-samples outside the contact band in red, each with its neighbours so that one is seen.
fn write_wrong(
    path: &Path,
    [width, height]: [usize; 2],
    pixel: &Array,
    truth: &Array,
    verdict: &Verdict,
) -> Result<(), Problems> {
    let mut bytes = vec![24u8; width * height * 3];
    let masks = truth.as_u32().chunks_exact(truth.dim(1).max(1));
    for (pixel, mask) in pixel.as_u32().iter().zip(masks) {
        let grey = if mask[0] & 1 == 1 { 70 } else { 190 };
        if let Some(texel) = bytes.get_mut(*pixel as usize * 3..*pixel as usize * 3 + 3) {
            texel.fill(grey);
        }
    }
    for row in &verdict.wrong_rows {
        let at = pixel.as_u32()[*row as usize] as usize;
        let (x, y) = (at % width, at / width);
        for (dx, dy) in (0..3).flat_map(|dy| (0..3).map(move |dx| (dx, dy))) {
            let (x, y) = ((x + dx).saturating_sub(1), (y + dy).saturating_sub(1));
            if x < width && y < height {
                bytes[(y * width + x) * 3..][..3].copy_from_slice(&[230, 30, 30]);
            }
        }
    }
    Ok(picture::write_rgb(path, width, height, &bytes)?)
}

fn rows_text(args: &VerifyArgs, rows: &[Row], is_right: bool) -> String {
    let mut table = table(&[
        "view",
        "on",
        "view-samples",
        "false shadow",
        "false lit",
        "in contact",
        "wrong outside",
        "share",
        "ms",
        "truth ms",
    ]);
    for row in rows {
        let verdict = &row.verdict;
        table.add_row([
            row.view.clone(),
            format!("{:?}", row.backend).to_lowercase(),
            verdict.view_samples_count.to_string(),
            verdict.all.false_shadow_count.to_string(),
            verdict.all.false_lit_count.to_string(),
            verdict.contact_count.to_string(),
            verdict.wrong_outside_count.to_string(),
            format!("{:.1e}", verdict.wrong_outside_share),
            format!("{:.1}", row.millis),
            format!("{:.1}", row.truth_millis),
        ]);
    }
    align_right(&mut table, &[2, 3, 4, 5, 6, 7, 8, 9]);
    let mut text = format!("{} against {} on {}\n{table}\n", args.graph.graph, args.truth, args.scene.scene);
    for row in rows {
        if row.verdict.wrong_outside_count > 0 {
            let ([port, pass], verdict) = (&row.judged, &row.verdict);
            text.push_str(&format!(
                "{}: {} of {} bits are wrong in {port}, made by {pass}\n",
                row.view, verdict.wrong_outside_count, verdict.all.bits_count
            ));
        }
        for wrong in row.verdict.wrong.iter().filter(|wrong| !wrong.contact).take(5) {
            text.push_str(&format!(
                "{}: {} at pixel {},{} on triangle {}, position {:?}\n",
                row.view, wrong.kind, wrong.pixel[0], wrong.pixel[1], wrong.triangle, wrong.position
            ));
        }
        let skipped = row.verdict.facing_away_not_compared_count;
        if skipped > 0 {
            text.push_str(&format!(
                "{}: {skipped} view-samples face away and are tested all the same: not compared\n",
                row.view
            ));
        }
    }
    text.push_str(if is_right { "right\n" } else { "WRONG: more bits differ than --accept allows\n" });
    text
}
