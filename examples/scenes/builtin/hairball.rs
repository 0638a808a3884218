//! A ball of hair: thin strips that leave a sphere and curl.

use super::Builtin;
use super::shapes::{WARM, ground, light_at, look_from};
use crate::random::Random;
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use shadowgraph_core::scene::flag;

/// `builtin:hairball`.
pub const SCENE: Builtin = Builtin {
    name: "hairball",
    doc: "open strips from a sphere along curl noise: sub-texel casters, long lists, high depth complexity",
    params: &[
        ParamSpec {
            name: "strands",
            range: Range::U32 { min: 1, max: 100_000, default: 5000 },
            unit: "strands",
            doc: "strips that leave the sphere",
        },
        ParamSpec {
            name: "segments",
            range: Range::U32 { min: 1, max: 64, default: 16 },
            unit: "segments",
            doc: "along each strip; two triangles each",
        },
        ParamSpec {
            name: "seed",
            range: Range::U32 { min: 0, max: u32::MAX, default: 1 },
            unit: "",
            doc: "another draw",
        },
    ],
    build,
};

const BALL_RADIUS: f32 = 0.6;
const HAIR_LENGTH: f32 = 0.8;
const HALF_WIDTH: f32 = 0.003;
const MIDDLE: Vec3 = vec3(0.0, 1.5, 0.0);

/// Waves of a vector potential; the curl of their sum has no divergence, so strands neither bunch nor part.
struct CurlNoise([(Vec3, Vec3, f32); 12]);

impl CurlNoise {
    fn new(random: &mut Random) -> Self {
        Self(std::array::from_fn(|wave| {
            let frequency = 2.0 + wave as f32 * 0.8;
            (random.direction() * frequency, random.direction(), random.range(0.0, std::f32::consts::TAU))
        }))
    }

    /// Curl of the sum of direction * sin(wave . p + phase) / |wave|.
    fn at(&self, point: Vec3) -> Vec3 {
        self.0
            .iter()
            .map(|(wave, direction, phase)| wave.normalize().cross(*direction) * (wave.dot(point) + phase).cos())
            .sum()
    }
}

fn build(params: &Params) -> Soup {
    let segments = params.u32("segments");
    let mut random = Random::new(params.u32("seed"));
    let noise = CurlNoise::new(&mut random);
    let mut soup = Soup::default();
    ground(&mut soup, 3.0, 0.0);
    soup.start_shape();
    let step = HAIR_LENGTH / segments as f32;
    for _ in 0..params.u32("strands") {
        let outward = random.direction();
        let mut root = outward * BALL_RADIUS;
        let side = outward.any_orthonormal_vector() * HALF_WIDTH;
        let mut edge = [MIDDLE + root - side, MIDDLE + root + side];
        for segment in 1..=segments {
            // Straight out at the root, more and more along the noise.
            let share = segment as f32 / segments as f32;
            root += (outward * (1.0 - 0.6 * share) + noise.at(root * 2.0) * (0.7 * share)).normalize() * step;
            let width = 1.0 - 0.9 * share;
            let next = [MIDDLE + root - side * width, MIDDLE + root + side * width];
            let look = WARM.with(flag::TWO_SIDED);
            soup.flat([edge[0], edge[1], next[1]], look);
            soup.flat([edge[0], next[1], next[0]], look);
            edge = next;
        }
    }
    light_at(&mut soup, vec3(1.5, 5.5, 1.0), 0.25);
    look_from(&mut soup, vec3(2.8, 2.6, 4.6), vec3(0.0, 1.1, 0.0));
    soup
}
