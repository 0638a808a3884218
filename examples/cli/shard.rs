//! Parts of a suite that runs on several machines.

use shadowgraph_core::problem::Problem;

/// Which of how many parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// From 1.
    pub index: usize,
    /// Parts in all.
    pub count: usize,
}

impl Shard {
    /// All of it.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// `I/N`, as `--shard` has it.
    ///
    /// # Errors
    /// Anything else.
    pub fn read(text: &str) -> Result<Self, Problem> {
        let numbers = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if 1 <= index && index <= count => Ok(Self { index, count }),
            _ => Err(crate::usage_problem("--shard is no part of a whole")
                .expected("I/N, with I from 1 to N")
                .found(text)),
        }
    }

    /// Whether it does the case of that position.
    pub fn takes(self, position: usize) -> bool {
        position % self.count == self.index - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_parts_that_make_a_whole() {
        let shards: Vec<Shard> = ["1/3", "2/3", "3/3"].iter().map(|text| Shard::read(text).unwrap()).collect();
        for position in 0..10 {
            assert_eq!(shards.iter().filter(|shard| shard.takes(position)).count(), 1, "{position}");
        }
    }
}
