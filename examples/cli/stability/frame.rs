//! Frames of a sequence: scene, view and view-samples of each, the same for every method.
//!
//! All methods answer for the same stored view-samples. Where the scene and the camera stand still (`LightOrbit`,
//! `GrowingLight`) these are the first frame's. In a `CameraPan` a frame has its own view-samples, which decide where lists and
//! maps lie, and behind them the first frame's, in a second picture below the first: there rows correspond exactly and the truth
//! does not change, so that whatever toggles is the method's. Everywhere else frames are no steps of one motion and each has its
//! own view-samples.

use super::edge;
use super::suite::{SceneEntry, SequenceEntry, Suite};
use crate::answers::{Answers, view_samples};
use crate::args::{GraphChoice, SceneChoice};
use crate::engine::Machine;
use crate::job::Job;
use crate::{graph_choice, light_choice};
use shadowgraph_charts::model::Sequence;
use shadowgraph_core::array::Array;
use shadowgraph_core::input;
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_core::scene::{Camera, Light, Scene};
use shadowgraph_graph::Keep;
use shadowgraph_scenes::soup::Soup;
use shadowgraph_scenes::vary::{Variation, say_closed};
use shadowgraph_scenes::{View, choose_view, load_soup};
use std::f64::consts::TAU;

/// Graph that makes view-samples and says what is right.
const TRUTH_HARD: &str = "truth_hard";
const TRUTH_SOFT: &str = "truth_soft";
/// Where a world that moves away goes: in no plane of its axes.
const AWAY: [f64; 3] = [0.8, 0.36, 0.48];

/// One frame.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Value of what changes.
    pub value: f64,
    scene: Scene,
    view: View,
    choice: SceneChoice,
    /// View-samples that every method gets.
    imports: Vec<(String, Array)>,
    image: [usize; 2],
    /// Rows from here on are the first frame's view-samples, in every frame of the sequence; none where no rows correspond.
    pub steady_from: Option<usize>,
}

impl Frame {
    /// Everything that a graph is run on, with so many light samples.
    ///
    /// # Errors
    /// A light that cannot be sampled so.
    pub fn job(&self, light_samples: u32) -> Result<Job, Problem> {
        let mut job = self.own_job(light_samples)?.importing(self.imports.clone());
        job.image = self.image;
        Ok(job)
    }

    fn own_job(&self, light_samples: u32) -> Result<Job, Problem> {
        let mut choice = self.choice.clone();
        choice.light.light_samples = Some(light_samples);
        Job::with_view(self.scene.clone(), self.view.clone(), &choice)
    }
}

/// What frames need beside the suite: a CPU to make view-samples and truths on.
pub struct Bench<'a> {
    /// All passes.
    pub catalogue: &'a Catalogue,
    /// The CPU backend.
    pub cpu: &'a Machine,
}

impl Bench<'_> {
    /// What is right for the view-samples of `frame`, with so many light samples.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn truth(&self, frame: &Frame, light_samples: u32) -> Result<Answers, Problems> {
        let graph = if light_samples == 1 { TRUTH_HARD } else { TRUTH_SOFT };
        let job = frame.job(light_samples)?;
        let choice = GraphChoice { graph: graph.into(), ..GraphChoice::default() };
        let plan = graph_choice::plan(&choice, self.catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)?;
        let outcome = self.cpu.run(&plan, &job, 1, &|_, _, _| {})?;
        Ok(Answers::of(&plan, &outcome, &job)?)
    }

    fn view_samples(&self, frame: &Frame) -> Result<Vec<(String, Array)>, Problems> {
        let job = frame.own_job(1)?;
        let choice = GraphChoice { graph: TRUTH_HARD.into(), ..GraphChoice::default() };
        let plan = graph_choice::plan(&choice, self.catalogue, Some(&job.facts), Backend::Cpu, Keep::AllLivePorts)?;
        Ok(view_samples(self.cpu, &plan, &job, &|_, _, _| {})?)
    }

    /// All frames of a scene along a sequence.
    ///
    /// # Errors
    /// A scene that cannot be loaded, options that do not fit it, a zoom without a shadow edge to close in on.
    pub fn frames(&self, suite: &Suite, scene: &SceneEntry, sequence: &SequenceEntry) -> Result<Vec<Frame>, Problems> {
        let base = Base::load(suite, scene)?;
        let edge = match sequence.change {
            Sequence::Zoom => Some(self.edge(&base)?),
            _ => None,
        };
        let mut frames: Vec<Frame> = Vec::new();
        let mut steady: Option<Vec<(String, Array)>> = None;
        for value in &sequence.values {
            let mut frame = base.frame(sequence.change, *value, edge)?;
            let is_steady = matches!(sequence.change, Sequence::LightOrbit | Sequence::GrowingLight);
            match (frames.first(), sequence.change) {
                (Some(first), _) if is_steady => frame.imports = first.imports.clone(),
                (_, Sequence::CameraPan) => {
                    let own = self.view_samples(&frame)?;
                    frame.steady_from = Some(own[0].1.dim(0));
                    frame.imports = joined(own.clone(), steady.get_or_insert(own), frame.image);
                    frame.image[1] *= 2;
                }
                _ => frame.imports = self.view_samples(&frame)?,
            }
            if sequence.change == Sequence::LightOrbit {
                frame.steady_from = Some(0);
            }
            frames.push(frame);
        }
        Ok(frames)
    }

    /// The point of a shadow's edge that is seen nearest to the middle of the picture.
    fn edge(&self, base: &Base) -> Result<[f32; 3], Problems> {
        let mut frame = base.frame(Sequence::Still, 0.0, None)?;
        frame.imports = self.view_samples(&frame)?;
        Ok(edge::nearest_to_the_middle(&self.truth(&frame, 1)?)?)
    }
}

