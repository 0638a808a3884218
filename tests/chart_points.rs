//! What a suite measures: ids that change with it, errors that are true, failures that are listed and stop nothing.

use crate::bench::{compare_args, merge_args};
use crate::chart_place::{COLUMNS, Place, TINY, VARIANTS, sorted, suite_of};
use crate::program::{program_path, stderr};
use libtest_mimic::{Failed, Trial};
use shadowgraph::commands;
use shadowgraph_charts::model::{Errors, Point};
use std::process::Command;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("chart_points/ids_are_those_of_another_process_and_change_with_what_is_measured", ids),
        Trial::test("chart_points/what_cannot_run_is_listed_and_stops_nothing", failures),
        Trial::test("chart_points/a_scene_that_comes_later_takes_the_place_of_its_failure", later),
        Trial::test("chart_points/a_failure_to_measure_is_tried_again", tried_again),
        Trial::test("chart_points/figures_that_no_chart_takes_stop_nothing", out_of_range),
        Trial::test("chart_points/a_wrong_pass_shows_its_error", wrong_pass),
        Trial::test("chart_points/errors_are_those_of_compare", like_compare),
        Trial::test("chart_points/a_reference_in_sets_agrees_with_one_of_a_single_set", reference),
        Trial::test("chart_points/a_quality_of_one_value_is_no_curve", one_value),
    ]
}

fn ids() -> Result<(), Failed> {
    let place = Place::new(TINY)?;
    let first = place.points("a", &[])?;
    assert_eq!(first.len(), VARIANTS);
    let mut distinct = sorted(&first);
    distinct.dedup();
    assert_eq!(distinct.len(), VARIANTS, "two variants share an id");
    let (suite, out) = (place.path("suite.ron"), place.path("b"));
    let output = Command::new(program_path()?)
        .args(["chart", &suite, "--out", &out, "--json", "-q"])
        .output()
        .map_err(|error| error.to_string())?;
    let other: Vec<Point> = serde_json::from_slice(&output.stdout).map_err(|_| stderr(&output))?;
    assert_eq!(sorted(&first), sorted(&other), "another process has other ids");

    // Whatever changes what is measured changes the id of just that.
    let changed = |from: &str, to: &str| -> Result<usize, Failed> {
        assert!(TINY.contains(from), "{from}");
        let place = Place::new(&TINY.replace(from, to))?;
        let points = place.points("a", &[])?;
        Ok(points.iter().filter(|point| !first.iter().any(|known| known.id == point.id)).count())
    };
    assert_eq!(changed("[64, 256]", "[64, 257]")?, 2, "a parameter, on two scenes");
    assert_eq!(changed("builtin:one-triangle\", options", "builtin:open\", options")?, 5, "a scene");
    assert_eq!(
        changed("\"builtin:columns\", options: [", "\"builtin:columns\", options: [\"--fov\", \"37\", ")?,
        5,
        "a view"
    );
    let shape = ["\"builtin:columns\", options: [", "\"builtin:columns\", options: [\"--light-shape\", \"disc\", "];
    assert_eq!(changed(shape[0], shape[1])?, 5, "a light's shape, which one light sample does not show");
    assert_eq!(changed("size: \"24x24\"", "size: \"24x25\"")?, VARIANTS, "the size");
    assert_eq!(changed("reference: 16", "reference: 17")?, VARIANTS, "the truth");
    assert_eq!(changed("(graph: \"hard\")", "(graph: \"hard\", set: [\"visibility=exact\"])")?, 2, "a pass");
    assert_eq!(changed("rounds: 3", "rounds: 4")?, 0, "more rounds are the same measurement");
    Ok(())
}

