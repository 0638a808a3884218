//! Light samples as soft tests take them: places in their box, -1 to 1 along each axis, sixteen at a time, and that box.
//!
//! A value linear over the light, n . s + d with s the offset of a light sample from the middle, is bounded over the box by
//! |n| . half: most pairs are decided for the whole light at once. Places are s / half, taken in f64 and rounded once, so they err
//! by 2^-24 of themselves; along an axis without extent they are zero.

use std::borrow::Cow;

/// Light samples of a chunk; two chunks make a mask word.
pub const LANES: usize = 16;

/// Places of sixteen light samples.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Chunk {
    /// Along x.
    pub x: [f32; LANES],
    /// Along y.
    pub y: [f32; LANES],
    /// Along z.
    pub z: [f32; LANES],
}

/// Boxes of sixteen chunks, in places.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub struct Groups {
    /// Middles, by axis.
    pub middle: [[f32; LANES]; 3],
    /// Half extents, by axis, rounded up.
    pub half: [[f32; LANES]; 3],
}

/// All light samples.
#[derive(Clone, Debug)]
pub struct LightBox<'a> {
    /// World space, in the order of the bits that tests work with.
    pub samples: Cow<'a, [[f32; 3]]>,
    /// The light sample at each place of that order; none where it is theirs.
    pub order: Option<Vec<u32>>,
    /// Middle of the box, an f32 point.
    pub middle: [f32; 3],
    /// Half extents.
    pub half: [f64; 3],
    /// Largest distance from the middle.
    pub radius: f64,
    /// Light sample l is lane l % 16 of chunk l / 16; lanes past the last repeat it. An even number of chunks.
    pub chunks: Vec<Chunk>,
    /// Chunk c is lane c % 16 of group c / 16.
    pub groups: Vec<Groups>,
}

impl<'a> LightBox<'a> {
    /// Of `samples`, put in an order in which the sixteen of a chunk lie close together: a small caster then meets few chunks.
    pub fn clustered(samples: &'a [[f32; 3]]) -> Self {
        let mut order: Vec<u32> = (0..samples.len() as u32).collect();
        cluster(&mut order, samples);
        let samples: Vec<[f32; 3]> = order.iter().map(|index| samples[*index as usize]).collect();
        Self { order: Some(order), ..Self::of(Cow::Owned(samples)) }
    }

    /// Of `samples` as they are ordered.
    pub fn new(samples: &'a [[f32; 3]]) -> Self {
        Self::of(Cow::Borrowed(samples))
    }

    fn of(samples: Cow<'a, [[f32; 3]]>) -> Self {
        let axis = |k: usize| samples.iter().map(move |sample| sample[k]);
        let middle = [0, 1, 2].map(|k| {
            let (low, high) = (axis(k).fold(f32::MAX, f32::min), axis(k).fold(f32::MIN, f32::max));
            if low <= high { (0.5 * f64::from(low) + 0.5 * f64::from(high)) as f32 } else { 0.0 }
        });
        let offset = |sample: &[f32; 3]| [0, 1, 2].map(|k| f64::from(sample[k]) - f64::from(middle[k]));
        let half = [0, 1, 2].map(|k| samples.iter().map(|sample| offset(sample)[k].abs()).fold(0.0, f64::max));
        let length = |[x, y, z]: [f64; 3]| (x * x + y * y + z * z).sqrt();
        let radius = samples.iter().map(|sample| length(offset(sample))).fold(0.0, f64::max);
        let words = samples.len().div_ceil(32);
        let mut chunks = vec![Chunk::default(); 2 * words];
        for place in 0..32 * words {
            let offset = offset(&samples[place.min(samples.len() - 1)]);
            let [x, y, z] = [0, 1, 2].map(|k| if half[k] > 0.0 { (offset[k] / half[k]) as f32 } else { 0.0 });
            let (chunk, lane) = (&mut chunks[place / LANES], place % LANES);
            (chunk.x[lane], chunk.y[lane], chunk.z[lane]) = (x, y, z);
        }
        let groups = chunks.chunks(LANES).map(groups_of).collect();
        Self { samples, order: None, middle, half, radius, chunks, groups }
    }

    /// Words of a mask.
    pub fn words(&self) -> usize {
        self.chunks.len() / 2
    }

    /// Half the range of n . s over the light: over its box, or over the ball around it where that is less.
    #[inline(always)]
    pub fn spread(&self, [x, y, z]: [f64; 3]) -> f64 {
        let of_box = x.abs() * self.half[0] + y.abs() * self.half[1] + z.abs() * self.half[2];
        of_box.min((x * x + y * y + z * z).sqrt() * self.radius)
    }

