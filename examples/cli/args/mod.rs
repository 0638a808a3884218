//! The command line, as clap sees it: one file a command, and one for what several take.

mod chart;
mod check;
mod compare;
mod graph;
mod listings;
mod profile;
mod render;
mod run;
mod scene;
mod stability;
mod suggest;
mod verify;

pub use chart::{ChartArgs, MergeArgs};
pub use check::CheckArgs;
pub use compare::CompareArgs;
pub use graph::{GraphArgs, GraphChoice};
pub use listings::{ExportArgs, PassesArgs, ScenesArgs};
pub use profile::ProfileArgs;
pub use render::RenderArgs;
pub use run::{BackendChoice, MachineChoice, RunChoice};
pub use scene::{GeneratorChoice, LightChoice, SceneChoice, ShapeChoice};
pub use stability::StabilityArgs;
pub use suggest::SuggestArgs;
pub use verify::VerifyArgs;

use clap::{Parser, Subcommand};

/// Render-graph plugins for shadows: how right a shadow is, and what it costs.
#[derive(Debug, Parser)]
#[command(name = "shadowgraph", version, about, after_help = EXAMPLES)]
pub struct Cli {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXAMPLES: &str = "Examples:
  shadowgraph render hard --scene builtin:columns --out out
  shadowgraph render hard --scene scene.glb --views views.json --view overview --swap visibility=fused
  shadowgraph verify hard --scene builtin:contact --backend wgpu
  shadowgraph profile hard --backend wgpu --trace trace.json
  shadowgraph check my_graph.ron
  shadowgraph check --invariance hard --scene builtin:columns
  shadowgraph graph hard --svg > hard.svg
  shadowgraph passes visibility";

/// Subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a graph on a scene: a picture, a table of what each node cost, and on request every value that travelled
    Render(RenderArgs),
    /// Run a graph and the exact truth on the same view-samples, and report wrong bits
    Verify(VerifyArgs),
    /// Compare two graphs, or two variants of one: what differs, which is faster and how certain that is, which is wrong and where
    Compare(CompareArgs),
    /// Run a suite of scenes and variants: milliseconds against error, as one page, charts and tables
    Chart(ChartArgs),
    /// Find the cheapest variant that is right enough on a scene, or the most right one that is fast enough, as a graph file
    Suggest(SuggestArgs),
    /// Make one folder of the parts of a sharded chart run
    Merge(MergeArgs),
    /// Time each node of a graph, within whole frames and alone, with what it counted, its memory, and how far the clocks can be trusted
    Profile(ProfileArgs),
    /// Run methods along sequences over failure scenes, and report where each holds and where it breaks
    Stability(StabilityArgs),
    /// Check graph files: every mistake at once, with its place; needs neither a scene nor a GPU. With --invariance: run them, and require the same values whatever must not matter
    Check(CheckArgs),
    /// Print a graph: its plan, or a drawing
    Graph(GraphArgs),
    /// List stages and their passes, or one of them with ports and parameters
    Passes(PassesArgs),
    /// List built-in scenes with their parameters, or the views of a scene
    Scenes(ScenesArgs),
    /// Write a built-in scene as a glTF binary file
    Export(ExportArgs),
}
