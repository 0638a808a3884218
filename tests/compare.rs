//! What `compare` promises: planted faults are found and named, differences by design are no faults, a slower node is called slower
//! and a graph is not called different from itself.

use crate::bench::{compare_args, job_lit, render_args, verify_args};
use crate::{gpu, planted};
use libtest_mimic::{Failed, Trial};
use serde_json::Value;
use shadowgraph::args::BackendChoice;
use shadowgraph::engine::Machine;
use shadowgraph::stretch::How;
use shadowgraph::{commands, graph_choice};
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::Problem;
use shadowgraph_graph::Keep;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("compare/one_wrong_bit_in_a_million_is_found_and_named", one_wrong_bit),
        Trial::test("compare/verify_names_what_made_a_wrong_bit", verify_names),
        gpu::trial("compare/bisection_names_the_node_with_one_wrong_bit".into(), |_| bisection()),
        Trial::test("compare/what_differs_between_graphs_is_told_exactly", differences),
        Trial::test("compare/a_node_that_only_one_graph_has_is_not_blamed_on_its_reader", only_in_one),
        Trial::test("compare/other_parameters_are_named_and_no_fault", parameters),
        Trial::test("compare/another_superset_is_allowed_and_approximations_are_told", contracts),
        Trial::test("compare/other_light_samples_are_told_and_judged_by_a_truth_of_their_own", light_samples),
        Trial::test("compare/light_samples_that_turn_from_pixel_to_pixel_are_compared", jitter),
        gpu::trial("compare/nodes_on_a_device_are_compared_and_timed".into(), |_| on_device()),
        gpu::trial("compare/transfers_between_backends_count_in_frames".into(), |_| transfers()),
        Trial::test("compare/errors_are_traced_to_the_node_that_makes_them", attribution),
        Trial::test("compare/graphs_without_answers_are_compared_and_not_judged", without_answers),
        Trial::test("compare/pictures_are_written_and_named", pictures),
        Trial::test("compare/flags_that_do_not_fit_are_problems", wrong_flags),
        Trial::test("compare/a_node_a_tenth_slower_is_called_slower", slower),
        Trial::test("compare/a_graph_is_not_called_different_from_itself", itself),
        Trial::test("compare/too_few_blocks_give_no_verdict_and_say_so", too_few),
        Trial::test("compare/time_to_spend_bounds_all_that_is_spent", budget),
    ]
}

const SMALL: &[&str] = &["--size", "32x24", "--no-timing", "--backend", "cpu"];

fn run(words: &[&str]) -> Result<(String, bool), Failed> {
    commands::compare::text(&planted::catalogue(), &compare_args(words)).map_err(|problems| problems.to_string().into())
}

/// A comparison at a small size: its text, and whether all is as allowed.
fn text(words: &[&str]) -> Result<(String, bool), Failed> {
    run(&[words, SMALL].concat())
}

fn json(words: &[&str]) -> Result<(Value, bool), Failed> {
    let (text, is_allowed) = run(&[words, &["--json"]].concat())?;
    Ok((serde_json::from_str(&text).map_err(|error| error.to_string())?, is_allowed))
}

fn small_json(words: &[&str]) -> Result<(Value, bool), Failed> {
    json(&[words, SMALL].concat())
}

fn has(text: &str, parts: &[&str]) -> Result<(), Failed> {
    match parts.iter().find(|part| !text.contains(**part)) {
        None => Ok(()),
        Some(part) => Err(format!("no `{part}` in\n{text}").into()),
    }
}

/// What a comparison said of a port.
fn port<'v>(report: &'v Value, node: &str, port: &str) -> Result<&'v Value, Failed> {
    let rows = report["ports"].as_array().ok_or("no ports")?;
    let row = rows.iter().find(|row| row["node"] == node && row["port"] == port);
    Ok(row.ok_or_else(|| format!("nothing is said of {node}.{port}"))?)
}

/// A picture with a million view-samples and more, one bit each.
const MILLION: &[&str] = &["--size", "1280x1280", "--backend", "cpu"];