/// A scene and its view before anything changes.
struct Base {
    name: String,
    said_closed: bool,
    soup: Soup,
    view: View,
    choice: SceneChoice,
    image: [usize; 2],
    diagonal: f64,
}

impl Base {
    fn load(suite: &Suite, entry: &SceneEntry) -> Result<Self, Problems> {
        let choice = &entry.choice;
        let soup = load_soup(&choice.scene)?;
        let scene = soup.clone().finish(&choice.scene);
        let view = choose_view(&scene, &choice.scene, choice.views.as_deref(), choice.view.as_deref())?;
        let job = Job::with_view(scene, view.clone(), choice)?;
        let mut notes = Vec::new();
        // Options are taken in here, once: in a frame they would undo what changed.
        let light = light_choice::light(view.light, view.rect_corners, job.camera.target, &choice.light, &mut notes)?;
        let view = View { camera: job.camera, light, rect_corners: None, note: notes };
        let plain = SceneChoice::plain(&choice.scene, &suite.size, &choice.light);
        let [low, high] = job.scene.bounds().unwrap_or_default();
        let diagonal = (0..3).map(|k| f64::from(high[k] - low[k]).powi(2)).sum::<f64>().sqrt();
        let name = choice.scene.clone();
        Ok(Self { name, said_closed: entry.said_closed, soup, view, choice: plain, image: job.image, diagonal })
    }

    fn frame(&self, change: Sequence, value: f64, edge: Option<[f32; 3]>) -> Result<Frame, Problem> {
        let variation = match change {
            Sequence::WorldScale => Some(Variation::Scaled(value)),
            Sequence::FarFromOrigin => Some(Variation::Moved(AWAY.map(|along| along * value * self.diagonal))),
            Sequence::Tessellation => Some(Variation::Divided(value as u32)),
            Sequence::ClosingContact => Some(Variation::Lifted(value)),
            Sequence::OpeningMeshes => Some(Variation::Opened(value)),
            _ => None,
        };
        let (mut soup, mut view) = (self.soup.clone(), self.view.clone());
        if let Some(variation) = variation {
            (soup, view) = (variation.soup(soup), variation.view(view));
        }
        view = match (change, edge) {
            (Sequence::LightOrbit, _) => View { light: orbited(view.light, view.camera.target, value), ..view },
            (Sequence::GrowingLight, _) => {
                let radius = (f64::from(view.light.radius) * value) as f32;
                View { light: view.light.with_radius(radius), ..view }
            }
            (Sequence::CameraPan, _) => View { camera: turned(view.camera, value, self.image), ..view },
            (Sequence::Zoom, Some(edge)) => View { camera: closer(view.camera, edge, value), ..view },
            _ => view,
        };
        let mut scene = soup.finish(&self.name);
        if self.said_closed {
            say_closed(&mut scene);
        }
        let (choice, image) = (self.choice.clone(), self.image);
        Ok(Frame { value, scene, view, choice, imports: Vec::new(), image, steady_from: None })
    }
}

