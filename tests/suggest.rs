//! What `suggest` promises: what it names meets the bound when it is measured again, the graph it prints is that variant, facts rule
//! out what cannot matter, and where nothing meets a bound it says what comes nearest.

use crate::bench::{chart_args, compare_args, suggest_args};
use crate::planted;
use libtest_mimic::{Failed, Trial};
use serde_json::Value;
use shadowgraph::commands;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("suggest/what_is_suggested_meets_the_bound_when_measured_again", meets),
        Trial::test("suggest/facts_rule_out_what_cannot_matter", facts),
        Trial::test("suggest/where_nothing_meets_the_bound_the_nearest_is_named", nothing),
        Trial::test("suggest/a_chart_that_is_there_is_used_with_its_own_suite", from_chart),
        Trial::test("suggest/figures_of_another_scene_do_not_count", other_scene),
        Trial::test("suggest/flags_that_do_not_fit_are_problems", wrong_flags),
    ]
}

/// Methods of four kinds, on a scene of one's own.
const SUITE: &str = r#"(
    version: 1, name: "few", reference: 64, rounds: 3, scenes: [],
    methods: [
        (graph: "soft_shafts", light_samples: [4, 16, 64], quality: "light_samples"),
        (graph: "soft_lu", light_samples: 16, axes: {"lu_table.size": [32, 64]}),
        (graph: "shadow_map", axes: {"light_depth.size": [64, 512]}),
        (graph: "hard"),
        (graph: "soft_lu_planar", light_samples: 16, when: "light_is_planar", unless: "light_is_point"),
        (graph: "rays", when: "light_is_point"),
    ],
)"#;
const SCENE: &[&str] = &["--scene", "builtin:columns", "--size", "32x32"];
const SOFT: &[&str] = &["--light-radius", "0.4"];

struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Result<Self, Failed> {
        let place = Self(tempfile::tempdir().map_err(|error| error.to_string())?);
        place.write("suite.ron", SUITE)?;
        Ok(place)
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    fn write(&self, name: &str, text: &str) -> Result<(), Failed> {
        std::fs::write(self.0.path().join(name), text).map_err(|error| error.to_string().into())
    }

    fn run(&self, words: &[&str]) -> Result<(String, bool), Failed> {
        let suite = self.path("suite.ron");
        let args = suggest_args(&[&["--suite", suite.as_str()], words].concat());
        commands::suggest::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string().into())
    }

    fn json(&self, words: &[&str]) -> Result<(Value, bool), Failed> {
        let (text, meets) = self.run(&[words, &["--json"]].concat())?;
        Ok((serde_json::from_str(&text).map_err(|error| error.to_string())?, meets))
    }
}

fn compare(words: &[&str]) -> Result<Value, Failed> {
    let args = compare_args(&[words, SCENE, SOFT, &["--backend", "cpu", "--no-timing", "--json"]].concat());
    let (text, _) =
        commands::compare::text(&planted::catalogue(), &args).map_err(|problems| Failed::from(problems.to_string()))?;
    serde_json::from_str(&text).map_err(|error| error.to_string().into())
}

fn meets() -> Result<(), Failed> {
    let place = Place::new()?;
    let out = place.path("kept");
    for (bound, expected) in [("0", "soft_shafts, 64 samples"), ("0.05", ""), ("0.3", "")] {
        let words = [SCENE, SOFT, &["--out", &out, "--error", bound, "--metric", "rmse_all"]].concat();
        let (found, meets) = place.json(&words)?;
        assert!(meets, "{bound}: {found}");
        let point = &found["suggestion"]["point"];
        let label = point["label"].as_str().ok_or("no label")?;
        assert!(expected.is_empty() || label == expected, "{bound}: {label}");
        // Measured again: the graph that was printed, whose grey is compared with that of as many samples as the reference has.
        let graph = found["graph"].as_str().ok_or("no graph")?;
        place.write("found.ron", graph)?;
        let report = compare(&[&place.path("found.ron"), "soft_shafts", "--no-truth"])?;
        assert_eq!(report["light_samples"][0], point["light_samples"]);
        let again = place.chart_of("found.ron", point["light_samples"].as_u64().unwrap_or(0))?;
        let error = again["errors"]["rmse_all"].as_f64().ok_or("no error")?;
        let most: f64 = bound.parse().map_err(|_| "no number")?;
        assert!(error <= most && Some(error) == found["suggestion"]["error"].as_f64(), "{label}: {error}");
        assert_eq!(again["provenance"]["graph_hash"], point["provenance"]["graph_hash"], "another plan");
        let (told, _) = place.run(&words)?;
        assert!(told.contains(&format!("use {label}, ")) && told.ends_with(graph), "{told}");
    }
    Ok(())
}

