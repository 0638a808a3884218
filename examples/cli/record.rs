//! A run's record: what ran, on what, what it cost, what was left out. Printed as JSON or as tables.

use crate::job::Job;
use crate::outcome::{NodeRecord, Outcome, Spread};
use serde::Serialize;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::plan::Plan;
use shadowgraph_graph::plan_id;

/// Which device and driver.
#[derive(Clone, Debug, Serialize)]
pub struct DeviceRecord {
    /// `cpu` or `wgpu`.
    pub backend: &'static str,
    /// Why this one.
    pub reason: String,
    /// Adapter name; empty on the CPU.
    pub adapter: String,
    /// Driver and its version; empty on the CPU.
    pub driver: String,
    /// Kind of adapter: `DiscreteGpu`, `Cpu` (a software rasteriser), ...
    pub adapter_type: String,
    /// CPU threads.
    pub threads: usize,
}

/// Everything about a run but its values.
#[derive(Clone, Debug, Serialize)]
pub struct RunRecord {
    /// Version of this program.
    pub version: &'static str,
    /// Version of wgpu it was built with.
    pub wgpu_version: &'static str,
    /// Graph name as given.
    pub graph: String,
    /// Stable number of the resolved graph: nodes, passes, parameters.
    pub graph_hash: String,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
    /// Where it ran.
    pub device: DeviceRecord,
    /// The scene.
    pub scene: SceneRecord,
    /// What `choose` could ask.
    pub facts: Facts,
    /// Nodes of the file that did not run, with the reason.
    pub left_out: Vec<(String, String)>,
    /// Remarks on scene, view and light.
    pub notes: Vec<String>,
    /// Nodes.
    pub nodes: Vec<NodeSummary>,
    /// Whole runs, milliseconds.
    pub frame_millis: Spread,
    /// Number of timed runs.
    pub runs_count: u32,
}

/// The scene in a record.
#[derive(Clone, Debug, Serialize)]
pub struct SceneRecord {
    /// As given on the command line.
    pub name: String,
    /// Name of the view.
    pub view: String,
    /// Triangles.
    pub triangles_count: usize,
    /// Connected parts.
    pub parts_count: usize,
    /// Closed parts.
    pub closed_parts_count: usize,
    /// Smallest and largest corner coordinates.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Camera position.
    pub eye: [f32; 3],
    /// Light position: its centre.
    pub light: [f32; 3],
    /// What shines: `point`, `sphere`, `disc`, ...
    pub light_shape: &'static str,
    /// Bound of the light around its position, scene units; 0 for a point.
    pub light_radius: f32,
    /// Linear RGB, the mean of a texture taken in.
    pub light_color: [f32; 3],
    /// Light samples.
    pub light_samples_count: usize,
    /// How they are spread.
    pub light_generator: &'static str,
    /// Which of equally good sets they are.
    pub light_seed: u32,
}

/// A node in a record: its times as a spread.
#[derive(Clone, Debug, Serialize)]
pub struct NodeSummary {
    /// What ran and what it counted.
    #[serde(flatten)]
    pub node: NodeRecord,
    /// Its times.
    pub millis_spread: Spread,
}

impl RunRecord {
    /// Collects the record of a finished run.
    pub fn new(plan: &Plan, job: &Job, device: DeviceRecord, outcome: &Outcome) -> Self {
        let nodes = outcome
            .nodes
            .iter()
            .map(|node| NodeSummary { millis_spread: Spread::of(&node.millis), node: node.clone() });
        Self {
            version: env!("CARGO_PKG_VERSION"),
            wgpu_version: WGPU_VERSION,
            graph: plan.name.clone(),
            graph_hash: plan_id(plan),
            size: job.image,
            device,
            scene: SceneRecord {
                name: job.scene_spec.clone(),
                view: job.camera.name.clone(),
                triangles_count: job.scene.triangle_count(),
                parts_count: job.scene.parts_count,
                closed_parts_count: job.scene.closed_parts_count,
                bounds: job.scene.bounds(),
                eye: job.camera.eye,
                light: job.light.position,
                light_shape: job.light.shape.name(),
                light_radius: job.light.radius,
                light_color: job.light.color,
                light_samples_count: job.light_samples_count(),
                light_generator: job.sampling.generator.name(),
                light_seed: job.sampling.seed,
            },
            facts: job.facts.clone(),
            left_out: plan.left_out.clone(),
            notes: job.notes.clone(),
            nodes: nodes.collect(),
            frame_millis: Spread::of(&outcome.frames_millis),
            runs_count: outcome.runs_count,
        }
    }
}

/// Major version this program is built with.
pub const WGPU_VERSION: &str = "30";
