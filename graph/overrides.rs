//! What the caller wants otherwise than the file says.

use crate::source::Span;
use crate::span::{Data, parse_fragment};
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::Backend;

/// Which values outlive the run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Keep {
    /// The graph's outputs.
    #[default]
    OutputsOnly,
    /// Every output port of every live node, for dumps and for node-by-node comparison.
    AllLivePorts,
}

/// Settings of one plan. What is said here wins over the file.
#[derive(Clone, Debug)]
pub struct Overrides {
    /// Node, pass: the node's `pass` and `choose` give way to this pass.
    pub swaps: Vec<(String, String)>,
    /// Node, parameter, value as RON text; a word needs no quotes.
    pub sets: Vec<(String, String, String)>,
    /// Node, backend.
    pub on: Vec<(String, Backend)>,
    /// Which values outlive the run.
    pub keep: Keep,
    /// Where nodes run that say nothing else. Nothing falls back to the other backend unasked.
    pub default_backend: Backend,
    /// Whether transients share memory.
    pub alias: bool,
}

impl Default for Overrides {
    /// The CPU, outputs kept, transients aliased.
    fn default() -> Self {
        Self {
            swaps: Vec::new(),
            sets: Vec::new(),
            on: Vec::new(),
            keep: Keep::OutputsOnly,
            default_backend: Backend::Cpu,
            alias: true,
        }
    }
}

impl Overrides {
    /// Every swap, set and pin as the command line spells it; a [`Span::flag`] counts in this list.
    pub(crate) fn flags(&self) -> Vec<String> {
        let swaps = self.swaps.iter().map(|(node, pass)| format!("--swap {node}={pass}"));
        let sets = self.sets.iter().map(|(node, param, value)| format!("--set {node}.{param}={value}"));
        let on = self.on.iter().map(|(node, on)| format!("--on {node}={}", backend_name(*on)));
        swaps.chain(sets).chain(on).collect()
    }
    pub(crate) fn swap_span(&self, index: usize) -> Span {
        Span::flag(index)
    }
    pub(crate) fn set_span(&self, index: usize) -> Span {
        Span::flag(self.swaps.len() + index)
    }
    pub(crate) fn on_span(&self, index: usize) -> Span {
        Span::flag(self.swaps.len() + self.sets.len() + index)
    }
}

/// A flag's value: RON, or a bare word.
pub(crate) fn flag_value(text: &str) -> Value {
    match parse_fragment(text) {
        Some(Data::Word(word)) => Value::Word(word),
        Some(data) => crate::read::scalar_value(&data).unwrap_or_else(|| Value::Word(text.into())),
        None => Value::Word(text.into()),
    }
}

/// `cpu` or `wgpu`.
pub(crate) fn backend_name(backend: Backend) -> &'static str {
    match backend {
        Backend::Cpu => "cpu",
        Backend::Wgpu => "wgpu",
    }
}
