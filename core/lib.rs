//! The nouns of shadowgraph. No GPU API, no files, no text format, no clocks.
//!
//! A **stage** ([`stage::Stage`]) is a signature: typed ports. A **pass** ([`pass::Pass`]) implements a stage with a CPU
//! function, a GPU recipe, or both. A **plan** ([`plan::Plan`]) is all that a backend ever sees. Every value that travels
//! between nodes is an [`array::Array`]: a shape and 32-bit words, the same bits on both backends.
#![forbid(unsafe_code)]

pub mod accumulation;
pub mod array;
pub mod cpu;
pub mod facts;
pub mod input;
mod light;
pub mod light_plane;
pub mod metric;
pub mod param;
pub mod pass;
pub mod plan;
pub mod port;
pub mod problem;
pub mod reading;
pub mod record;
pub mod scene;
pub mod shared;
pub mod size;
pub mod stage;
