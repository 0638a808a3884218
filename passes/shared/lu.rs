//! Look-up tables from a plane to light samples: which bin a plane falls in, and what the words of a layout say.
//!
//! A plane is value(s) = n . s + d over offsets s from the middle of the light; a bit is set where the value is not below zero.
//! With R the largest |s|, its coordinates are
//!
//! - theta = atan2(sqrt(nx^2 + ny^2), nz) in [0, pi], phi = atan2(ny, nx) in [-pi, pi] and t = d / (|n| R) in [-1, 1]; or
//! - for a light in the plane of axes X and Y, at N . s = h along its normal N, phi = atan2(n.Y, n.X) and
//!   t = (d + (n.N) h) / (|(n.X, n.Y)| R). The middle of a tilted light's box is off its plane by h.
//!
//! `size` bins of equal width along each, an even number: the opposite plane falls in the mirrored bin (theta and t from the
//! other end, phi half a turn on), whose bits are the complement. Bins are counted along theta, phi, t, the last fastest; t past
//! -1 or 1 takes no bin, for all light samples are on one side.
//!
//! [`angle`] takes the place of atan2 on both backends and errs by less than [`ANGLE_ERROR`].

use super::light_box::LightBox;
use super::view_planes::Planes;
use shadowgraph_core::array::Array;
use shadowgraph_core::problem::{Kind, Problem};
use std::f32::consts::{FRAC_PI_2, PI};

/// Light samples of a block.
pub const BLOCK: usize = 128;
/// Words of `lu_layout`.
pub const LAYOUT_WORDS: usize = 16;
/// Bound on the error of [`angle`], radians.
pub const ANGLE_ERROR: f32 = 2e-5;
/// How far past -1 or 1 a t may lie and still take the last bin: rounding must not put a light sample at the very end aside.
const PAST_END: f64 = 1e-4;
/// Largest table the CPU functions make.
pub const MOST_CPU_BYTES: u64 = 1 << 31;

/// What `lu_layout` says. Words: middle xyz, R, axis X xyz, 0, axis Y xyz, 0, normal N xyz, h; all from the axes on are zero but
/// for planar lights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Middle of the light's box, world space.
    pub middle: [f32; 3],
    /// R, scene units.
    pub radius: f32,
    /// X, Y and their normal for a planar light.
    pub axes: [[f32; 3]; 3],
    /// h, from the middle to the plane of a planar light along its normal, scene units.
    pub height: f32,
}

impl Layout {
    /// That of `light`, without axes.
    pub fn new(light: &LightBox) -> Self {
        let far = |sample: &[f32; 3]| {
            (0..3).map(|k| (f64::from(sample[k]) - f64::from(light.middle[k])).powi(2)).sum::<f64>().sqrt()
        };
        let radius = light.samples.iter().map(far).fold(0.0, f64::max) as f32;
        Self { middle: light.middle, radius, axes: [[0.0; 3]; 3], height: 0.0 }
    }

    /// From its words.
    pub fn from_words(words: &[f32]) -> Self {
        let vector = |start: usize| [words[start], words[start + 1], words[start + 2]];
        Self { middle: vector(0), radius: words[3], axes: [4, 8, 12].map(vector), height: words[15] }
    }

    /// Its words.
    pub fn to_words(&self) -> Vec<f32> {
        let [x, y, z] = self.middle;
        let mut words = vec![x, y, z, self.radius];
        words.extend(self.axes.iter().flat_map(|[x, y, z]| [*x, *y, *z, 0.0]));
        words[15] = self.height;
        words
    }

    /// Offsets of `sample` from the middle over R; zero for a light without extent.
    pub fn offset(&self, sample: [f32; 3]) -> [f32; 3] {
        let inverse = if self.radius > 0.0 { 1.0 / f64::from(self.radius) } else { 0.0 };
        [0, 1, 2].map(|k| ((f64::from(sample[k]) - f64::from(self.middle[k])) * inverse) as f32)
    }
}

/// Even number of bins for the parameter `size`.
pub fn even(size: u32) -> usize {
    size.next_multiple_of(2) as usize
}

