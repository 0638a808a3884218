//! Stage `present`: Hands the picture to a host as a texture.

pub mod to_rgba32float;

use crate::ports;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::stage::Stage;

/// The signature.
pub static STAGE: Stage = Stage {
    name: "present",
    doc: "Hands the picture to a host as a texture.",
    ports: &[
        ports::IMAGE.read(),
        ports::IMAGE.named("image_texture").storage(shadowgraph_core::port::Storage::Rgba32Float),
    ],
};

/// Its passes; the first is the one used when a graph names none.
pub const PASSES: &[&Pass] = &[&to_rgba32float::PASS];
