//! Small suites and the folders they run in, for tests of charts.

use crate::bench::chart_args;
use crate::planted;
use libtest_mimic::Failed;
use shadowgraph::commands;
use shadowgraph_charts::model::Point;
use std::collections::BTreeMap;

/// Seconds in all; every kind of method.
pub const TINY: &str = r#"(
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
/// Its variants on both scenes.
pub const VARIANTS: usize = 10;
/// Its rounds.
pub const ROUNDS_OF_EACH: usize = 3;

/// A folder with a suite in it.
pub struct Place(pub tempfile::TempDir);

impl Place {
    /// With the text of a suite.
    pub fn new(suite: &str) -> Result<Self, Failed> {
        let place = Self(tempfile::tempdir().map_err(|error| error.to_string())?);
        place.write("suite.ron", suite.as_bytes())?;
        Ok(place)
    }

    /// Of a file or folder in it.
    pub fn path(&self, name: &str) -> String {
        self.0.path().join(name).display().to_string()
    }

    /// Writes a file.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Failed> {
        std::fs::write(self.0.path().join(name), bytes).map_err(|error| error.to_string().into())
    }

    /// Reads a file.
    pub fn read(&self, name: &str) -> Result<String, Failed> {
        std::fs::read_to_string(self.0.path().join(name)).map_err(|error| format!("{name}: {error}").into())
    }

    /// Runs the suite into a folder; what it prints.
    pub fn chart(&self, out: &str, words: &[&str]) -> Result<String, Failed> {
        let (suite, out) = (self.path("suite.ron"), self.path(out));
        let args = chart_args(&[&[suite.as_str(), "--out", &out], words].concat());
        commands::chart::text(&planted::catalogue(), &args).map_err(|problems| problems.to_string().into())
    }

    /// The same; its points.
    pub fn points(&self, out: &str, words: &[&str]) -> Result<Vec<Point>, Failed> {
        let text = self.chart(out, &[&["--json"], words].concat())?;
        serde_json::from_str(&text).map_err(|error| error.to_string().into())
    }

    /// How often each id stands in a file of records.
    pub fn ids_in(&self, file: &str) -> Result<BTreeMap<String, usize>, Failed> {
        let mut ids = BTreeMap::new();
        for line in self.read(file)?.lines() {
            let record: serde_json::Value = serde_json::from_str(line).map_err(|error| format!("{error}: {line}"))?;
            *ids.entry(record["id"].as_str().unwrap_or_default().to_string()).or_insert(0) += 1;
        }
        Ok(ids)
    }
}

/// A suite of two rounds.
pub fn suite_of(scenes: &str, methods: &str) -> String {
    format!(
        "(version: 1, name: \"x\", size: \"24x24\", backends: [cpu], reference: 16, rounds: 2, scenes: [{scenes}], methods: [{methods}])"
    )
}

/// A scene with penumbrae.
pub const COLUMNS: &str = r#"(name: "columns", scene: "builtin:columns", options: ["--light-radius", "0.4"])"#;

/// Their ids, sorted.
pub fn sorted(points: &[Point]) -> Vec<&str> {
    let mut ids: Vec<&str> = points.iter().map(|point| point.id.as_str()).collect();
    ids.sort_unstable();
    ids
}
