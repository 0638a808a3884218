//! Arrows between crates run one way.

use super::files::sources;
use crate::root;

/// Folder -> crates of ours it may name in its manifest.
const MAY: &[(&str, &[&str])] = &[
    ("core", &[]),
    ("graph", &["shadowgraph-core"]),
    ("passes", &["shadowgraph-core"]),
    ("backends/cpu", &["shadowgraph-core"]),
    ("backends/wgpu", &["shadowgraph-core"]),
    ("examples/scenes", &["shadowgraph-core"]),
    ("examples/charts", &["shadowgraph-core"]),
    ("examples/measure", &["shadowgraph-core"]),
];

/// Folder -> foreign crates it must not name.
const NEVER: &[(&str, &[&str])] = &[
    ("core", &["wgpu", "naga", "ron", "rayon", "gltf"]),
    ("graph", &["wgpu", "naga", "rayon", "gltf"]),
    ("passes", &["wgpu", "naga", "ron", "gltf"]),
    ("backends/cpu", &["wgpu", "naga", "ron", "gltf"]),
    ("backends/wgpu", &["ron", "gltf", "rayon"]),
    ("examples/scenes", &["wgpu", "naga", "ron"]),
    ("examples/charts", &["wgpu", "naga", "ron", "gltf", "rayon"]),
    ("examples/measure", &["wgpu", "naga", "ron", "gltf"]),
];

pub fn crates_use_only_what_they_may() -> Vec<String> {
    MAY.iter()
        .flat_map(|(folder, may)| {
            let path = root().join(folder).join("Cargo.toml");
            let manifest = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            let never = NEVER.iter().find(|(name, _)| name == folder).map_or(&[] as &[&str], |(_, never)| never);
            manifest_faults(folder, &manifest, may, never)
        })
        .collect()
}

/// Dependencies proper, not those of tests: a test may wire what the crate may not.
fn manifest_faults(folder: &str, manifest: &str, may: &[&str], never: &[&str]) -> Vec<String> {
    let dependencies = manifest.split("[dependencies]").nth(1).unwrap_or_default();
    let dependencies = dependencies.split("\n[").next().unwrap_or_default();
    let names =
        dependencies.lines().filter_map(|line| line.split(['.', ' ', '=']).next()).filter(|name| !name.is_empty());
    names
        .filter(|name| (name.starts_with("shadowgraph") && !may.contains(name)) || never.contains(name))
        .map(|name| format!("{folder} may not use {name}"))
        .collect()
}

pub fn no_pass_imports_another() -> Vec<String> {
    let catalogue = shadowgraph_passes::catalogue();
    let stages: Vec<&str> = catalogue.stages().iter().map(|stage| stage.name).collect();
    let mut faults = Vec::new();
    for (path, text) in sources(&["rs"]) {
        let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        let [passes, stage, ..] = parts.as_slice() else { continue };
        if passes == "passes" && (stages.contains(&stage.as_str()) || stage == "shared") {
            faults.extend(
                foreign_stages(stage, &text, &stages)
                    .into_iter()
                    .map(|other| format!("{} uses {other}", path.display())),
            );
        }
    }
    faults
}

/// Stages other than `stage` that the text reaches into by path.
fn foreign_stages(stage: &str, text: &str, stages: &[&str]) -> Vec<String> {
    let others = stages.iter().filter(|other| **other != stage);
    others.filter(|other| text.contains(&format!("crate::{other}::"))).map(|other| (*other).to_string()).collect()
}

pub fn the_rule_can_fail() -> Vec<String> {
    let manifest = "[package]\n[dependencies]\nshadowgraph-passes.workspace = true\nwgpu = \"30\"\n[dev-dependencies]\nron = \"1\"\n";
    let faults = manifest_faults("graph", manifest, &["shadowgraph-core"], &["wgpu", "ron"]);
    assert_eq!(faults, ["graph may not use shadowgraph-passes", "graph may not use wgpu"]);
    assert_eq!(foreign_stages("scan", "use crate::casters::all;", &["scan", "casters"]), ["casters"]);
    Vec::new()
}
