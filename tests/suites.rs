//! Suite files: every mistake at once with its place and remedy, variants told apart, and each variant also a graph file.

use crate::bench::{chart_args, job};
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::GraphChoice;
use shadowgraph::chart::suite::Suite;
use shadowgraph::chart::variant::Variant;
use shadowgraph::graph_choice;
use shadowgraph::stability::records::Shard;
use shadowgraph::suggest::graph_text;
use shadowgraph_core::plan::Backend;
use shadowgraph_graph::{Keep, Source, plan_id};
use std::path::Path;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("suites/every_mistake_is_told_with_its_place", mistakes),
        Trial::test("suites/what_cannot_be_read_is_a_problem", unreadable),
        Trial::test("suites/axes_make_every_combination", combinations),
        Trial::test("suites/variants_that_differ_have_labels_that_do", labels),
        Trial::test("suites/scene_files_are_looked_up_in_a_folder", folder),
        Trial::test("suites/every_variant_is_a_graph_file_with_the_same_plan", graph_files),
        Trial::test("suites/shards_are_parts_of_a_whole", shards),
    ]
}

fn read(text: &str) -> Result<Suite, String> {
    Suite::read(Source { name: "a.ron".into(), text: text.into() }, None).map_err(|problems| problems.to_string())
}

fn told(text: &str) -> Result<String, Failed> {
    read(text).map(|_| ()).err().ok_or_else(|| format!("this is accepted:\n{text}").into())
}

const WRONG: &str = r#"(
    version: 2,
    name: 3,
    size: "24",
    backend: [cpu],
    reference: 5000,
    rounds: 0,
    scenes: [
        (name: "one", scene: "builtin:columns", options: ["--light-radus", "0.4"]),
        (name: "two", scene: "builtin:columns", options: ["--light-samples", "4"]),
        (name: "two", scene: "builtin:columns"),
        (scene: "builtin:one-triangle"),
        (name: "four", scene: "builtin:columns", view: 3),
    ],
    methods: [
        (graph: "soft_shafts", light_samples: [4, 0], quality: "light_sample"),
        (graph: "shadow_map", axes: {"light_depth.size": [], "light_samples": [3], "x.y": [(a: 1)]}, only: ["twoo", "zebra"]),
        (graph: "hard", set: ["visibility"], backends: [gpu], when: "light_is_plane"),
        (graph: "hard", light_samples: []),
        (light_samples: 3),
    ],
)"#;

const WRONG_TOLD: &str = r#"a.ron:2:14: `version` is not allowed; expected a whole number in 1..=1; found 2
a.ron:3:11: `name` is of the wrong type; expected text in quotes; found 3
a.ron:4:11: `size` is not a picture size; expected WIDTHxHEIGHT, each 1..=16384; found 24
a.ron:5:5: a suite has no field `backend` (did you mean `backends`?)
a.ron:6:16: light samples above 4096 come in sets of 4096; expected a multiple of 4096; found 5000
a.ron:7:13: `rounds` is not allowed; expected a whole number in 1..=1000; found 0
a.ron:9:9: options of this scene are not understood; expected flags as `shadowgraph render` takes them for scene and light; found unexpected argument '--light-radus' found
a.ron:10:9: light samples are a method's, not a scene's; found --light-samples 4 (give them as light_samples of methods)
a.ron:11:9: scene "two" is named twice (give each scene and view a name of its own)
a.ron:12:9: a scene has no name; expected name: ..
a.ron:13:56: `view` is of the wrong type; expected text in quotes; found 3
a.ron:16:51: `light_samples` is not allowed; expected a whole number in 1..=4096; found 0
a.ron:16:64: the quality is no axis of the method; expected light_samples; found light_sample (did you mean light_samples?)
a.ron:17:58: axis `light_depth.size` has no values; expected one or more
a.ron:17:62: light samples are an axis of their own (give them as light_samples: [..] of the method)
a.ron:17:92: `x.y` is of the wrong type; expected a number, a word, or text in quotes; found a struct (name: ..)
a.ron:17:109: no scene of the suite has this name; found twoo (did you mean two?)
a.ron:17:117: no scene of the suite has this name; found zebra (scenes are two, four)
a.ron:18:31: this sets nothing; expected NODE=PASS or NODE.PARAM=VALUE; found visibility
a.ron:18:57: `backends` is of the wrong type; expected cpu or wgpu; found gpu
a.ron:18:69: there is no such fact; found light_is_plane (did you mean light_is_planar?)
a.ron:19:40: axis `light_samples` has no values; expected one or more
a.ron:20:9: a method has no graph; expected graph: .."#;

