//! Rules about files.

use crate::root;
use std::path::{Path, PathBuf};

/// Source files of the workspace by path relative to the root.
pub fn sources(extensions: &[&str]) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let mut folders = vec![root()];
    while let Some(folder) = folders.pop() {
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()) {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                if !name.starts_with('.') && !["target", "out"].contains(&name.as_str()) {
                    folders.push(path);
                }
            } else if path.extension().is_some_and(|end| extensions.iter().any(|want| end == *want)) {
                let text = std::fs::read_to_string(&path).unwrap_or_default();
                found.push((path.strip_prefix(root()).unwrap_or(&path).to_path_buf(), text));
            }
        }
    }
    found.sort();
    assert!(!found.is_empty(), "no sources found under {}", root().display());
    found
}

pub fn none_past_600_lines() -> Vec<String> {
    let long = |(path, text): (PathBuf, String)| {
        let lines = text.lines().count();
        (lines > 600).then(|| format!("{}: {lines} lines", path.display()))
    };
    sources(&["rs", "wgsl", "c"]).into_iter().filter_map(long).collect()
}

pub fn no_drawers() -> Vec<String> {
    let is_drawer = |part: &str| {
        let stem = part.split('.').next().unwrap_or_default();
        ["util", "utils", "common", "misc", "helper", "helpers"].contains(&stem)
    };
    sources(&["rs", "wgsl"])
        .into_iter()
        .filter(|(path, _)| path.iter().any(|part| is_drawer(&part.to_string_lossy())))
        .map(|(path, _)| format!("{} is a drawer", path.display()))
        .collect()
}

pub fn every_shader_is_used() -> Vec<String> {
    let code: String = sources(&["rs"]).into_iter().map(|(_, text)| text).collect();
    let unused = |path: &Path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        !code.contains(&format!("{name}\")"))
    };
    sources(&["wgsl"])
        .into_iter()
        .filter(|(path, _)| unused(path))
        .map(|(path, _)| format!("{} is included nowhere", path.display()))
        .collect()
}

/// `passes/<stage>/<pass>/mod.rs` on disk and the catalogue name the same passes.
pub fn every_pass_folder_is_in_the_catalogue() -> Vec<String> {
    let mut folders = Vec::new();
    for (path, _) in sources(&["rs"]) {
        let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        if let [passes, stage, pass, file] = parts.as_slice()
            && (passes.as_str(), file.as_str()) == ("passes", "mod.rs")
            && stage != "shared"
        {
            folders.push(format!("{stage}/{pass}"));
        }
    }
    let catalogue = shadowgraph_passes::catalogue();
    let named: Vec<_> = catalogue.passes().map(|pass| format!("{}/{}", pass.stage.name, pass.name)).collect();
    let orphans =
        folders.iter().filter(|folder| !named.contains(folder)).map(|f| format!("{f} is not in the catalogue"));
    let ghosts = named.iter().filter(|name| !folders.contains(name)).map(|n| format!("{n} has no folder of its name"));
    orphans.chain(ghosts).collect()
}

pub fn no_paths_of_a_machine() -> Vec<String> {
    let marks = ["/home/", "/root/", "/Users/", concat!("/wo", "rk/")];
    sources(&["rs", "wgsl", "md", "toml", "ron", "c", "sh"])
        .into_iter()
        .filter(|(path, _)| path != Path::new("tests/tidy/files.rs"))
        .filter(|(_, text)| marks.iter().any(|mark| text.contains(mark)))
        .map(|(path, _)| format!("{} names a path of a machine", path.display()))
        .collect()
}
