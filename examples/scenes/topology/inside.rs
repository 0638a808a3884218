//! Closed parts around a point: for view-samples inside of them light-back-facing triangles alone do not decide.

use super::parts::weld;
use glam::{DVec3, Vec3};
use shadowgraph_core::scene::{Scene, flag};

/// A point counts as inside from this winding number on: outside is 0, inside 1, and sums of angles are not exact.
const INSIDE: f64 = 0.25;

/// Takes [`flag::CLOSED`] off the parts that `eye` lies in, and returns how many these were. What a camera outside of
/// every closed part sees lies outside of them too, so this is all that light-back-facing culling needs.
pub fn open_parts_around(scene: &mut Scene, eye: [f32; 3]) -> usize {
    let closed: Vec<u32> =
        (0..scene.triangle_count() as u32).filter(|row| scene.flags[*row as usize] & flag::CLOSED != 0).collect();
    // Parts that touch in a vertex are one here, which opens more than it must, never less.
    let welded = weld(&scene.positions, &closed, |_| 0);
    let mut winding = vec![0.0; welded.closed.len()];
    let eye = Vec3::from(eye).as_dvec3();
    for (&triangle, &part) in closed.iter().zip(&welded.part_of) {
        let corners = scene.positions[triangle as usize].map(|corner| Vec3::from(corner).as_dvec3() - eye);
        winding[part as usize] += solid_angle(corners) / (4.0 * std::f64::consts::PI);
    }
    for (&triangle, &part) in closed.iter().zip(&welded.part_of) {
        if winding[part as usize].abs() > INSIDE {
            scene.flags[triangle as usize] &= !flag::CLOSED;
        }
    }
    let opened = winding.iter().filter(|winding| winding.abs() > INSIDE).count();
    if opened > 0 {
        scene.notes.push(format!("the camera is inside {opened} closed parts: all their triangles cast"));
    }
    opened
}

/// Takes [`flag::CLOSED`] off every part: for view-samples that come from elsewhere and may lie inside of anything.
pub fn open_all_parts(scene: &mut Scene) {
    let closed = scene.flags.iter().filter(|flags| **flags & flag::CLOSED != 0).count();
    if closed > 0 {
        scene.flags.iter_mut().for_each(|flags| *flags &= !flag::CLOSED);
        scene.notes.push(format!("view-samples are imported: all {closed} triangles of closed parts cast"));
    }
}

/// Signed solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983, equation 8); infinite from a
/// point of the triangle itself, which so counts as inside.
fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    let volume = a.dot(b.cross(c));
    if volume == 0.0 && below <= 0.0 { f64::INFINITY } else { 2.0 * volume.atan2(below) }
}
