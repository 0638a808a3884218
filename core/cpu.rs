//! What a CPU function sees: its inputs by port name, its parameters, and places for its outputs and counts.

use crate::array::Array;
use crate::param::Params;
use crate::pass::Pass;
use crate::problem::Problem;

/// A pass on the CPU: reads inputs, puts every output. May use threads; must not depend on their number or order except
/// where its contract says so.
pub type CpuFn = fn(&mut CpuCx) -> Result<(), Problem>;

/// One run of one node.
pub struct CpuCx<'a> {
    pass: &'static Pass,
    params: &'a Params,
    image: [usize; 2],
    inputs: Vec<(&'static str, &'a Array)>,
    outputs: Vec<(&'static str, Array)>,
    counts: Vec<u64>,
    progress: &'a (dyn Fn(u64, u64) + Sync),
}

impl<'a> CpuCx<'a> {
    /// For backends.
    pub fn new(
        pass: &'static Pass,
        params: &'a Params,
        image: [usize; 2],
        inputs: Vec<(&'static str, &'a Array)>,
        progress: &'a (dyn Fn(u64, u64) + Sync),
    ) -> Self {
        let counts = vec![0; pass.counters.len()];
        Self { pass, params, image, inputs, outputs: Vec::new(), counts, progress }
    }
    /// Parameters of the node.
    pub fn params(&self) -> &'a Params {
        self.params
    }
    /// Picture width and height, pixels.
    pub fn image(&self) -> [usize; 2] {
        self.image
    }
    /// Required input `port`; panics when absent (checked before the run).
    pub fn input(&self, port: &str) -> &'a Array {
        match self.optional(port) {
            Some(array) => array,
            None => unreachable!("{:?} reads unconnected port {port}", self.pass),
        }
    }
    /// Input `port` if it is connected.
    pub fn optional(&self, port: &str) -> Option<&'a Array> {
        self.inputs.iter().find(|(name, _)| *name == port).map(|(_, array)| *array)
    }
    /// Gives output `port` its value; panics on a name the stage does not have, or a second value.
    pub fn put(&mut self, port: &'static str, array: Array) {
        let declared = self.pass.stage.port(port);
        assert!(declared.is_some_and(|p| !p.is_input() && p.element == array.element()), "{:?} puts {port}", self.pass);
        assert!(!self.outputs.iter().any(|(name, _)| *name == port), "{:?} puts {port} twice", self.pass);
        self.outputs.push((port, array));
    }
    /// Adds to counter `name`.
    pub fn count(&mut self, name: &str, amount: u64) {
        self.counts[self.pass.counter_index(name)] += amount;
    }
    /// Tells how far long work is; cheap enough to call some hundred times a run.
    pub fn progress(&self) -> &'a (dyn Fn(u64, u64) + Sync) {
        self.progress
    }
    /// For backends: outputs and counts after the run; panics when an output was not put.
    pub fn finish(self) -> (Vec<(&'static str, Array)>, Vec<u64>) {
        for port in self.pass.stage.outputs() {
            assert!(
                self.outputs.iter().any(|(name, _)| *name == port.name),
                "{:?} did not put {}",
                self.pass,
                port.name
            );
        }
        (self.outputs, self.counts)
    }
}