fn failures() -> Result<(), Failed> {
    let scenes = format!("{COLUMNS}, (name: \"gone\", scene: \"gone.glb\")");
    let methods = r#"(graph: "hard", light_samples: [1, 4]), (graph: "hrad"), (graph: "soft_shafts", light_samples: 4),
        (graph: "hard", axes: {"list_build.size": [64, 3000000]}), (graph: "rays", when: "light_is_point")"#;
    let place = Place::new(&suite_of(&scenes, methods))?;
    let points = place.points("out", &[])?;
    assert_eq!(points.len(), 14);
    let failure = |scene: &str, label: &str| {
        let point = points.iter().find(|point| point.scene == scene && point.label == label);
        point.ok_or_else(|| Failed::from(format!("no {scene} {label}"))).map(|point| point.failure.clone())
    };
    for label in ["hard, 1 samples", "soft_shafts, 4 samples", "hard, size=64"] {
        assert_eq!(failure("columns", label)?, None);
        assert!(failure("gone", label)?.is_some_and(|text| text.starts_with("gone.glb: ")));
    }
    let says = |label: &str, part: &str| match failure("columns", label)? {
        Some(text) if text.contains(part) => Ok(()),
        other => Err(Failed::from(format!("{label}: {other:?}"))),
    };
    says("hard, 4 samples", "light sample")?;
    says("hrad", "did you mean hard?")?;
    says("hard, size=3000000", "size")?;
    says("rays", "not tried: light_is_point does not hold")?;
    let told = place.chart("out", &[])?;
    for part in ["Not run:", "gone hard hard, 1 samples: gone.glb", "columns hrad hrad: no built-in graph"] {
        assert!(told.contains(part), "no {part} in\n{told}");
    }
    let page = place.read("out/chart.html")?;
    assert!(page.contains("did you mean hard?"), "the page says nothing of what did not run");
    Ok(())
}

/// The scene file is missing, then there, then another one: each run shows what it found, once.
fn later() -> Result<(), Failed> {
    let place = Place::new(&suite_of("(name: \"file\", scene: \"file.glb\")", "(graph: \"hard\"), (graph: \"rays\")"))?;
    let folder = place.path("");
    let run = || place.points("out", &["--scenes", &folder]);
    let missing = run()?;
    assert!(missing.len() == 2 && missing.iter().all(|point| point.failure.is_some()));
    let export = |scene: &str| {
        let scene = shadowgraph_scenes::load(scene).map_err(|problem| problem.to_string())?;
        Ok::<_, Failed>(shadowgraph_scenes::export::write_glb(&scene))
    };
    place.write("file.glb", &export("builtin:columns")?)?;
    let first = run()?;
    assert!(first.len() == 2 && first.iter().all(|point| point.failure.is_none()), "{first:?}");
    place.write("file.glb", &export("builtin:one-triangle")?)?;
    let second = run()?;
    assert!(second.len() == 2 && second.iter().all(|point| first.iter().all(|known| known.id != point.id)));
    // Undone: nothing is measured again, and answers and rounds still count.
    let records = || Ok::<_, Failed>([place.read("out/answers.jsonl")?, place.read("out/rounds.jsonl")?]);
    let before = records()?;
    place.write("file.glb", &export("builtin:columns")?)?;
    assert_eq!(sorted(&run()?), sorted(&first));
    assert!(records()? == before, "measured again");
    // Gone: what was measured is shown beside what says so. There again: as it was.
    std::fs::remove_file(place.path("file.glb")).map_err(|error| error.to_string())?;
    let gone = run()?;
    assert!(gone.len() == 4 && first.iter().all(|point| gone.contains(point)), "{gone:?}");
    place.write("file.glb", &export("builtin:columns")?)?;
    assert_eq!(run()?, first);
    assert!(place.read("out/rounds.jsonl")? == before[1], "timed again");
    let measured = place.ids_in("out/answers.jsonl")?;
    assert!(first.iter().all(|point| measured[&point.id] == 1), "judged again: {measured:?}");
    Ok(())
}

