//! Pass `light_frame/six_faces`: a cube of faces along the world's axes, for a light with view-samples all around it.
//!
//! In: `position [P 3] f32, world`, `sample_state [P] u32`, `light_samples [L 3] f32, world`. Out: `light_frame [6 20] f32, world`.
//!
//! Faces look along +x, -x, +y, -y, +z, -z; x, y, z of each are right-handed world axes, so projecting is one division with
//! no rounded axis in it. With `fit`, the window of each face is cut to the 2D bounding box of its own view-samples, padded
//! as in `fitted` (Sintorn 2008, section 4.3, Parametrization, face by face); else it is the whole square from -1 to 1.
//!
//! After it: `valid` marks faces that hold a kept view-sample; a view-sample is placed unless it lies at the light itself,
//! which is counted (`behind`).

mod cpu;
mod gpu;
#[cfg(test)]
mod tests;

use crate::ports;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::shared::FACE_WORDS;
use shadowgraph_core::size::SizeCx;

/// Number of faces.
const FACES: usize = 6;

/// View-samples that no face can place.
const BEHIND: Counter = Counter {
    name: "behind",
    doc: "kept view-samples that lie at the light itself",
    kind: CounterKind::MustBeZero("move the light off the surface"),
};

/// Six faces.
pub static PASS: Pass = Pass {
    name: "six_faces",
    stage: &super::STAGE,
    doc: "Six faces along the world's axes, each fitted to its view-samples.",
    source: "Sintorn 2008, section 4.3, Parametrization, on a cube",
    ignores: &[input::SCENE_BOUNDS.name],
    params: &[ParamSpec {
        name: "fit",
        range: Range::Bool { default: true },
        unit: "",
        doc: "cut each face's window to its view-samples: shorter lists; false keeps whole cube faces",
    }],
    counters: &[BEHIND],
    contract: Contract::Within(1e-3),
    features: &[],
    size,
    cpu: Some(cpu::run),
    gpu: Some(gpu::record),
};

fn size(_: &SizeCx) -> Vec<(&'static str, Vec<usize>)> {
    vec![(ports::LIGHT_FRAME.name, vec![FACES, FACE_WORDS])]
}