    /// Writes a mask in the order of the light samples: `mask` is in the order of the tests, `out` of zeros.
    pub fn restore(&self, mask: &[u32], out: &mut [u32]) {
        let Some(order) = &self.order else { return out.copy_from_slice(mask) };
        let is_full = |word: usize| mask[word] == self.used(word);
        if mask.iter().all(|word| *word == 0) || (0..mask.len()).all(is_full) {
            return out.copy_from_slice(mask);
        }
        for (word, bits) in mask.iter().enumerate() {
            let mut bits = *bits;
            while bits != 0 {
                let place = 32 * word + bits.trailing_zeros() as usize;
                bits &= bits - 1;
                out[order[place] as usize / 32] |= 1 << (order[place] % 32);
            }
        }
    }

    /// The bits of mask word `word` that stand for a light sample.
    pub fn used(&self, word: usize) -> u32 {
        u32::MAX >> (32 * (word + 1)).saturating_sub(self.samples.len())
    }
}

/// Splits `order` at the middle of the longest side of its box, on a border of chunks, until each chunk stands alone.
fn cluster(order: &mut [u32], samples: &[[f32; 3]]) {
    if order.len() <= LANES {
        return;
    }
    let extent = |axis: usize| {
        let along = order.iter().map(|index| samples[*index as usize][axis]);
        along.clone().fold(f32::MIN, f32::max) - along.fold(f32::MAX, f32::min)
    };
    let extents = [0, 1, 2].map(extent);
    let axis = (0..3).max_by(|a, b| extents[*a].total_cmp(&extents[*b])).unwrap_or(0);
    // Ties by index: the same order on every run.
    let key = |index: &u32| (samples[*index as usize][axis], *index);
    order.sort_unstable_by(|a, b| key(a).0.total_cmp(&key(b).0).then(a.cmp(b)));
    let (low, high) = order.split_at_mut((order.len() / 2).next_multiple_of(LANES));
    cluster(low, samples);
    cluster(high, samples);
}

/// Boxes of up to sixteen chunks.
fn groups_of(chunks: &[Chunk]) -> Groups {
    let mut groups = Groups::default();
    for (lane, chunk) in chunks.iter().enumerate() {
        for (axis, along) in [&chunk.x, &chunk.y, &chunk.z].into_iter().enumerate() {
            let (low, high) =
                (along.iter().copied().fold(f32::MAX, f32::min), along.iter().copied().fold(f32::MIN, f32::max));
            let middle = 0.5 * low + 0.5 * high;
            groups.middle[axis][lane] = middle;
            // Places are at most 1: rounding of the two differences is below this.
            groups.half[axis][lane] = (high - middle).max(middle - low) + 2.0 * f32::EPSILON;
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clusters_are_small_and_restoring_undoes_the_order() {
        let samples: Vec<[f32; 3]> = (0..256).map(|k| [(k % 16) as f32, (k / 16) as f32, 0.0]).collect();
        let light = LightBox::clustered(&samples);
        let order = light.order.clone().unwrap();
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..256));
        let widest = light.groups[0].half[0].iter().fold(0.0f32, |most, half| most.max(*half));
        assert!(widest < 0.3, "{widest}");
        let mut mask = vec![0; 8];
        for place in [3, 77, 130] {
            mask[place / 32] |= 1 << (place % 32);
        }
        let mut out = vec![0; 8];
        light.restore(&mask, &mut out);
        let expected = |index: usize| [3, 77, 130].iter().any(|place| order[*place] as usize == index);
        assert!((0..256).all(|index| (out[index / 32] >> (index % 32) & 1 == 1) == expected(index)));
    }

    #[test]
    fn the_box_holds_every_sample_and_the_last_repeats() {
        let samples = [[1.0, 2.0, 3.0], [3.0, 2.0, 5.0], [2.0, 2.5, 9.0]];
        let light = LightBox::new(&samples);
        assert_eq!((light.middle, light.half), ([2.0, 2.25, 6.0], [1.0, 0.25, 3.0]));
        assert_eq!((light.words(), light.used(0)), (1, 0b111));
        assert_eq!(light.chunks[1].z[15], 1.0);
        assert_eq!((light.chunks[0].x[0], light.chunks[0].y[1]), (-1.0, -1.0));
    }

    #[test]
    fn no_sample_makes_no_word() {
        let light = LightBox::new(&[]);
        assert_eq!((light.words(), light.half), (0, [0.0; 3]));
    }

    #[test]
    fn used_bits_end_with_the_samples() {
        let light = [[0.0; 3]; 33];
        let light = LightBox::new(&light);
        assert_eq!([light.used(0), light.used(1)], [u32::MAX, 1]);
    }
}
