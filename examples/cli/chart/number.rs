//! Ids of variants: numbers of everything that is measured.

use shadowgraph_core::array::Array;

/// A number of what is measured: 64-bit FNV-1a of words, turned so that high bits count in what follows.
#[derive(Clone, Copy)]
pub struct Number(u64);

impl Default for Number {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Number {
    /// Takes in a word.
    pub fn word(&mut self, word: u32) {
        self.0 = (self.0 ^ u64::from(word)).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29);
    }

    /// Takes in a text with its length.
    pub fn text(&mut self, text: &str) {
        self.word(text.len() as u32);
        text.bytes().for_each(|byte| self.word(u32::from(byte)));
    }

    /// Takes in shape and words.
    pub fn array(&mut self, array: &Array) {
        array.shape().iter().for_each(|side| self.word(*side as u32));
        array.words().iter().for_each(|word| self.word(*word));
    }

    /// Sixteen hexadecimal digits.
    pub fn hex(self) -> String {
        format!("{:016x}", self.0)
    }
}
