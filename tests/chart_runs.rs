//! Runs of a suite: nothing lost or doubled whatever interrupts them, parts that make the whole, errors that are true, failures that
//! stop nothing.

use crate::bench::{chart_args, compare_args, merge_args};
use crate::planted;
use crate::program::{program_path, stderr};
use libtest_mimic::{Failed, Trial};
use shadowgraph::chart::store::{ANSWERS, Lock, ROUNDS};
use shadowgraph::commands;
use shadowgraph_charts::model::Point;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("chart_runs/ids_are_those_of_another_process_and_change_with_what_is_measured", ids),
        Trial::test("chart_runs/a_run_killed_again_and_again_ends_with_the_whole", killed),
        Trial::test("chart_runs/a_last_line_cut_short_is_told_and_measured_again", cut_short),
        Trial::test("chart_runs/a_finished_run_measures_nothing", finished),
        Trial::test("chart_runs/parts_make_the_whole", parts),
        Trial::test("chart_runs/what_cannot_run_is_listed_and_stops_nothing", failures),
        Trial::test("chart_runs/a_scene_that_comes_later_takes_the_place_of_its_failure", later),
        Trial::test("chart_runs/a_wrong_pass_shows_its_error", wrong_pass),
        Trial::test("chart_runs/errors_are_those_of_compare", like_compare),
        Trial::test("chart_runs/a_quality_of_one_value_is_no_curve", one_value),
        Trial::test("chart_runs/two_runs_in_one_folder_are_refused", locked),
        Trial::test("chart_runs/a_folder_that_is_looked_at_is_not_touched", untouched),
    ]
}

/// Seconds in all; every kind of method.
const TINY: &str = r#"(
    version: 1,
    name: "tiny",
    size: "24x24",
    backends: [cpu],
    reference: 16,
    rounds: 3,
    scenes: [
        (name: "columns", scene: "builtin:columns", options: ["--light-radius", "0.4"]),
        (name: "one", scene: "builtin:one-triangle", options: ["--light-radius", "0.4"]),
    ],
    methods: [
        (graph: "soft_shafts", light_samples: [4, 16], quality: "light_samples"),
        (graph: "shadow_map", axes: {"light_depth.size": [64, 256]}, quality: "light_depth.size"),
        (graph: "hard"),
    ],
)"#;
const VARIANTS: usize = 10;
const ROUNDS_OF_EACH: usize = 3;

/// A folder with a suite in it.
struct Place(tempfile::TempDir);

impl Place {
    fn new(suite: &str) -> Result<Self, Failed> {
        let place = Self(tempfile::tempdir().map_err(|error| error.to_string())?);
        place.write("suite.ron", suite.as_bytes())?;
        Ok(place)
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failed> {
        std::fs::write(self.0.path().join(name), bytes).map_err(|error| error.to_string().into())
    }

    fn read(&self, name: &str) -> Result<String, Failed> {
        std::fs::read_to_string(self.0.path().join(name)).map_err(|error| format!("{name}: {error}").into())
    }

    /// Runs the suite into a folder; what it prints.
    fn chart(&self, out: &str, words: &[&str]) -> Result<String, Failed> {
        let (suite, out) = (self.path("suite.ron"), self.path(out));
        let args = chart_args(&[&[suite.as_str(), "--out", &out], words].concat());
        commands::chart::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string().into())
    }

    fn points(&self, out: &str, words: &[&str]) -> Result<Vec<Point>, Failed> {
        let text = self.chart(out, &[&["--json"], words].concat())?;
        serde_json::from_str(&text).map_err(|error| error.to_string().into())
    }

    /// How often each id stands in a file of records.
    fn ids_in(&self, file: &str) -> Result<BTreeMap<String, usize>, Failed> {
        let mut ids = BTreeMap::new();
        for line in self.read(file)?.lines() {
            let record: serde_json::Value = serde_json::from_str(line).map_err(|error| format!("{error}: {line}"))?;
            *ids.entry(record["id"].as_str().unwrap_or_default().to_string()).or_insert(0) += 1;
        }
        Ok(ids)
    }
}

