//! The truth for every light sample, and the mean over many, against scenes whose soft shadow is known without samples.
//!
//! Bounds: 1024 Hammersley points err in the penumbrae of these scenes by 0.0003 (one straight edge along the light's side) to 0.002
//! (two tilted polygons) in the root of the mean square, and by at most 0.01; bounds are a quarter above. The planted fault moves
//! every caster sideways by 5 % of its size, which must be seen as four times the bound.

use crate::bench::{render_args, soft_job};
use glam::{DVec3, Vec3};
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::converged::converged;
use shadowgraph::engine::Machine;
use shadowgraph::graph_choice;
use shadowgraph::job::Job;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::shared::KEPT;
use shadowgraph_graph::Keep;
use shadowgraph_scenes::closed_form::{ClosedForm, of_builtin};

/// Light samples of a run.
const SAMPLES: usize = 1024;
/// Root of the mean squared error over view-samples in penumbra that [`SAMPLES`] may have.
const RMS: f64 = 0.0025;
/// The largest error that they may have.
const MOST: f64 = 0.012;
/// Scenes that have a closed form.
const SCENES: &[&str] =
    &["half-plane", "sphere-over-disc?facets=24", "polygon", "apart", "nested", "fusion", "fusion?halves=same"];

/// All of them.
pub fn trials() -> Vec<Trial> {
    let mut trials: Vec<Trial> =
        SCENES.iter().map(|scene| Trial::test(format!("closed_form/{scene}"), move || agrees(scene))).collect();
    for (halves, visible) in [("other", 0.0), ("same", 0.5)] {
        let run = move || halves_are_exact(halves, visible);
        trials.push(Trial::test(format!("closed_form/fusion_is_exact/{halves}"), run));
    }
    trials.push(Trial::test("closed_form/the_error_falls_as_samples_grow", converges));
    trials
}

fn plan(job: &Job) -> Result<Plan, Failed> {
    let choice = render_args(&["truth_soft"]).graph;
    let catalogue = shadowgraph_passes::catalogue();
    graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)
        .map_err(|problems| problems.to_string().into())
}

/// Receivers on the ground, and what is visible there.
struct Seen {
    receivers: Vec<DVec3>,
    visible: Vec<f64>,
}

fn see(job: &Job, sets: usize) -> Result<Seen, Failed> {
    let (plan, machine) = (plan(job)?, Machine::new(BackendChoice::Cpu).map_err(|problem| problem.to_string())?);
    let quiet = |_: &str, _, _| {};
    let outcome =
        if sets == 1 { machine.run(&plan, job, 1, &quiet) } else { converged(&machine, &plan, job, sets, &quiet) };
    let outcome = outcome.map_err(|problem| problem.to_string())?;
    let value = |name: &str| -> Result<&Array, Failed> {
        Ok(outcome.values.try_get(plan.slot(name).ok_or("no such slot")?).ok_or(format!("{name} was not kept"))?)
    };
    let (position, triangle) = (value("view_samples.position")?, value("view_samples.triangle")?.as_u32());
    let (state, visible) = (value("sample_filter.sample_state")?.as_u32(), value("combine.visible")?.as_f32());
    // The ground is the first two triangles.
    let rows = (0..triangle.len()).filter(|row| triangle[*row] < 2 && state[*row] == KEPT);
    let (receivers, visible) =
        rows.map(|row| (Vec3::from(position.as_vec3()[row]).as_dvec3(), f64::from(visible[row]))).unzip();
    Ok(Seen { receivers, visible })
}

/// Root mean square over penumbra, largest error, view-samples in penumbra.
fn errors(seen: &Seen, form: &ClosedForm) -> (f64, f64, usize) {
    let (mut squares, mut most, mut count) = (0.0, 0.0f64, 0);
    for (at, visible) in seen.receivers.iter().zip(&seen.visible) {
        let known = form.visible(*at);
        most = most.max((visible - known).abs());
        if (1e-9..=1.0 - 1e-9).contains(&known) {
            squares += (visible - known).powi(2);
            count += 1;
        }
    }
    ((squares / f64::from(count.max(1))).sqrt(), most, count as usize)
}

fn form(scene: &str) -> Result<ClosedForm, Failed> {
    Ok(of_builtin(scene).map_err(|problem| problem.to_string())?.ok_or("no closed form")?)
}

/// Every caster moved along x by 5 % of its width, of which one unit counts at most.
fn shifted(form: &ClosedForm) -> ClosedForm {
    let moved = |vertices: &Vec<DVec3>| {
        let size = vertices.iter().map(|v| (v.x - vertices[0].x).abs()).fold(0.0, f64::max).min(1.0);
        vertices.iter().map(|vertex| *vertex + DVec3::X * 0.05 * size).collect()
    };
    ClosedForm { casters: form.casters.iter().map(moved).collect(), ..form.clone() }
}

fn agrees(scene: &str) -> Result<(), Failed> {
    let seen = see(&soft_job(&format!("builtin:{scene}"), "96x72", &SAMPLES.to_string()), 1)?;
    let form = form(scene)?;
    let (rms, most, count) = errors(&seen, &form);
    let text = format!("rms {rms:.5}, most {most:.5}, {count} of {} in penumbra", seen.receivers.len());
    if count < 200 || rms > RMS || most > MOST {
        return Err(text.into());
    }
    let (planted, ..) = errors(&seen, &shifted(&form));
    if planted < 4.0 * RMS {
        return Err(format!("a caster that is moved by 5 % makes an error of {planted} only; {text}").into());
    }
    Ok(())
}

/// On x = 0 exactly all or exactly half of the light samples are blocked, to the bit.
fn halves_are_exact(halves: &str, expected: f32) -> Result<(), Failed> {
    let count = 401;
    let rows = |row: [f32; 3]| -> Vec<f32> { row.repeat(count) };
    let place = |index: usize| [0.0, 0.0, index as f32 / 100.0 - 2.0];
    let job = soft_job(&format!("builtin:fusion?halves={halves}"), "401x1", &SAMPLES.to_string()).importing(vec![
        ("imported_position".into(), Array::f32([count, 3], (0..count).flat_map(place).collect())),
        ("imported_normal".into(), Array::f32([count, 3], rows([0.0, 1.0, 0.0]))),
        ("imported_triangle".into(), Array::u32([count], (0..count).map(|index| u32::from(index > 200)).collect())),
        ("imported_pixel".into(), Array::u32([count], (0..count as u32).collect())),
    ]);
    let seen = see(&job, 1)?;
    assert_eq!(seen.visible.len(), count);
    match seen.visible.iter().find(|visible| **visible != f64::from(expected)) {
        None => Ok(()),
        Some(other) => Err(format!("{other} is visible, not {expected}").into()),
    }
}

/// 65,536 light samples in 16 sets, and fewer: each time N grows, the error falls about as N^-0.77.
fn converges() -> Result<(), Failed> {
    let scene = "polygon";
    let form = form(scene)?;
    let mut found = Vec::new();
    for (samples, sets) in [(256, 1), (4096, 1), (4096, 16)] {
        let seen = see(&soft_job(&format!("builtin:{scene}"), "24x18", &samples.to_string()), sets)?;
        found.push(((samples * sets) as f64, errors(&seen, &form).0));
    }
    for pair in found.windows(2) {
        let slope = (pair[1].1 / pair[0].1).ln() / (pair[1].0 / pair[0].0).ln();
        if !(-1.1..=-0.6).contains(&slope) {
            return Err(format!("the error falls as N^{slope:.2}: {found:?}").into());
        }
    }
    Ok(())
}
