//! The same scene changed by one number: scaled, moved away, lifted off its receiver, divided finer, opened. What sequences that
//! look for the limits of a method are made of.
//!
//! Numbers are computed in f64 and rounded once, and equal corners stay equal, so closed meshes stay closed.

use crate::place::View;
use crate::random::Random;
use crate::soup::{Soup, geometric_normal};
use glam::{DVec3, Vec3};
use shadowgraph_core::scene::{Camera, Light, Scene, flag};

/// A change of a scene and its view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Variation {
    /// Everything times this number, about the origin.
    Scaled(f64),
    /// Everything moved by this vector, scene units.
    Moved([f64; 3]),
    /// Every shape but the first, which receives, moved up by this much, scene units.
    Lifted(f64),
    /// Every triangle cut at the middles of its edges into four, so many times: the same surface but for rounding.
    Divided(u32),
    /// Every triangle of every shape but the first left out with this chance; what a smaller chance leaves out stays left out.
    Opened(f64),
}

impl Variation {
    /// The changed scene, not finished yet: what is closed is found anew.
    pub fn soup(self, mut soup: Soup) -> Soup {
        let first = soup.shapes.first().copied();
        match self {
            Self::Scaled(_) | Self::Moved(_) => {
                soup.positions.iter_mut().flatten().for_each(|corner| *corner = self.point(*corner));
                soup.cameras = soup.cameras.into_iter().map(|camera| self.camera(camera)).collect();
                soup.lights = soup.lights.into_iter().map(|light| self.light(light)).collect();
            }
            Self::Lifted(by) => {
                for (corners, shape) in soup.positions.iter_mut().zip(&soup.shapes) {
                    if Some(*shape) != first {
                        *corners = corners.map(|[x, y, z]| [x, (f64::from(y) + by) as f32, z]);
                    }
                }
            }
            Self::Divided(times) => (0..times).for_each(|_| divide(&mut soup)),
            Self::Opened(chance) => {
                let mut random = Random::new(1);
                let stays: Vec<bool> =
                    soup.shapes.iter().map(|shape| random.unit() >= chance || Some(*shape) == first).collect();
                retain(&mut soup.positions, &stays);
                retain(&mut soup.normals, &stays);
                retain(&mut soup.looks, &stays);
                retain(&mut soup.shapes, &stays);
            }
        }
        soup
    }

    /// The changed view.
    pub fn view(self, view: View) -> View {
        View {
            camera: self.camera(view.camera),
            light: self.light(view.light),
            rect_corners: view.rect_corners.map(|corners| corners.map(|corner| self.point(corner))),
            note: view.note,
        }
    }

    fn camera(self, camera: Camera) -> Camera {
        Camera { eye: self.point(camera.eye), target: self.point(camera.target), ..camera }
    }

    fn light(self, light: Light) -> Light {
        let moved = self.point(light.position);
        let radius = f64::from(light.radius);
        let light = light.moved_to(moved);
        match self {
            Self::Scaled(by) if radius > 0.0 => light.with_radius((radius * by) as f32),
            _ => light,
        }
    }

    fn point(self, point: [f32; 3]) -> [f32; 3] {
        let wide = Vec3::from(point).as_dvec3();
        let changed = match self {
            Self::Scaled(by) => wide * by,
            Self::Moved(by) => wide + DVec3::from(by),
            Self::Lifted(_) | Self::Divided(_) | Self::Opened(_) => return point,
        };
        changed.as_vec3().to_array()
    }
}

/// Flags every triangle as part of a closed mesh, whatever it is: a wrong flag, to show what it does.
pub fn say_closed(scene: &mut Scene) {
    scene.flags.iter_mut().for_each(|flags| *flags |= flag::CLOSED);
    scene.notes.push("every triangle is said to be part of a closed mesh, which is not so".into());
}

fn retain<T>(rows: &mut Vec<T>, stays: &[bool]) {
    let mut stays = stays.iter();
    rows.retain(|_| stays.next().is_none_or(|stays| *stays));
}

fn divide(soup: &mut Soup) {
    let triangles = soup.positions.len();
    let (mut positions, mut normals) = (Vec::with_capacity(4 * triangles), Vec::with_capacity(4 * triangles));
    for (corners, normal) in soup.positions.iter().zip(&soup.normals) {
        let middles = between(corners, |sum| sum / 2.0);
        let flat = Vec3::from(geometric_normal(*corners)).as_dvec3();
        let turned = between(normal, |sum| sum.normalize_or(flat));
        for [a, b, c] in [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]] {
            let pick = |corners: &[[f32; 3]; 3], middles: &[[f32; 3]; 3]| {
                [a, b, c].map(|index| if index < 3 { corners[index] } else { middles[index - 3] })
            };
            positions.push(pick(corners, &middles));
            normals.push(pick(normal, &turned));
        }
    }
    soup.looks = soup.looks.iter().flat_map(|look| [*look; 4]).collect();
    soup.shapes = soup.shapes.iter().flat_map(|shape| [*shape; 4]).collect();
    (soup.positions, soup.normals) = (positions, normals);
}