/// Memory or a disk that failed once may do the next time.
fn tried_again() -> Result<(), Failed> {
    let place = Place::new(&suite_of(COLUMNS, "(graph: \"hard\"), (graph: \"rays\")"))?;
    let first = place.points("out", &[])?;
    let lost = Point { failure: Some("the device is lost".into()), errors: Errors::default(), ..first[0].clone() };
    let line = shadowgraph_charts::lines::to_line(&lost).map_err(|problem| problem.to_string())?;
    let text = place.read("out/answers.jsonl")? + &line;
    place.write("out/answers.jsonl", text.as_bytes())?;
    assert!(place.points("out", &["--page-only"])?.iter().any(|point| point.failure.is_some()));
    // What was measured elsewhere takes its place, whichever folder comes first.
    std::fs::create_dir(place.path("good")).map_err(|error| error.to_string())?;
    for name in ["answers.jsonl", "rounds.jsonl"] {
        let text = place.read(&format!("out/{name}"))?;
        let own = text.lines().filter(|line| !line.contains("is lost")).map(|line| format!("{line}\n"));
        place.write(&format!("good/{name}"), own.collect::<String>().as_bytes())?;
    }
    let copied =
        std::process::Command::new("cp").args(["-r", &place.path("out/pictures"), &place.path("good")]).status();
    assert!(copied.is_ok_and(|status| status.success()));
    for order in [["out", "good"], ["good", "out"]] {
        let [one, two, whole] =
            [order[0].into(), order[1].into(), format!("{}_first", order[0])].map(|name: String| place.path(&name));
        commands::chart::merge_text(&merge_args(&[&one, &two, "--out", &whole])).map_err(|p| p.to_string())?;
        let points = place.points(&format!("{}_first", order[0]), &["--page-only"])?;
        assert!(points.len() == 2 && points.iter().all(|point| point.failure.is_none()), "{points:?}");
    }
    let again = place.points("out", &[])?;
    let errors =
        |points: &[Point]| points.iter().map(|point| (point.failure.clone(), point.errors.clone())).collect::<Vec<_>>();
    assert_eq!(errors(&again), errors(&first));
    Ok(())
}

/// A pass that lets twice the light through: its own failure, now and when the run goes on.
fn out_of_range() -> Result<(), Failed> {
    let methods = r#"(graph: "soft_shafts", light_samples: 16, axes: {"combine": [twice_lit, popcount]})"#;
    let place = Place::new(&suite_of(COLUMNS, methods))?;
    for _ in 0..2 {
        let points = place.points("out", &[])?;
        let failures = points.iter().filter_map(|point| point.failure.as_ref());
        let failures: Vec<&String> = failures.collect();
        assert!(points.len() == 2 && failures.len() == 1, "{points:?}");
        assert!(
            failures[0].contains("a record that cannot be charted") && failures[0].contains("errors."),
            "{failures:?}"
        );
    }
    assert_eq!(place.read("out/answers.jsonl")?.lines().count(), 2, "the failure is written again and again");
    Ok(())
}

fn wrong_pass() -> Result<(), Failed> {
    let methods = r#"(graph: "soft_shafts", light_samples: 16, axes: {"visibility": [shafts, all_lit]}),
        (graph: "hard", axes: {"visibility": [planes, one_wrong_bit]})"#;
    let place = Place::new(&suite_of(COLUMNS, methods))?;
    let points = place.points("out", &[])?;
    let errors = |label: &str| {
        let point =
            points.iter().find(|point| point.label == label).ok_or_else(|| Failed::from(format!("no {label}")))?;
        Ok::<_, Failed>((point.errors.wrong_bit_share, point.errors.rmse_all, point.errors.light_leak_share))
    };
    let exact = errors("soft_shafts, 16 samples, visibility=shafts")?;
    assert_eq!(exact, (Some(0.0), Some(0.0), Some(0.0)));
    let (wrong, rmse, leak) = errors("soft_shafts, 16 samples, visibility=all_lit")?;
    assert!(wrong > Some(0.01) && rmse > Some(0.05) && leak == wrong, "{wrong:?} {rmse:?} {leak:?}");
    assert_eq!(errors("hard, visibility=planes")?.0, Some(0.0));
    let (wrong, ..) = errors("hard, visibility=one_wrong_bit")?;
    // One bit of at most 24 x 24.
    assert!(wrong >= Some(1.0 / 576.0) && wrong < Some(0.01), "{wrong:?}");
    Ok(())
}

