//! A stage: a signature that passes implement and that a graph file names.

use crate::port::Port;

/// A signature. Passes of one stage are interchangeable; that set is what swaps and sweeps range over.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Stage {
    /// Name, the same in Rust, RON and charts.
    pub name: &'static str,
    /// One sentence.
    pub doc: &'static str,
    /// Inputs first, then outputs.
    pub ports: &'static [Port],
}

impl Stage {
    /// The port called `name`.
    pub fn port(&self, name: &str) -> Option<&'static Port> {
        self.ports.iter().find(|port| port.name == name)
    }
    /// Ports that are read.
    pub fn inputs(&self) -> impl Iterator<Item = &'static Port> {
        self.ports.iter().filter(|port| port.is_input())
    }
    /// Ports that are produced.
    pub fn outputs(&self) -> impl Iterator<Item = &'static Port> {
        self.ports.iter().filter(|port| !port.is_input())
    }
}
