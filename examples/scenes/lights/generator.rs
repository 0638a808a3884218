//! Sample generators: N points in the unit square or cube, each of volume 1/N in the mean.
//!
//! Every coordinate lies in [0, 1). The same generator, count and seed give the same bits on every run and machine: only additions,
//! multiplications and divisions of 64-bit numbers are used. Generators are for any count.
//!
//! | Generator | Points | Seed |
//! |---|---|---|
//! | [`Hammersley`](Generator::Hammersley) | i/N beside mirrored digits in bases 2 and 3 | 0: as they are; else shifted cyclically (Cranley and Patterson 1976) |
//! | [`Jittered`](Generator::Jittered) | one at random in each of N boxes of equal volume | chooses the points |
//! | [`Lattice`](Generator::Lattice) | i/N beside multiples of an irrational number | as Hammersley |
//! | [`Random`](Generator::Random) | independent | chooses the points |

use super::{hammersley, jittered, lattice};
use crate::random::Random;

/// How samples are spread.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Generator {
    /// Low discrepancy; the default.
    #[default]
    Hammersley,
    /// Stratified.
    Jittered,
    /// Rank-1: golden ratio in two dimensions (the Fibonacci lattice), plastic number in three.
    Lattice,
    /// White noise, the control that every other one must beat.
    Random,
}

impl Generator {
    /// All, in the order of documentation.
    pub const ALL: [Self; 4] = [Self::Hammersley, Self::Jittered, Self::Lattice, Self::Random];

    /// Its name on the command line and in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hammersley => "hammersley",
            Self::Jittered => "jittered",
            Self::Lattice => "lattice",
            Self::Random => "random",
        }
    }

    /// The generator of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|generator| generator.name() == name)
    }
}

/// A generator with its seed. Streams of one seed are independent of each other: parts of a light have one each.
#[derive(Clone, Copy, Debug)]
pub struct Sequence {
    pub generator: Generator,
    pub seed: u32,
    pub stream: u32,
}

impl Sequence {
    /// `count` points of the unit square.
    pub fn square(self, count: usize) -> Vec<[f64; 2]> {
        match self.generator {
            Generator::Hammersley => self.shifted((0..count).map(|index| hammersley::square(index, count)).collect()),
            Generator::Lattice => self.shifted((0..count).map(|index| lattice::square(index, count)).collect()),
            Generator::Jittered => jittered::square(count, &mut self.random()),
            Generator::Random => {
                let mut random = self.random();
                (0..count).map(|_| [random.unit(), random.unit()]).collect()
            }
        }
    }

    /// `count` points of the unit cube.
    pub fn cube(self, count: usize) -> Vec<[f64; 3]> {
        match self.generator {
            Generator::Hammersley => self.shifted((0..count).map(|index| hammersley::cube(index, count)).collect()),
            Generator::Lattice => self.shifted((0..count).map(|index| lattice::cube(index, count)).collect()),
            Generator::Jittered => jittered::cube(count, &mut self.random()),
            Generator::Random => {
                let mut random = self.random();
                (0..count).map(|_| [random.unit(), random.unit(), random.unit()]).collect()
            }
        }
    }

    /// The source of what this sequence draws.
    pub fn random(self) -> Random {
        Random::new(self.seed.wrapping_add(self.stream.wrapping_mul(0x9e37_79b9)))
    }

    fn shifted<const D: usize>(self, mut points: Vec<[f64; D]>) -> Vec<[f64; D]> {
        if self.seed == 0 {
            return points;
        }
        let mut random = self.random();
        let shift: [f64; D] = std::array::from_fn(|_| random.unit());
        for (x, by) in points.iter_mut().flat_map(|point| point.iter_mut().zip(shift)) {
            *x = (*x + by).fract();
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        for generator in Generator::ALL {
            assert_eq!(Generator::named(generator.name()), Some(generator));
        }
        assert_eq!(Generator::named("halton"), None);
    }

    #[test]
    fn every_point_lies_in_the_square_or_cube_for_any_count_and_seed() {
        let is_inside = |x: &f64| (0.0..1.0).contains(x);
        for generator in Generator::ALL {
            for (count, seed) in [(1, 0), (2, 1), (3, 0), (7, 9), (100, 0), (1000, u32::MAX), (4096, 0)] {
                let sequence = Sequence { generator, seed, stream: 0 };
                let (square, cube) = (sequence.square(count), sequence.cube(count));
                assert_eq!([square.len(), cube.len()], [count; 2]);
                assert!(square.iter().flatten().all(is_inside) && cube.iter().flatten().all(is_inside), "{sequence:?}");
            }
        }
    }

    #[test]
    fn seeds_and_streams_differ() {
        for generator in Generator::ALL {
            let at = |seed, stream| Sequence { generator, seed, stream }.square(16);
            assert_eq!(at(1, 0), at(1, 0));
            assert_ne!(at(1, 0), at(2, 0));
            assert_ne!(at(1, 0), at(1, 1));
        }
    }
}
