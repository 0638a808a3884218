//! Means over frames against the converged answer.

use crate::bench::{job, render_args, soft_job};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::BackendChoice;
use shadowgraph::converged::converged;
use shadowgraph::engine::Machine;
use shadowgraph::frames::Frames;
use shadowgraph::graph_choice;
use shadowgraph::job::Job;
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_graph::Keep;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("frames/the_error_falls_as_frames_come", falls),
        gpu::trial("frames/repeated_on_a_device_each_has_its_time".into(), |_| each_has_its_time()),
        Trial::test("frames/a_moved_camera_or_light_begins_anew", begins_anew),
    ]
}

fn plan(job: &Job) -> Result<Plan, Failed> {
    let (choice, catalogue) = (render_args(&["soft"]).graph, shadowgraph_passes::catalogue());
    graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)
        .map_err(|problems| problems.to_string().into())
}

/// Medians without a spread would hide what they are of.
fn each_has_its_time() -> Result<(), Failed> {
    let text = |problem: shadowgraph_core::problem::Problem| Failed::from(problem.to_string());
    let (job, machine) = (job("builtin:columns", "16x16"), Machine::new(BackendChoice::Wgpu).map_err(text)?);
    let (choice, catalogue) = (render_args(&["hard"]).graph, shadowgraph_passes::catalogue());
    let plan = graph_choice::plan(&choice, &catalogue, Some(&job.facts), Backend::Wgpu, Keep::OutputsOnly)
        .map_err(|problems| problems.to_string())?;
    let outcome = machine.run(&plan, &job, 5, &quiet).map_err(text)?;
    assert_eq!((outcome.runs_count, outcome.frames_millis.len()), (5, 5));
    assert!(outcome.nodes.iter().all(|node| node.millis.len() == 5), "{:?}", outcome.nodes);
    assert!(plan.outputs.iter().all(|(_, slot)| outcome.values.try_get(*slot).is_some()));
    Ok(())
}

fn quiet(_: &str, _: u64, _: u64) {}

/// Root mean squared difference where the converged answer is neither lit nor dark.
fn error(found: &Array, converged: &Array) -> f64 {
    let pairs = found.as_f32().iter().zip(converged.as_f32()).filter(|(_, known)| **known > 0.0 && **known < 1.0);
    let squares: Vec<f64> = pairs.map(|(found, known)| f64::from(found - known).powi(2)).collect();
    assert!(squares.len() > 100, "{} view-samples in penumbra", squares.len());
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

fn falls() -> Result<(), Failed> {
    let text = |problem: shadowgraph_core::problem::Problem| Failed::from(problem.to_string());
    let machine = Machine::new(BackendChoice::Cpu).map_err(text)?;
    let job = soft_job("builtin:columns", "64x48", "16");
    let plan = plan(&job)?;
    let visible = plan.slot("combine.visible").ok_or("no visible fractions")?;
    let large = soft_job("builtin:columns", "64x48", "1024");
    let known = converged(&machine, &plan, &large, 8, &quiet).map_err(text)?;
    let known = known.values.try_get(visible).ok_or("no converged answer")?;
    let mut frames = Frames::new(&plan);
    let mut errors = Vec::new();
    for frame in 0..64 {
        let outcome = machine.run(&plan, &job.in_frame(frame).map_err(text)?, 1, &quiet).map_err(text)?;
        assert_eq!(frames.add(outcome, job.standing()), frame + 1);
        if (frame + 1).is_power_of_two() {
            errors.push(error(&frames.mean(visible).ok_or("no mean")?, known));
        }
    }
    // Frames are independent: the error falls with the root of their number, by 8 in the mean. The control: one frame again and
    // again stays where it is.
    let mut still = Frames::new(&plan);
    for _ in 0..4 {
        still.add(machine.run(&plan, &job, 1, &quiet).map_err(text)?, job.standing());
    }
    let unchanged = error(&still.mean(visible).ok_or("no mean")?, known);
    if errors.windows(2).all(|pair| pair[1] < pair[0] * 1.25) && errors[6] * 5.0 < errors[0] && unchanged == errors[0] {
        return Ok(());
    }
    Err(format!("errors of 1, 2, 4, .. 64 frames: {errors:?}; of one frame repeated {unchanged}").into())
}

fn begins_anew() -> Result<(), Failed> {
    let text = |problem: shadowgraph_core::problem::Problem| Failed::from(problem.to_string());
    let machine = Machine::new(BackendChoice::Cpu).map_err(text)?;
    let job = soft_job("builtin:columns", "32x24", "8");
    let plan = plan(&job)?;
    let visible = plan.slot("combine.visible").ok_or("no visible fractions")?;
    let mut moved = job.clone();
    moved.camera.eye[0] += 0.01;
    let mut dimmed = job.clone();
    dimmed.light.radius *= 0.5;
    let mut frames = Frames::new(&plan);
    for (job, expected) in [(&job, 1), (&job, 2), (&moved, 1), (&moved, 2), (&dimmed, 1), (&job, 1)] {
        let outcome = machine.run(&plan, job, 1, &quiet).map_err(text)?;
        let alone = outcome.values.try_get(visible).ok_or("no visible fractions")?.clone();
        assert_eq!(frames.add(outcome, job.standing()), expected);
        // Frames of equal light samples: the mean is each of them, of the last view only.
        assert!(frames.mean(visible) == Some(alone));
    }
    Ok(())
}
