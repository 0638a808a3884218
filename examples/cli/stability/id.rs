//! Numbers that tell records apart: equal whenever the same method meets the same frames.

use crate::job::Job;
use shadowgraph_core::plan::Plan;
use shadowgraph_graph::plan_id;

/// 64-bit FNV-1a, taken in piece by piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hash(u64);

impl Hash {
    /// Of nothing.
    pub fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn bytes(mut self, bytes: impl IntoIterator<Item = u8>) -> Self {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
        self
    }

    /// And this text, its end included.
    pub fn text(self, text: &str) -> Self {
        self.bytes(text.bytes().chain([0xff]))
    }

    /// And these words.
    pub fn words(self, words: &[u32]) -> Self {
        self.bytes((words.len() as u64).to_le_bytes()).bytes(words.iter().flat_map(|word| word.to_le_bytes()))
    }

    /// And a plan: nodes, passes, parameters, and the sources of the passes.
    pub fn plan(self, plan: &Plan) -> Self {
        let sources = plan.nodes.iter().map(|node| shadowgraph_passes::source_id(node.pass).unwrap_or_default());
        sources.fold(self.text(&plan_id(plan)), Self::text)
    }

    /// And everything that a graph is given: geometry, camera, light samples, imported view-samples.
    pub fn inputs(self, job: &Job) -> Self {
        job.inputs().iter().fold(self, |hash, (name, array)| hash.text(name).words(array.words()))
    }

    /// Sixteen hexadecimal digits.
    pub fn digits(self) -> String {
        format!("{:016x}", self.0)
    }
}

impl Default for Hash {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_values_and_pieces_that_cannot_be_confused() {
        assert_eq!(Hash::new().bytes(*b"a").digits(), "af63dc4c8601ec8c");
        assert_ne!(Hash::new().text("ab").text("c").0, Hash::new().text("a").text("bc").0);
        assert_ne!(Hash::new().words(&[1]).words(&[]).0, Hash::new().words(&[]).words(&[1]).0);
    }
}
