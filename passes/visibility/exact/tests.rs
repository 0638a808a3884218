use super::cpu::{Receivers, answer};
use crate::shared::contact::contact_band;
use crate::shared::predicate::{Corners, blocks};
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

/// The control: every triangle, no tree, the judge's own words.
fn brute_force(scene: Receivers) -> Vec<u32> {
    let words = scene.light_samples.len().div_ceil(32);
    let mut masks = vec![0; scene.position.len() * words];
    for (row, mask) in masks.chunks_exact_mut(words).enumerate() {
        let own = scene.triangle[row];
        for (sample, light) in scene.light_samples.iter().enumerate() {
            let is_blocked = (0u32..).zip(scene.triangles).any(|(id, caster)| {
                scene.caster_state[id as usize] == 1
                    && id != own
                    && blocks(scene.position[row], scene.triangles.get(own as usize), caster, *light)
            });
            mask[sample / 32] |= u32::from(is_blocked) << (sample % 32);
        }
        match scene.sample_state[row] {
            BACKGROUND => mask.fill(0),
            KEPT => {}
            _ => mask.fill(u32::MAX),
        }
    }
    masks
}

/// Seeded numbers in 0..1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }
    fn point(&mut self) -> [f32; 3] {
        [0; 3].map(|_| 2.0 * self.next() - 1.0)
    }
    fn near(&mut self, centre: [f32; 3], by: f32) -> [f32; 3] {
        let offset = self.point();
        [0, 1, 2].map(|k| centre[k] + by * offset[k])
    }
    fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f32) as usize).min(count - 1)
    }
}

/// A scene whose view-samples are placed by `place`, compared with the control.
fn compare(what: &str, triangles: &[Corners], light_samples: &[[f32; 3]], rows: &[([f32; 3], u32)]) -> u32 {
    let position: Vec<_> = rows.iter().map(|row| row.0).collect();
    let triangle: Vec<_> = rows.iter().map(|row| row.1).collect();
    let caster_state: Vec<u32> = (0..triangles.len()).map(|id| u32::from(id % 13 != 5)).collect();
    let sample_state: Vec<u32> = (0..rows.len()).map(|row| if row % 50 == 7 { FACING_AWAY } else { KEPT }).collect();
    let scene = Receivers {
        triangles,
        caster_state: &caster_state,
        light_samples,
        position: &position,
        triangle: &triangle,
        sample_state: &sample_state,
    };
    let expected = brute_force(scene);
    for ulps in [0.0, 2.0] {
        let found = answer(scene, ulps, &|_, _| {}).masks;
        assert!(expected == found, "{what}: masks differ");
    }
    expected.iter().map(|mask| mask.count_ones()).sum()
}

/// A point of `triangle` at random barycentrics, rounded to f32.
fn on_triangle(random: &mut Random, triangle: &Corners) -> [f32; 3] {
    let (mut a, mut b) = (random.next(), random.next());
    if a + b > 1.0 {
        (a, b) = (1.0 - a, 1.0 - b);
    }
    [0, 1, 2].map(|k| triangle[0][k] + a * (triangle[1][k] - triangle[0][k]) + b * (triangle[2][k] - triangle[0][k]))
}

fn soup(random: &mut Random, count: usize, size: f32) -> Vec<Corners> {
    (0..count)
        .map(|_| {
            let centre = random.point();
            [0; 3].map(|_| random.near(centre, size))
        })
        .collect()
}

#[test]
fn a_segment_through_one_triangle_is_blocked_from_either_side() {
    let triangles = [[[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 0.0, 1.0]]];
    let scene = Receivers {
        triangles: &triangles,
        caster_state: &[1],
        light_samples: &[[0.0, 2.0, 0.0], [5.0, 2.0, 0.0], [0.0, -1.0, 0.0]],
        position: &[[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -1.0, 0.0], [0.0, -1.0, 0.0]],
        triangle: &[NO_TRIANGLE, NO_TRIANGLE, 0, NO_TRIANGLE, NO_TRIANGLE],
        sample_state: &[KEPT, KEPT, KEPT, FACING_AWAY, BACKGROUND],
    };
    // Below: sample 0 is behind the triangle; above: sample 2 is; its own triangle never blocks.
    let found = answer(scene, 0.0, &|_, _| {});
    assert_eq!(found.masks, [0b001, 0b100, 0, u32::MAX, 0]);
    assert_eq!(found.masks, brute_force(scene));
    let off = answer(Receivers { caster_state: &[0], ..scene }, 0.0, &|_, _| {});
    assert_eq!((off.masks[0], off.candidates), (0, 0));
}

