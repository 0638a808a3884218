//! Scene, camera, light and view-samples as the command line names them, ready as graph inputs.

use crate::args::SceneChoice;
use crate::jitter::Jitter;
use crate::{jitter, light_choice, npy, usage_problem};
use shadowgraph_core::accumulation::Standing;
use shadowgraph_core::array::Array;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::input;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::scene::{Camera, Light, Scene};
use shadowgraph_scenes::View;
use shadowgraph_scenes::lights::{self, LightSamples, Sampling};
use std::path::Path;

/// Everything a graph is run on.
#[derive(Clone, Debug)]
pub struct Job {
    /// The scene as named on the command line.
    pub scene_spec: String,
    /// The scene.
    pub scene: Scene,
    /// The camera.
    pub camera: Camera,
    /// The light.
    pub light: Light,
    /// How it is sampled.
    pub sampling: Sampling,
    /// Light samples of all sets: the light's centre for hard shadows.
    pub samples: Vec<[f32; 3]>,
    /// The RGB share of the light that each carries in its set.
    pub weights: Vec<[f32; 3]>,
    /// Sample sets: one, or one for each pixel of the jitter pattern.
    pub sets: Vec<LightSamples>,
    /// Where these sets come from.
    pub jitter: Jitter,
    /// Pixels a side of the jitter pattern.
    pub jitter_side: usize,
    /// Picture width and height, pixels.
    pub image: [usize; 2],
    /// What `choose` may ask.
    pub facts: Facts,
    /// Remarks for the record.
    pub notes: Vec<String>,
    /// Colour of the light before its texture's mean was taken in.
    given_color: [f32; 3],
    /// Imported view-samples, if any.
    imports: Vec<(String, Array)>,
}

impl Job {
    /// Loads scene and view, and applies the command line's overrides.
    ///
    /// # Errors
    /// Scene or views cannot be loaded, a flag cannot be understood, imported view-samples do not fit.
    pub fn load(choice: &SceneChoice) -> Result<Self, Problem> {
        let scene = shadowgraph_scenes::load(&choice.scene)?;
        let view =
            shadowgraph_scenes::choose_view(&scene, &choice.scene, choice.views.as_deref(), choice.view.as_deref())?;
        Self::with_view(scene, view, choice)
    }

    /// The same scene through another view.
    ///
    /// # Errors
    /// As [`Job::load`].
    pub fn with_view(mut scene: Scene, view: View, choice: &SceneChoice) -> Result<Self, Problem> {
        let View { mut camera, light, rect_corners, note } = view;
        if let Some(text) = &choice.eye {
            camera.eye = point("--eye", text)?;
        }
        if let Some(text) = &choice.target {
            camera.target = point("--target", text)?;
        }
        if let Some(degrees) = choice.fov {
            if !(degrees > 0.0 && degrees < 180.0) {
                return Err(usage_problem("--fov is out of range")
                    .expected("degrees in 0..180")
                    .found(degrees.to_string()));
            }
            camera.fov_y = degrees.to_radians();
        }
        check_camera(&camera)?;
        let mut image = size(&choice.size)?;
        let mut imports = Vec::new();
        if let Some(folder) = &choice.view_samples {
            imports = read_view_samples(folder)?;
            image = fitting_image(image, &imports);
        }
        // Light-back-facing triangles of a closed part decide only what lies outside of it.
        if imports.is_empty() {
            shadowgraph_scenes::open_parts_around(&mut scene, camera.eye);
        } else {
            shadowgraph_scenes::open_all_parts(&mut scene);
        }
        let mut notes = scene.notes.clone();
        notes.extend(note);
        let mut light = light_choice::light(light, rect_corners, camera.target, &choice.light, &mut notes)?;
        let sampling = light_choice::sampling(&light, &choice.light)?;
        let base = lights::sample(&light, &sampling)?;
        let sets = jitter::sets(choice.light.jitter, choice.light.jitter_side, &light, &sampling, &base)?;
        let samples: Vec<_> = sets.iter().flat_map(|set| &set.positions).copied().collect();
        let weights: Vec<_> = sets.iter().flat_map(|set| &set.weights).copied().collect();
        if sampling.count > 1 && !lights::has_extent(&light) {
            notes.push(format!(
                "the light has no extent: all {} light samples coincide (--light-radius gives it one)",
                sampling.count
            ));
        }
        // A texture's mean is part of the light's colour from here on: weights are shares of it.
        let given_color = std::mem::replace(&mut light.color, base.color);
        let facts = input::facts(&scene, &samples, !imports.is_empty()).with_weights(&base.weights);
        let scene_spec = choice.scene.clone();
        let jitter_side = choice.light.jitter_side as usize;
        Ok(Self {
            scene_spec,
            scene,
            camera,
            light,
            sampling,
            samples,
            weights,
            sets,
            jitter: choice.light.jitter,
            jitter_side,
            image,
            facts,
            notes,
            given_color,
            imports,
        })
    }

