//! Hard shadows against exact predicates on the built-in failure scenes: no wrong bit on the CPU, at most one in 1e5 on a GPU.

use crate::bench::{graph_file, job, job_lit, verify_args};
use crate::gpu;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::VerifyArgs;
use shadowgraph::commands::verify::{Row, verify};
use shadowgraph::engine::Machine;
use shadowgraph::job::Job;

/// Parameters that keep heavy scenes quick; every other built-in scene runs as it is.
const LIGHTER: &[(&str, &str)] = &[
    ("random-triangles", "count=5000"),
    ("hairball", "strands=300"),
    ("grass-ring", "blades=2000"),
    ("depth-noise", "count=3000"),
];

/// Every built-in scene.
fn scenes() -> Vec<String> {
    let name = |scene: &shadowgraph_scenes::builtin::Builtin| match LIGHTER.iter().find(|(name, _)| *name == scene.name)
    {
        Some((name, params)) => format!("{name}?{params}"),
        None => scene.name.to_string(),
    };
    shadowgraph_scenes::builtin::list().iter().map(name).collect()
}

/// Graphs that promise exact answers, and how many wrong bits a GPU may have.
const EXACT: &[&str] = &["hard", "hard_fused"];
const GPU_SHARE: f64 = 1e-5;
/// The same for area lights, every light sample a bit.
const EXACT_SOFT: &[&str] = &["soft", "soft_certain", "soft_penumbra"];
/// Light of the scenes for them: two words of samples, and wide.
const AREA_LIGHT: &[&str] = &["--light-samples", "40", "--light-radius", "0.3"];
/// A graph of `graphs/` that promises the same, on some scenes.
const EXACT_FILE: &str = "penumbra_certain";
const EXACT_FILE_SCENES: &[&str] = &["columns", "random-triangles?count=5000", "big-penumbra", "contact"];
/// Graphs that answer by a table, of `graphs/` where they are named so, and the light they do it for.
const LOOK_UP: &[(&str, &[&str])] = &[
    ("soft_lu", AREA_LIGHT),
    ("penumbra_lu", AREA_LIGHT),
    ("soft_lu_planar", &["--light-samples", "128", "--light-shape", "disc", "--light-radius", "0.3"]),
];
/// Scenes for them, and the share of bits that may be wrong at the default sizes: half as many again as the worst of them have.
const LOOK_UP_SCENES: &[(&str, f64)] = &[("columns", 0.001), ("random-triangles?count=5000", 0.0125)];
/// With one light sample an influence region holds all that the footprint does.
const INFLUENCE: &[&str] = &["hard", "--swap", "conservative_raster=influence"];
const DRAWN: &[&[&str]] = &[&["hard_draw"], &["hard", "--swap", "conservative_raster=expanded_draw"]];

