//! Means over frames while nothing moves (Sintorn 2008, section 4.2: jittered light samples, Figure 7).
//!
//! Each frame has light samples of its own; the mean over frames is the answer of all of them. It starts anew as soon as the camera,
//! the light, the scene or the picture's size is another: [`Standing`] tells, and has the light samples themselves left out.
//!
//! The mean of frames 1 to n is `m(n) = m(n-1) + (x(n) - m(n-1)) / n`, in 64-bit numbers.

use crate::array::{Array, Element};
use crate::input::camera_words;
use crate::scene::{Camera, Light, LightShape, Scene};

/// What a mean is of: equal for frames that may be averaged.
///
/// A hash of 64 bits over every number that a graph reads, light samples and weights excepted. A host that knows otherwise what
/// changed can make one of a counter of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Standing(pub u64);

impl Standing {
    /// Of a scene as it is seen and lit.
    pub fn of(scene: &Scene, camera: &Camera, image: [usize; 2], light: &Light) -> Self {
        let mut hash = Hash(0xcbf2_9ce4_8422_2325);
        hash.floats(scene.positions.as_flattened().as_flattened());
        hash.floats(scene.normals.as_flattened().as_flattened());
        hash.floats(scene.albedo.as_flattened());
        scene.flags.iter().for_each(|flags| hash.word(*flags));
        scene.corner_vertex.as_flattened().iter().for_each(|vertex| hash.word(*vertex));
        hash.floats(&camera_words(camera, image));
        hash.light(light);
        Self(hash.0)
    }
}

/// 64-bit FNV-1a over 32-bit words.
struct Hash(u64);

impl Hash {
    fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29);
    }

    /// The count too, so that rows cannot pass from one list to the next unseen.
    fn floats(&mut self, values: &[f32]) {
        self.word(values.len() as u32);
        values.iter().for_each(|value| self.word(value.to_bits()));
    }

    fn light(&mut self, light: &Light) {
        self.floats(&light.position);
        self.floats(&[light.radius]);
        self.floats(&light.color);
        light.shape.name().bytes().for_each(|byte| self.word(u32::from(byte)));
        match &light.shape {
            LightShape::Point | LightShape::Sphere => {}
            LightShape::Disc { half_axes } | LightShape::Rectangle { half_axes } => {
                self.floats(half_axes.as_flattened());
            }
            LightShape::Ellipsoid { half_axes } => self.floats(half_axes.as_flattened()),
            LightShape::Points { positions, colors } => {
                self.floats(positions.as_flattened());
                self.floats(colors.as_flattened());
            }
            LightShape::Surface(triangles) | LightShape::Volume(triangles) => {
                self.floats(triangles.as_flattened().as_flattened());
            }
            LightShape::Parts(parts) => {
                self.word(parts.len() as u32);
                parts.iter().for_each(|part| self.light(part));
            }
        }
        if let Some(texture) = &light.texture {
            self.word(texture.width as u32);
            self.floats(texture.texels.as_flattened());
        }
    }
}

/// The mean of one value over frames, such as a picture or visible fractions. Empty at first.
#[derive(Clone, Debug, Default)]
pub struct Accumulation {
    standing: Option<Standing>,
    shape: Vec<usize>,
    mean: Vec<f64>,
    frames: u32,
}

impl Accumulation {
    /// Takes one frame's value in and returns how many frames the mean is of: 1 where it began anew, because `standing` or the
    /// shape is another. Panics on an integer array, which has no mean.
    pub fn add(&mut self, standing: Standing, value: &Array) -> u32 {
        assert_eq!(value.element(), Element::F32, "a mean is of floats");
        if self.standing != Some(standing) || self.shape != value.shape() {
            *self = Self { standing: Some(standing), shape: value.shape().to_vec(), ..Self::default() };
            self.mean = vec![0.0; value.words().len()];
        }
        self.frames = self.frames.saturating_add(1);
        let share = 1.0 / f64::from(self.frames);
        for (mean, value) in self.mean.iter_mut().zip(value.as_f32()) {
            *mean += (f64::from(*value) - *mean) * share;
        }
        self.frames
    }

