//! The stability run: what is biased is flagged, what is right is not, and a run that was cut off goes on.

use clap::Parser;
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::{Cli, Command};
use shadowgraph::commands::stability::text;
use shadowgraph_charts::lines;
use shadowgraph_charts::model::{Expected, Stability, Verdict};
use std::path::Path;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("stability/a_planted_bias_is_flagged_with_pictures_and_what_is_exact_is_not", bias),
        Trial::test("stability/the_truth_against_itself_flags_nothing_and_that_is_told", identity),
        Trial::test("stability/a_run_that_was_cut_off_goes_on_and_measures_nothing_twice", resumed),
        Trial::test("stability/shards_make_a_whole", shards),
        Trial::test("stability/other_thresholds_and_expectations_need_no_second_measurement", judged_again),
        Trial::test("stability/equal_view_samples_get_equal_answers_while_the_camera_turns", camera_pan),
        Trial::test("stability/every_change_runs_and_alias_free_methods_hold", every_change),
        Trial::test("stability/what_cannot_run_says_why_and_is_no_failure", not_run),
        Trial::test("stability/mistakes_are_told_and_nothing_runs", mistakes),
    ]
}

const HARD: &str = r#"(graph: "hard", judge: (by: "wrong_outside_share", at_most: 0))"#;
const BIASED: &str = r#"(name: "biased", graph: "shadow_map", set: ["shadow_lookup.bias_constant=1.5"], judge: (by: "wrong_bit_share", at_most: 0.005))"#;
const CONTACT: &str = r#"(name: "contact", scene: "builtin:contact")"#;

/// A suite of small pictures.
fn suite(scenes: &[&str], sequences: &[&str], methods: &[&str], expect: &[&str]) -> String {
    format!(
        "(version: 1, name: \"small\", size: \"40x30\", scenes: [{}], sequences: [{}], methods: [{}], expect: [{}])",
        scenes.join(", "),
        sequences.join(", "),
        methods.join(", "),
        expect.join(", ")
    )
}

/// Runs a suite into a folder and returns what it prints and whether it is accepted.
fn run(folder: &Path, suite: &str, words: &[&str]) -> Result<(String, bool), Failed> {
    let file = folder.join("suite.ron");
    std::fs::write(&file, suite).map_err(|error| error.to_string())?;
    let (file, out) = (file.display().to_string(), folder.join("out").display().to_string());
    let all = ["shadowgraph", "stability", &file, "--out", &out, "--quiet", "--backend", "cpu"];
    let args = match Cli::parse_from(all.iter().chain(words)).command {
        Command::Stability(args) => args,
        other => unreachable!("{other:?}"),
    };
    text(&shadowgraph_passes::catalogue(), &args).map_err(|problems| problems.to_string().into())
}

fn folder() -> Result<tempfile::TempDir, Failed> {
    tempfile::tempdir().map_err(|error| error.to_string().into())
}

fn records(folder: &Path, file: &str) -> Result<Vec<Stability>, Failed> {
    let bytes = std::fs::read(folder.join("out").join(file)).map_err(|error| error.to_string())?;
    Ok(lines::read(&bytes, file).map_err(|problems| problems.to_string())?.records)
}

fn of<'r>(records: &'r [Stability], method: &str) -> Result<&'r Stability, Failed> {
    records.iter().find(|record| record.label == method).ok_or_else(|| format!("no record of {method}").into())
}

fn bias() -> Result<(), Failed> {
    let folder = folder()?;
    let must_hold = r#"(is: MustHold, why: "a control: the biased map must be caught")"#;
    let text = suite(&[CONTACT], &["(change: Still)"], &[HARD, BIASED], &[must_hold]);
    let (printed, is_accepted) = run(folder.path(), &text, &[])?;
    assert!(!is_accepted && printed.contains("MUST HOLD and fails: biased on contact, Still"), "{printed}");
    assert!(!printed.contains("fails: hard"), "{printed}");
    let records = records(folder.path(), "records.jsonl")?;
    let (hard, biased) = (of(&records, "hard")?, of(&records, "biased")?);
    assert_eq!((&hard.verdict, hard.figure, &hard.worst), (&Verdict::Holds, Some(0.0), &None));
    assert_eq!(biased.verdict, Verdict::Fails);
    // A bias lets light through; it blocks none.
    let frame = &biased.frames[0];
    assert!(frame.light_leak_share > Some(0.005) && frame.shadow_leak_share < frame.light_leak_share, "{frame:?}");
    let worst = biased.worst.as_ref().ok_or("no failing place")?;
    for name in [&worst.picture, &worst.truth, &worst.error].into_iter().flatten() {
        let bytes = std::fs::read(folder.path().join("out").join(name)).map_err(|error| error.to_string())?;
        assert!(bytes.starts_with(b"\x89PNG"), "{name}");
    }
    let page = std::fs::read_to_string(folder.path().join("out/stability.html")).map_err(|error| error.to_string())?;
    assert!(page.contains("biased") && page.matches("data:image/png").count() >= 3);
    Ok(())
}