impl Place {
    /// A chart of one graph file on the scene, judged as the suite judges.
    fn chart_of(&self, graph: &str, light_samples: u64) -> Result<Value, Failed> {
        let graph = self.path(graph);
        let suite = format!(
            "(version: 1, name: \"again\", size: \"32x32\", reference: 64, rounds: 1,
              scenes: [(name: \"s\", scene: \"builtin:columns\", options: [\"--light-radius\", \"0.4\"])],
              methods: [(graph: {graph:?}, light_samples: {light_samples})])"
        );
        self.write("again.ron", &suite)?;
        let (suite, out) = (self.path("again.ron"), self.path(&format!("again-{light_samples}-{}", graph.len())));
        let text = commands::chart::text(&planted::catalogue(), &chart_args(&[&suite, "--out", &out, "--json"]))
            .map_err(|problems| problems.to_string())?;
        let points: Value = serde_json::from_str(&text).map_err(|error| error.to_string())?;
        let last = points.as_array().and_then(|points| points.last()).ok_or("no point")?;
        Ok(last.clone())
    }
}

/// The variants that ran, by the lines of the table, and why others did not.
fn tried(place: &Place, light: &[&str]) -> Result<(String, String), Failed> {
    let (told, _) = place.run(&[SCENE, light, &["--error", "1", "--metric", "rmse_all"]].concat())?;
    let (table, rest) = told.split_once('╘').or_else(|| told.split_once('└')).ok_or("no table")?;
    Ok((table.to_string(), rest.to_string()))
}

fn facts() -> Result<(), Failed> {
    let place = Place::new()?;
    let (table, rest) = tried(&place, &["--light-radius", "0.4"])?;
    assert!(!table.contains("soft_lu_planar") && !table.contains("rays"), "{table}");
    assert!(rest.contains("soft_lu_planar, 16 samples: not tried: light_is_planar does not hold"), "{rest}");
    assert!(rest.contains("rays: not tried: light_is_point does not hold"), "{rest}");
    let (table, rest) = tried(&place, &["--light-radius", "0.4", "--light-shape", "disc"])?;
    assert!(table.contains("soft_lu_planar, 16 samples") && !rest.contains("planar"), "{table}{rest}");
    // However many samples a light without extent has, they are one point.
    for light in [&["--light-radius", "0"][..], &["--light-shape", "point"]] {
        let (table, rest) = tried(&place, light)?;
        assert!(table.contains("rays") && !table.contains("soft_lu_planar"), "{table}");
        assert!(rest.contains("soft_lu_planar, 16 samples: not tried: light_is_point holds"), "{rest}");
    }
    Ok(())
}

fn nothing() -> Result<(), Failed> {
    let place = Place::new()?;
    let out = place.path("kept");
    let (told, meets) = place.run(&[SCENE, SOFT, &["--out", &out, "--ms", "0"]].concat())?;
    assert!(!meets && told.contains("Nothing meets at most 0 ms a frame. The fastest is "), "{told}");
    let (json, meets) = place.json(&[SCENE, SOFT, &["--out", &out, "--ms", "0"]].concat())?;
    assert!(!meets && json["suggestion"].is_null() && json["graph"].is_null(), "{json}");
    assert!(json["nearest"].as_str().is_some_and(|text| text.starts_with("The fastest is ")), "{json}");
    // Without the exact method, nothing is exact.
    place.write("suite.ron", &SUITE.replace("[4, 16, 64]", "[4, 16]"))?;
    let words = ["--out", &out, "--error", "0", "--metric", "rmse_all"];
    let (told, meets) = place.run(&[SCENE, SOFT, &words].concat())?;
    assert!(!meets, "figures of a variant that is no more in the suite count:\n{told}");
    let says = "Nothing meets RMSE over all view-samples of at most 0. The least error is ";
    assert!(told.contains(says) && told.contains(", of soft_"), "{told}");
    Ok(())
}

fn from_chart() -> Result<(), Failed> {
    let place = Place::new()?;
    let out = place.path("chart");
    let suite = place.path("charted.ron");
    let scenes = "scenes: [(name: \"a\", scene: \"builtin:columns\", options: [\"--light-radius\", \"0.4\"]),
        (name: \"b\", scene: \"builtin:one-triangle\")],";
    place.write(
        "charted.ron",
        &SUITE.replace("scenes: [],", scenes).replace("reference", "size: \"24x24\", reference"),
    )?;
    commands::chart::text(&planted::catalogue(), &chart_args(&[&suite, "--out", &out])).map_err(|p| p.to_string())?;
    let run = |words: &[&str]| {
        let args = suggest_args(&[&["--chart", &out], words].concat());
        commands::suggest::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string())
    };
    let refused = |words: &[&str]| run(words).map(|_| ()).err().unwrap_or_default();
    assert_eq!(
        refused(&["--error", "0"]),
        "command line: the chart has several scenes, or none; expected --on and one of a, b"
    );
    assert_eq!(refused(&["--error", "0", "--on", "c"]), "the chart has no such scene; found c (did you mean a?)");
    // Whose suite is a file says so; with it, the graph is shown.
    let (told, meets) = run(&["--error", "0", "--on", "a", "--metric", "rmse_all"])?;
    assert!(
        meets && told.contains("use soft_shafts, 64 samples") && told.contains("name its file by --suite"),
        "{told}"
    );
    let (told, _) = run(&["--error", "0", "--on", "a", "--metric", "rmse_all", "--suite", &suite])?;
    assert!(told.contains("base: \"soft_shafts\",\n    light_samples: 64,"), "{told}");
    let nowhere = suggest_args(&["--chart", &place.path("nowhere"), "--error", "0"]);
    let problem = commands::suggest::text(&planted::catalogue(), &nowhere).err().map(|problems| problems.to_string());
    assert!(problem.is_some_and(|text| text.starts_with("this folder holds no records of a chart run")));
    Ok(())
}

/// One folder for two scenes.
fn other_scene() -> Result<(), Failed> {
    let place = Place::new()?;
    let out = place.path("kept");
    let words =
        ["--size", "32x32", "--out", &out, "--error", "0", "--metric", "wrong_bit_share", "--light-radius", "0.4"];
    let labels = |scene: &str| {
        let (told, _) = place.run(&[&words[..], &["--scene", scene]].concat())?;
        Ok::<_, Failed>(told.lines().filter(|line| line.contains("│ shadow_map, size=64")).count())
    };
    assert_eq!((labels("builtin:columns")?, labels("builtin:one-triangle")?, labels("builtin:columns")?), (1, 1, 1));
    Ok(())
}

fn wrong_flags() -> Result<(), Failed> {
    let place = Place::new()?;
    let refused = |words: &[&str]| match place.run(words) {
        Ok((told, _)) => Err(Failed::from(format!("{words:?} is accepted: {told}"))),
        Err(failed) => Ok(failed.message().unwrap_or_default().to_string()),
    };
    // One problem, not one for each variant.
    let told = refused(&["--scene", "missing.glb", "--error", "0"])?;
    assert!(told.starts_with("missing.glb: ") && told.lines().count() == 1, "{told}");
    let told = refused(&[SCENE, &["--error", "0", "--metric", "rms"]].concat())?;
    assert!(told.starts_with("command line: --metric names no error; expected rmse_penumbra, "), "{told}");
    use clap::Parser;
    let parse = |words: &[&str]| {
        let words = ["shadowgraph", "suggest"].iter().chain(words);
        shadowgraph::args::Cli::try_parse_from(words).map(|_| ()).err().map(|error| error.to_string())
    };
    let says = |words: &[&str], part: &str| assert!(parse(words).is_some_and(|text| text.contains(part)), "{words:?}");
    for wrong in ["nan", "inf", "-1", "few"] {
        says(&[&format!("--error={wrong}")], "expected a number, 0 or more");
        says(&[&format!("--ms={wrong}")], "expected a number, 0 or more");
    }
    says(&[], "--error");
    says(&["--error", "0", "--ms", "3"], "cannot be used with");
    says(&["--error", "0", "--on", "a"], "--chart");
    says(&["--error", "0", "--chart", "a", "--out", "b"], "cannot be used with");
    Ok(())
}
