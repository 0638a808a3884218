//! A torus knot above a ground square.

use super::Builtin;
use super::shapes::{COOL, LIGHT, ground, light_at, look_from};
use crate::soup::Soup;
use glam::{Vec3, vec3};
use shadowgraph_core::param::{ParamSpec, Params, Range};
use std::f32::consts::TAU;

/// `builtin:torus-knot`.
pub const SCENE: Builtin = Builtin {
    name: "torus-knot",
    doc: "a closed knotted tube above its receiver: self-shadowing on a closed two-manifold",
    params: &[
        ParamSpec {
            name: "segments",
            range: Range::U32 { min: 8, max: 8192, default: 256 },
            unit: "segments",
            doc: "along the tube",
        },
        ParamSpec {
            name: "sides",
            range: Range::U32 { min: 3, max: 256, default: 16 },
            unit: "sides",
            doc: "around the tube; two triangles each a segment",
        },
    ],
    build,
};

const TUBE_RADIUS: f32 = 0.18;

/// The middle line at `share` of the way, in 0..1: twice around the axis, three times around the ring.
fn middle(share: f32) -> Vec3 {
    let (around, through) = (2.0 * share * TAU, 3.0 * share * TAU);
    let ring = 0.9 + 0.35 * through.cos();
    vec3(ring * around.cos(), 1.1 + 0.35 * through.sin(), ring * around.sin())
}

fn build(params: &Params) -> Soup {
    let (segments, sides) = (params.u32("segments"), params.u32("sides"));
    let mut soup = Soup::default();
    ground(&mut soup, 2.5, 0.0);
    soup.start_shape();
    // The last ring is the first, bit by bit. The frame is taken from the torus's own normal, which never lies along
    // the line, so it closes without a twist.
    let point = |segment: u32, side: u32| {
        let share = (segment % segments) as f32 / segments as f32;
        let along = (middle(share + 1e-3) - middle(share - 1e-3)).normalize();
        let around = 2.0 * share * TAU;
        let outward = middle(share) - vec3(0.9 * around.cos(), 1.1, 0.9 * around.sin());
        let right = (outward - along * outward.dot(along)).normalize();
        let ahead = along.cross(right);
        let angle = (side % sides) as f32 / sides as f32 * TAU;
        let normal = right * angle.cos() + ahead * angle.sin();
        (middle(share) + TUBE_RADIUS * normal, normal.normalize())
    };
    for segment in 0..segments {
        for side in 0..sides {
            let corners = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(ahead, turn)| point(segment + ahead, side + turn));
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let [a, b, c] = [corners[a], corners[b], corners[c]];
                soup.smooth([a.0, b.0, c.0], [a.1, b.1, c.1], COOL);
            }
        }
    }
    light_at(&mut soup, LIGHT, 0.25);
    look_from(&mut soup, vec3(2.4, 3.0, 4.0), vec3(0.0, 0.8, 0.0));
    soup
}