fn mistakes() -> Result<(), Failed> {
    let told = told(WRONG)?;
    if told == WRONG_TOLD { Ok(()) } else { Err(format!("told is\n{told}").into()) }
}

fn unreadable() -> Result<(), Failed> {
    let methods = |text: &str| format!("(version: 1, name: \"x\", scenes: [], methods: [{text}])");
    assert_eq!(told(&methods(""))?, "a.ron:1:46: a suite needs methods; expected (graph: ..)");
    let ten = "[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]";
    let many = format!("(graph: \"hard\", axes: {{\"a.b\": {ten}, \"c.d\": {ten}, \"e.f\": {ten}, \"g.h\": [1, 2]}})");
    assert_eq!(told(&methods(&many))?, "a.ron:1:47: axes make too many variants; expected at most 1000; found 2000");
    assert!(told("(version: 1")?.starts_with("a.ron:1:"));
    let problem = |name: &str| Suite::load(name, None).map(|_| ()).err().map(|problems| problems.to_string());
    let unknown = problem("chart_smal").unwrap_or_default();
    assert_eq!(unknown, "no built-in suite has this name; found chart_smal (did you mean chart_small?)");
    assert!(problem("no_such_suite.ron").is_some_and(|text| text.starts_with("no_such_suite.ron: ")));
    for name in ["chart", "chart_small", "suggest"] {
        assert_eq!(problem(name), None);
    }
    Ok(())
}

fn variants(methods: &str) -> Result<Vec<Variant>, Failed> {
    let text = format!(
        "(version: 1, name: \"x\", scenes: [(name: \"one\", scene: \"builtin:columns\")], methods: [{methods}])"
    );
    Ok(read(&text)?.variants)
}

fn combinations() -> Result<(), Failed> {
    let all = variants(
        r#"(graph: "soft_lu", light_samples: [8, 16], set: ["casters=light_back_facing"],
            axes: {"lu_table.size": [32, "64"], "visibility": [lu, lu_certain]}, only: ["one"], unless: "light_is_point")"#,
    )?;
    let labels: Vec<String> = all.iter().map(Variant::label).collect();
    let expected = [
        "soft_lu, casters=light_back_facing, 8 samples, size=32, visibility=lu",
        "soft_lu, casters=light_back_facing, 8 samples, size=32, visibility=lu_certain",
        "soft_lu, casters=light_back_facing, 8 samples, size=64, visibility=lu",
        "soft_lu, casters=light_back_facing, 8 samples, size=64, visibility=lu_certain",
        "soft_lu, casters=light_back_facing, 16 samples, size=32, visibility=lu",
        "soft_lu, casters=light_back_facing, 16 samples, size=32, visibility=lu_certain",
        "soft_lu, casters=light_back_facing, 16 samples, size=64, visibility=lu",
        "soft_lu, casters=light_back_facing, 16 samples, size=64, visibility=lu_certain",
    ];
    assert_eq!(labels, expected);
    let last = all.last().ok_or("no variant")?;
    assert_eq!(last.choice.swap, ["casters=light_back_facing", "visibility=lu_certain"]);
    assert_eq!((last.choice.set.as_slice(), last.light_samples), (&["lu_table.size=64".to_string()][..], 16));
    assert_eq!((last.only.as_slice(), last.unless.as_deref()), (&["one".to_string()][..], Some("light_is_point")));
    Ok(())
}

