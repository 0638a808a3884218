use super::*;
use crate::shared::shadow_map::depth_from_linear;
use crate::shared::shadow_raster::{CLEAR, draw};

const LOOKUP: Lookup = Lookup { bias_constant: 0.0, bias_slope: 0.0, normal_offset: 0.0, kernel: 1 };

/// Looks down -y from (0, 4, 0); 8 x 8 texels span u, v in -1..1, far plane at 8.
fn face() -> Face {
    Face {
        origin: Vec3::new(0.0, 4.0, 0.0),
        valid: true,
        axis_x: Vec3::X,
        axis_y: Vec3::Z,
        axis_z: -Vec3::Y,
        window_low: [-1.0, -1.0],
        window_size: [2.0, 2.0],
        near: 1.0,
        far: 8.0,
    }
}

#[test]
fn taps_are_counted_by_hand() {
    // Columns 5..8 hold depth 2, the others nothing; the view-sample at depth 4 falls in column 4, row 4.
    let near = depth_from_linear(2.0, 8.0);
    let depth: Vec<f32> = (0..64).map(|texel| if texel % 8 >= 5 { near } else { CLEAR }).collect();
    let faces = [face()];
    let map = Map { faces: &faces, depth: &depth, side: 8 };
    let at = |x: f32| Vec3::new(x, 0.0, 0.1);
    let share = |x: f32, kernel: u32| visible(map, Lookup { kernel, ..LOOKUP }, at(x), Vec3::Y);
    assert_eq!([share(0.9, 1), share(1.1, 1)], [1.0, 0.0]);
    assert_eq!([share(0.9, 3), share(1.1, 3)], [2.0 / 3.0, 1.0 / 3.0]);
    // Column 7: the kernel's right column is outside the map, which is lit.
    assert_eq!(share(3.9, 3), 1.0 / 3.0);
    // Outside the window, behind the light.
    assert_eq!(share(5.0, 1), 1.0);
    assert_eq!(visible(map, LOOKUP, Vec3::new(1.1, 5.0, 0.1), Vec3::Y), 1.0);
    // A bias of 2 makes depth 4 equal to depth 2.
    assert_eq!(visible(map, Lookup { bias_constant: 2.01, ..LOOKUP }, at(1.1), Vec3::Y), 1.0);
    assert_eq!(visible(map, Lookup { bias_constant: 1.99, ..LOOKUP }, at(1.1), Vec3::Y), 0.0);
    // A quarter of texel width 1 to the left, on the light's side whichever way the normal points.
    for normal in [-Vec3::X, Vec3::X] {
        let offset = Lookup { normal_offset: 0.25, ..LOOKUP };
        assert_eq!(visible(map, offset, at(1.1), normal), 1.0);
    }
}

/// Share of view-samples on the plane of `normal` through the world's origin that the plane itself shadows.
fn self_shadow(lookup: Lookup, normal: Vec3) -> f32 {
    let side = 64;
    let (e1, e2) = (normal.any_orthonormal_pair().0 * 30.0, normal.any_orthonormal_pair().1 * 30.0);
    let corners = [-e1 - e2, 3.0 * e1 - e2, 3.0 * e2 - e1].map(|p| p.to_array());
    let faces = [face()];
    let mut depth = vec![CLEAR; side * side];
    draw(&faces[0], side, &[corners], &[1], &mut depth, |_, _| true);
    let map = Map { faces: &faces, depth: &depth, side };
    let mut blocked = 0;
    let count = 100;
    for k in 0..count * count {
        let (u, v) = ((k % count) as f32 / 60.0 - 0.8, (k / count) as f32 / 60.0 - 0.8);
        // Where the ray of tangents u, v meets the plane through the world's origin.
        let ray = Vec3::new(u, -1.0, v);
        let along = normal.dot(-faces[0].origin) / normal.dot(ray);
        if along > 0.1 && along < 7.9 {
            blocked += usize::from(visible(map, lookup, faces[0].origin + ray * along, normal) < 1.0);
        }
    }
    blocked as f32 / (count * count) as f32
}

#[test]
fn planes_shadow_themselves_without_slope_bias_and_not_with_it() {
    for kernel in [1, 5] {
        for normal in [Vec3::Y, Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.5, 0.6, 0.62).normalize()] {
            let with = self_shadow(Lookup { bias_slope: 1.0, kernel, ..LOOKUP }, normal);
            assert_eq!(with, 0.0, "{normal} with a kernel of {kernel}");
        }
        let without = self_shadow(Lookup { kernel, ..LOOKUP }, Vec3::new(0.6, 0.8, 0.0));
        assert!(without > 0.2, "{without} with a kernel of {kernel}");
    }
}