fn identity() -> Result<(), Failed> {
    let folder = folder()?;
    let methods = [
        r#"(graph: "truth_hard", judge: (by: "wrong_bit_share", at_most: 0))"#,
        r#"(graph: "truth_soft", light_samples: 8, judge: (by: "rmse_penumbra", at_most: 0))"#,
    ];
    let sequences = ["(change: Still)", "(change: LightOrbit, values: [0, 3])"];
    let expect = r#"(is: ExpectedToFail, methods: ["truth_soft"], changes: [Still], why: "a control: it will not")"#;
    let (printed, is_accepted) = run(folder.path(), &suite(&[CONTACT], &sequences, &methods, &[expect]), &[])?;
    assert!(is_accepted && printed.contains("nothing fails: such a suite has not shown"), "{printed}");
    assert!(printed.contains("not seen to fail: explain: truth_soft on contact, Still"), "{printed}");
    for record in records(folder.path(), "records.jsonl")? {
        assert_eq!((record.figure, &record.worst), (Some(0.0), &None), "{} {:?}", record.label, record.sequence);
        let temporal = record.temporal.unwrap_or_default();
        assert!(temporal.t_rmse.unwrap_or_default() == 0.0 && temporal.toggled_count.unwrap_or_default() == 0);
        assert_eq!(record.temporal.is_some(), record.frames.len() > 1);
    }
    Ok(())
}

fn resumed() -> Result<(), Failed> {
    let folder = folder()?;
    let text = suite(&[CONTACT], &["(change: Still)", "(change: Zoom, values: [1, 0.5])"], &[HARD, BIASED], &[]);
    run(folder.path(), &text, &[])?;
    let whole = records(folder.path(), "records.jsonl")?;
    let file = folder.path().join("out/records.jsonl");
    let bytes = std::fs::read(&file).map_err(|error| error.to_string())?;
    // Killed while it wrote the third line.
    let ends: Vec<usize> = (0..bytes.len()).filter(|at| bytes[*at] == b'\n').collect();
    std::fs::write(&file, &bytes[..(ends[1] + ends[2]) / 2]).map_err(|error| error.to_string())?;
    let (printed, _) = run(folder.path(), &text, &[])?;
    assert!(printed.contains("the last line was not written to its end") && printed.contains("4 records"), "{printed}");
    let again = records(folder.path(), "records.jsonl")?;
    assert_eq!(again.len(), 4);
    assert_eq!(again[..2], whole[..2], "measured a second time");
    for (one, other) in whole.iter().zip(&again) {
        assert_eq!((&one.id, one.figure, &one.verdict), (&other.id, other.figure, &other.verdict));
    }
    let before = std::fs::read(&file).map_err(|error| error.to_string())?;
    let (printed, _) = run(folder.path(), &text, &[])?;
    assert!(printed.contains("4 records, 4 of them of earlier runs"), "{printed}");
    assert!(before == std::fs::read(&file).map_err(|error| error.to_string())?, "a finished run wrote a record");
    // Another parameter is another record.
    run(folder.path(), &text.replace("bias_constant=1.5", "bias_constant=1.2"), &[])?;
    assert_eq!(records(folder.path(), "records.jsonl")?.len(), 6);
    Ok(())
}