fn one_wrong_bit() -> Result<(), Failed> {
    let words = ["truth_hard", "--swap", "visibility=one_wrong_bit", "--no-timing"];
    let (report, is_allowed) = json(&[&words[..], MILLION].concat())?;
    assert!(!is_allowed, "a wrong bit passes for right");
    assert_eq!(report["first_difference"], "visibility");
    let row = &port(&report, "visibility", "mask")?["comparison"];
    assert_eq!((&row["is"], &row["count"]), (&"differs".into(), &1.into()));
    assert!(row["of"].as_u64() >= Some(1_000_000), "{row}");
    let [a, b] = [0, 1].map(|side| report["errors"][side]["wrong_bit_share"].as_f64());
    assert_eq!(a, Some(0.0));
    let judged = report["errors"][1]["rows_count"].as_u64().ok_or("no count")? as f64;
    assert!(b.is_some_and(|share| (share * judged - 1.0).abs() < 1e-6), "{b:?} of {judged}");

    // One in a million is within what `planes` promises on a GPU: it is named all the same.
    let words = ["hard", "--swap", "visibility=one_wrong_bit", "--no-truth", "--no-timing"];
    let (told, is_allowed) = run(&[&words[..], MILLION].concat())?;
    assert!(is_allowed, "{told}");
    has(&told, &["first node that differs: visibility", "1 of 16", "bits differ, a share within 1.0e-5"])?;

    // On a small picture it is not.
    let (told, is_allowed) = text(&["hard", "--swap", "visibility=one_wrong_bit"])?;
    assert!(!is_allowed);
    has(&told, &["NOT AS ITS CONTRACT ALLOWS: visibility.mask: 1 of 768 bits; first at row "])
}

fn verify_names() -> Result<(), Failed> {
    let verify = |words: &[&str]| {
        commands::verify::text(&planted::catalogue(), &verify_args(words)).map_err(|problems| problems.to_string())
    };
    let words = ["hard", "--swap", "visibility=one_wrong_bit", "-q"];
    let (told, is_right) = verify(&[&words[..], MILLION].concat())?;
    assert!(!is_right, "{told}");
    let judged = "bits are wrong in visibility.mask, made by visibility/one_wrong_bit";
    has(&told, &[judged, ": 1 of 10", "WRONG", "at pixel "])?;
    let (told, is_right) = verify(&[&["hard", "-q"][..], &MILLION[2..], &["--size", "64x64"]].concat())?;
    assert!(is_right && !told.contains("bits are wrong"), "{told}");
    Ok(())
}

/// The CPU function is wrong, the recipe is true.
fn bisection() -> Result<(), Failed> {
    let words = ["hard", "--swap-a", "visibility=one_wrong_bit", "--bisect"];
    let (found, agree) = json(&[&words[..], MILLION].concat())?;
    assert!(!agree);
    assert_eq!((&found["node"], &found["output"]), (&"visibility".into(), &"visibility.mask".into()));
    let steps = found["steps"].as_array().ok_or("no steps")?;
    assert!(steps.len() > 2 && steps[0]["comparison"]["count"] == 1, "{found}");
    let by_itself = found["ports"].as_array().ok_or("no ports")?;
    let is_mask = |row: &&Value| row[0] == "visibility.mask";
    let mask = by_itself.iter().find(is_mask).ok_or("the mask was not compared by itself")?;
    assert!(mask[1].to_string().contains('1') && mask[1]["is"] == "differs", "{mask}");
    let (told, _) = run(&[&words[..], &["--size", "64x48", "--backend", "cpu"]].concat())?;
    has(&told, &["the answer begins to differ with node: visibility", "visibility.mask: 1 of 3072 bits"])?;

    let (told, agree) = run(&["hard", "--bisect", "--size", "64x48", "--backend", "cpu"])?;
    assert!(agree, "{told}");
    has(&told, &["the backends agree", "view-samples: the CPU's"])
}

