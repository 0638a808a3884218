//! A caster as one view-sample sees it: three planes through the view-sample and the edges, and the supporting plane, as values
//! linear over the light, with bounds on their rounding (Sintorn 2008, section 4.2).
//!
//! With P the view-sample, S = O + s a light sample, O the middle of the light, corners V_k with v_k = V_k - P, and all signs turned so
//! that w = N . v_0 > 0 for N = (V_1 - V_0) x (V_2 - V_0), the caster hides S when
//!
//! - n_k . s + n_k . (O - P) >= 0 with n_k = v_k x (V_k+1 - V_k), for k = 0, 1, 2: S is in the pyramid of P over the triangle, and
//! - N . s + N . (O - V_0) >= 0: S is not on P's side of the triangle,
//!
//! which are the conditions of [`crate::shared::predicate`]. Edge vectors are differences of corners, taken before anything else.
//! Ends of an edge are put in order by position first, and the sign of the walk around the triangle is kept apart: two triangles
//! at a shared edge have one plane, bit for bit, and opposite signs.
//!
//! Bounds. With e = 2^-53, differences of f32 taken in f64 err by at most e of themselves, a coordinate of a cross product by 8 e of
//! the product of the lengths, a constant by 32 e of the product of three. Lengths are sums of absolute coordinates.

use super::light_box::LightBox;
use super::predicate::{self, Corners};
use super::pyramid::{cross, dot, size};

/// 128 e: all of the above with room.
const ERROR: f64 = 1.45e-14;

/// How much further than the ball's radius a plane beside it passes.
const BESIDE: f64 = 1e-6;

/// Planes of one (view-sample, caster); the first three through the edges, the last the supporting plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planes {
    /// n_k and N before signs are turned.
    pub normal: [[f64; 3]; 4],
    /// Value at the middle of the light, before signs are turned.
    pub constant: [f64; 4],
    /// Bound on the error of the value anywhere in the light's box. Zero: the value is exactly zero everywhere.
    pub slack: [f64; 4],
    /// Half the range of the value over the light's box.
    pub range: [f64; 4],
    /// Whether the sign is turned.
    pub turned: [bool; 4],
    /// Whether the light's box and ball have, or may have, both sides. Elsewhere all of the light is inside.
    pub cut: [bool; 4],
}

/// What a caster hides from a view-sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hidden {
    /// Nothing.
    Nothing,
    /// The whole light.
    All,
    /// What is inside the planes that cut it.
    Within,
}

fn minus(a: [f32; 3], b: [f32; 3]) -> [f64; 3] {
    [f64::from(a[0]) - f64::from(b[0]), f64::from(a[1]) - f64::from(b[1]), f64::from(a[2]) - f64::from(b[2])]
}

/// Whether `a` comes before `b`: by x, then y, then z.
fn before(a: [f32; 3], b: [f32; 3]) -> bool {
    a < b
}

impl Planes {
    /// To be filled.
    pub const EMPTY: Self = Self {
        normal: [[0.0; 3]; 4],
        constant: [0.0; 4],
        slack: [0.0; 4],
        range: [0.0; 4],
        turned: [false; 4],
        cut: [false; 4],
    };

    /// Sets plane `k`; whether some of the light may be inside.
    #[inline(always)]
    fn set(&mut self, k: usize, light: &LightBox, normal: [f64; 3], constant: f64, slack: f64, turned: bool) -> bool {
        let range = (0..3).map(|axis| normal[axis].abs() * light.half[axis]).sum::<f64>();
        let (value, width) = (if turned { -constant } else { constant }, light.spread(normal) * (1.0 + 1e-12) + slack);
        (self.normal[k], self.constant[k], self.slack[k], self.range[k]) = (normal, constant, slack, range);
        self.turned[k] = turned;
        // An exact zero is inside.
        self.cut[k] = value <= width && slack > 0.0;
        value >= -width
    }
}