#[test]
fn no_light_sample_and_no_triangle_leave_nothing_blocked() {
    let empty = Receivers {
        triangles: &[],
        caster_state: &[],
        light_samples: &[[0.0; 3]],
        position: &[[1.0; 3]],
        triangle: &[3],
        sample_state: &[KEPT],
    };
    assert_eq!(answer(empty, 1.0, &|_, _| {}).masks, [0]);
    assert_eq!(answer(Receivers { light_samples: &[], ..empty }, 0.0, &|_, _| {}).masks, [0u32; 0]);
}

#[test]
fn random_soup_agrees_with_all_triangles() {
    let mut random = Random(1);
    let triangles = soup(&mut random, 700, 0.15);
    // 40 light samples: two words, one of them not full; some inside the scene.
    let light_samples: Vec<_> = (0..40).map(|_| random.near([0.3, 0.8, 0.1], 0.7)).collect();
    let rows: Vec<_> = (0..600)
        .map(|_| {
            let own = random.below(triangles.len());
            (on_triangle(&mut random, &triangles[own]), own as u32)
        })
        .collect();
    assert!(compare("soup", &triangles, &light_samples, &rows) > 5_000);
}

#[test]
fn needles_points_and_edge_on_triangles_agree() {
    let mut random = Random(2);
    let light = [0.25, 1.5, -0.5];
    let mut triangles = soup(&mut random, 150, 0.3);
    for index in 0..450 {
        let (a, b) = (random.point(), random.point());
        let along = |t: f32| [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k]));
        triangles.push(match index % 5 {
            0 => [a, b, along(0.5)],
            1 => [a, a, b],
            2 => [a, a, a],
            3 => [a, random.near(a, 1e-6), b],
            // In a plane through the light.
            _ => [a, b, [0, 1, 2].map(|k| light[k] + 0.5 * (a[k] - light[k]))],
        });
    }
    let rows: Vec<_> = (0..900)
        .map(|_| {
            let own = random.below(triangles.len());
            (on_triangle(&mut random, &triangles[own]), own as u32)
        })
        .collect();
    assert!(compare("degenerate", &triangles, &[light], &rows) > 20);
}

/// A height field on a grid of halves: many triangles share planes, edges and corners with exact coordinates.
fn steps(side: usize) -> Vec<Corners> {
    let height = |x: usize, z: usize| if (x / 2 + z / 2).is_multiple_of(2) { 0.0 } else { 0.5 };
    let corner = |x: usize, z: usize| [x as f32 * 0.5, height(x, z), z as f32 * 0.5];
    (0..side * side)
        .flat_map(|cell| {
            let (x, z) = (cell % side, cell / side);
            let [a, b, c, d] = [corner(x, z), corner(x + 1, z), corner(x, z + 1), corner(x + 1, z + 1)];
            [[a, c, b], [b, c, d]]
        })
        .collect()
}

#[test]
fn view_samples_on_shared_edges_and_corners_and_lights_in_planes_agree() {
    let triangles = steps(12);
    let mut rows = Vec::new();
    for (id, triangle) in (0u32..).zip(&triangles) {
        for k in 0..3 {
            let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
            rows.push((a, id));
            rows.push(([0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis])), id));
        }
    }
    // In the plane of the lower steps, of the upper ones, above, at a corner, and on the line of a whole row of edges.
    let lights =
        [[-3.0, 0.0, 1.0], [9.0, 0.5, 2.0], [3.0, 4.0, 3.0], [1.0, 0.0, 1.0], [-2.0, 0.0, 2.0], [3.25, 0.75, 2.5]];
    assert!(compare("steps", &triangles, &lights, &rows) > 100);
}

#[test]
fn huge_tiny_and_far_off_scenes_agree() {
    for (what, scale, shift) in [
        ("huge", 1e38, 0.0),
        ("tiny", 1e-38, 0.0),
        ("subnormal", 1e-42, 0.0),
        ("far off", 1.0, 1e6),
        ("mixed", 1e25, 1.0),
    ] {
        let mut random = Random(3);
        let place = |p: [f32; 3]| p.map(|x| x * scale + shift);
        let triangles: Vec<Corners> = soup(&mut random, 300, 0.2).into_iter().map(|t| t.map(place)).collect();
        let lights = [place([0.1, 1.4, 0.2]), place([0.0; 3])];
        let rows: Vec<_> = (0..300)
            .map(|_| {
                let own = random.below(triangles.len());
                (on_triangle(&mut random, &triangles[own]), own as u32)
            })
            .collect();
        assert!(compare(what, &triangles, &lights, &rows) > 20, "{what}");
    }
}

