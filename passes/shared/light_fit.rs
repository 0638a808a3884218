//! How a light frame is fitted to view-samples: direction of view, then window, near and far (Sintorn 2008, section 4.3,
//! Parametrization). [`WGSL`] tells the same story in the same order.

use crate::ports;
use crate::shared::light_frame::{Face, project, uv_pad};
use glam::{BVec4A, Vec3, Vec4};
use rayon::prelude::*;
use shadowgraph_core::input;
use shadowgraph_core::pass::{Counter, CounterKind};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::Bind::{Read, ReadWrite, Uniform};
use shadowgraph_core::record::{Bind, GpuCx, Target, Target::Port};
use shadowgraph_core::shared::{KEPT, LOOP_STEPS};

/// The same in WGSL, joined after `shared::PRELUDE` and [`crate::shared::light_frame::WGSL`].
pub const WGSL: &str = include_str!("light_fit.wgsl");

/// Largest |u| and |v| that a fitted window reaches, tangent (83 degrees off the axis). Points further out, almost beside
/// the light, go to border texels: a window that held them all would leave nothing of its resolution to the rest.
pub const LARGEST_TANGENT: f32 = 8.0;
/// Widening of a fitted window, near and far, relative; above the rounding of the projection.
pub const PAD: f32 = 1e-5;
/// Near of a face over a whole scene, at least this share of far.
pub const NEAREST: f32 = 1e-4;
/// View-samples that one kernel invocation reduces before it touches shared words.
pub const SAMPLES_PER_INVOCATION: usize = 64;
/// Words of the kernels' reduction, for each face.
pub const FIT_WORDS: usize = 6;

/// View-samples that a single face cannot place.
pub const BEHIND: Counter = Counter {
    name: "behind",
    doc: "kept view-samples that lie beside or behind the light, where a single face does not look",
    kind: CounterKind::MustBeZero("use light_frame six_faces"),
};

/// Smallest and largest of three numbers over many view-samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Smallest; above `high` when there was none.
    pub low: [f32; 3],
    /// Largest.
    pub high: [f32; 3],
}

/// Bounds over no view-sample.
pub const EMPTY: Bounds = Bounds { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

impl Bounds {
    /// Whether there was none.
    pub fn is_empty(&self) -> bool {
        self.low[0] > self.high[0]
    }
    /// Takes `values` in.
    #[inline]
    pub fn add(&mut self, values: [f32; 3]) {
        for (axis, value) in values.into_iter().enumerate() {
            self.low[axis] = self.low[axis].min(value);
            self.high[axis] = self.high[axis].max(value);
        }
    }
    /// Of both.
    pub fn union(mut self, other: Self) -> Self {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(other.low[axis]);
            self.high[axis] = self.high[axis].max(other.high[axis]);
        }
        self
    }
}

/// The one light sample, or the mean of them: their offsets from the first are averaged, so that a single one is kept as it is.
pub fn origin(light_samples: &[[f32; 3]]) -> Vec3 {
    let Some(first) = light_samples.first().copied().map(Vec3::from) else { return Vec3::ZERO };
    let sum: Vec3 = light_samples.iter().map(|sample| Vec3::from(*sample) - first).sum();
    first + sum / light_samples.len() as f32
}

/// Unit vector along `towards`; straight down where that has no direction.
fn direction(towards: Vec3) -> Vec3 {
    let largest = towards.abs().max_element();
    if !(largest > 0.0 && largest < f32::INFINITY) {
        return Vec3::NEG_Y;
    }
    let scaled = towards / largest;
    scaled / scaled.dot(scaled).sqrt()
}

/// A face at `origin` that looks along `towards`, with the widest window and no view-samples.
///
/// Axis x is the world axis most nearly across the view, made orthogonal, so that axis-aligned buildings stay aligned with
/// the window. Ties within a thousandth go to the lower axis: both backends choose equally. x, y, z is right-handed.
pub fn look(origin: Vec3, towards: Vec3) -> Face {
    let axis_z = direction(towards);
    let across = axis_z.abs();
    let mut axis = 0;
    for other in [1, 2] {
        if across[other] < across[axis] - 1e-3 {
            axis = other;
        }
    }
    let axis_x = direction(Vec3::AXES[axis] - axis_z * axis_z[axis]);
    let axis_y = axis_z.cross(axis_x);
    let window_low = [-LARGEST_TANGENT; 2];
    let window_size = [2.0 * LARGEST_TANGENT; 2];
    Face { origin, valid: false, axis_x, axis_y, axis_z, window_low, window_size, near: 1.0, far: 2.0 }
}

