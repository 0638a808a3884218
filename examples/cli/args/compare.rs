//! `compare`.

use super::{BackendChoice, GraphChoice, SceneChoice};
use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  shadowgraph compare hard hard_fused --scene builtin:columns
  shadowgraph compare hard --swap visibility=fused              # B is A with another pass
  shadowgraph compare soft_lu --set lu_table.size=64 --attribute
  shadowgraph compare shadow_map --swap-a shadow_lookup=pcf --set light_depth.size=4096
  shadowgraph compare hard --bisect                             # which node makes the CPU and wgpu differ?

Exit status 1: a value differs other than its contract allows.";

/// `compare`.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct CompareArgs {
    /// Graph A: a file or a built-in name
    pub a: String,
    /// Graph B; without it B is A but for the flags below
    pub b: Option<String>,
    /// In B, use another pass for a node
    #[arg(long, value_name = "NODE=PASS")]
    pub swap: Vec<String>,
    /// In B, set a parameter of a node
    #[arg(long, value_name = "NODE.PARAM=VALUE")]
    pub set: Vec<String>,
    /// In B, pin a node to a backend
    #[arg(long, value_name = "NODE=cpu|wgpu")]
    pub on: Vec<String>,
    /// In A, use another pass for a node
    #[arg(long, value_name = "NODE=PASS")]
    pub swap_a: Vec<String>,
    /// In A, set a parameter of a node
    #[arg(long, value_name = "NODE.PARAM=VALUE")]
    pub set_a: Vec<String>,
    /// In A, pin a node to a backend
    #[arg(long, value_name = "NODE=cpu|wgpu")]
    pub on_a: Vec<String>,
    #[command(flatten)]
    #[allow(missing_docs)]
    pub scene: SceneChoice,
    /// Where nodes run that are not pinned
    #[arg(long, value_enum, default_value = "auto")]
    pub backend: BackendChoice,
    /// CPU threads; 0 for all
    #[arg(long, default_value_t = 0)]
    pub threads: usize,
    /// Largest difference of time that does not count, as a share
    #[arg(long, help_heading = "Timing", default_value_t = 0.02, value_name = "SHARE")]
    pub threshold: f64,
    /// Most time to spend on timing, seconds
    #[arg(long, help_heading = "Timing", default_value_t = 60.0, value_name = "SECONDS")]
    pub seconds: f64,
    /// Most blocks of four timings
    #[arg(long, help_heading = "Timing", default_value_t = 400, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub blocks: u32,
    /// What the order of timings starts from
    #[arg(long, help_heading = "Timing", default_value_t = 1, value_name = "SEED")]
    pub seed: u64,
    /// Compare answers only
    #[arg(long, help_heading = "Timing")]
    pub no_timing: bool,
    /// The graph that is right; without it truth_hard for one light sample, else truth_soft. Visible fractions of both are judged with
    /// the larger number of light samples of the two, bits with each one's own
    #[arg(long, help_heading = "Errors", value_name = "GRAPH")]
    pub truth: Option<String>,
    /// Judge neither A nor B against a truth
    #[arg(long, help_heading = "Errors", conflicts_with = "attribute")]
    pub no_truth: bool,
    /// In B, replace the output of one node at a time by the truth's, and report how much of the error goes away;
    /// view-samples, bent_light and shade are named as not attributed
    #[arg(long, help_heading = "Errors")]
    pub attribute: bool,
    /// Run A's nodes on the CPU and on wgpu by turns until the node is found that makes them differ; nothing else is compared.
    /// A's flags are --swap-a and --set-a
    #[arg(long, conflicts_with_all = ["b", "swap", "set", "on", "attribute", "out"])]
    pub bisect: bool,
    /// Write pictures as DIR/difference.png, DIR/error-a.png and DIR/error-b.png: visible fractions, at one fixed scale
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// As JSON on stdout instead of tables
    #[arg(long)]
    pub json: bool,
    /// No progress bars
    #[arg(long, short)]
    pub quiet: bool,
}

impl CompareArgs {
    /// Graph A with its flags.
    pub fn choice_a(&self) -> GraphChoice {
        let (swap, set, on) = (self.swap_a.clone(), self.set_a.clone(), self.on_a.clone());
        GraphChoice { graph: self.a.clone(), swap, set, on, no_alias: false }
    }

    /// Graph B with its flags; those of A count for it too where it is the same graph.
    pub fn choice_b(&self) -> GraphChoice {
        let mut choice = match &self.b {
            Some(graph) => GraphChoice { graph: graph.clone(), ..GraphChoice::default() },
            None => self.choice_a(),
        };
        lay_over(&mut choice.swap, &self.swap, '=');
        lay_over(&mut choice.set, &self.set, '=');
        lay_over(&mut choice.on, &self.on, '=');
        choice
    }
}

/// A later flag takes the place of an earlier one about the same thing.
fn lay_over(flags: &mut Vec<String>, later: &[String], at: char) {
    let about = |flag: &String| flag.split(at).next().map(str::to_string);
    flags.retain(|flag| !later.iter().any(|other| about(other) == about(flag)));
    flags.extend(later.iter().cloned());
}