fn differences() -> Result<(), Failed> {
    let what =
        |words: &[&str]| Ok::<_, Failed>(small_json(&[words, &["--no-truth"]].concat())?.0["differences"].clone());
    let of = |text: &str| serde_json::from_str::<Value>(text).map_err(|error| Failed::from(error.to_string()));
    assert_eq!(
        what(&["hard", "--swap", "sample_filter=all"])?,
        of(r#"[{"what": "pass", "node": "sample_filter", "a": "light_facing", "b": "all"}]"#)?
    );
    assert_eq!(
        what(&["hard", "--set-a", "shade.c=2", "--set", "shade.c=3"])?,
        of(r#"[{"what": "param", "node": "shade", "param": "c", "a": "2", "b": "3"}]"#)?
    );
    let fused = what(&["hard", "hard_fused"])?;
    let only_in_a = fused.as_array().ok_or("no list")?.iter().filter(|difference| difference["what"] == "only_in_a");
    let only_in_a: Vec<_> = only_in_a.map(|difference| difference["node"].as_str().unwrap_or_default()).collect();
    assert_eq!(only_in_a, ["conservative_raster", "caster_scan", "caster_fill"]);
    // Flags of A count for B where both are one graph, and not where B is another.
    assert_eq!(what(&["hard", "--set-a", "list_build.size=64"])?, of("[]")?);
    assert_eq!(
        what(&["hard", "hard", "--set-a", "list_build.size=64"])?,
        of(r#"[{"what": "param", "node": "list_build", "param": "size", "a": "64", "b": "512"}]"#)?
    );
    // Wiring: a graph file that feeds a port from elsewhere.
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let path = folder.path().join("serial.ron");
    let graph = r#"(version: 1, base: "hard", add: [(id: "other_scan", stage: "scan", pass: "serial",
        in: {"length": "list_build.list_length"})], replace: [(id: "list_fill", in: {"list_offset": "other_scan.offset"})])"#;
    std::fs::write(&path, graph).map_err(|error| error.to_string())?;
    let (told, is_allowed) = text(&["hard", &path.display().to_string()])?;
    assert!(is_allowed, "{told}");
    has(&told, &["list_fill.list_offset reads list_scan.offset -> other_scan.offset"])?;
    has(&told, &["other_scan (scan/serial): only in B", "no node differs"])?;
    // What is the same is not run twice.
    let (report, _) = small_json(&["hard", "--swap", "visibility=fused"])?;
    let shared: Vec<_> = report["shared"].as_array().ok_or("no list")?.iter().filter_map(Value::as_str).collect();
    let upstream = ["view_samples", "sample_filter", "light_frame", "list_build", "list_scan", "list_fill", "casters"];
    assert_eq!(shared, [&upstream[..], &["bent_light"]].concat());
    Ok(())
}

fn only_in_one() -> Result<(), Failed> {
    let (told, is_allowed) = text(&["pcss", "hard"])?;
    assert!(is_allowed, "shade is blamed for what it reads:\n{told}");
    has(&told, &["combine (combine/popcount): only in B", "light_depth (light_depth/first_surface): only in A"])?;
    has(&told, &["shade.visible reads shadow_lookup.visible -> combine.visible"])?;
    has(&told, &["no node makes other values of the same inputs; the first that are not the same: shade.image"])?;
    // Found wrong by the truth all the same.
    let (report, _) = small_json(&["pcss", "hard"])?;
    let rmse = |side: usize| report["errors"][side]["rmse_all"].as_f64().unwrap_or(f64::NAN);
    assert!(rmse(0) > 0.01 && rmse(1) == 0.0, "{} and {}", rmse(0), rmse(1));
    assert!(report["errors"][0]["wrong_bit_share"].is_null(), "pcss has no bit of its own for each light sample");
    Ok(())
}

fn parameters() -> Result<(), Failed> {
    let (told, is_allowed) = text(&["hard", "--set", "list_build.size=64"])?;
    assert!(is_allowed, "another size of the tables passes for a fault:\n{told}");
    has(&told, &["list_build.size: 512 -> 64", "first node that differs: list_build", "by its parameters: "])?;
    let (report, _) = small_json(&["hard", "--set", "list_build.size=64"])?;
    assert_eq!(port(&report, "visibility", "mask")?["comparison"]["is"], "equal");
    // A parameter is no excuse for a mask.
    let words = ["hard", "--set", "list_build.size=64", "--swap", "visibility=one_wrong_bit"];
    let (report, is_allowed) = small_json(&words)?;
    assert!(!is_allowed, "other tables excuse a wrong bit: {report}");
    assert_eq!(port(&report, "visibility", "mask")?["comparison"]["count"], 1);
    assert!(report["errors"][1]["wrong_bit_share"].as_f64() > Some(0.0));
    Ok(())
}