#[test]
fn rays_along_axes_in_the_faces_of_boxes_agree() {
    // Axis-parallel segments, flat boxes, coordinates equal bit for bit: every slab is touched, not crossed.
    let mut triangles = Vec::new();
    for index in 0..27 {
        let [x, y, z] = [index % 3, index / 3 % 3, index / 9].map(|k| k as f32);
        triangles.push([[x, y, z], [x + 1.0, y, z], [x, y, z + 1.0]]);
        triangles.push([[x, y, z], [x, y + 1.0, z], [x, y, z + 1.0]]);
    }
    let rows: Vec<_> = (0..125).map(|k| ([k % 5, k / 5 % 5, k / 25].map(|k| k as f32 * 0.5), NO_TRIANGLE)).collect();
    let lights = [[0.5, 7.0, 0.5], [1.0, 7.0, 1.0], [7.0, 0.5, 0.5], [0.5, 0.5, -4.0], [1.0, 1.0, 1.0]];
    assert!(compare("axes", &triangles, &lights, &rows) > 50);
}

#[test]
fn many_equal_triangles_build_in_time_and_agree() {
    let mut triangles = vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]; 50_000];
    triangles.push([[-1.0, -1.0, -1.0], [2.0, -1.0, -1.0], [-1.0, -1.0, 2.0]]);
    let last = triangles.len() as u32 - 1;
    let scene = Receivers {
        triangles: &triangles,
        caster_state: &vec![1; triangles.len()],
        light_samples: &[[0.2, 1.0, 0.2]],
        position: &[[0.2, -1.0, 0.2], [1.5, -1.0, -0.5]],
        triangle: &[last, last],
        sample_state: &[KEPT, KEPT],
    };
    assert_eq!(answer(scene, 0.0, &|_, _| {}).masks, [1, 0]);
}

#[test]
fn the_contact_band_holds_what_a_rounding_step_can_turn_and_little_else() {
    let caster = [[0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
    let floor = [[-4.0, 0.0, -4.0], [-4.0, 0.0, 9.0], [9.0, 0.0, -4.0]];
    let light = [0.25, 4.0, 0.25];
    let triangles = [caster, floor];
    // The shadow's edge x = 0 of the caster falls on the floor at x = -1/12, which f32 rounds.
    let edge = -1.0 / 12.0;
    let position = [[edge, 0.0, 0.2], [edge - 1e-4, 0.0, 0.2], [edge + 1e-4, 0.0, 0.2], [3.0, 0.0, 3.0]];
    let band = |ulps| contact_band(&triangles, &[1, 1], &[light], &position, &[1; 4], &[0, 1, 2, 3], ulps);
    assert_eq!(band(1.0), [true, false, false, false]);
    assert_eq!(band(0.0), [false; 4]);
    assert_eq!(band(1000.0), [true, true, true, false]);
    let scene = Receivers {
        triangles: &triangles,
        caster_state: &[1, 1],
        light_samples: &[light],
        position: &position,
        triangle: &[1; 4],
        sample_state: &[KEPT; 4],
    };
    assert_eq!(answer(scene, 1.0, &|_, _| {}).contact, 1);
    // A second caster that covers the edge for certain takes the first one's doubt away.
    let cover = [[-2.0, 2.0, -2.0], [3.0, 2.0, -2.0], [-2.0, 2.0, 3.0]];
    let covered = contact_band(&[caster, floor, cover], &[1; 3], &[light], &position, &[1; 4], &[0], 1.0);
    assert_eq!(covered, [false]);
}

#[test]
fn outside_the_band_moved_view_samples_keep_their_answer() {
    let mut random = Random(4);
    let triangles = soup(&mut random, 200, 0.4);
    let caster_state = vec![1; triangles.len()];
    let light = [0.2, 3.0, 0.1];
    let step = f32::EPSILON * 3.0;
    let (mut position, mut triangle) = (Vec::new(), Vec::new());
    for _ in 0..2_000 {
        let own = random.below(triangles.len());
        position.push(on_triangle(&mut random, &triangles[own]));
        triangle.push(own as u32);
    }
    let rows: Vec<usize> = (0..position.len()).collect();
    let band = contact_band(&triangles, &caster_state, &[light], &position, &triangle, &rows, 2.0);
    let masks = |position: &[[f32; 3]]| {
        let sample_state = vec![KEPT; position.len()];
        brute_force(Receivers {
            triangles: &triangles,
            caster_state: &caster_state,
            light_samples: &[light],
            position,
            triangle: &triangle,
            sample_state: &sample_state,
        })
    };
    let before = masks(&position);
    for _ in 0..4 {
        let moved: Vec<_> = position.iter().map(|&p| random.near(p, step)).collect();
        for (row, (a, b)) in before.iter().zip(masks(&moved)).enumerate() {
            assert!(band[row] || *a == b, "view-sample {row} is outside the band and turned");
        }
    }
    assert!(band.iter().filter(|in_band| **in_band).count() < position.len() / 50);
}
