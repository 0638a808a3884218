//! The records behind every chart: one [`Point`] for each variant on one scene and view, one [`Stability`] for each method
//! along one sequence. Runners fill them in, one JSON object a line ([`crate::lines`]); unknown keys are ignored, so that
//! older pages read newer files.
//!
//! A share is a number from 0 to 1. `None` (JSON `null` or an absent key) means not measured, never zero. No number here may
//! be NaN or infinite: [`crate::check`] refuses it.

use serde::{Deserialize, Serialize};

/// One variant on one scene and view: what it cost and how wrong it was, or why there is no such figure.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// 16 hexadecimal digits, equal whenever the same variant of the same suite meets the same scene, view, size, light
    /// samples and backend. Of two records with one id the later counts.
    pub id: String,
    /// Name of the suite.
    pub suite: String,
    /// Scene as the suite names it.
    pub scene: String,
    /// View of the scene.
    pub view: String,
    /// Graph, which is what charts call a method: `soft_shafts`, `shadow_map`.
    pub graph: String,
    /// What this variant sets, `(axis, value)` in the suite's order: `("light_depth.size", "2048")`, `("visibility", "fused")`.
    #[serde(default)]
    pub choices: Vec<(String, String)>,
    /// The axis of `choices` that is the method's quality: its points are joined by a line in ascending order of the value.
    #[serde(default)]
    pub quality_axis: Option<String>,
    /// Short name for legends and tables, unlike that of any other variant of this graph.
    pub label: String,
    /// `cpu` or `wgpu`.
    pub backend: String,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
    /// Light samples; 1 for hard shadows.
    pub light_samples: usize,
    /// The whole frame with node timers off, milliseconds. `None` only beside a `failure`.
    #[serde(default)]
    pub millis: Option<Interval>,
    /// Timed runs behind `millis`.
    #[serde(default)]
    pub runs_count: u32,
    /// Cost by node in order of execution, timers on: they need not sum to `millis`.
    #[serde(default)]
    pub nodes: Vec<NodeCost>,
    /// How wrong it was.
    #[serde(default)]
    pub errors: Errors,
    /// Nodes that did not run because the scene does not need them: `(node, reason)`.
    #[serde(default)]
    pub left_out: Vec<(String, String)>,
    /// PNG files.
    #[serde(default)]
    pub pictures: Pictures,
    /// Text of the problem that kept the variant from running or from being measured. Such a point is listed, not drawn.
    #[serde(default)]
    pub failure: Option<String>,
    /// The part of the scene's variants that was timed together, `2/4`; empty where all of them were.
    #[serde(default)]
    pub part: String,
    /// On what, from what, when.
    #[serde(default)]
    pub provenance: Provenance,
}

/// A figure with the range it may lie in: `low <= median <= high`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The figure.
    pub median: f64,
    /// Lower end of the interval that the runner states (a confidence interval of the median).
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

/// What one node took.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct NodeCost {
    /// Id in the graph.
    pub node: String,
    /// Stage: what bars are coloured by.
    pub stage: String,
    /// Pass.
    pub pass: String,
    /// Median time in the frame, milliseconds.
    pub millis: f64,
    /// Size of its outputs.
    #[serde(default)]
    pub bytes: u64,
    /// Counters of its kernels by name: pairs tested, longest list.
    #[serde(default)]
    pub counts: Vec<(String, u64)>,
}

