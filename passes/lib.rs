//! Every stage of the shadow papers as a swappable pass. This file is the catalogue; the code is in the stages' folders.
//!
//! A stage is a folder with its signature in `mod.rs`; a pass is a folder inside it. Values that travel between stages are
//! the constants of [`ports`]; code and WGSL that several passes need is in [`shared`]. No pass imports another's folder.

pub mod ports;
pub mod shared;

pub mod adjacency;
pub mod bent_light;
pub mod bvh_build;
pub mod caster_fill;
pub mod casters;
pub mod combine;
pub mod conservative_raster;
pub mod light_depth;
pub mod light_frame;
pub mod list_build;
pub mod list_fill;
pub mod lu_table;
pub mod penumbra;
pub mod present;
pub mod sample_filter;
pub mod scan;
pub mod shade;
pub mod shadow_lookup;
pub mod view_samples;
pub mod visibility;

use shadowgraph_core::pass::{Catalogue, Pass};

/// All passes of this crate, stage by stage in the order of a frame.
pub fn catalogue() -> Catalogue {
    let stages: [&[&'static Pass]; 20] = [
        view_samples::PASSES,
        sample_filter::PASSES,
        light_frame::PASSES,
        list_build::PASSES,
        scan::PASSES,
        list_fill::PASSES,
        casters::PASSES,
        conservative_raster::PASSES,
        caster_fill::PASSES,
        adjacency::PASSES,
        penumbra::PASSES,
        lu_table::PASSES,
        bvh_build::PASSES,
        visibility::PASSES,
        light_depth::PASSES,
        shadow_lookup::PASSES,
        combine::PASSES,
        bent_light::PASSES,
        shade::PASSES,
        present::PASSES,
    ];
    Catalogue::new(stages.into_iter().flatten().copied())
}

/// A number of the sources of `pass` in sixteen hexadecimal digits: its folder with its WGSL, what lies beside it in its stage's
/// folder, [`ports`] and [`shared`], tests left out. Other crates are not in it. None for a pass that is not of this crate.
pub fn source_id(pass: &Pass) -> Option<&'static str> {
    let sources: &[(&str, &str, &'static str)] = include!(concat!(env!("OUT_DIR"), "/sources.rs"));
    sources.iter().find(|(stage, name, _)| (*stage, *name) == (pass.stage.name, pass.name)).map(|(_, _, id)| *id)
}

#[cfg(test)]
#[allow(dead_code, reason = "a build script has a main function")]
#[path = "build.rs"]
mod build;

#[cfg(test)]
mod tests {
    use super::build;

    /// Files that change the number of a pass, and those that do not.
    #[test]
    fn a_source_is_all_that_the_pass_calls_in_this_crate() {
        let root = std::path::Path::new(env!("OUT_DIR")).join("sources_of_a_test");
        let write = |file: &str, text: &str| {
            let path = root.join(file);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        };
        let files = ["ports.rs", "shared/walk.rs", "scan/mod.rs", "scan/fold.wgsl", "scan/sums/cpu.rs"];
        let beside = ["lib.rs", "scan/tests.rs", "scan/sums/tests.rs", "shade/lambert/cpu.rs"];
        for file in files.iter().chain(&beside) {
            write(file, "before");
        }
        let id = || build::sources(&root).lines().find(|line| line.contains("sums")).map(String::from).unwrap();
        let before = id();
        for (file, changes) in files.map(|file| (file, true)).into_iter().chain(beside.map(|file| (file, false))) {
            write(file, "after");
            assert_eq!(id() != before, changes, "{file}");
            write(file, "before");
        }
    }

    #[test]
    fn every_pass_has_a_source_of_its_own() {
        let mut ids: Vec<_> = super::catalogue().passes().map(super::source_id).collect();
        assert!(ids.iter().all(Option::is_some), "a pass is not the folder of its name: {ids:?}");
        let count = ids.len();
        ids.sort();
        ids.dedup();
        assert_eq!(ids.len(), count);
    }
}