/// Bounds of the directions from `origin` to kept view-samples, each scaled so that its largest component is 1: on the cube
/// around the light, whose box's middle keeps single faces in front of all samples wherever their spread allows.
pub fn direction_bounds(origin: Vec3, positions: &[[f32; 3]], states: &[u32]) -> Bounds {
    let ([bounds], _) = reduce(origin, positions, states, |offset| {
        let largest = offset[0].abs().max(offset[1].abs()).max(offset[2].abs());
        [(offset.map(|component| component / largest), largest.cmpgt(Vec4::ZERO))]
    });
    bounds
}

/// Where a single face looks that is to see everything within `bounds` of directions.
pub fn middle(bounds: &Bounds) -> Vec3 {
    if bounds.is_empty() { Vec3::ZERO } else { Vec3::from(bounds.low) + Vec3::from(bounds.high) }
}

/// Bounds of (u, v, depth) of kept view-samples in front of a single face, and the number of those that are not.
pub fn window_bounds(face: &Face, positions: &[[f32; 3]], states: &[u32]) -> (Bounds, u64) {
    let ([bounds], behind) = reduce(face.origin, positions, states, |[x, y, z]| {
        let along = |axis: Vec3| axis.x * x + axis.y * y + axis.z * z;
        let depth = along(face.axis_z);
        [([along(face.axis_x) / depth, along(face.axis_y) / depth, depth], depth.cmpgt(Vec4::ZERO))]
    });
    (bounds, behind)
}

/// `face` with window, near and far fitted to `bounds` of (u, v, depth); as it was, and not valid, when they are empty.
pub fn fit(mut face: Face, bounds: &Bounds) -> Face {
    face.valid = !bounds.is_empty();
    if face.valid {
        let low = [0, 1].map(|axis| bounds.low[axis].clamp(-LARGEST_TANGENT, LARGEST_TANGENT));
        let high = [0, 1].map(|axis| bounds.high[axis].clamp(-LARGEST_TANGENT, LARGEST_TANGENT));
        let rounding = 4.0 * uv_pad(low[0].abs().max(high[0].abs()), low[1].abs().max(high[1].abs()));
        for axis in 0..2 {
            let size = high[axis] - low[axis];
            let pad = PAD * size + rounding;
            face.window_low[axis] = low[axis] - pad;
            face.window_size[axis] = size + 2.0 * pad;
        }
        face = fit_depth(face, bounds);
    }
    face
}

/// `face` with near and far fitted to the depths of `bounds`, which are not empty.
pub fn fit_depth(mut face: Face, bounds: &Bounds) -> Face {
    face.near = bounds.low[2] * (1.0 - PAD);
    face.far = (bounds.high[2] * (1.0 + PAD)).min(f32::MAX);
    face
}

/// `faces` as they look from `origin`, with windows, near and far fitted to the view-samples, and the number of kept view-samples
/// that none of them can place.
pub fn refit(faces: &[Face], origin: Vec3, positions: &[[f32; 3]], states: &[u32]) -> (Vec<Face>, u64) {
    let moved: Vec<Face> = faces.iter().map(|face| Face { origin, ..*face }).collect();
    if let [face] = moved[..] {
        let (bounds, behind) = window_bounds(&face, positions, states);
        return (vec![fit(face, &bounds)], behind);
    }
    let parts = positions.par_chunks(CHUNK).zip(states.par_chunks(CHUNK)).map(|(positions, states)| {
        let (mut bounds, mut behind) = (vec![EMPTY; moved.len()], 0);
        for (position, _) in positions.iter().zip(states).filter(|(_, state)| **state == KEPT) {
            match project(&moved, Vec3::from(*position)) {
                Some(point) => bounds[point.face].add([point.u, point.v, point.depth]),
                None => behind += 1,
            }
        }
        (bounds, behind)
    });
    let nothing = || (vec![EMPTY; moved.len()], 0);
    let (bounds, behind) =
        parts.reduce(nothing, |a, b| (a.0.iter().zip(b.0).map(|(one, other)| one.union(other)).collect(), a.1 + b.1));
    (moved.iter().zip(&bounds).map(|(face, bounds)| fit(*face, bounds)).collect(), behind)
}

/// View-samples of a rayon task.
const CHUNK: usize = 1 << 14;
/// View-samples of a step of its inner loop: those of a vector register.
const LANES: usize = 4;

/// One component of four view-samples in each vector.
pub type Lanes = [Vec4; 3];