fn contracts() -> Result<(), Failed> {
    let (report, is_allowed) = small_json(&["hard", "--swap", "conservative_raster=influence"])?;
    assert!(is_allowed, "{report}");
    let pairs = &port(&report, "conservative_raster", "pair_caster")?["comparison"];
    assert_eq!(pairs["is"], "allowed", "{pairs}");
    assert!(pairs["why"].as_str().is_some_and(|why| why.starts_with("another superset: ")), "{pairs}");
    assert_eq!(port(&report, "visibility", "mask")?["comparison"]["is"], "equal");
    assert_eq!(report["first_difference"], Value::Null);
    for (node, of) in [("caster_scan", "offset"), ("caster_fill", "caster_entries")] {
        assert_eq!(port(&report, node, of)?["comparison"]["is"], "allowed", "{node} is blamed for another superset");
    }
    // The mask made from it is judged all the same.
    let both = ["hard", "--swap", "conservative_raster=influence", "--swap", "visibility=one_wrong_bit"];
    let (report, is_allowed) = small_json(&both)?;
    assert!(!is_allowed && report["first_difference"] == "visibility", "{report}");
    // So is the table: with itself, as it cannot be with the other's.
    let both = ["hard", "--swap", "conservative_raster=influence", "--swap", "caster_fill=one_lost"];
    let (report, is_allowed) = small_json(&both)?;
    assert!(!is_allowed && report["first_difference"] == "caster_fill", "{report}");
    let coarse = ["soft_lu", "--swap", "visibility=multi_shadow_map", "--light-samples", "32", "--light-radius", "0.4"];
    let (report, is_allowed) = small_json(&coarse)?;
    assert!(is_allowed);
    let mask = &port(&report, "visibility", "mask")?["comparison"];
    assert_eq!((&mask["is"], &report["first_difference"]), (&"approximation".into(), &"visibility".into()), "{mask}");
    Ok(())
}

fn light_samples() -> Result<(), Failed> {
    let scene = ["--light-radius", "0.4"];
    let (told, is_allowed) = text(&[&["hard", "soft_shafts"], &scene[..]].concat())?;
    assert!(is_allowed, "{told}");
    has(&told, &["1 light samples for A and 256 for B: bits cannot be compared between them"])?;
    let (report, _) = small_json(&[&["hard", "soft_shafts"], &scene[..]].concat())?;
    // Each is right about the light samples that it asked.
    for side in 0..2 {
        assert_eq!(report["errors"][side]["wrong_bit_share"], 0.0);
    }
    // And one truth says how far one light sample is from many.
    let rmse = |report: &Value, side: usize| report["errors"][side]["rmse_all"].as_f64().unwrap_or(f64::NAN);
    assert!(rmse(&report, 0) > 0.01 && rmse(&report, 1) < 1e-6, "{} and {}", rmse(&report, 0), rmse(&report, 1));
    assert_eq!(report["truth_light_samples"], 256);
    has(&told, &["visible fractions and pictures of both against 256 light samples"])?;
    let (report, _) = small_json(&[&["soft_shafts", "hard", "--attribute"], &scene[..]].concat())?;
    let blame = &report["blames"][0];
    assert_eq!((&blame["node"], &blame["removed_share"]), (&"light samples".into(), &1.0.into()), "{report}");
    Ok(())
}

fn jitter() -> Result<(), Failed> {
    let light = ["--light-radius", "0.4", "--light-samples", "40", "--jitter", "turn", "--jitter-side", "2"];
    let (report, is_allowed) = small_json(&[&["soft", "soft_shafts"], &light[..]].concat())?;
    assert!(is_allowed);
    assert_eq!(port(&report, "visibility", "mask")?["comparison"]["is"], "equal");
    assert_eq!(report["errors"][1]["wrong_bit_share"], 0.0);
    let (report, is_allowed) = small_json(&[&["soft_shafts", "--swap", "visibility=all_lit"], &light[..]].concat())?;
    assert!(!is_allowed, "a graph that sees no shadow passes");
    assert_eq!(report["first_difference"], "visibility");
    Ok(())
}

fn on_device() -> Result<(), Failed> {
    let size = ["--size", "48x32", "--no-truth"];
    let words = ["hard", "--swap", "visibility=fused", "--backend", "wgpu", "--blocks", "2"];
    let (told, is_allowed) = run(&[&words[..], &size].concat())?;
    assert!(is_allowed, "{told}");
    has(
        &told,
        &["conservative_raster (conservative_raster/binning): only in A", "no node differs", "in frames of their own"],
    )?;
    let (report, is_allowed) =
        json(&[&["hard", "--on", "visibility=wgpu", "--backend", "cpu", "--blocks", "2"], &size[..]].concat())?;
    assert!(is_allowed && report["differences"][0]["what"] == "backend", "{report}");
    assert_eq!(port(&report, "visibility", "mask")?["comparison"]["is"], "equal");
    assert_eq!(report["timing"]["nodes"].as_array().map(Vec::len), Some(14));
    Ok(())
}