/// The same variant, judged by the truth of as many light samples.
fn like_compare() -> Result<(), Failed> {
    let methods = r#"(graph: "soft_lu", light_samples: 16, set: ["lu_table.size=32"]), (graph: "shadow_map", set: ["light_depth.size=64"])"#;
    let place = Place::new(&suite_of(COLUMNS, methods))?;
    let points = place.points("out", &[])?;
    let compared = |words: &[&str]| {
        let scene = ["--light-radius", "0.4", "--size", "24x24", "--backend", "cpu", "--no-timing", "--json"];
        let args = compare_args(&[words, &scene].concat());
        let (text, _) = commands::compare::text(&shadowgraph_passes::catalogue(), &args).map_err(|p| p.to_string())?;
        let report: serde_json::Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        serde_json::from_value::<Errors>(report["errors"][1].clone()).map_err(|error| Failed::from(error.to_string()))
    };
    let soft = points.iter().find(|point| point.graph == "soft_lu").ok_or("no soft_lu")?;
    let other = compared(&["soft_lu", "--light-samples", "16", "--set", "lu_table.size=32"])?;
    assert!(other.wrong_bit_share > Some(0.0), "nothing to compare");
    assert_eq!(soft.errors, other);
    // One light sample's visible fractions are compared with those of sixteen here, with those of one there: only bits are alike.
    let hard = points.iter().find(|point| point.graph == "shadow_map").ok_or("no shadow_map")?;
    let other = compared(&["shadow_map", "--set", "light_depth.size=64"])?;
    let bits = |errors: &Errors| (errors.wrong_bit_share, errors.light_leak_share, errors.shadow_leak_share);
    assert!(other.wrong_bit_share > Some(0.0) && bits(&hard.errors) == bits(&other), "{:?} {other:?}", hard.errors);
    Ok(())
}

/// Above 4096 light samples the reference is a mean over sets: a little more than the exact answer for one set, and close to it.
fn reference() -> Result<(), Failed> {
    let methods = "(graph: \"soft_shafts\", light_samples: 4), (graph: \"soft_shafts\", light_samples: 64)";
    let errors = |reference: &str| {
        let place = Place::new(&suite_of(COLUMNS, methods).replace("reference: 16", reference))?;
        let points = place.points("out", &[])?;
        assert!(points.iter().all(|point| point.errors.wrong_bit_share == Some(0.0)), "{points:?}");
        points
            .iter()
            .map(|point| point.errors.rmse_penumbra.ok_or("no penumbra".into()))
            .collect::<Result<Vec<f64>, Failed>>()
    };
    let (one_set, sets) = (errors("reference: 4096")?, errors("reference: 8192")?);
    println!("{one_set:?} and {sets:?}");
    assert!(one_set != sets, "the second set changes nothing");
    assert!(sets[0] > 2.0 * sets[1], "more light samples are not better");
    let is_close = |(a, b): (&f64, &f64)| (a / b - 1.0).abs() < 0.2;
    if one_set.iter().zip(&sets).all(is_close) { Ok(()) } else { Err("they disagree".into()) }
}

fn one_value() -> Result<(), Failed> {
    let methods = r#"(graph: "shadow_map", axes: {"light_depth.size": [64]}, quality: "light_depth.size"),
        (graph: "hard", light_samples: [1], quality: "light_samples")"#;
    let points = Place::new(&suite_of(COLUMNS, methods))?.points("out", &[])?;
    assert!(points.len() == 2 && points.iter().all(|point| point.failure.is_none() && point.quality_axis.is_none()));
    Ok(())
}
