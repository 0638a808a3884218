//! The rules of a graph, one file each. A rule notes what is wrong and gives back what later rules can go on with.

mod backends;
mod cycles;
mod facts;
mod names;
mod params;
mod variants;
mod wires;

pub(crate) use backends::backend;
pub(crate) use cycles::cycles;
pub(crate) use facts::guard;
pub(crate) use names::{inputs, pass, stage};
pub(crate) use params::{ParamReader, Set, unused_sets};
pub(crate) use variants::axes;
pub(crate) use wires::{mismatch, output, wires};
