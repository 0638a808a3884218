//! Runs of a suite: nothing lost or doubled whatever interrupts them, parts that make the whole, one run a folder.

use crate::bench::{merge_args, suggest_args};
use crate::chart_place::{COLUMNS, Place, ROUNDS_OF_EACH, TINY, VARIANTS, sorted, suite_of};
use crate::planted;
use crate::program::{program_path, stderr};
use libtest_mimic::{Failed, Trial};
use shadowgraph::chart::store::{ANSWERS, Lock, ROUNDS};
use shadowgraph::commands;
use shadowgraph_charts::model::Point;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("chart_runs/a_run_killed_again_and_again_ends_with_the_whole", killed),
        Trial::test("chart_runs/a_last_line_cut_short_is_told_and_measured_again", cut_short),
        Trial::test("chart_runs/a_finished_run_measures_nothing", finished),
        Trial::test("chart_runs/parts_make_the_whole", parts),
        Trial::test("chart_runs/two_runs_in_one_folder_are_refused", locked),
        Trial::test("chart_runs/a_folder_that_is_looked_at_is_not_touched", untouched),
    ]
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
    // Each scene's times are taken together.
    assert!(one.iter().all(|point| point.scene == "columns") && two.iter().all(|point| point.scene == "one"));
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
    // More parts than scenes share each scene out, and the page says so.
    let thirds = ["1/3", "2/3", "3/3"].map(|part| place.points(&part.replace('/', "of"), &["--shard", part]));
    let thirds = thirds.into_iter().collect::<Result<Vec<_>, Failed>>()?;
    let all: Vec<Point> = thirds.into_iter().flatten().collect();
    assert_eq!(sorted(&all), sorted(&whole));
    let names = ["1of3", "2of3", "3of3"].map(|name| place.path(name));
    // Into the first of them, which is there already and loses nothing.
    let pictures = |folder: &str| -> Result<u64, Failed> {
        let entries = std::fs::read_dir(place.path(folder)).map_err(|error| error.to_string())?;
        Ok(entries.flatten().filter_map(|entry| entry.metadata().ok()).map(|file| file.len()).min().unwrap_or(0))
    };
    let told = commands::chart::merge_text(&merge_args(&[&names[0], &names[1], &names[2], "--out", &names[0]]))
        .map_err(|problems| problems.to_string())?;
    assert!(told.contains("1of3: 0 answers, 0 timed rounds"), "{told}");
    assert!(pictures("1of3/pictures")? > 0, "a picture was emptied");
    assert_eq!(sorted(&place.points("1of3", &["--page-only"])?), sorted(&whole));
    let says = "Not all times were taken together";
    assert!(place.read("1of3/chart.html")?.contains(says) && !place.read("merged/chart.html")?.contains(says));
    // Twice is once, and a folder without records is a problem.
    let again = commands::chart::merge_text(&merge_args(&[&from_one, "--out", &out])).map_err(|p| p.to_string())?;
    assert!(again.contains("one: 0 answers, 0 timed rounds"), "{again}");
    let empty = place.path("nothing");
    let refused = commands::chart::merge_text(&merge_args(&[&empty, "--out", &out])).err().map(|p| p.to_string());
    assert!(refused.is_some_and(|text| text.starts_with("this folder holds no records of a chart run")));
    assert!(!Path::new(&empty).exists(), "merge made the folder that it did not find");
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
    let args = suggest_args(&words);
    commands::suggest::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string())?;
    assert_eq!(place.read("part/rounds.jsonl")?, before);
    Ok(())
}
