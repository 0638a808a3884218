//! Sizes of output ports, known before anything runs: from input sizes, parameters and the run's settings.

use crate::param::Params;

/// What a size may depend on.
pub struct SizeCx<'a> {
    /// Picture width and height, pixels.
    pub image: [usize; 2],
    /// Parameters of the node.
    pub params: &'a Params,
    /// Shape of each connected input port, by port name.
    pub inputs: &'a [(&'static str, Vec<usize>)],
    /// Capacity asked for output port names by an earlier run that overflowed, words; empty on a first run.
    pub grown: &'a [(&'static str, usize)],
}

impl SizeCx<'_> {
    /// Length of dimension `axis` of input `port`; panics if it is not connected (ask only for required ports).
    pub fn dim(&self, port: &str, axis: usize) -> usize {
        match self.inputs.iter().find(|(name, _)| *name == port) {
            Some((_, shape)) => shape.get(axis).copied().unwrap_or(1),
            None => unreachable!("size asks for unconnected port {port}"),
        }
    }
    /// Number of words of input `port`.
    pub fn count(&self, port: &str) -> usize {
        match self.inputs.iter().find(|(name, _)| *name == port) {
            Some((_, shape)) => shape.iter().product(),
            None => unreachable!("size asks for unconnected port {port}"),
        }
    }
    /// The grown capacity of `port` if there is one, else `first`.
    pub fn capacity(&self, port: &str, first: usize) -> usize {
        self.grown.iter().find(|(name, _)| *name == port).map_or(first, |(_, words)| *words)
    }
}

/// Shapes of all output ports of a pass, by port name.
pub type SizeFn = fn(&SizeCx) -> Vec<(&'static str, Vec<usize>)>;
