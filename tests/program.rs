//! The program as a user meets it: exit status, output for people and for scripts, files it writes.

use crate::root;
use libtest_mimic::{Failed, Trial};
use std::path::PathBuf;
use std::process::{Command, Output};

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("program/render_writes_pictures_and_says_what_each_node_cost", render),
        Trial::test("program/dump_has_one_row_for_every_view_sample", dump),
        Trial::test("program/dumped_view_samples_can_be_imported", import),
        Trial::test("program/check_tells_every_mistake_and_fails", check),
        Trial::test("program/a_wrong_flag_is_a_problem_with_a_remedy", wrong_flags),
        Trial::test("program/the_record_is_json", json),
        Trial::test("program/a_soft_graph_has_its_light_samples_without_flags", light_samples),
        Trial::test("program/the_light_is_what_its_flags_say_in_record_and_dump", light),
        Trial::test("program/light_flags_that_do_not_fit_are_problems", wrong_light),
        Trial::test("program/profiles_are_tables_json_and_traces", profiles),
        Trial::test("program/invariance_needs_a_run_and_says_what_it_compared", invariance),
        Trial::test("program/sets_of_light_samples_are_averaged", light_sets),
    ]
}

/// Checks that run a graph: all the same, in words and as JSON; flags of a run are refused where nothing runs.
fn invariance() -> Result<(), Failed> {
    let words = ["check", "--invariance", "hard", "--backend", "cpu", "--size", "24x20", "--frames", "3", "-q"];
    let output = program(&words)?;
    succeeded(&output)?;
    let text = stdout(&output);
    for word in ["order", "frame 3 against the first", "poison: not applicable", "same"] {
        assert!(text.contains(word), "no {word} in\n{text}");
    }
    let output = program(&[&words[..], &["--json"]].concat())?;
    succeeded(&output)?;
    let reports: serde_json::Value = serde_json::from_str(&stdout(&output)).map_err(|error| error.to_string())?;
    let verdicts = reports[0]["checks"].as_array().ok_or("no checks")?;
    assert!(verdicts.iter().any(|check| check["verdict"]["is"] == "same"), "{reports}");
    let output = program(&["check", "hard", "--size", "24x20"])?;
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("--invariance"), "{}", stderr(&output));
    Ok(())
}

/// Times of each node, with the files that were asked for; without timers whole frames alone.
fn profiles() -> Result<(), Failed> {
    let (_keep, out) = folder()?;
    let [trace, csv] = ["trace.json", "nodes.csv"].map(|name| PathBuf::from(&out).join(name).display().to_string());
    let common = ["profile", "hard", "--backend", "cpu", "--size", "32x24", "--frames", "4"];
    let output = program(&[&common[..], &["--trace", &trace, "--csv", &csv]].concat())?;
    succeeded(&output)?;
    let text = stdout(&output);
    for word in
        ["visibility", "alone", "P99", "4 whole frames, timers on", "timers cost", "readings in frames", "left out:"]
    {
        assert!(text.contains(word), "no {word} in\n{text}");
    }
    let read = |path: &str| std::fs::read_to_string(path).map_err(|error| error.to_string());
    let trace: serde_json::Value = serde_json::from_str(&read(&trace)?).map_err(|error| error.to_string())?;
    let slices = |name: &str| {
        let events = trace["traceEvents"].as_array().map(Vec::as_slice).unwrap_or_default();
        events.iter().filter(|event| event["ph"] == "X" && event["name"] == name).count()
    };
    assert_eq!((slices("visibility"), slices("frame 4")), (4, 1));
    assert!(read(&csv)?.lines().filter(|line| line.contains(",visibility,")).count() == 2, "in frame and alone");
    let output = program(&[&common[..], &["--no-timers", "--json"]].concat())?;
    succeeded(&output)?;
    let profile: serde_json::Value = serde_json::from_str(&stdout(&output)).map_err(|error| error.to_string())?;
    assert_eq!((&profile["frame"]["count"], &profile["timed_frame"]), (&4.into(), &serde_json::Value::Null));
    assert_eq!(profile["clocks"]["timers"], false);
    Ok(())
}

/// The mean over sets keeps view-samples and visible shares and has no mask; its record says what it is.
fn light_sets() -> Result<(), Failed> {
    let (_keep, out) = folder()?;
    let scene = ["render", "truth_soft", "--scene", "builtin:half-plane", "--backend", "cpu", "--size", "40x30"];
    let sets = ["--light-samples", "32", "--light-sets", "4", "--dump", &out];
    let output = program(&[&scene[..], &sets].concat())?;
    succeeded(&output)?;
    assert!(stdout(&output).contains("4 disjoint sets of 32 light samples"), "{}", stdout(&output));
    let index = std::fs::read_to_string(PathBuf::from(&out).join("index.json")).map_err(|error| error.to_string())?;
    assert_eq!(shape_of(&index, "view_samples.position.npy")?[0], shape_of(&index, "combine.visible.npy")?[0]);
    assert!(shape_of(&index, "visibility.mask.npy").is_err(), "masks differ from set to set");
    let repeated = program(&["render", "truth_soft", "--light-sets", "4", "--repeat", "2"])?;
    assert!(!repeated.status.success() && stderr(&repeated).contains("--repeat"), "{}", stderr(&repeated));
    Ok(())
}