/// What `caster` hides of `light` from `position`, as far as bounds can tell; `planes` are set where it is a part.
#[inline(always)]
pub fn hidden(caster: &Corners, position: [f32; 3], light: &LightBox, planes: &mut Planes) -> Hidden {
    let [a, b, c] = *caster;
    let corners = [minus(a, position), minus(b, position), minus(c, position)];
    let lines = [minus(b, a), minus(c, a)];
    let normal = cross(lines[0], lines[1]);
    let across = size(lines[0]) * size(lines[1]);
    let w = dot(normal, corners[0]);
    let mut winding = w;
    if w.abs() <= ERROR * across * size(corners[0]) {
        winding = f64::from(predicate::side(caster, position));
    }
    if winding == 0.0 {
        return Hidden::Nothing;
    }
    let reach = light.half.iter().sum::<f64>();
    let from_light = minus(light.middle, a);
    let slack = ERROR * across * (size(from_light) + reach);
    if !planes.set(3, light, normal, dot(normal, from_light), slack, winding < 0.0) {
        return Hidden::Nothing;
    }
    let to_light = minus(light.middle, position);
    if is_beside(&corners, to_light, light.radius) {
        return Hidden::Nothing;
    }
    let far = ERROR * (size(to_light) + reach);
    for k in 0..3 {
        let next = (k + 1) % 3;
        let ordered = before(caster[k], caster[next]);
        let [from, to] = if ordered { [k, next] } else { [next, k] };
        let line = minus(caster[to], caster[from]);
        let normal = cross(corners[from], line);
        let slack = far * size(corners[from]) * size(line);
        if !planes.set(k, light, normal, dot(normal, to_light), slack, (winding < 0.0) == ordered) {
            return Hidden::Nothing;
        }
    }
    if planes.cut == [false; 4] { Hidden::All } else { Hidden::Within }
}

/// Whether a plane through the view-sample, close to the ball around the light, has the corners beyond it: all three lines of a small
/// caster may cut the light that it stands beside. Corners and the light's middle from the view-sample. Any normal would do: both sides
/// are asked, with bounds on rounding.
#[inline(always)]
fn is_beside(corners: &[[f64; 3]; 3], to_light: [f64; 3], radius: f64) -> bool {
    let [a, b, c] = corners;
    let middle = [0, 1, 2].map(|axis| a[axis] + b[axis] + c[axis]);
    let (square, along) = (dot(to_light, to_light), dot(middle, to_light));
    let across = [0, 1, 2].map(|axis| middle[axis] * square - to_light[axis] * along);
    let (tilt, rest) = (radius * (1.0 + BESIDE), square - radius * radius * (1.0 + 3.0 * BESIDE));
    if rest <= 0.0 {
        return false;
    }
    let share = tilt * (dot(across, across) / (square * rest)).sqrt();
    let normal = [0, 1, 2].map(|axis| across[axis] - to_light[axis] * share);
    let beyond = |corner: &[f64; 3]| dot(normal, *corner) > ERROR * size(normal) * size(*corner);
    let light_side = dot(normal, to_light) + radius * dot(normal, normal).sqrt() * (1.0 + 1e-12);
    beyond(a) && beyond(b) && beyond(c) && light_side < -ERROR * size(normal) * size(to_light)
}

/// A plane's sides of the light: -1 or 1 where all of it is on one, 0 where both sides or neither may be.
pub fn side_of_light(corners: &Corners, light: &LightBox) -> i32 {
    let [a, b, c] = *corners;
    let lines = [minus(b, a), minus(c, a)];
    let (normal, from_light) = (cross(lines[0], lines[1]), minus(light.middle, a));
    // det(a - S, b - S, c - S) = N . (a - S).
    let value = -dot(normal, from_light);
    let reach = light.half.iter().sum::<f64>();
    let width =
        light.spread(normal) * (1.0 + 1e-12) + ERROR * size(lines[0]) * size(lines[1]) * (size(from_light) + reach);
    i32::from(value > width) - i32::from(value < -width)
}

#[cfg(test)]
#[path = "view_planes_tests.rs"]
mod tests;