    /// Frames in the mean.
    pub fn frames(&self) -> u32 {
        self.frames
    }

    /// The mean in the shape of the frames' values; none before the first. One frame's mean is its value, bit for bit.
    pub fn mean(&self) -> Option<Array> {
        let values = || self.mean.iter().map(|value| *value as f32).collect();
        (self.frames > 0).then(|| Array::f32(self.shape.clone(), values()))
    }

    /// Forgets all frames.
    pub fn reset(&mut self) {
        *self = Self::default();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fractions(values: &[f32]) -> Array {
        Array::f32([values.len()], values.to_vec())
    }

    #[test]
    fn means_counted_by_hand() {
        let mut accumulation = Accumulation::default();
        assert_eq!(accumulation.mean(), None);
        let first = fractions(&[0.1, -0.0, 1.0]);
        assert_eq!(accumulation.add(Standing(7), &first), 1);
        assert_eq!(accumulation.mean().unwrap().words()[0], first.words()[0]);
        accumulation.add(Standing(7), &fractions(&[0.3, 0.5, 0.0]));
        assert_eq!(accumulation.add(Standing(7), &fractions(&[0.5, 1.0, 0.5])), 3);
        assert_eq!(accumulation.mean().unwrap().as_f32(), [0.3, 0.5, 0.5]);
        accumulation.reset();
        assert_eq!((accumulation.frames(), accumulation.mean()), (0, None));
    }

    #[test]
    fn whatever_moves_begins_anew() {
        let scene = Scene { positions: vec![[[0.0; 3]; 3]], albedo: vec![[1.0; 3]], ..Scene::default() };
        let up = [0.0, 1.0, 0.0];
        let camera = Camera { name: String::new(), eye: [0.0, 0.0, 5.0], target: [0.0; 3], up, fov_y: 1.0 };
        let light = Light::sphere("", [0.0, 4.0, 0.0], 0.5);
        let still = Standing::of(&scene, &camera, [8, 8], &light);
        assert_eq!(still, Standing::of(&scene.clone(), &camera.clone(), [8, 8], &light.clone()));
        let mut moved = scene.clone();
        moved.positions[0][2][1] = 1e-30;
        let mut painted = scene.clone();
        painted.albedo[0][1] = 0.5;
        let disc = LightShape::Disc { half_axes: [[0.5, 0.0, 0.0], [0.0, 0.0, 0.5]] };
        let others = [
            Standing::of(&moved, &camera, [8, 8], &light),
            Standing::of(&painted, &camera, [8, 8], &light),
            Standing::of(&scene, &Camera { eye: [0.0, 0.001, 5.0], ..camera.clone() }, [8, 8], &light),
            Standing::of(&scene, &Camera { fov_y: 1.01, ..camera.clone() }, [8, 8], &light),
            Standing::of(&scene, &camera, [8, 9], &light),
            Standing::of(&scene, &camera, [8, 8], &light.clone().moved_to([0.0, 4.0, 0.1])),
            Standing::of(&scene, &camera, [8, 8], &light.clone().with_radius(0.6)),
            Standing::of(&scene, &camera, [8, 8], &light.clone().colored([1.0, 1.0, 0.9])),
            Standing::of(&scene, &camera, [8, 8], &Light::shaped("", light.position, disc)),
        ];
        let mut accumulation = Accumulation::default();
        for other in others {
            assert_ne!(other, still);
            accumulation.add(still, &fractions(&[1.0]));
            assert_eq!(accumulation.add(still, &fractions(&[1.0])), 2);
            assert_eq!(accumulation.add(other, &fractions(&[0.25])), 1);
            assert_eq!(accumulation.mean().unwrap().as_f32(), [0.25]);
        }
        assert_eq!(accumulation.add(others[0], &fractions(&[0.25, 0.5])), 1, "another shape");
    }
}
