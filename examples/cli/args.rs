//! The command line, as clap sees it.

use crate::jitter::Jitter;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

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
  shadowgraph check my_graph.ron
  shadowgraph graph hard --svg > hard.svg
  shadowgraph passes visibility";

/// Subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a graph on a scene: a picture, a table of what each node cost, and on request every value that travelled
    Render(RenderArgs),
    /// Run a graph and the exact truth on the same view-samples, and report wrong bits
    Verify(VerifyArgs),
    /// Check graph files: every mistake at once, with its place; needs neither a scene nor a GPU
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

/// What to run and how it differs from the file.
#[derive(Clone, Debug, Args)]
pub struct GraphChoice {
    /// A graph file, or a built-in name (see `shadowgraph graph --list`)
    #[arg(default_value = "hard")]
    pub graph: String,
    /// Use another pass for a node
    #[arg(long, value_name = "NODE=PASS")]
    pub swap: Vec<String>,
    /// Set a parameter of a node
    #[arg(long, value_name = "NODE.PARAM=VALUE")]
    pub set: Vec<String>,
    /// Pin a node to a backend
    #[arg(long, value_name = "NODE=cpu|wgpu")]
    pub on: Vec<String>,
    /// Give every transient memory of its own
    #[arg(long)]
    pub no_alias: bool,
}

/// Scene, camera, light and picture size.
#[derive(Clone, Debug, Args)]
pub struct SceneChoice {
    /// A glTF 2.0 file, or builtin:NAME?param=value (see `shadowgraph scenes`)
    #[arg(long, default_value = "builtin:columns")]
    pub scene: String,
    /// A views file with cameras and lights for scenes by file name
    #[arg(long, value_name = "FILE")]
    pub views: Option<PathBuf>,
    /// The view's name; without it the first one
    #[arg(long, value_name = "NAME")]
    pub view: Option<String>,
    /// Camera position, overriding the view's
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<String>,
    /// Point the camera looks at
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub target: Option<String>,
    /// Full vertical field of view, degrees
    #[arg(long, value_name = "DEGREES")]
    pub fov: Option<f32>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub light: LightChoice,
    /// Picture size, pixels
    #[arg(long, default_value = "512x512", value_name = "WxH")]
    pub size: String,
    /// View-samples from DIR/position.npy, normal.npy, triangle.npy and pixel.npy in place of the camera's
    #[arg(long, value_name = "DIR")]
    pub view_samples: Option<PathBuf>,
}

impl SceneChoice {
    /// The same choice for a graph that is made for so many light samples.
    pub fn for_graph(&self, light_samples: Option<u32>) -> Self {
        let mut choice = self.clone();
        choice.light.light_samples_of_graph = light_samples;
        choice
    }
}

/// The light and its samples. What is not given is the view's.
#[derive(Clone, Debug, Default, Args)]
pub struct LightChoice {
    /// The light's centre; the whole light moves there
    #[arg(long, help_heading = "Light", value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub light: Option<String>,
    /// What shines. A rectangle is the view file's `rect_corners` where it has them
    #[arg(long, help_heading = "Light", value_enum, value_name = "SHAPE")]
    pub light_shape: Option<ShapeChoice>,
    /// Radius of a sphere or disc; of the disc that a rectangle is as large as; of the ball around any other shape. Scene units
    #[arg(long, help_heading = "Light", value_name = "RADIUS")]
    pub light_radius: Option<f32>,
    /// A half axis, from the centre to the edge: twice for a disc or rectangle, three times for an ellipsoid
    #[arg(
        long,
        help_heading = "Light",
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        conflicts_with = "light_radius"
    )]
    pub light_axis: Vec<String>,
    /// Where a disc or rectangle without axes faces; without it towards the camera's target
    #[arg(
        long,
        help_heading = "Light",
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        conflicts_with = "light_axis"
    )]
    pub light_direction: Option<String>,
    /// Separate points as light: .npy, 32-bit floats [N, 3], world space. All of them are samples, in their order
    #[arg(long, help_heading = "Light", value_name = "FILE", conflicts_with = "light_mesh")]
    pub light_points: Option<PathBuf>,
    /// Linear RGB of each of these points: .npy, 32-bit floats [N, 3]
    #[arg(long, help_heading = "Light", value_name = "FILE", requires = "light_points")]
    pub light_point_colors: Option<PathBuf>,
    /// A mesh as light: a glTF 2.0 file or builtin:NAME, world space. Its surface, or with --light-shape volume its inside
    #[arg(long, help_heading = "Light", value_name = "FILE")]
    pub light_mesh: Option<String>,
    /// A PNG on a sphere, disc, rectangle or ellipsoid: what each sample shows
    #[arg(long, help_heading = "Light", value_name = "FILE")]
    pub light_texture: Option<PathBuf>,
    /// Linear RGB of the light
    #[arg(long, help_heading = "Light", value_name = "R,G,B")]
    pub light_color: Option<String>,
    /// Give neighbouring pixels other samples of the same light: the set turned about the light's axis, or sets of other seeds
    #[arg(long, help_heading = "Light", value_enum, default_value = "none")]
    pub jitter: Jitter,
    /// Pixels a side of the pattern in which jitter repeats: 2, 4 or 8. Every pixel of it is a run of its own
    #[arg(long, help_heading = "Light", default_value_t = 4, value_name = "PIXELS")]
    pub jitter_side: u32,
    /// Light samples, 1 to 4096; one is the light's centre. Without it: all of --light-points, else what the graph says, else 1
    #[arg(long, help_heading = "Light", value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub light_samples: Option<u32>,
    /// How light samples are spread
    #[arg(long, help_heading = "Light", value_enum, default_value = "hammersley")]
    pub generator: GeneratorChoice,
    /// Chooses other samples that are as good. 0 leaves hammersley and lattice as they are, else they are shifted cyclically
    #[arg(long, help_heading = "Light", default_value_t = 0, value_name = "SEED")]
    pub light_seed: u32,
    /// How many light samples the graph says that it is made for; [`crate::graph_choice::light_samples`] knows.
    #[arg(skip)]
    pub light_samples_of_graph: Option<u32>,
}

