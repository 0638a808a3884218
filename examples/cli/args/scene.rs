//! Scene, camera and light, as every command that runs takes them.

use crate::jitter::Jitter;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

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
    /// A scene at a size with its own view, and with the same kind of light samples as `light`: nothing else is overridden.
    pub fn plain(scene: &str, size: &str, light: &LightChoice) -> Self {
        let light = LightChoice {
            generator: light.generator,
            light_seed: light.light_seed,
            jitter_side: light.jitter_side,
            ..LightChoice::default()
        };
        let (scene, size) = (scene.to_string(), size.to_string());
        Self { scene, views: None, view: None, eye: None, target: None, fov: None, light, size, view_samples: None }
    }

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