/// What `of` makes of the sums of corners 0 and 1, 1 and 2, 2 and 0. A sum does not depend on the order of its two numbers, so
/// that neighbours get the same bits.
fn between(corners: &[[f32; 3]; 3], of: impl Fn(DVec3) -> DVec3) -> [[f32; 3]; 3] {
    let wide = corners.map(|corner| Vec3::from(corner).as_dvec3());
    [[0, 1], [1, 2], [2, 0]].map(|[from, to]| of(wide[from] + wide[to]).as_vec3().to_array())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{builtin, choose_view};

    fn soup(name: &str) -> Soup {
        builtin::soup(name).unwrap()
    }

    fn finished(name: &str, variation: Variation) -> Scene {
        variation.soup(soup(name)).finish(name)
    }

    fn area(scene: &Scene) -> f64 {
        scene.positions.iter().map(|corners| crate::soup::area_vector(corners).length() / 2.0).sum()
    }

    #[test]
    fn scaling_and_moving_take_camera_and_light_along() {
        let scene = builtin::build("half-plane").unwrap();
        let view = choose_view(&scene, "builtin:half-plane", None, None).unwrap();
        let scaled = Variation::Scaled(2.0).view(view.clone());
        assert_eq!(scaled.camera.eye, view.camera.eye.map(|x| 2.0 * x));
        assert_eq!((scaled.light.position, scaled.light.radius), ([0.0, 6.0, 0.0], 2.0 * view.light.radius));
        let moved = Variation::Moved([1.0, 0.0, -1.0]).view(view.clone());
        assert_eq!((moved.light.position, moved.light.radius), ([1.0, 3.0, -1.0], view.light.radius));
        let scene = finished("half-plane", Variation::Scaled(2.0));
        assert_eq!((scene.bounds().unwrap()[0][1], scene.bounds().unwrap()[1][1]), (0.0, 2.4));
        assert_eq!(scene.lights[0], scaled.light);
    }

    #[test]
    fn closed_meshes_stay_closed_when_scaled_moved_lifted_and_divided() {
        let closed = builtin::build("contact").unwrap().closed_parts_count;
        let variations = [
            Variation::Scaled(1e-3),
            Variation::Scaled(1e4),
            Variation::Moved([1e4, 3e3, -5e3]),
            Variation::Lifted(0.1),
            Variation::Divided(2),
        ];
        for variation in variations {
            let scene = finished("contact", variation);
            assert_eq!((scene.closed_parts_count, closed), (closed, 3), "{variation:?}");
        }
    }

    #[test]
    fn lifting_moves_all_but_the_ground() {
        let scene = finished("contact", Variation::Lifted(0.25));
        assert_eq!(scene.positions[0][0][1], 0.0);
        let lowest = scene.positions[2..].iter().flatten().map(|corner| corner[1]).fold(f32::INFINITY, f32::min);
        assert_eq!(lowest, 0.25);
    }

    #[test]
    fn dividing_keeps_the_surface() {
        let (plain, fine) = (soup("contact").finish("a"), finished("contact", Variation::Divided(2)));
        assert_eq!(fine.triangle_count(), 16 * plain.triangle_count());
        assert!((area(&fine) - area(&plain)).abs() < 1e-6 * area(&plain));
    }

    #[test]
    fn opening_leaves_out_ever_more_and_never_the_ground() {
        let counts = [0.0, 0.1, 0.5].map(|chance| finished("contact", Variation::Opened(chance)).triangle_count());
        assert!(counts[0] == 38 && counts[1] < 38 && counts[2] < counts[1], "{counts:?}");
        let nothing = finished("contact", Variation::Opened(1.0));
        assert_eq!((nothing.triangle_count(), nothing.closed_parts_count), (2, 0));
        let (some, fewer) = (finished("contact", Variation::Opened(0.2)), finished("contact", Variation::Opened(0.4)));
        assert!(fewer.positions.iter().all(|corners| some.positions.contains(corners)));
    }

    #[test]
    fn a_wrong_flag_is_on_all_and_noted() {
        let mut scene = builtin::build("open").unwrap();
        say_closed(&mut scene);
        assert!(scene.flags.iter().all(|flags| flags & flag::CLOSED != 0) && !scene.notes.is_empty());
    }
}