/// Distance from the truth over the view-samples that see the light's side. Errors of grey are differences of the visible
/// fraction, test minus truth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Errors {
    /// Mask bits that differ, over all bits compared. `None` when the method answers with a fraction and has no mask.
    pub wrong_bit_share: Option<f64>,
    /// Share of the light that the truth blocks and the method lets through: bits over all bits compared. Without a mask, the
    /// mean of the positive part of test minus truth, which is a lower bound of the same quantity.
    pub light_leak_share: Option<f64>,
    /// Share of the light that the method blocks and the truth lets through; likewise.
    pub shadow_leak_share: Option<f64>,
    /// Root mean square over view-samples in true penumbra. `None` when the scene has none, or the light is one sample.
    pub rmse_penumbra: Option<f64>,
    /// Root mean square over all view-samples compared.
    pub rmse_all: Option<f64>,
    /// 99th percentile of the absolute difference, over all view-samples compared.
    pub p99: Option<f64>,
    /// Largest absolute difference.
    pub max: Option<f64>,
    /// Mean difference, -1 to 1; above zero is too light.
    pub mean_signed: Option<f64>,
    /// Mean FLIP of the tone-mapped picture, 0 to 1.
    pub flip_tonemapped: Option<f64>,
    /// Mean HDR-FLIP of the linear picture, 0 to 1.
    pub flip_linear: Option<f64>,
    /// Width of penumbrae (10 to 90 per cent of the ramp) over that of the truth; 1 is right, above 1 too soft.
    pub penumbra_width_ratio: Option<f64>,
    /// View-samples in true penumbra: what `rmse_penumbra` rests on.
    pub penumbra_rows_count: Option<u64>,
    /// View-samples compared.
    pub rows_count: Option<u64>,
}

/// PNG files, by names relative to the folder of the records. Error maps have the one fixed scale that the page states.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Pictures {
    /// The shaded picture of the method.
    pub picture: Option<String>,
    /// That of the truth on the same view-samples.
    pub truth: Option<String>,
    /// The difference of visible fractions.
    pub error: Option<String>,
    /// A penumbra enlarged: the method.
    pub closeup_picture: Option<String>,
    /// The same place: the truth.
    pub closeup_truth: Option<String>,
    /// The same place: the difference.
    pub closeup_error: Option<String>,
}

/// Where a record comes from. Text that is empty was not known, which pages say.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Stable number of the resolved graph: nodes, passes, parameters, shader sources.
    pub graph_hash: String,
    /// Stable number of the scene's stored geometry, view and light samples.
    pub scene_hash: String,
    /// Version of the program.
    pub program_version: String,
    /// Commit it was built from, with `+` behind it when the tree had changes.
    pub commit: String,
    /// Adapter; empty on the CPU.
    pub adapter: String,
    /// Driver and its version; empty on the CPU.
    pub driver: String,
    /// `DiscreteGpu`, `Cpu` (a software rasteriser), ...; empty on the CPU backend.
    pub adapter_type: String,
    /// CPU threads.
    pub threads: usize,
    /// Version of wgpu.
    pub wgpu_version: String,
    /// Start of the measurement, ISO 8601.
    pub started: String,
}

/// One method along one sequence on one scene: where it holds and where it breaks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stability {
    /// 16 hexadecimal digits, as in [`Point::id`].
    pub id: String,
    /// Name of the suite.
    pub suite: String,
    /// Graph.
    pub graph: String,
    /// What the variant sets, as in [`Point::choices`].
    #[serde(default)]
    pub choices: Vec<(String, String)>,
    /// Short name of the method for tables: the graph, or graph and choices.
    pub label: String,
    /// `cpu` or `wgpu`.
    pub backend: String,
    /// Failure scene.
    pub scene: String,
    /// View of the scene.
    #[serde(default)]
    pub view: String,
    /// What changes from frame to frame.
    pub sequence: Sequence,
    /// Name of the parameter that changes: `light angle`, `world scale`.
    pub parameter: String,
    /// Its unit; empty for a plain number.
    #[serde(default)]
    pub unit: String,
    /// Frames in order. Empty when nothing ran.
    #[serde(default)]
    pub frames: Vec<StabilityFrame>,
    /// Error from frame to frame. `None` where frames are not steps of one motion.
    #[serde(default)]
    pub temporal: Option<Temporal>,
    /// Where it is worst.
    #[serde(default)]
    pub worst: Option<Worst>,
    /// Whether the method holds.
    pub verdict: Verdict,
    /// Name of the figure it was judged by, in words of this module: `wrong_bit_share`, `t_rmse`.
    #[serde(default)]
    pub judged_by: String,
    /// That figure.
    #[serde(default)]
    pub figure: Option<f64>,
    /// The figure above which it fails.
    #[serde(default)]
    pub threshold: Option<f64>,
    /// What theory says.
    pub expected: Expected,
    /// Where the statement comes from: paper and section, or the reason in a sentence.
    #[serde(default)]
    pub expected_source: String,
    /// On what, from what, when.
    #[serde(default)]
    pub provenance: Provenance,
}

