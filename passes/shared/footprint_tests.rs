use super::*;
use crate::shared::hard_scenes::{Random, random};
use crate::shared::light_frame;
use crate::shared::pyramid::{LightSpace, Reach};
use glam::Vec3;

/// Looks along +z from the origin; the window is [-1, 1] x [-1, 1].
fn face() -> Face {
    Face {
        origin: Vec3::ZERO,
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Y,
        axis_z: Vec3::Z,
        window_low: [-1.0; 2],
        window_size: [2.0; 2],
        near: 1.0,
        far: 10.0,
    }
}

fn touched(face: &Face, side: usize, reach: Option<[[f32; 2]; 2]>, caster: [[f32; 3]; 3]) -> Vec<[usize; 2]> {
    let grid = Grid::new(face, side, reach);
    let space = LightSpace::new(face);
    if grid.is_beside(&space.corners(&caster)) {
        return Vec::new();
    }
    let Reach::Cone(cone) = space.reach(&caster) else {
        return Vec::new();
    };
    let Some(footprint) = Footprint::new(&cone, &grid) else {
        return Vec::new();
    };
    let rows = footprint.rows[0]..=footprint.rows[1];
    let span = |row| footprint.span(&grid, row).map(|[first, last]| (first..=last).map(move |column| [column, row]));
    rows.filter_map(span).flatten().collect()
}

#[test]
fn a_right_triangle_touches_the_cells_under_it() {
    // Corners at (-0.9, -0.9), (0.8, -0.9), (-0.9, 0.8) in texels of 0.5: all cells but those above the diagonal.
    let caster = [[-0.9, -0.9, 1.0], [0.8, -0.9, 1.0], [-0.9, 0.8, 1.0]];
    let cells = touched(&face(), 4, None, caster);
    let expected: Vec<[usize; 2]> = (0..4).flat_map(|row| (0..4 - row).map(move |column| [column, row])).collect();
    assert_eq!(cells, expected);
}

#[test]
fn beyond_all_view_samples_and_outside_their_reach_nothing_is_touched() {
    let caster = |x: f32, z: f32| [[x, 0.1, z], [x + 0.1, 0.1, z], [x, 0.2, z]];
    assert_eq!(touched(&face(), 4, None, caster(0.1, 1.0)), [[2, 2]]);
    assert!(touched(&face(), 4, None, caster(0.1, 11.0)).is_empty());
    // Left of the window: the border column reaches there unless view-samples are known not to.
    assert_eq!(touched(&face(), 4, None, caster(-3.0, 1.0)), [[0, 2]]);
    assert!(touched(&face(), 4, Some([[-1.0, 1.0]; 2]), caster(-3.0, 1.0)).is_empty());
}

#[test]
fn a_triangle_through_the_plane_of_the_light_is_cut_there() {
    // A strip along z at x from 0.2 to 0.3, y = -1, from far behind the light to far before it.
    let caster = [[0.2, -1.0, -50.0], [0.3, -1.0, -50.0], [0.25, -1.0, 50.0]];
    let cells = touched(&face(), 8, Some([[-1.0, 1.0]; 2]), caster);
    // Nothing above the horizon but the padded row at it; the horizon itself only where the strip vanishes.
    assert!(!cells.is_empty() && cells.iter().all(|[_, row]| *row <= 4), "{cells:?}");
    assert!(cells.contains(&[5, 0]) && !cells.contains(&[0, 0]) && !cells.contains(&[7, 3]), "{cells:?}");
}

#[test]
fn faces_of_a_cube_end_at_45_degrees_and_a_single_face_does_not() {
    let axes = [Vec3::X, Vec3::Y, Vec3::Z];
    let sided = |k: usize, sign: f32| Face {
        axis_x: axes[(k + 1) % 3],
        axis_y: sign * axes[(k + 2) % 3],
        axis_z: sign * axes[k],
        ..face()
    };
    let cube: Vec<Face> = (0..3).flat_map(|k| [sided(k, 1.0), sided(k, -1.0)]).collect();
    for index in 0..6 {
        let [[low, high], _] = reach_among(&cube, index).unwrap();
        assert!((-1.001..=-1.0).contains(&low) && (1.0..1.001).contains(&high));
    }
    assert_eq!(reach_among(&cube[..5], 0), None);
    assert_eq!(reach_among(&[face()], 0), None);
    // Above the window of the face, so in that of another.
    let caster = [[0.0, 3.0, 1.0], [0.5, 3.0, 1.0], [0.0, 4.0, 1.0]];
    assert!(touched(&face(), 4, reach_among(&cube, 4), caster).is_empty());
    assert!(!touched(&face(), 4, None, caster).is_empty());
}

/// Directions inside the pyramid, listed as list building lists them, always fall in a touched cell.
#[test]
fn listed_directions_inside_the_pyramid_are_touched() {
    let mut numbers = Random(11);
    let (mut inside, mut cells, mut all) = (0, 0, 0);
    for seed in 0..200 {
        let case = random(seed, 12, 30);
        for caster in &case.triangles {
            for (index, face) in case.faces.iter().enumerate() {
                let face = Face { far: f32::MAX, ..*face };
                let here = touched(&face, case.side, reach_among(&case.faces, index), *caster);
                (cells, all) = (cells + here.len(), all + case.side * case.side);
                for _ in 0..10 {
                    let weights = [0; 3].map(|_| 0.5 + 0.5 * numbers.signed());
                    let total: f32 = weights.iter().sum();
                    let point: Vec3 = (0..3).map(|k| weights[k] / total * Vec3::from(caster[k])).sum();
                    let point = face.origin + (point - face.origin) * (1.0 + numbers.signed());
                    let Some(projected) = light_frame::project(&case.faces, point) else { continue };
                    let (spot, tame) = LightSpace::new(&face).project(point.to_array());
                    let Reach::Cone(cone) = LightSpace::new(&face).reach(caster) else { continue };
                    let edge = |k: usize| {
                        let [x, y, z] = cone.edges[k];
                        x * f64::from(spot.u) + y * f64::from(spot.v) + z
                    };
                    if projected.face == index && tame && (0..3).all(|k| edge(k) >= 0.0) {
                        let texel = face.texel(projected.u, projected.v, case.side);
                        assert!(here.contains(&texel), "seed {seed} {caster:?} {point} {texel:?}");
                        inside += 1;
                    }
                }
            }
        }
    }
    assert!(inside > 10_000 && cells < all / 2, "{inside} {cells} {all}");
}
