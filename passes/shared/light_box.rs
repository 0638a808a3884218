//! Light samples as soft tests take them: places in their box, -1 to 1 along each axis, sixteen at a time, and that box.
//!
//! A value linear over the light, n . s + d with s the offset of a light sample from the middle, is bounded over the box by
//! |n| . half: most pairs are decided for the whole light at once. Places are s / half, taken in f64 and rounded once, so they err
//! by 2^-24 of themselves; along an axis without extent they are zero.

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

/// All light samples.
#[derive(Clone, Debug)]
pub struct LightBox<'a> {
    /// World space.
    pub samples: &'a [[f32; 3]],
    /// Middle of the box, an f32 point.
    pub middle: [f32; 3],
    /// Half extents.
    pub half: [f64; 3],
    /// Largest distance from the middle.
    pub radius: f64,
    /// Light sample l is lane l % 16 of chunk l / 16; lanes past the last repeat it. An even number of chunks.
    pub chunks: Vec<Chunk>,
}

impl<'a> LightBox<'a> {
    /// Of `samples`.
    pub fn new(samples: &'a [[f32; 3]]) -> Self {
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
        Self { samples, middle, half, radius, chunks }
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

    /// The bits of mask word `word` that stand for a light sample.
    pub fn used(&self, word: usize) -> u32 {
        u32::MAX >> (32 * (word + 1)).saturating_sub(self.samples.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
