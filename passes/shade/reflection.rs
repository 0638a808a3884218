//! What a surface makes of light from one direction: Lambert's cosine and Phong's highlight; the CPU side of `reflection.wgsl`.

use glam::Vec3;
use shadowgraph_core::param::{ParamSpec, Params, Range};

/// Strength of the highlight.
pub const SPECULAR: ParamSpec = ParamSpec {
    name: "specular",
    range: Range::F32 { min: 0.0, max: 1e3, default: 0.0 },
    unit: "share of the light's colour",
    doc: "strength of the highlight; 0 is none",
};
/// Size of the highlight.
pub const SHININESS: ParamSpec = ParamSpec {
    name: "shininess",
    range: Range::F32 { min: 1.0, max: 1e4, default: 32.0 },
    unit: "",
    doc: "the highlight is smaller as it grows",
};

/// Their values.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    /// Strength of the highlight, share of the light's colour.
    pub specular: f32,
    /// Exponent of the highlight.
    pub shininess: f32,
}

impl Reflection {
    /// From a node's parameters.
    pub fn new(params: &Params) -> Self {
        Self { specular: params.f32(SPECULAR.name), shininess: params.f32(SHININESS.name) }
    }

    /// Factors of albedo and of white for light from the unit direction `l` on a surface of unit normal `n`: the cosine, and
    /// the highlight seen from the unit direction `toward_eye`. Zeros where the light is behind.
    pub fn terms(&self, n: Vec3, l: Vec3, toward_eye: Vec3) -> [f32; 2] {
        let cosine = n.dot(l);
        if cosine > 0.0 {
            let mirrored = 2.0 * cosine * n - l;
            [cosine, self.specular * mirrored.dot(toward_eye).max(0.0).powf(self.shininess)]
        } else {
            [0.0, 0.0]
        }
    }
}