/// What changes along a sequence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sequence {
    /// Nothing: one frame of a failure scene.
    Still,
    /// The light moves on a circle.
    LightOrbit,
    /// The camera turns by parts of a pixel.
    CameraPan,
    /// The camera closes in on a shadow edge.
    Zoom,
    /// Everything is multiplied, 1e-3 to 1e4.
    WorldScale,
    /// Everything is moved away from the origin.
    FarFromOrigin,
    /// The light grows from a point.
    GrowingLight,
    /// Meshes are divided ever finer, in the same shape.
    Tessellation,
    /// A gap between caster and receiver closes.
    ClosingContact,
    /// Closed meshes lose triangles.
    OpeningMeshes,
}

impl Sequence {
    /// Name in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Still => "still",
            Self::LightOrbit => "light orbit",
            Self::CameraPan => "camera pan",
            Self::Zoom => "zoom",
            Self::WorldScale => "world scale",
            Self::FarFromOrigin => "far from origin",
            Self::GrowingLight => "growing light",
            Self::Tessellation => "tessellation",
            Self::ClosingContact => "closing contact",
            Self::OpeningMeshes => "opening meshes",
        }
    }
}

/// One frame of a sequence.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct StabilityFrame {
    /// The parameter, in the record's unit.
    pub value: f64,
    /// As in [`Errors::wrong_bit_share`].
    pub wrong_bit_share: Option<f64>,
    /// The same without the contact band: view-samples so close to a decisive plane that rounding of their position decides.
    pub wrong_outside_share: Option<f64>,
    /// As in [`Errors::light_leak_share`].
    pub light_leak_share: Option<f64>,
    /// As in [`Errors::shadow_leak_share`].
    pub shadow_leak_share: Option<f64>,
    /// As in [`Errors::rmse_penumbra`].
    pub rmse_penumbra: Option<f64>,
    /// As in [`Errors::rmse_all`].
    pub rmse_all: Option<f64>,
    /// The whole frame, milliseconds.
    pub millis: Option<f64>,
    /// Entries of the longest list of any cell.
    pub longest_list_count: Option<u64>,
}

/// Error from frame to frame over a sequence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Temporal {
    /// Root mean square, over pixels and frame steps, of the step of the visible fraction minus the truth's step.
    pub t_rmse: Option<f64>,
    /// Bits that toggle where the truth's do not, over bits compared in all steps.
    pub toggled_share: Option<f64>,
    /// Number of such bits.
    pub toggled_count: Option<u64>,
}

/// The failing place.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Worst {
    /// Position in `frames`, from 0.
    pub frame: usize,
    /// Pixel, from the top left.
    pub pixel: [usize; 2],
    /// PNG of the surroundings, a name relative to the folder of the records: the method.
    pub picture: Option<String>,
    /// The same place: the truth.
    pub truth: Option<String>,
    /// The same place: the difference.
    pub error: Option<String>,
}

/// Whether a method holds along a sequence.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Verdict {
    /// The figure stays at or below the threshold.
    Holds,
    /// It does not.
    Fails,
    /// There is no figure.
    NotRun {
        /// Why: the problem's text, or what the method cannot do.
        why: String,
    },
}

impl Verdict {
    /// Whether it contradicts what theory says. A method that was not run contradicts nothing.
    pub fn surprises(&self, expected: Expected) -> bool {
        matches!((self, expected), (Self::Fails, Expected::MustHold) | (Self::Holds, Expected::ExpectedToFail))
    }
}

/// What theory says about a method on a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Expected {
    /// Must hold: a failure is our fault.
    MustHold,
    /// Known to fail: a report that does not show it needs an explanation.
    ExpectedToFail,
    /// Nothing is claimed.
    Open,
}

impl Expected {
    /// Name in words.
    pub fn title(self) -> &'static str {
        match self {
            Self::MustHold => "must hold",
            Self::ExpectedToFail => "expected to fail",
            Self::Open => "open",
        }
    }
}