/// Where the program lies that this test run built.
pub fn program_path() -> Result<PathBuf, Failed> {
    let mut path = std::env::current_exe().map_err(|error| error.to_string())?;
    path.pop();
    if path.ends_with("deps") {
        path.pop();
    }
    let path = path.join(format!("shadowgraph{}", std::env::consts::EXE_SUFFIX));
    if !path.exists() {
        return Err(format!("{} is not built; run the tests of the whole workspace", path.display()).into());
    }
    Ok(path)
}

fn program(words: &[&str]) -> Result<Output, Failed> {
    Command::new(program_path()?).args(words).current_dir(root()).output().map_err(|error| error.to_string().into())
}

fn folder() -> Result<(tempfile::TempDir, String), Failed> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let name = folder.path().display().to_string();
    Ok((folder, name))
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// What it said on stderr.
pub fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn succeeded(output: &Output) -> Result<(), Failed> {
    if output.status.success() { Ok(()) } else { Err(format!("{}\n{}", stdout(output), stderr(output)).into()) }
}

fn render() -> Result<(), Failed> {
    let (_keep, out) = folder()?;
    let output = program(&["render", "hard", "--backend", "cpu", "--size", "64x48", "--out", &out])?;
    succeeded(&output)?;
    let text = stdout(&output);
    for word in ["view_samples", "visibility", "shade", "CPU backend"] {
        assert!(text.contains(word), "no {word} in\n{text}");
    }
    for file in ["image.png", "image.exr"] {
        assert!(PathBuf::from(&out).join(file).exists(), "{file}");
    }
    Ok(())
}

fn shape_of(index: &str, file: &str) -> Result<Vec<u64>, Failed> {
    let index: serde_json::Value = serde_json::from_str(index).map_err(|error| error.to_string())?;
    let rows = index["arrays"].as_array().ok_or("no arrays")?;
    let row = rows.iter().find(|row| row["file"] == file).ok_or(format!("no {file} in the index"))?;
    Ok(row["shape"].as_array().ok_or("no shape")?.iter().filter_map(serde_json::Value::as_u64).collect())
}

fn dump() -> Result<(), Failed> {
    let (_keep, out) = folder()?;
    succeeded(&program(&["render", "hard", "--backend", "cpu", "--size", "40x30", "--dump", &out])?)?;
    let index = std::fs::read_to_string(PathBuf::from(&out).join("index.json")).map_err(|error| error.to_string())?;
    let positions = shape_of(&index, "view_samples.position.npy")?;
    let masks = shape_of(&index, "visibility.mask.npy")?;
    assert_eq!((masks[0], masks[1]), (positions[0], 1), "masks and positions differ in rows");
    assert!(positions[0] > 0 && positions[0] <= 1200, "{positions:?}");
    assert_eq!(shape_of(&index, "light_samples.npy")?, [1, 3]);
    assert_eq!(shape_of(&index, "triangles.npy")?[1..], [3, 3]);
    Ok(())
}

fn import() -> Result<(), Failed> {
    let (_keep, first) = folder()?;
    let (_keep_too, second) = folder()?;
    succeeded(&program(&["render", "hard", "--backend", "cpu", "--size", "40x30", "--dump", &first])?)?;
    let words = ["render", "rays", "--backend", "cpu", "--size", "40x30", "--view-samples", &first, "--dump", &second];
    succeeded(&program(&words)?)?;
    let read =
        |folder: &str, file: &str| std::fs::read(PathBuf::from(folder).join(file)).map_err(|error| error.to_string());
    let same = read(&first, "view_samples.position.npy")? == read(&second, "view_samples.position.npy")?;
    if same { Ok(()) } else { Err("imported positions are not those that were dumped".into()) }
}

fn check() -> Result<(), Failed> {
    let (_keep, folder) = folder()?;
    let path = PathBuf::from(&folder).join("wrong.ron");
    let text =
        r#"(version: 1, base: "hard", replace: [(id: "visibilty", pass: "planes"), (id: "combine", pass: "popcnt")])"#;
    std::fs::write(&path, text).map_err(|error| error.to_string())?;
    let output = program(&["check", &path.display().to_string()])?;
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    let text = stdout(&output);
    assert!(text.contains("wrong.ron:1:") && text.contains("visibility") && text.contains("popcount"), "{text}");
    succeeded(&program(&[
        "check",
        "hard",
        "hard_fused",
        "hard_draw",
        "shadow_map",
        "pcf",
        "pcss",
        "multi_shadow_map",
        "rays",
        "rays_soft",
        "truth_hard",
        "truth_soft",
        "soft_shafts",
        "soft_silhouettes",
    ])?)
}