/// The light on a circle around the vertical axis through `middle`.
fn orbited(light: Light, middle: [f32; 3], degrees: f64) -> Light {
    let (sin, cos) = (degrees / 360.0 * TAU).sin_cos();
    let [x, y, z] = light.position;
    let (dx, dz) = (f64::from(x) - f64::from(middle[0]), f64::from(z) - f64::from(middle[2]));
    let at = |middle: f32, offset: f64| (f64::from(middle) + offset) as f32;
    light.moved_to([at(middle[0], cos * dx - sin * dz), y, at(middle[2], sin * dx + cos * dz)])
}

/// The camera turned to the right by so many pixels at the middle of the picture.
fn turned(camera: Camera, pixels: f64, image: [usize; 2]) -> Camera {
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(|v| glam::Vec3::from(v).as_dvec3());
    let forward = target - eye;
    let right = forward.cross(up).normalize();
    let pixel = 2.0 * (f64::from(camera.fov_y) / 2.0).tan() / image[1] as f64;
    let target = eye + forward + right * (pixels * pixel * forward.length());
    Camera { target: target.as_vec3().to_array(), ..camera }
}

/// The camera looking at `edge`, with this share of its distance left.
fn closer(camera: Camera, edge: [f32; 3], share: f64) -> Camera {
    let eye = [0, 1, 2].map(|k| {
        let (edge, eye) = (f64::from(edge[k]), f64::from(camera.eye[k]));
        (edge + share * (eye - edge)) as f32
    });
    Camera { eye, target: edge, ..camera }
}

/// `first` and below it `second`, whose pixels move down by the picture's height.
fn joined(first: Vec<(String, Array)>, second: &[(String, Array)], image: [usize; 2]) -> Vec<(String, Array)> {
    let pixels = (image[0] * image[1]) as u32;
    let join = |((name, mut rows), (_, more)): ((String, Array), &(String, Array))| {
        let mut shape = rows.shape().to_vec();
        shape[0] += more.dim(0);
        rows = if name == input::IMPORTED_PIXEL.name {
            let moved = more.as_u32().iter().map(|pixel| pixel + pixels);
            Array::u32(shape, rows.as_u32().iter().copied().chain(moved).collect::<Vec<_>>())
        } else if name == input::IMPORTED_TRIANGLE.name {
            Array::u32(shape, [rows.as_u32(), more.as_u32()].concat())
        } else {
            Array::f32(shape, [rows.as_f32(), more.as_f32()].concat())
        };
        (name, rows)
    };
    first.into_iter().zip(second).map(join).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_go_around_and_cameras_turn_by_pixels() {
        let light = Light::point("", [1.0, 4.0, 0.0]);
        assert_eq!(orbited(light.clone(), [0.0; 3], 0.0).position, light.position);
        let quarter = orbited(light, [0.0, 1.0, 1.0], 90.0).position;
        assert!((quarter[0] - 1.0).abs() < 1e-6 && quarter[1] == 4.0 && (quarter[2] - 2.0).abs() < 1e-6, "{quarter:?}");
        let (eye, target, up) = ([0.0; 3], [0.0, 0.0, -2.0], [0.0, 1.0, 0.0]);
        let camera = Camera { name: String::new(), eye, target, up, fov_y: std::f32::consts::FRAC_PI_2 };
        // Half the picture's height is half of 100 pixels away, at 45 degrees.
        let turned = turned(camera.clone(), 50.0, [100, 100]);
        assert!((turned.target[0] - 2.0).abs() < 1e-6, "{turned:?}");
        let near = closer(camera, [0.0, 0.0, -1.0], 0.25);
        assert_eq!((near.eye, near.target), ([0.0, 0.0, -0.75], [0.0, 0.0, -1.0]));
    }

    #[test]
    fn the_first_frame_s_rows_lie_below_the_picture() {
        let own = vec![
            (input::IMPORTED_POSITION.name.to_string(), Array::f32([2, 3], vec![0.0; 6])),
            (input::IMPORTED_PIXEL.name.to_string(), Array::u32([2], vec![0, 1])),
        ];
        let joined = joined(own.clone(), &own, [2, 1]);
        assert_eq!((joined[0].1.shape(), joined[1].1.as_u32()), ([4, 3].as_slice(), [0, 1, 2, 3].as_slice()));
    }
}