/// Refuses a table of `shape` that does not fit `available` bytes.
///
/// # Errors
/// Names needed and available bytes and, as remedy, the largest size that fits.
pub fn check_bytes(shape: &[usize; 5], available: u64) -> Result<(), Problem> {
    let bytes = |size: u64| {
        let bins = if shape[3] == 1 { size.pow(2) } else { size.pow(3) };
        4 * shape[0] as u64 * bins * shape[4] as u64
    };
    let size = shape[1] as u64;
    if bytes(size) <= available {
        return Ok(());
    }
    let fitting = (32..size).rev().find(|size| size % 2 == 0 && bytes(*size) <= available);
    let remedy = match fitting {
        Some(fitting) => format!("set `size` to {fitting} or less, or take fewer light samples"),
        None => "take fewer light samples, or test by arithmetic (visibility=half_planes)".to_string(),
    };
    Err(Problem::new(Kind::Unsupported, "the look-up table is too large")
        .port("lu")
        .expected(format!("at most {available} bytes"))
        .found(format!("{} bytes for size {size} and {} blocks of 128 light samples", bytes(size), shape[0]))
        .remedy(remedy))
}

/// atan2(y, x) to within [`ANGLE_ERROR`], in [-pi, pi]; 0 at the origin.
#[inline(always)]
pub fn angle(y: f32, x: f32) -> f32 {
    let (small, large) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    let q = if large > 0.0 { small / large } else { 0.0 };
    let z = q * q;
    // Abramowitz, Stegun 4.4.49, as a polynomial in the square.
    let poly = 0.999_866 + z * (-0.330_299_5 + z * (0.180_141 + z * (-0.085_133 + z * 0.020_835_1)));
    let turn = q * poly;
    let turn = if y.abs() > x.abs() { FRAC_PI_2 - turn } else { turn };
    let turn = if x < 0.0 { PI - turn } else { turn };
    if y < 0.0 { -turn } else { turn }
}

/// The bin of `share`, in [0, 1], of `size`.
#[inline(always)]
pub fn bin(share: f32, size: usize) -> usize {
    // A negative share converts to zero.
    ((share * size as f32) as usize).min(size - 1)
}

/// Bins of a direction: theta, phi.
#[inline(always)]
pub fn direction_bins([x, y, z]: [f32; 3], size: usize) -> [usize; 2] {
    let theta = angle((x * x + y * y).sqrt(), z);
    let phi = angle(y, x);
    [bin(theta / PI, size), bin(phi / (2.0 * PI) + 0.5, size)]
}

/// Bin of the direction of a line's normal in the light's plane.
#[inline(always)]
pub fn line_bin([x, y]: [f32; 2], size: usize) -> usize {
    bin(angle(y, x) / (2.0 * PI) + 0.5, size)
}

/// Bins that the planes of one pair look up.
#[derive(Clone, Copy, Debug)]
pub struct Bins {
    /// How many.
    pub count: usize,
    /// Bin within a block.
    pub bin: [usize; 4],
    /// All bits set where a plane is turned: its bits are the complement.
    pub turned: [u32; 4],
    /// Some plane has all of the light outside.
    pub is_outside: bool,
}

impl Bins {
    /// The bins of the planes that cut the light; `locate` gives of a plane's normal the bins before the last, its length, and what the
    /// constant grows by.
    #[inline(always)]
    pub fn of(planes: &Planes, radius: f32, size: usize, locate: impl Fn([f64; 3]) -> (usize, f64, f64)) -> Self {
        let mut bins = Self { count: 0, bin: [0; 4], turned: [0; 4], is_outside: false };
        for k in (0..4).filter(|k| planes.cut[*k]) {
            let (row, length, shift) = locate(planes.normal[k]);
            let (constant, reach) = (planes.constant[k] + shift, length * f64::from(radius));
            if constant.abs() >= reach * (1.0 + PAST_END) {
                // An exact zero is inside, from whichever side it is seen.
                bins.is_outside |= constant != 0.0 && (constant < 0.0) != planes.turned[k];
                continue;
            }
            let share = (0.5 + 0.5 * constant / reach) as f32;
            bins.bin[bins.count] = row * size + bin(share, size);
            bins.turned[bins.count] = if planes.turned[k] { u32::MAX } else { 0 };
            bins.count += 1;
        }
        bins
    }