/// Shapes of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ShapeChoice {
    /// No extent
    Point,
    /// A solid ball
    Sphere,
    /// A flat disc, or ellipse
    Disc,
    /// A flat rectangle, or parallelogram
    Rectangle,
    /// A solid ellipsoid
    Ellipsoid,
    /// Separate points: those of --light-points
    Points,
    /// A mesh's surface: that of --light-mesh
    Surface,
    /// A closed mesh's inside: that of --light-mesh
    Volume,
}

/// Sample generators.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum GeneratorChoice {
    /// Low discrepancy, from mirrored digits
    #[default]
    Hammersley,
    /// One at random in each of N equal parts
    Jittered,
    /// Low discrepancy, from multiples of the golden ratio or the plastic number
    Lattice,
    /// Independent random points
    Random,
}

/// Which backend runs nodes that are not pinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum BackendChoice {
    /// A hardware adapter if there is one, else the CPU
    Auto,
    /// CPU functions
    Cpu,
    /// GPU recipes, on any adapter, software ones included
    Wgpu,
}

/// How to run.
#[derive(Clone, Debug, Args)]
pub struct RunChoice {
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Run so many times after one warm-up and report medians
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000))]
    pub repeat: u32,
    /// Ranges of view-samples that run one after another, to bound memory; 0: as few as the device's bindings allow
    #[arg(long, default_value_t = 0, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=100_000))]
    pub ranges: u32,
    /// Print the run's record as JSON on stdout instead of tables
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

/// `render`.
#[derive(Clone, Debug, Args)]
pub struct RenderArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub run: RunChoice,
    /// Mean over so many disjoint sets of light samples, one run each: 16 sets of 4096 make a converged reference
    #[arg(
        long,
        help_heading = "Light",
        value_name = "N",
        conflicts_with = "repeat",
        value_parser = clap::value_parser!(u32).range(2..=4096)
    )]
    pub light_sets: Option<u32>,
    /// Mean over so many frames, each with light samples of its own (seeds from --light-seed on), as a host shows it while nothing moves
    #[arg(
        long,
        help_heading = "Light",
        value_name = "N",
        conflicts_with_all = ["repeat", "light_sets"],
        value_parser = clap::value_parser!(u32).range(1..=10_000)
    )]
    pub frames: Option<u32>,
    /// Write the picture as DIR/image.png and DIR/image.exr
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write the graph's inputs and every live output port as .npy with DIR/index.json
    #[arg(long, value_name = "DIR")]
    pub dump: Option<PathBuf>,
}

/// `verify`.
#[derive(Clone, Debug, Args)]
pub struct VerifyArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub run: RunChoice,
    /// The graph that is right
    #[arg(long, default_value = "truth_hard", value_name = "GRAPH")]
    pub truth: String,
    /// Every view of the views file for this scene, one after another
    #[arg(long)]
    pub all_views: bool,
    /// Largest accepted share of wrong bits outside the contact band; above it the exit status is 1
    #[arg(long, default_value_t = 0.0, value_name = "SHARE")]
    pub accept: f64,
    /// Half width of the contact band, in units of the last place of the coordinates involved
    #[arg(long, default_value_t = 4.0, value_name = "ULPS")]
    pub contact_ulps: f32,
    /// Write a picture of where the wrong bits are as DIR/wrong.png
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

/// `check`.
#[derive(Clone, Debug, Args)]
pub struct CheckArgs {
    /// Graph files or built-in names
    #[arg(required = true)]
    pub graphs: Vec<String>,
    /// Print the problems as JSON
    #[arg(long)]
    pub json: bool,
}

/// `graph`.
#[derive(Clone, Debug, Args)]
pub struct GraphArgs {
    #[command(flatten)]
    #[allow(missing_docs)]
    pub graph: GraphChoice,
    /// Names of the built-in graphs with a line each
    #[arg(long)]
    pub list: bool,
    /// The graph file's own text
    #[arg(long, group = "form")]
    pub source: bool,
    /// Graphviz
    #[arg(long, group = "form")]
    pub dot: bool,
    /// Mermaid
    #[arg(long, group = "form")]
    pub mermaid: bool,
    /// SVG
    #[arg(long, group = "form")]
    pub svg: bool,
    /// Backend of nodes that are not pinned
    #[arg(long, value_enum, default_value = "cpu")]
    pub backend: BackendChoice,
    /// Hold this fact true while `choose` is resolved
    #[arg(long, value_name = "FACT")]
    pub fact: Vec<String>,
}

/// `passes`.
#[derive(Clone, Debug, Args)]
pub struct PassesArgs {
    /// A stage, a pass, or STAGE/PASS
    pub name: Option<String>,
    /// As JSON
    #[arg(long, group = "form")]
    pub json: bool,
    /// As the Markdown of docs/PASSES.md
    #[arg(long, group = "form")]
    pub markdown: bool,
}

/// `scenes`.
#[derive(Clone, Debug, Args)]
pub struct ScenesArgs {
    /// Load this scene and print its facts
    pub scene: Option<String>,
    /// As JSON
    #[arg(long)]
    pub json: bool,
}

/// `export`.
#[derive(Clone, Debug, Args)]
pub struct ExportArgs {
    /// builtin:NAME?param=value, or a glTF file to be flattened
    pub scene: String,
    /// The .glb file to write
    pub file: PathBuf,
}