/// One trial a scene, graph and backend, and the controls.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    for scene in scenes() {
        for graph in EXACT {
            let name = scene.clone();
            let run = move || check(graph, &name, "160x120", "cpu", 0.0);
            trials.push(Trial::test(format!("truth/{graph}/{scene}/cpu"), run));
            let name = scene.clone();
            let run = move |_: &_| check(graph, &name, "96x72", "wgpu", GPU_SHARE);
            trials.push(gpu::trial(format!("truth/{graph}/{scene}/wgpu"), run));
        }
    }
    for scene in scenes() {
        for graph in EXACT_SOFT {
            for (backend, size, share) in [("cpu", "64x48", 0.0), ("wgpu", "40x30", GPU_SHARE)] {
                let scene = scene.clone();
                let name = format!("truth/{graph}/{scene}/{backend}");
                let run = move || check_soft(graph, &scene, size, backend, share);
                trials.push(if backend == "cpu" { Trial::test(name, run) } else { gpu::trial(name, move |_| run()) });
            }
        }
        let name = scene.clone();
        let run = move || check_soft("soft_silhouettes", &name, "64x48", "cpu", 0.0);
        trials.push(Trial::test(format!("truth/soft_silhouettes/{scene}/cpu"), run));
        for (backend, size, share) in [("cpu", "160x120", 0.0), ("wgpu", "96x72", GPU_SHARE)] {
            let name = format!("truth/{}/{scene}/{backend}", INFLUENCE.join("+"));
            let scene = scene.clone();
            let run = move || check_words(INFLUENCE, &scene, size, backend, share);
            trials.push(if backend == "cpu" { Trial::test(name, run) } else { gpu::trial(name, move |_| run()) });
        }
    }
    for scene in EXACT_FILE_SCENES {
        for (backend, size, share) in [("cpu", "64x48", 0.0), ("wgpu", "40x30", GPU_SHARE)] {
            let name = format!("truth/{EXACT_FILE}/{scene}/{backend}");
            let run = move || check_soft(&graph_file(EXACT_FILE), scene, size, backend, share);
            trials.push(if backend == "cpu" { Trial::test(name, run) } else { gpu::trial(name, move |_| run()) });
        }
    }
    for (graph, light) in LOOK_UP {
        for (scene, share) in LOOK_UP_SCENES {
            for (backend, size) in [("cpu", "64x48"), ("wgpu", "40x30")] {
                let name = format!("truth/{graph}/{scene}/{backend}");
                let words = if *graph == "penumbra_lu" { graph_file(graph) } else { graph.to_string() };
                let run = move || check_lit(&[&words], light, scene, size, backend, *share);
                trials.push(if backend == "cpu" { Trial::test(name, run) } else { gpu::trial(name, move |_| run()) });
            }
        }
    }
    // What only the rasteriser does: casters drawn grown, into the table or straight into the masks.
    for scene in scenes() {
        for words in DRAWN {
            let name = scene.clone();
            let run = move |_: &_| check_words(words, &name, "96x72", "wgpu", GPU_SHARE);
            trials.push(gpu::trial(format!("truth/{}/{scene}/wgpu", words.join("+")), run));
        }
    }
    trials.push(Trial::test("truth/control/coarse_maps_are_worse_than_a_table", || {
        let words = ["multi_shadow_map", "--set", "visibility.size=16"];
        let (scene, share) = LOOK_UP_SCENES[0];
        match check_lit(&words, AREA_LIGHT, scene, "64x48", "cpu", share) {
            Ok(()) => Err("16 x 16 maps pass for a table".into()),
            Err(failed) if failed.message().is_some_and(|text| text.contains("wrong bits of")) => Ok(()),
            Err(failed) => Err(failed),
        }
    }));
    trials.push(Trial::test("truth/control/a_coarse_shadow_map_is_wrong", || {
        let args = verify_args(&[
            "shadow_map",
            "--set",
            "light_depth.size=64",
            "--backend",
            "cpu",
            "--size",
            "96x72",
            "--quiet",
        ]);
        let row = row(&args, "builtin:columns", "96x72")?;
        if row.verdict.wrong_outside_count > 0 {
            Ok(())
        } else {
            Err("no wrong bit found in a 64x64 shadow map".into())
        }
    }));
    trials
}

fn check(graph: &str, scene: &str, size: &str, backend: &str, share: f64) -> Result<(), Failed> {
    check_words(&[graph], scene, size, backend, share)
}

fn check_soft(graph: &str, scene: &str, size: &str, backend: &str, share: f64) -> Result<(), Failed> {
    check_lit(&[graph], AREA_LIGHT, scene, size, backend, share)
}

fn check_lit(words: &[&str], light: &[&str], scene: &str, size: &str, backend: &str, share: f64) -> Result<(), Failed> {
    let more: &[&str] = &["--truth", "truth_soft", "--backend", backend, "--size", size, "--quiet"];
    let args = verify_args(&[words, more, light].concat());
    let job = job_lit(&format!("builtin:{scene}"), size, light);
    judge(&row_of(&args, &job)?, share)
}

fn check_words(words: &[&str], scene: &str, size: &str, backend: &str, share: f64) -> Result<(), Failed> {
    let args = verify_args(&[words, &["--backend", backend, "--size", size, "--quiet"]].concat());
    judge(&row(&args, &format!("builtin:{scene}"), size)?, share)
}

fn judge(row: &Row, share: f64) -> Result<(), Failed> {
    let verdict = &row.verdict;
    // One wrong bit on a small picture is more than the share of any large one: one is let pass on a GPU.
    println!("{} wrong bits of {}", verdict.wrong_outside_count, verdict.all.bits_count);
    let allowed = if share > 0.0 { (share * verdict.all.bits_count as f64).max(1.0) as u64 } else { 0 };
    if verdict.wrong_outside_count <= allowed {
        return Ok(());
    }
    Err(format!(
        "{} wrong bits of {}: {:?}",
        verdict.wrong_outside_count,
        verdict.all.bits_count,
        verdict.wrong.first()
    )
    .into())
}

fn row(args: &VerifyArgs, scene: &str, size: &str) -> Result<Row, Failed> {
    row_of(args, &job(scene, size))
}

fn row_of(args: &VerifyArgs, job: &Job) -> Result<Row, Failed> {
    let mut machine = Machine::new(args.run.backend).map_err(|problem| problem.to_string())?;
    let catalogue = shadowgraph_passes::catalogue();
    verify(&catalogue, args, &mut machine, String::new(), job).map_err(|problems| problems.to_string().into())
}