/// A frame on both backends takes longer than its stretches by what goes up and down; one on a single backend does not.
fn transfers() -> Result<(), Failed> {
    let text = |problem: Problem| Failed::from(problem.to_string());
    let (catalogue, job) = (planted::catalogue(), job_lit("builtin:columns", "48x40", &[]));
    for (on, is_mixed) in [(&[][..], false), (&["--on", "visibility=wgpu"], true)] {
        let args = render_args(&[&["hard"], on].concat()).graph;
        let plan = graph_choice::plan(&args, &catalogue, Some(&job.facts), Backend::Cpu, Keep::OutputsOnly)
            .map_err(|problems| problems.to_string())?;
        let mut machine = Machine::new(BackendChoice::Cpu).map_err(text)?;
        machine.ready_for(&plan).map_err(text)?;
        let how = How { is_warmed_up: true, ..How::once(&machine, &job, &|_, _, _| {}) };
        let (frame, _) = machine.frame(&plan, &[], &how).map_err(text)?;
        let nodes: f64 = frame.nodes.iter().flatten().filter_map(|ran| ran.millis).sum();
        let between = frame.between_millis;
        assert_eq!(between > 0.0, is_mixed, "{between} ms between stretches");
        assert!(frame.millis >= nodes + between, "{} ms of {nodes} and {between}", frame.millis);
    }
    Ok(())
}

fn attribution() -> Result<(), Failed> {
    let light = ["--light-radius", "0.4", "--light-samples", "40", "--attribute"];
    let blames = |swap: &str| {
        let (report, _) = small_json(&[&["soft_shafts", "--swap", swap], &light[..]].concat())?;
        let share = |node: &str| {
            let rows = report["blames"].as_array()?;
            rows.iter().find(|row| row["node"] == node)?["removed_share"].as_f64()
        };
        let first = report["blames"][0]["node"].clone();
        Ok::<_, Failed>((first, ["visibility", "combine", "casters"].map(share)))
    };
    let (first, [visibility, combine, casters]) = blames("visibility=all_lit")?;
    assert_eq!((first, visibility, casters), ("visibility".into(), Some(1.0), Some(0.0)));
    // The mask stays wrong when only what is counted of it is made right.
    assert_eq!(combine, Some(0.0));
    let (first, [visibility, combine, casters]) = blames("combine=threshold")?;
    assert_eq!((first, visibility, combine, casters), ("combine".into(), Some(0.0), Some(1.0), Some(0.0)));
    let (told, _) = text(&[&["soft_shafts", "--swap", "visibility=all_lit"], &light[..]].concat())?;
    has(&told, &["node of B made right", "100.0 %", "no answer comes from them: view_samples, "])?;
    let (report, _) = small_json(&[&["soft_shafts", "--swap", "sample_filter=all"], &light[..]].concat())?;
    let named = |list: &str, node: &str| report[list].to_string().contains(&format!("\"{node}\""));
    assert!(named("blames", "sample_filter") && named("not_attributed", "shade"), "{report}");
    let (told, _) = text(&[&["soft_shafts"], &light[..]].concat())?;
    has(&told, &["no error"])
}

/// A graph of view-samples alone makes nothing that could be right or wrong.
fn without_answers() -> Result<(), Failed> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let path = folder.path().join("seen.ron");
    let graph = r#"(version: 1, nodes: [(id: "view_samples", pass: "raster"), (id: "sample_filter", pass: "light_facing")],
        outputs: {"state": "sample_filter.sample_state"})"#;
    std::fs::write(&path, graph).map_err(|error| error.to_string())?;
    let path = path.display().to_string();
    let (told, is_allowed) = text(&[&path, "--swap", "sample_filter=all", "--no-truth"])?;
    assert!(!is_allowed, "{told}");
    has(&told, &["first node that differs: sample_filter"])?;
    let refused = text(&[&path]).err().and_then(|failed| failed.message().map(String::from)).unwrap_or_default();
    has(&refused, &["the graph makes no mask, so its answers cannot be judged", "--no-truth"])
}

fn pictures() -> Result<(), Failed> {
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let out = folder.path().join("new").display().to_string();
    let (told, _) = text(&["shadow_map", "hard", "--out", &out])?;
    for name in ["difference.png", "error-a.png", "error-b.png"] {
        has(&told, &[name])?;
        assert!(folder.path().join("new").join(name).exists(), "{name}");
    }
    let bytes = |name: &str| std::fs::read(folder.path().join("new").join(name)).map_err(|error| error.to_string());
    assert_ne!(bytes("error-a.png")?, bytes("error-b.png")?, "a shadow map and the truth have one error picture");
    let (told, _) = text(&["hard", "--out", &out, "--no-truth"])?;
    has(&told, &["no pictures: nothing was judged (--no-truth)"])
}