fn labels() -> Result<(), Failed> {
    // Two parameters called size, and two files of one name.
    let all = variants(
        r#"(graph: "hard", axes: {"list_build.size": [64, 128]}), (graph: "hard", axes: {"light_depth.size": [64, 256]}),
           (graph: "a/mine.ron"), (graph: "b/mine.ron"), (graph: "hard"), (graph: "hard", only: ["one"])"#,
    )?;
    let labels: Vec<String> = all.iter().map(Variant::label).collect();
    let expected = [
        "hard, list_build.size=64",
        "hard, size=128",
        "hard, light_depth.size=64",
        "hard, size=256",
        "a/mine.ron",
        "b/mine.ron",
        "hard",
        "hard",
    ];
    assert_eq!(labels, expected);
    Ok(())
}

fn folder() -> Result<(), Failed> {
    let text = r#"(version: 1, name: "x", scenes: [
        (name: "file", scene: "a.glb", views: "views.json", view: "left"), (name: "own", scene: "builtin:columns"),
        (name: "far", scene: "/elsewhere/a.glb")], methods: [(graph: "hard")])"#;
    let suite = Suite::read(Source { name: "a.ron".into(), text: text.into() }, Some(Path::new("scenes")))
        .map_err(|problems| problems.to_string())?;
    let scenes: Vec<&str> = suite.scenes.iter().map(|scene| scene.choice.scene.as_str()).collect();
    assert_eq!(scenes, ["scenes/a.glb", "builtin:columns", "/elsewhere/a.glb"]);
    let first = &suite.scenes[0].choice;
    assert_eq!(first.views.as_deref(), Some(Path::new("scenes/views.json")));
    assert_eq!((first.view.as_deref(), first.size.as_str()), (Some("left"), "256x256"));
    Ok(())
}

/// What `suggest` prints of a variant plans to the variant's plan, on a scene with the light outside and with it inside.
fn graph_files() -> Result<(), Failed> {
    let catalogue = shadowgraph_passes::catalogue();
    let folder = tempfile::tempdir().map_err(|error| error.to_string())?;
    let path = folder.path().join("variant.ron");
    let facts = [job("builtin:columns", "8x8").facts, job("builtin:light-inside", "8x8").facts];
    assert_ne!(facts[0].light_inside_scene, facts[1].light_inside_scene, "both lights are on one side");
    let mut count = 0;
    for name in ["chart", "chart_small", "suggest"] {
        let suite = Suite::load(name, None).map_err(|problems| problems.to_string())?;
        for variant in &suite.variants {
            std::fs::write(&path, graph_text(&variant.choice, variant.light_samples as usize))
                .map_err(|error| error.to_string())?;
            let file = GraphChoice { graph: path.display().to_string(), ..GraphChoice::default() };
            let on = if variant.backends == ["wgpu"] { Backend::Wgpu } else { Backend::Cpu };
            for facts in &facts {
                let id = |choice: &GraphChoice| {
                    graph_choice::plan(choice, &catalogue, Some(facts), on, Keep::OutputsOnly)
                        .map(|plan| plan_id(&plan))
                        .map_err(|problems| format!("{}: {problems}", variant.label()))
                };
                assert_eq!(id(&file)?, id(&variant.choice)?, "{}", variant.label());
            }
            let samples = graph_choice::light_samples(&file).map_err(|problems| problems.to_string())?;
            assert_eq!(samples, Some(variant.light_samples), "{}", variant.label());
            count += 1;
        }
    }
    assert!(count > 30, "only {count} variants");
    Ok(())
}

fn shards() -> Result<(), Failed> {
    let of = |part: &str| chart_args(&["chart_small", "--out", "x", "--shard", part]).shard;
    assert_eq!(of("2/4"), Shard { index: 2, count: 4 });
    for wrong in ["0/4", "5/4", "1", "a/b", "1/2/3", "1/0", "", "1/x/2", "a/1/2", "1/2/"] {
        let problem = wrong.parse::<Shard>().err().unwrap_or_default();
        assert!(problem.starts_with("expected I/N with I in 1..=N"), "{wrong}: {problem}");
    }
    Ok(())
}