fn suite_of(scenes: &str, methods: &str) -> String {
    format!(
        "(version: 1, name: \"x\", size: \"24x24\", backends: [cpu], reference: 16, rounds: 2, scenes: [{scenes}], methods: [{methods}])"
    )
}

const COLUMNS: &str = r#"(name: "columns", scene: "builtin:columns", options: ["--light-radius", "0.4"])"#;

fn sorted(points: &[Point]) -> Vec<&str> {
    let mut ids: Vec<&str> = points.iter().map(|point| point.id.as_str()).collect();
    ids.sort_unstable();
    ids
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
    assert_eq!(changed("size: \"24x24\"", "size: \"24x25\"")?, VARIANTS, "the size");
    assert_eq!(changed("reference: 16", "reference: 17")?, VARIANTS, "the truth");
    assert_eq!(changed("(graph: \"hard\")", "(graph: \"hard\", set: [\"visibility=exact\"])")?, 2, "a pass");
    assert_eq!(changed("rounds: 3", "rounds: 4")?, 0, "more rounds are the same measurement");
    Ok(())
}

/// Kills the program at several moments of its run, then lets it finish.
fn killed() -> Result<(), Failed> {
    let place = Place::new(TINY)?;
    let whole = place.points("whole", &[])?;
    let (suite, out) = (place.path("suite.ron"), place.path("out"));
    let lines = || {
        let count = |name: &str| place.read(&format!("out/{name}")).map_or(0, |text| text.lines().count());
        (count(ANSWERS), count(ROUNDS))
    };
    let all = (VARIANTS, VARIANTS * ROUNDS_OF_EACH);
    let mut kills = Vec::new();
    for moment in [1, 4, 9, 14, 22, 31] {
        let mut child = Command::new(program_path()?)
            .args(["chart", &suite, "--out", &out, "-q"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| error.to_string())?;
        while lines().0 + lines().1 < moment && child.try_wait().map_err(|error| error.to_string())?.is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().map_err(|error| error.to_string())?;
        child.wait().map_err(|error| error.to_string())?;
        kills.push(lines());
    }
    println!("killed with (answers, rounds) on disk: {kills:?}");
    let midway = kills.iter().filter(|seen| **seen != (0, 0) && **seen != all).count();
    assert!(midway >= 3, "only {midway} kills came midway: {kills:?}");
    let points = place.points("out", &[])?;
    assert_eq!(sorted(&points), sorted(&whole));
    assert!(points.iter().all(|point| point.runs_count as usize == ROUNDS_OF_EACH && point.failure.is_none()));
    let answers = place.ids_in(&format!("out/{ANSWERS}"))?;
    assert!(answers.len() == VARIANTS && answers.values().all(|count| *count == 1), "{answers:?}");
    let rounds = place.ids_in(&format!("out/{ROUNDS}"))?;
    assert!(rounds.values().all(|count| *count == 1), "{rounds:?}");
    let expected =
        points.iter().flat_map(|point| (0..ROUNDS_OF_EACH).map(move |round| format!("{}#{round}", point.id)));
    let mut expected: Vec<String> = expected.collect();
    expected.sort();
    assert!(rounds.keys().eq(&expected), "{rounds:?}");
    let error =
        |points: &[Point], id: &str| points.iter().find(|point| point.id == id).map(|point| point.errors.clone());
    assert!(whole.iter().all(|point| error(&points, &point.id) == Some(point.errors.clone())), "errors changed");
    Ok(())
}

fn cut_short() -> Result<(), Failed> {
    let place = Place::new(TINY)?;
    let whole = place.points("out", &[])?;
    for (file, lost) in [(ANSWERS, 40), (ROUNDS, 7), (ANSWERS, 1)] {
        let name = format!("out/{file}");
        let text = place.read(&name)?;
        place.write(&name, &text.as_bytes()[..text.len() - lost])?;
        let points = place.points("out", &[])?;
        assert_eq!(sorted(&points), sorted(&whole));
        let ids = place.ids_in(&name)?;
        assert!(ids.values().all(|count| *count == 1) && ids.len() == text.lines().count(), "{file}: {ids:?}");
    }
    // The program says what does not count.
    let text = place.read(&format!("out/{ROUNDS}"))?;
    place.write(&format!("out/{ROUNDS}"), &text.as_bytes()[..text.len() - 9])?;
    let (suite, out) = (place.path("suite.ron"), place.path("out"));
    let output = Command::new(program_path()?)
        .args(["chart", &suite, "--out", &out, "-q"])
        .output()
        .map_err(|error| error.to_string())?;
    let says = format!("{ROUNDS}:{}:", VARIANTS * ROUNDS_OF_EACH);
    assert!(stderr(&output).contains(&says) && output.status.success(), "{}", stderr(&output));
    assert!(stderr(&output).contains("the last line was not written to its end; it does not count"));
    // A line in the middle that is no record is no accident of a kill.
    place.write(&format!("out/{ROUNDS}"), &[b"{}\n", text.as_bytes()].concat())?;
    let refused = place.chart("out", &[]).err().and_then(|failed| failed.message().map(String::from));
    assert!(refused.is_some_and(|text| text.contains(&format!("{ROUNDS}:1:"))));
    Ok(())
}

fn finished() -> Result<(), Failed> {
    let place = Place::new(TINY)?;
    let first = place.chart("out", &[])?;
    let records = |place: &Place| Ok::<_, Failed>([place.read("out/answers.jsonl")?, place.read("out/rounds.jsonl")?]);
    let before = records(&place)?;
    assert_eq!(place.chart("out", &[])?, first);
    assert!(records(&place)? == before, "a finished run measured something");
    assert_eq!(place.chart("out", &["--page-only"])?, first);
    let page = place.read("out/chart.html")?;
    for point in place.points("out", &[])? {
        let label = point.label.replace('&', "&amp;");
        assert!(page.contains(&label) && first.contains(&point.label), "the page lacks {label}");
    }
    for name in ["points.csv", "points.jsonl", "svg", "pictures"] {
        assert!(Path::new(&place.path("out")).join(name).exists(), "{name}");
    }
    // One scene of two, by name.
    let one = place.points("part", &["--scene", "one"])?;
    assert!(one.len() == VARIANTS / 2 && one.iter().all(|point| point.scene == "one"));
    let wrong = place.chart("part", &["--scene", "two"]).err().and_then(|failed| failed.message().map(String::from));
    let says = "command line: --scene names no scene of the suite; expected columns, one; found two";
    assert_eq!(wrong.as_deref(), Some(says));
    Ok(())
}

fn parts() -> Result<(), Failed> {
    let place = Place::new(TINY)?;
    let whole = place.points("whole", &[])?;
    let one = place.points("one", &["--shard", "1/2"])?;
    let two = place.points("two", &["--shard", "2/2"])?;
    assert_eq!(one.len() + two.len(), whole.len(), "parts overlap or miss something");
    assert!(!one.is_empty() && !two.is_empty());
    let [from_one, from_two, out] = ["one", "two", "merged"].map(|name| place.path(name));
    let told = commands::chart::merge_text(&merge_args(&[&from_one, &from_two, "--out", &out]))
        .map_err(|problems| problems.to_string())?;
    assert!(
        told.contains(&format!("one: {} answers, {} timed rounds", one.len(), one.len() * ROUNDS_OF_EACH)),
        "{told}"
    );
    // A finished run of the merged folder measures nothing.
    let before = place.read("merged/rounds.jsonl")?;
    let merged = place.points("merged", &[])?;
    assert!(place.read("merged/rounds.jsonl")? == before, "the merged folder was not whole");
    assert_eq!(sorted(&merged), sorted(&whole));
    for point in &whole {
        let twin = merged.iter().find(|other| other.id == point.id).ok_or("an id is missing")?;
        assert_eq!(twin.errors, point.errors, "{}", point.label);
        for picture in [&twin.pictures.picture, &twin.pictures.error].into_iter().flatten() {
            assert!(Path::new(&out).join(picture).exists(), "{picture}");
        }
    }
    // Twice is once, and a folder without records is a problem.
    let again = commands::chart::merge_text(&merge_args(&[&from_one, "--out", &out])).map_err(|p| p.to_string())?;
    assert!(again.contains("one: 0 answers, 0 timed rounds"), "{again}");
    let empty = place.path("nothing");
    let refused = commands::chart::merge_text(&merge_args(&[&empty, "--out", &out])).err().map(|p| p.to_string());
    assert!(refused.is_some_and(|text| text.starts_with("this folder holds no records of a chart run")));
    assert!(!Path::new(&empty).exists(), "merge made the folder that it did not find");
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
    // Undone: judged again, and its rounds still count.
    place.write("file.glb", &export("builtin:columns")?)?;
    let rounds = place.read("out/rounds.jsonl")?;
    assert_eq!(sorted(&run()?), sorted(&first));
    assert!(place.read("out/rounds.jsonl")? == rounds, "timed again");
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
        serde_json::from_value::<shadowgraph_charts::model::Errors>(report["errors"][1].clone())
            .map_err(|error| Failed::from(error.to_string()))
    };
    let soft = points.iter().find(|point| point.graph == "soft_lu").ok_or("no soft_lu")?;
    let other = compared(&["soft_lu", "--light-samples", "16", "--set", "lu_table.size=32"])?;
    assert!(other.wrong_bit_share > Some(0.0), "nothing to compare");
    assert_eq!(soft.errors, other);
    // One light sample's visible fractions are compared with those of sixteen here, with those of one there: only bits are alike.
    let hard = points.iter().find(|point| point.graph == "shadow_map").ok_or("no shadow_map")?;
    let other = compared(&["shadow_map", "--set", "light_depth.size=64"])?;
    let bits = |errors: &shadowgraph_charts::model::Errors| {
        (errors.wrong_bit_share, errors.light_leak_share, errors.shadow_leak_share)
    };
    assert!(other.wrong_bit_share > Some(0.0) && bits(&hard.errors) == bits(&other), "{:?} {other:?}", hard.errors);
    Ok(())
}