fn shards() -> Result<(), Failed> {
    let folder = folder()?;
    let scenes = [CONTACT, r#"(name: "half-plane", scene: "builtin:half-plane")"#];
    let text = suite(&scenes, &["(change: Still)", "(change: WorldScale, values: [10])"], &[HARD], &[]);
    let (first, _) = run(folder.path(), &text, &["--shard", "1/2"])?;
    assert!(first.contains("2 records, 0 of them"), "{first}");
    let (second, _) = run(folder.path(), &text, &["--shard", "2/2"])?;
    assert!(second.contains("2 records, 0 of them"), "{second}");
    let (whole, _) = run(folder.path(), &text, &[])?;
    assert!(whole.contains("4 records, 4 of them of earlier runs"), "{whole}");
    assert_eq!(records(folder.path(), "records.2of2.jsonl")?.len(), 2);
    Ok(())
}

fn judged_again() -> Result<(), Failed> {
    let folder = folder()?;
    let text = suite(&[CONTACT], &["(change: Still)"], &[BIASED], &[]);
    run(folder.path(), &text, &[])?;
    let rule = r#"(is: ExpectedToFail, why: "a bias of more than a cube")"#;
    let generous = suite(&[CONTACT], &["(change: Still)"], &[&BIASED.replace("0.005", "0.9")], &[rule]);
    let (printed, _) = run(folder.path(), &generous, &[])?;
    assert!(printed.contains("1 records, 1 of them of earlier runs"), "{printed}");
    assert!(printed.contains("not seen to fail: explain: biased on contact"), "{printed}");
    let records = records(folder.path(), "records.jsonl")?;
    let record = of(&records, "biased")?;
    assert_eq!((&record.verdict, record.expected), (&Verdict::Holds, Expected::ExpectedToFail));
    Ok(())
}

fn camera_pan() -> Result<(), Failed> {
    let folder = folder()?;
    let coarse = r#"(name: "coarse", graph: "shadow_map", set: ["light_depth.size=64"], judge: (by: "wrong_bit_share", at_most: 0))"#;
    let scene = r#"(name: "anim-cam", scene: "builtin:anim-cam")"#;
    let text = suite(&[scene], &["(change: CameraPan, values: [0, 0.3, 0.6, 2])"], &[HARD, coarse], &[]);
    run(folder.path(), &text, &[])?;
    let records = records(folder.path(), "records.jsonl")?;
    let motion = |method: &str| Ok::<_, Failed>(of(&records, method)?.temporal.ok_or("no temporal error")?);
    let (hard, coarse) = (motion("hard")?, motion("coarse")?);
    assert_eq!((hard.t_rmse, hard.toggled_count), (Some(0.0), Some(0)));
    assert!(coarse.toggled_count > Some(0) && coarse.t_rmse > Some(0.0), "{coarse:?}");
    Ok(())
}

fn every_change() -> Result<(), Failed> {
    let folder = folder()?;
    let sequences = [
        "(change: LightOrbit, values: [0, 2])",
        "(change: Zoom, values: [1, 0.01])",
        "(change: WorldScale, values: [1e-3, 1e4])",
        "(change: FarFromOrigin, values: [0, 1e3])",
        "(change: GrowingLight, values: [0.1, 3])",
        "(change: Tessellation, values: [0, 2])",
        "(change: ClosingContact, values: [0.1, 0])",
        "(change: OpeningMeshes, values: [0, 0.4])",
    ];
    let soft = r#"(graph: "soft", light_samples: 8, judge: (by: "wrong_outside_share", at_most: 0))"#;
    let shafts = r#"(graph: "soft_shafts", light_samples: 8, judge: (by: "wrong_outside_share", at_most: 0))"#;
    let must_hold = r#"(is: MustHold, why: "decided by exact predicates where single precision is not sure")"#;
    let text = suite(&[CONTACT], &sequences, &[HARD, soft, shafts], &[must_hold]);
    let (printed, is_accepted) = run(folder.path(), &text, &[])?;
    assert!(is_accepted, "{printed}");
    let records = records(folder.path(), "records.jsonl")?;
    assert_eq!(records.len(), 3 * sequences.len());
    for record in &records {
        assert_eq!(record.frames.len(), 2);
        assert!(record.frames.iter().all(|frame| frame.millis.is_some()), "{:?}", record.sequence);
        let has_lists = record.frames.iter().all(|frame| frame.longest_list_count > Some(0));
        assert_eq!(has_lists, record.label != "soft_shafts", "{} {:?}", record.label, record.sequence);
    }
    Ok(())
}

fn not_run() -> Result<(), Failed> {
    let folder = folder()?;
    let methods = [
        r#"(graph: "hard_draw", judge: (by: "wrong_outside_share", at_most: 0))"#,
        r#"(name: "planar", graph: "soft_lu_planar", light_samples: 8, needs: "light_is_planar", judge: (by: "rmse_penumbra", at_most: 0))"#,
    ];
    let must_hold = r#"(is: MustHold, why: "a control: neither runs here")"#;
    let (printed, is_accepted) =
        run(folder.path(), &suite(&[CONTACT], &["(change: Still)"], &methods, &[must_hold]), &[])?;
    assert!(is_accepted, "{printed}");
    let records = records(folder.path(), "records.jsonl")?;
    for (method, says) in [("hard_draw", "cpu"), ("planar", "light_is_planar")] {
        let record = of(&records, method)?;
        let Verdict::NotRun { why } = &record.verdict else { return Err(format!("{method} ran").into()) };
        assert!(why.to_lowercase().contains(says) && record.expected == Expected::Open, "{why}");
    }
    // A graph that is wrong is no method that does not apply.
    let wrong = r#"(graph: "hard", set: ["list_build.sise=4"], judge: (by: "wrong_outside_share", at_most: 0))"#;
    let (printed, is_accepted) =
        run(folder.path(), &suite(&[CONTACT], &["(change: Still)"], &[wrong], &[must_hold]), &[])?;
    assert!(!is_accepted && printed.contains("did you mean `size`?"), "{printed}");
    Ok(())
}

fn mistakes() -> Result<(), Failed> {
    let folder = folder()?;
    let text = suite(&[CONTACT], &["(change: Still, scenes: [\"contakt\"])"], &[HARD], &[]);
    let failed = run(folder.path(), &text, &[]).err().and_then(|failed| failed.message().map(str::to_string));
    let failed = failed.ok_or("it ran")?;
    assert!(failed.contains("suite.ron:1:") && failed.contains("did you mean contact?"), "{failed}");
    assert!(!folder.path().join("out").exists());
    let text = suite(&[CONTACT], &["(change: Still)"], &[HARD], &[]);
    let failed =
        run(folder.path(), &text, &["--method", "hart"]).err().and_then(|failed| failed.message().map(str::to_string));
    assert_eq!(
        failed.as_deref(),
        Some("command line: --method names nothing in the suite; found hart (did you mean hard?)")
    );
    Ok(())
}