    /// As [`Bins::of`], for a table over two angles and a distance.
    #[inline(always)]
    pub fn angles_distance(planes: &Planes, layout: &Layout, size: usize) -> Self {
        Self::of(planes, layout.radius, size, |normal| {
            let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
            let inverse = if length > 0.0 { 1.0 / length } else { 0.0 };
            let [theta, phi] = direction_bins(normal.map(|x| (x * inverse) as f32), size);
            (theta * size + phi, length, 0.0)
        })
    }
}

/// The table that a pass of stage `visibility` reads.
pub struct Table<'a> {
    /// Bins along each coordinate.
    pub size: usize,
    /// Words a bin.
    pub entry_words: usize,
    /// Words a block.
    pub block_words: usize,
    /// All words.
    pub words: &'a [u32],
    /// Layout.
    pub layout: Layout,
}

/// What a table's shape must end in, by the pass of stage `lu_table` that makes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Form {
    /// Pass.
    pub pass: &'static str,
    /// Whether bins run along a third coordinate.
    pub is_solid: bool,
    /// Words a bin.
    pub entry_words: usize,
}

impl Form {
    /// Whether `shape` has this form.
    ///
    /// # Errors
    /// No table, or one of another pass.
    pub fn check(&self, shape: Option<&[usize]>) -> Result<(), Problem> {
        let fits =
            |shape: &[usize]| shape.len() == 5 && (shape[3] > 1) == self.is_solid && shape[4] == self.entry_words;
        if shape.is_some_and(fits) {
            return Ok(());
        }
        let found = shape.map_or("nothing connected".to_string(), |shape| format!("a table of shape {shape:?}"));
        Err(Problem::new(Kind::BadValue, "this pass looks up another table")
            .port("lu")
            .expected(format!("the table of lu_table/{}", self.pass))
            .found(found)
            .remedy(format!("give the graph a node of stage lu_table with pass {}", self.pass)))
    }
}

impl<'a> Table<'a> {
    /// From the ports `lu` and `lu_layout`.
    ///
    /// # Errors
    /// As [`Form::check`]; a table for other light samples.
    pub fn new(
        form: Form,
        lu: Option<&'a Array>,
        layout: Option<&'a Array>,
        light_sample_count: usize,
    ) -> Result<Self, Problem> {
        form.check(lu.map(Array::shape))?;
        let (Some(lu), Some(layout)) = (lu, layout) else { return Err(missing_layout()) };
        if lu.dim(0) != light_sample_count.div_ceil(BLOCK) {
            return Err(Problem::new(Kind::BadValue, "the look-up table is of other light samples")
                .port("lu")
                .expected(format!("{} blocks of 128 light samples", light_sample_count.div_ceil(BLOCK)))
                .found(lu.dim(0).to_string()));
        }
        Ok(Self {
            size: lu.dim(1),
            entry_words: lu.dim(4),
            block_words: lu.dim(1) * lu.dim(2) * lu.dim(3) * lu.dim(4),
            words: lu.as_u32(),
            layout: Layout::from_words(layout.as_f32()),
        })
    }

    /// Where the entry of `bin` for mask word `word` starts, at the block's own word.
    #[inline(always)]
    pub fn place(&self, bin: usize, word: usize) -> usize {
        word / 4 * self.block_words + bin * self.entry_words + word % 4
    }
}

/// A table without its layout.
pub fn missing_layout() -> Problem {
    Problem::new(Kind::BadValue, "a look-up table needs its layout")
        .port("lu_layout")
        .expected("lu_layout of the node that makes lu")
        .found("nothing connected")
}

#[cfg(test)]
#[path = "lu_tests.rs"]
mod tests;