fn wrong_flags() -> Result<(), Failed> {
    let refused = |words: &[&str], says: &str| match text(words) {
        Ok(_) => Err(Failed::from(format!("{words:?} is accepted"))),
        Err(failed) => has(failed.message().unwrap_or_default(), &[says]),
    };
    refused(&["hrad"], "did you mean hard?")?;
    refused(&["hard", "hrad"], "did you mean hard?")?;
    refused(&["hard", "--swap", "visibilty=fused"], "visibility")?;
    refused(&["hard", "--set", "list_build.sise=3"], "size")?;
    refused(&["hard", "--on", "visibility=gpu"], "cpu or wgpu")?;
    refused(&["hard", "--truth", "truth"], "no built-in graph has this name")
}

/// A node that takes a tenth longer, in a scene where it takes the most. Pairs cancel what slows the machine as a whole; what slows it
/// in bursts may leave the matter undecided, and then it is looked at again.
fn slower() -> Result<(), Failed> {
    let words = ["hard", "--swap-a", "visibility=same_again", "--swap", "visibility=tenth_slower", "--no-truth"];
    let scene = ["--scene", "builtin:random-triangles?count=3000", "--size", "96x96", "--backend", "cpu"];
    let mut last = String::new();
    for seed in ["1", "2", "3", "4"] {
        let (report, _) = json(&[&words[..], &scene, &["--seconds", "20", "--seed", seed]].concat())?;
        let nodes = report["timing"]["nodes"].as_array().ok_or("no nodes")?;
        let node = nodes.iter().find(|node| node["node"] == "visibility").ok_or("no visibility")?;
        let summary = &node["summary"];
        last = format!("{summary}\nwhole frame: {}", report["timing"]["frame"]);
        println!("{last}");
        match summary["verdict"].as_str() {
            Some("slower") => {
                let ratio = summary["ratio"].as_f64().unwrap_or_default();
                assert!((1.05..1.2).contains(&ratio), "slower, but by {ratio}");
                return Ok(());
            }
            Some("undecided") => continue,
            other => return Err(format!("{other:?}: {last}").into()),
        }
    }
    Err(format!("not called slower: {last}").into())
}

fn itself() -> Result<(), Failed> {
    for seed in ["1", "2", "3"] {
        // Tables much larger than the picture: which memory a side finds free would show.
        let words =
            ["hard_fused", "--no-truth", "--size", "48x36", "--backend", "cpu", "--seconds", "8", "--seed", seed];
        let (report, is_allowed) = json(&words)?;
        assert!(is_allowed && report["differences"] == serde_json::json!([]), "{report}");
        let frame = &report["timing"]["frame"];
        assert_eq!(frame["verdict"], "undecided", "{frame}");
        assert!(frame["blocks_count"].as_u64() >= Some(15), "too few blocks for any verdict: {frame}");
        assert!(frame["interval"]["low"].as_f64() <= Some(1.05) && frame["interval"]["high"].as_f64() >= Some(0.95));
    }
    Ok(())
}

fn too_few() -> Result<(), Failed> {
    let words = ["hard", "--no-truth", "--size", "16x16", "--backend", "cpu", "--blocks", "3"];
    let (told, _) = run(&words)?;
    has(&told, &["3 blocks of four timings", "3 blocks are too few for a verdict, which takes 15"])
}

/// Short frames are timed several at once, after one that is not timed: all of them count.
fn budget() -> Result<(), Failed> {
    let seconds = 0.1;
    let small = ["hard_fused", "--scene", "builtin:one-triangle", "--size", "16x16", "--set-a", "list_build.size=16"];
    let (report, _) = json(&[&small[..], &["--no-truth", "--backend", "cpu", "--seconds", "0.1"]].concat())?;
    let timing = &report["timing"];
    assert_eq!(timing["stop"], "budget", "{timing}");
    let number = |value: &Value| value.as_f64().ok_or_else(|| Failed::from("no number"));
    let frame = &timing["frame"];
    let fastest = number(&frame["a_millis"]["median"])?.min(number(&frame["b_millis"]["median"])?);
    assert!(number(&timing["frames_count"])? > 1.0, "no short frames: {timing}");
    let frames = number(&frame["blocks_count"])? * 4.0 * (number(&timing["frames_count"])? + 1.0);
    let spent = frames * fastest * 1e-3;
    if spent < seconds * 1.3 { Ok(()) } else { Err(format!("{spent} s of {seconds} s: {timing}").into()) }
}