/// Bounds over the kept view-samples of each of `N` groups, and the number of kept ones in no group. `groups` takes offsets
/// from `origin`, and gives for each group three numbers and the lanes that are in it.
pub fn reduce<const N: usize>(
    origin: Vec3,
    positions: &[[f32; 3]],
    states: &[u32],
    groups: impl Fn(Lanes) -> [(Lanes, BVec4A); N] + Sync,
) -> ([Bounds; N], u64) {
    let chunks = positions.par_chunks(CHUNK).zip(states.par_chunks(CHUNK));
    let parts = chunks.map(|(positions, states)| {
        let (whole_positions, last_positions) = positions.as_chunks::<LANES>();
        let (whole_states, last_states) = states.as_chunks::<LANES>();
        let mut padded = ([[0.0; 3]; LANES], [!KEPT; LANES]);
        padded.0[..last_positions.len()].copy_from_slice(last_positions);
        padded.1[..last_states.len()].copy_from_slice(last_states);

        let mut extremes = [([Vec4::INFINITY; 3], [Vec4::NEG_INFINITY; 3]); N];
        let mut left_out = 0u64;
        let last = std::iter::once((&padded.0, &padded.1));
        for (p, state) in whole_positions.iter().zip(whole_states).chain(last) {
            let offset: Lanes =
                std::array::from_fn(|k| Vec4::new(p[0][k], p[1][k], p[2][k], p[3][k]) - Vec4::splat(origin[k]));
            let mut rest = BVec4A::new(state[0] == KEPT, state[1] == KEPT, state[2] == KEPT, state[3] == KEPT);
            for ((values, member), (low, high)) in groups(offset).into_iter().zip(&mut extremes) {
                let taken = rest & member;
                // Neighbours share a group: most of six are empty.
                if N > 1 && !taken.any() {
                    continue;
                }
                for axis in 0..3 {
                    low[axis] = Vec4::select(taken, values[axis], Vec4::INFINITY).min(low[axis]);
                    high[axis] = Vec4::select(taken, values[axis], Vec4::NEG_INFINITY).max(high[axis]);
                }
                rest &= !member;
            }
            left_out += u64::from(rest.bitmask().count_ones());
        }
        let bounds =
            |(low, high): (Lanes, Lanes)| Bounds { low: low.map(Vec4::min_element), high: high.map(Vec4::max_element) };
        (extremes.map(bounds), left_out)
    });
    parts.reduce(|| ([EMPTY; N], 0), |a, b| (std::array::from_fn(|group| a.0[group].union(b.0[group])), a.1 + b.1))
}

/// Invocations of a reducing kernel.
pub fn invocations(sample_count: usize) -> usize {
    sample_count.div_ceil(SAMPLES_PER_INVOCATION)
}

/// Words of the uniform `FitSize` in WGSL.
pub fn uniform(sample_count: usize, light_count: usize, face_count: usize) -> Vec<u32> {
    let invocations = invocations(sample_count);
    let counts = [sample_count, light_count, invocations, face_count].map(|count| count as u32);
    [counts, [LARGEST_TANGENT.to_bits(), PAD.to_bits(), NEAREST.to_bits(), 0]].concat()
}

/// Resources of every kernel of a fitting pass, in the order of the bindings at the head of `light_fit.wgsl`, and the
/// scratch words of the reduction.
///
/// # Errors
/// More light samples than one invocation may average.
pub fn bindings(cx: &mut GpuCx, face_count: usize) -> Result<(Vec<Bind>, Target), Problem> {
    let light_count = cx.dim(input::LIGHT_SAMPLES.name, 0);
    if light_count > LOOP_STEPS {
        return Err(Problem::new(Kind::Unsupported, "too many light samples for one kernel invocation")
            .port(input::LIGHT_SAMPLES.name)
            .expected(format!("at most {LOOP_STEPS}"))
            .found(light_count.to_string())
            .remedy("run this node on the CPU"));
    }
    let sample_count = cx.dim(ports::POSITION.name, 0);
    // One group of words for directions, then one for each face's window.
    let reduction = cx.scratch("fit", FIT_WORDS * (face_count + 1));
    let bind = vec![
        Uniform(uniform(sample_count, light_count, face_count)),
        Read(Port(ports::POSITION.name)),
        Read(Port(ports::SAMPLE_STATE.name)),
        Read(Port(input::LIGHT_SAMPLES.name)),
        ReadWrite(reduction),
        ReadWrite(Port(ports::LIGHT_FRAME.name)),
    ];
    Ok((bind, reduction))
}