    /// Graph inputs by name.
    pub fn inputs(&self) -> Vec<(String, Array)> {
        let arrays =
            input::scene_arrays(&self.scene, &self.camera, self.image, &self.light, &self.samples, &self.weights);
        let mut arrays: Vec<_> = arrays.into_iter().map(|(name, array)| (name.to_string(), array)).collect();
        arrays.extend(self.imports.iter().cloned());
        arrays
    }

    /// Light samples of a view-sample.
    pub fn light_samples_count(&self) -> usize {
        self.sets[0].positions.len()
    }

    /// The graph inputs that differ from sample set to sample set, of one set.
    pub fn set_inputs(&self, set: usize) -> [(&'static str, Array); 2] {
        let LightSamples { positions, weights, .. } = &self.sets[set];
        let rows = |rows: &[[f32; 3]]| Array::f32([rows.len(), 3], rows.as_flattened().to_vec());
        [(input::LIGHT_SAMPLES.name, rows(positions)), (input::LIGHT_WEIGHTS.name, rows(weights))]
    }

    /// The same job on each of `sets` disjoint sets of as many light samples, see [`lights::sample_sets`].
    ///
    /// # Errors
    /// The light cannot be sampled so often.
    pub fn in_sets(&self, sets: usize) -> Result<impl Iterator<Item = Self> + '_, Problem> {
        let given = self.given_light();
        let sets = lights::sample_sets(&given, &self.sampling, sets)?;
        Ok(sets.into_iter().map(|set| {
            let light = Light { color: set.color, ..self.light.clone() };
            let (samples, weights) = (set.positions.clone(), set.weights.clone());
            Self { samples, weights, sets: vec![set], light, ..self.clone() }
        }))
    }

    /// The same job with the light samples of another frame: seeds of its own. Frame 0 is the job itself.
    ///
    /// # Errors
    /// The light cannot be sampled with another seed.
    pub fn in_frame(&self, frame: u32) -> Result<Self, Problem> {
        let given = self.given_light();
        // A pattern of seeds takes as many of them as it has sets.
        let seed = self.sampling.seed.wrapping_add(frame.wrapping_mul(self.sets.len() as u32));
        let sampling = Sampling { seed, ..self.sampling };
        let base = lights::sample(&given, &sampling)?;
        let sets = jitter::sets(self.jitter, self.jitter_side as u32, &given, &sampling, &base)?;
        let samples = sets.iter().flat_map(|set| &set.positions).copied().collect();
        let weights = sets.iter().flat_map(|set| &set.weights).copied().collect();
        let light = Light { color: base.color, ..given };
        Ok(Self { samples, weights, sets, sampling, light, ..self.clone() })
    }

    /// What the means of frames are of: everything but the light samples.
    pub fn standing(&self) -> Standing {
        Standing::of(&self.scene, &self.camera, self.image, &self.given_light())
    }

    /// The light in its own colour.
    fn given_light(&self) -> Light {
        Light { color: self.given_color, ..self.light.clone() }
    }

    /// The same job on view-samples of an earlier run.
    pub fn importing(&self, imports: Vec<(String, Array)>) -> Self {
        let facts = Facts { view_samples_imported: true, ..self.facts.clone() };
        Self { imports, facts, ..self.clone() }
    }
}