fn wrong_flags() -> Result<(), Failed> {
    for (words, part) in [
        (vec!["render", "hrad"], "did you mean hard?"),
        (vec!["render", "hard", "--scene", "builtin:colums"], "columns"),
        (vec!["render", "hard", "--size", "12"], "WIDTHxHEIGHT"),
        (vec!["render", "hard", "--swap", "visibility"], "NODE=PASS"),
        (vec!["render", "hard", "--scene", "missing.glb"], "missing.glb"),
        (vec!["passes", "visibilty"], "visibility"),
    ] {
        let output = program(&words)?;
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(stderr(&output).contains(part), "{words:?}: {}", stderr(&output));
    }
    Ok(())
}

fn json() -> Result<(), Failed> {
    let output = program(&["render", "hard", "--backend", "cpu", "--size", "32x32", "--json", "--repeat", "2"])?;
    succeeded(&output)?;
    let record: serde_json::Value = serde_json::from_str(&stdout(&output)).map_err(|error| error.to_string())?;
    assert_eq!(record["runs_count"], 2);
    assert_eq!(record["device"]["backend"], "cpu");
    assert!(record["nodes"].as_array().is_some_and(|nodes| nodes.len() > 10), "{record}");
    Ok(())
}

fn record(words: &[&str]) -> Result<serde_json::Value, Failed> {
    let common = ["--backend", "cpu", "--size", "16x12", "--json", "-q"];
    let output = program(&[words, &common].concat())?;
    succeeded(&output)?;
    serde_json::from_str(&stdout(&output)).map_err(|error| error.to_string().into())
}

fn light_samples() -> Result<(), Failed> {
    let count = |words: &[&str]| Ok::<_, Failed>(record(words)?["scene"]["light_samples_count"].clone());
    assert_eq!(count(&["render", "truth_soft"])?, 256);
    assert_eq!(count(&["render", "truth_soft", "--light-samples", "5"])?, 5);
    assert_eq!(count(&["render", "hard"])?, 1);
    let still = record(&["render", "truth_soft", "--light-radius", "0", "--light-samples", "3"])?;
    let notes = still["notes"].to_string();
    assert!(notes.contains("all 3 light samples coincide"), "{notes}");
    Ok(())
}

fn light() -> Result<(), Failed> {
    let (_keep, out) = folder()?;
    let words = ["render", "truth_soft", "--dump", &out, "--light-shape", "disc", "--light-radius", "0.5"];
    let words = [&words[..], &["--generator", "lattice", "--light-seed", "9", "--light-samples", "100"]].concat();
    let record = record(&words)?;
    let scene = &record["scene"];
    assert_eq!((&scene["light_shape"], &scene["light_generator"]), (&"disc".into(), &"lattice".into()));
    let radius = scene["light_radius"].as_f64().ok_or("no radius")?;
    assert!(scene["light_seed"] == 9 && (radius - 0.5).abs() < 1e-6, "{scene}");
    assert_eq!(record["facts"]["light_is_planar"], true);
    let index = std::fs::read_to_string(PathBuf::from(&out).join("index.json")).map_err(|error| error.to_string())?;
    assert_eq!(shape_of(&index, "light_samples.npy")?, [100, 3]);
    assert_eq!(shape_of(&index, "light_weights.npy")?, [100, 3]);
    let index: serde_json::Value = serde_json::from_str(&index).map_err(|error| error.to_string())?;
    let unit = |file| index["arrays"].as_array().and_then(|rows| rows.iter().find(|row| row["file"] == file));
    assert_eq!(unit("light_samples.npy").map(|row| &row["unit"]), Some(&"scene units".into()));
    assert_eq!(unit("light_weights.npy").map(|row| &row["unit"]), Some(&"share of the light".into()));
    // What was dumped is a light again: the same samples in the same order.
    let samples = PathBuf::from(&out).join("light_samples.npy").display().to_string();
    let (_keep, again) = folder()?;
    self::record(&["render", "truth_soft", "--light-points", &samples, "--dump", &again])?;
    let bytes = |folder: &str, file: &str| std::fs::read(PathBuf::from(folder).join(file)).map_err(|e| e.to_string());
    assert!(bytes(&out, "light_samples.npy")? == bytes(&again, "light_samples.npy")?);
    assert!(bytes(&out, "visibility.mask.npy")? == bytes(&again, "visibility.mask.npy")?);
    Ok(())
}

fn wrong_light() -> Result<(), Failed> {
    let refused = |words: &[&str], says: &str| {
        let output = program(&[&["render", "truth_soft", "--backend", "cpu"], words].concat())?;
        assert_eq!(output.status.code(), Some(2), "{words:?}");
        assert!(stderr(&output).contains(says), "{}", stderr(&output));
        Ok::<_, Failed>(())
    };
    refused(&["--light-shape", "disk"], "invalid value 'disk'")?;
    refused(&["--light-shape", "ellipsoid"], "expected 3 times, each X,Y,Z")?;
    refused(&["--light-points", "no/such.npy"], "no/such.npy")?;
    refused(&["--light-texture", "Cargo.toml"], "Cargo.toml: not a PNG file")?;
    refused(&["--light-mesh", "builtin:one-triangle", "--light-shape", "volume"], "not closed")?;
    refused(&["--light-points", "x.npy", "--light-mesh", "y.glb"], "cannot be used with")
}