fn one_value() -> Result<(), Failed> {
    let methods = r#"(graph: "shadow_map", axes: {"light_depth.size": [64]}, quality: "light_depth.size"),
        (graph: "hard", light_samples: [1], quality: "light_samples")"#;
    let points = Place::new(&suite_of(COLUMNS, methods))?.points("out", &[])?;
    assert!(points.len() == 2 && points.iter().all(|point| point.failure.is_none() && point.quality_axis.is_none()));
    Ok(())
}

fn locked() -> Result<(), Failed> {
    let place = Place::new(&suite_of(COLUMNS, "(graph: \"hard\")"))?;
    let out = place.path("out");
    let lock = Lock::take(Path::new(&out)).map_err(|problem| problem.to_string())?;
    let suite = place.path("suite.ron");
    let run = || {
        let output = Command::new(program_path()?).args(["chart", &suite, "--out", &out, "-q"]).output();
        output.map_err(|error| Failed::from(error.to_string()))
    };
    let output = run()?;
    assert_eq!(output.status.code(), Some(2));
    let says = format!("another run writes into this folder; found process {}", std::process::id());
    assert!(stderr(&output).contains(&says), "{}", stderr(&output));
    assert!(place.read("out/answers.jsonl").is_err(), "it wrote all the same");
    drop(lock);
    let output = run()?;
    assert!(output.status.success(), "{}", stderr(&output));
    // What a run that was killed left behind holds nothing, whoever has its number now.
    place.write("out/lock", std::process::id().to_string().as_bytes())?;
    assert!(run()?.status.success());
    Ok(())
}

/// A run may be writing its last line just then.
fn untouched() -> Result<(), Failed> {
    let place = Place::new(&suite_of(COLUMNS, "(graph: \"hard\")"))?;
    place.points("part", &[])?;
    let text = place.read("part/rounds.jsonl")?;
    place.write("part/rounds.jsonl", &text.as_bytes()[..text.len() - 5])?;
    let before = place.read("part/rounds.jsonl")?;
    let [part, out] = ["part", "out"].map(|name| place.path(name));
    commands::chart::merge_text(&merge_args(&[&part, "--out", &out])).map_err(|problems| problems.to_string())?;
    let words = ["--chart", part.as_str(), "--error", "1", "--metric", "wrong_bit_share"];
    let args = crate::bench::suggest_args(&words);
    commands::suggest::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string())?;
    assert_eq!(place.read("part/rounds.jsonl")?, before);
    Ok(())
}