fn check_camera(camera: &Camera) -> Result<(), Problem> {
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(wide);
    let forward = [0, 1, 2].map(|k| target[k] - eye[k]);
    let cross = [
        forward[1] * up[2] - forward[2] * up[1],
        forward[2] * up[0] - forward[0] * up[2],
        forward[0] * up[1] - forward[1] * up[0],
    ];
    let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length(cross) > 1e-9 * length(forward) * length(up) {
        return Ok(());
    }
    Err(usage_problem("the camera has no direction")
        .expected("a target that differs from the eye, and an up vector not parallel to the view direction")
        .found(format!("eye {:?}, target {:?}, up {:?}", camera.eye, camera.target, camera.up)))
}

fn wide(v: [f32; 3]) -> [f64; 3] {
    v.map(f64::from)
}

/// Three finite numbers.
///
/// # Errors
/// Anything else.
pub fn point(flag: &str, text: &str) -> Result<[f32; 3], Problem> {
    let numbers: Vec<f32> =
        text.split(',').filter_map(|part| part.trim().parse().ok()).filter(|x: &f32| x.is_finite()).collect();
    <[f32; 3]>::try_from(numbers)
        .map_err(|_| usage_problem(format!("{flag} is not a point")).expected("three finite numbers X,Y,Z").found(text))
}

/// Width and height, each 1 to 16,384.
///
/// # Errors
/// Anything else.
pub fn size(text: &str) -> Result<[usize; 2], Problem> {
    let sides: Vec<usize> = text.split('x').filter_map(|part| part.trim().parse().ok()).collect();
    match sides.as_slice() {
        [width, height] if (1..=16_384).contains(width) && (1..=16_384).contains(height) => Ok([*width, *height]),
        _ => Err(usage_problem("--size is not a picture size").expected("WIDTHxHEIGHT, each 1..=16384").found(text)),
    }
}

/// `DIR/{position,normal,triangle,pixel}.npy`, or the names that a dump gives them.
fn read_view_samples(folder: &Path) -> Result<Vec<(String, Array)>, Problem> {
    let path = |port: &str| {
        let plain = folder.join(format!("{port}.npy"));
        if plain.exists() { plain } else { folder.join(format!("view_samples.{port}.npy")) }
    };
    let position = npy::read_f32(&path("position"), 3)?;
    let rows = position.dim(0);
    let normal = npy::read_f32(&path("normal"), 3)?;
    let triangle = npy::read_u32(&path("triangle"))?;
    let pixel_path = path("pixel");
    let pixel =
        if pixel_path.exists() { npy::read_u32(&pixel_path)? } else { Array::u32([rows], (0..rows as u32).collect()) };
    for (name, array) in [("normal", &normal), ("triangle", &triangle), ("pixel", &pixel)] {
        if array.dim(0) != rows {
            return Err(Problem::new(Kind::BadValue, format!("{name}.npy and position.npy differ in rows"))
                .expected(rows.to_string())
                .found(array.dim(0).to_string()));
        }
    }
    Ok([
        (input::IMPORTED_POSITION, position),
        (input::IMPORTED_NORMAL, normal),
        (input::IMPORTED_TRIANGLE, triangle),
        (input::IMPORTED_PIXEL, pixel),
    ]
    .into_iter()
    .map(|(port, array)| (port.name.to_string(), array))
    .collect())
}

/// The picture must hold every imported pixel; it grows downwards where it does not.
fn fitting_image([width, height]: [usize; 2], imports: &[(String, Array)]) -> [usize; 2] {
    let pixels = imports.iter().find(|(name, _)| name == input::IMPORTED_PIXEL.name);
    let last = pixels.and_then(|(_, array)| array.as_u32().iter().max().copied()).unwrap_or(0) as usize;
    [width, height.max(last / width + 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_points_are_checked() {
        assert_eq!(size("640x480").unwrap(), [640, 480]);
        for wrong in ["640", "0x5", "5x99999", "axb", "1x2x3"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(point("--eye", "1, -2,3.5").unwrap(), [1.0, -2.0, 3.5]);
        let problem = point("--eye", "1,2").unwrap_err();
        assert_eq!(
            problem.to_string(),
            "command line: --eye is not a point; expected three finite numbers X,Y,Z; found 1,2"
        );
        assert!(point("--eye", "1,2,NaN").is_err());
    }
}
