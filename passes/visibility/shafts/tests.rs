mod borders;
mod halving;

use super::cpu::{Receivers, answer};
use super::patches::Choice;
use super::rays::Leaves;
use crate::shared::predicate::{Corners, blocks};
use fearless_simd::Level;
use shadowgraph_core::shared::{BACKGROUND, FACING_AWAY, KEPT, NO_TRIANGLE};

/// The control: every triangle, no shafts, the judge's own words.
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
    /// Points in a ball.
    fn light(&mut self, count: usize, centre: [f32; 3], radius: f32) -> Vec<[f32; 3]> {
        (0..count)
            .map(|_| {
                loop {
                    let offset = self.point();
                    if offset.iter().map(|x| x * x).sum::<f32>() <= 1.0 {
                        return [0, 1, 2].map(|k| centre[k] + radius * offset[k]);
                    }
                }
            })
            .collect()
    }
    fn soup(&mut self, count: usize, size: f32) -> Vec<Corners> {
        (0..count)
            .map(|_| {
                let centre = self.point();
                [0; 3].map(|_| self.near(centre, size))
            })
            .collect()
    }
}

/// The point of `triangle` at barycentrics (a, b), rounded.
fn on(triangle: &Corners, [mut a, mut b]: [f32; 2]) -> [f32; 3] {
    if a + b > 1.0 {
        (a, b) = (1.0 - a, 1.0 - b);
    }
    [0, 1, 2].map(|k| triangle[0][k] + a * (triangle[1][k] - triangle[0][k]) + b * (triangle[2][k] - triangle[0][k]))
}

/// A scene compared with the control on every instruction set; blocked bits of view-samples that are kept.
fn compare(
    what: &str,
    triangles: &[Corners],
    light_samples: &[[f32; 3]],
    rows: &[([f32; 3], u32)],
    width: usize,
) -> u32 {
    let position: Vec<_> = rows.iter().map(|row| row.0).collect();
    let triangle: Vec<_> = rows.iter().map(|row| row.1).collect();
    let caster_state: Vec<u32> = (0..triangles.len()).map(|id| u32::from(id % 13 != 5)).collect();
    let state = |row: usize| match row % 50 {
        7 => FACING_AWAY,
        8 => BACKGROUND,
        _ => KEPT,
    };
    let sample_state: Vec<u32> = (0..rows.len()).map(state).collect();
    let scene = Receivers {
        triangles,
        caster_state: &caster_state,
        light_samples,
        position: &position,
        triangle: &triangle,
        sample_state: &sample_state,
        image: [width, rows.len().div_ceil(width.max(1))],
        patches: Choice::Auto,
        leaves: Leaves::Auto,
    };
    let expected = brute_force(scene);
    for (level, patches, leaves) in [
        (Level::new(), Choice::Always, Leaves::Triangles),
        (Level::new(), Choice::Off, Leaves::Triangles),
        (Level::new(), Choice::Off, Leaves::Rays),
        (Level::new(), Choice::Auto, Leaves::Auto),
        (Level::baseline(), Choice::Always, Leaves::Triangles),
        (Level::baseline(), Choice::Auto, Leaves::Rays),
    ] {
        let (found, _) = answer(Receivers { patches, leaves, ..scene }, level, &|_, _| {});
        let wrong = expected.iter().zip(&found).map(|(a, b)| (a ^ b).count_ones()).sum::<u32>();
        assert_eq!(
            wrong,
            0,
            "{what}, {level:?}, patches {patches:?}, leaves {leaves:?}: {} bits in all",
            expected.len() * 32
        );
    }
    let words = light_samples.len().div_ceil(32);
    let kept = expected.chunks(words).zip(&sample_state).filter(|(_, state)| **state == KEPT);
    kept.flat_map(|(mask, _)| mask).map(|mask| mask.count_ones()).sum()
}

/// A screen of view-samples on `triangle`, `side` a side, in one corner of it.
fn screen(triangle: &Corners, id: u32, side: usize, size: f32, from: [f32; 2]) -> Vec<([f32; 3], u32)> {
    let step = size / side as f32;
    (0..side * side)
        .map(|at| (on(triangle, [from[0] + step * (at % side) as f32, from[1] + step * (at / side) as f32]), id))
        .collect()
}

const FLOOR: [Corners; 2] = [
    [[-4.0, -1.5, -4.0], [-4.0, -1.5, 4.0], [4.0, -1.5, -4.0]],
    [[4.0, -1.5, 4.0], [4.0, -1.5, -4.0], [-4.0, -1.5, 4.0]],
];

#[test]
fn a_floor_under_soup_agrees_for_every_number_of_light_samples() {
    for (seed, count, size, radius) in [
        (1, 40, 0.5, 0.3),
        (2, 300, 0.1, 0.5),
        (3, 12, 1.5, 0.1),
        (4, 900, 0.05, 0.8),
        (5, 60, 0.4, 2.0),
        (6, 8, 3.0, 1.0),
    ] {
        for lights in [1, 5, 33, 256] {
            let mut random = Random(seed);
            let mut triangles = random.soup(count, size);
            let id = triangles.len() as u32;
            triangles.extend(FLOOR);
            let light_samples = random.light(lights, [0.5, 3.0, 0.3], radius);
            let rows = screen(&FLOOR[0], id, 24, 0.2, [0.3, 0.3]);
            let blocked = compare("floor", &triangles, &light_samples, &rows, 24);
            assert!(lights < 33 || blocked > 1000, "seed {seed}, {lights} light samples: {blocked}");
        }
    }
}

#[test]
fn more_light_samples_than_a_thousand_agree() {
    let mut random = Random(7);
    let mut triangles = random.soup(60, 0.3);
    triangles.extend(FLOOR);
    let light_samples = random.light(1024, [0.5, 3.0, 0.3], 0.6);
    let rows = screen(&FLOOR[0], 60, 16, 0.3, [0.2, 0.3]);
    assert!(compare("1024", &triangles, &light_samples, &rows, 16) > 10_000);
}

#[test]
fn view_samples_anywhere_in_soup_agree() {
    for seed in 0..6 {
        let mut random = Random(20 + seed);
        let triangles = random.soup(250, 0.25);
        // Some light samples are inside the scene.
        let light_samples = random.light(40, [0.3, 0.9, 0.1], 0.7);
        let rows: Vec<_> = (0..500)
            .map(|_| {
                let own = random.below(triangles.len());
                let at = [random.next(), random.next()];
                (on(&triangles[own], at), if own.is_multiple_of(11) { NO_TRIANGLE } else { own as u32 })
            })
            .collect();
        assert!(compare("soup", &triangles, &light_samples, &rows, 25) > 1_000);
    }
}

#[test]
fn needles_points_and_edge_on_triangles_agree() {
    let mut random = Random(2);
    let light = [0.25, 1.5, -0.5];
    let mut triangles = random.soup(100, 0.3);
    for index in 0..300 {
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
    let mut lights = random.light(20, light, 0.2);
    lights[0] = light;
    let rows: Vec<_> = (0..400)
        .map(|_| {
            let own = random.below(triangles.len());
            (on(&triangles[own], [random.next(), random.next()]), own as u32)
        })
        .collect();
    assert!(compare("degenerate", &triangles, &lights, &rows, 20) > 200);
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
    assert!(compare("steps", &triangles, &lights, &rows, 54) > 100);
    // A light whose samples lie on a grid in a plane parallel to the steps: edges and planes are met exactly.
    let grid: Vec<_> = (0..64).map(|k| [(k % 8) as f32 * 0.5 + 1.0, 2.0, (k / 8) as f32 * 0.5 + 1.0]).collect();
    assert!(compare("grid", &triangles, &grid, &rows, 54) > 1000);
}

#[test]
fn a_light_that_cuts_the_floor_and_touches_geometry_agrees() {
    let mut random = Random(31);
    let mut triangles = random.soup(40, 0.4);
    let id = triangles.len() as u32;
    triangles.extend(FLOOR);
    for centre in [[3.0, -1.5, 0.5], [0.0, -1.4, -1.0], triangles[3][0]] {
        let mut lights = random.light(50, centre, 0.5);
        lights[0] = triangles[3][0];
        lights[1] = [1.0, -1.5, 1.0];
        let mut rows = screen(&FLOOR[0], id, 16, 0.9, [0.05, 0.05]);
        rows.extend(screen(&FLOOR[1], id + 1, 16, 0.9, [0.05, 0.05]));
        assert!(compare("cut", &triangles, &lights, &rows, 16) > 100);
    }
}

#[test]
fn a_fine_sphere_over_itself_and_a_floor_agrees() {
    // Neighbours of own triangles everywhere, convex and concave, and an umbra that no single triangle makes.
    let (rings, turns) = (24, 48);
    let corner = |ring: usize, turn: usize| {
        let (a, b) = (
            ring as f32 / rings as f32 * std::f32::consts::PI,
            (turn % turns) as f32 / turns as f32 * std::f32::consts::TAU,
        );
        let r = 1.0 + 0.1 * (5.0 * b).sin() * (3.0 * a).sin();
        [r * a.sin() * b.cos(), r * a.cos(), r * a.sin() * b.sin()]
    };
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for turn in 0..turns {
            let [a, b, c, d] =
                [corner(ring, turn), corner(ring, turn + 1), corner(ring + 1, turn), corner(ring + 1, turn + 1)];
            triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    let id = triangles.len() as u32;
    triangles.extend(FLOOR);
    let mut random = Random(5);
    let lights = random.light(64, [0.4, 4.0, 0.2], 0.4);
    let mut rows = screen(&FLOOR[0], id, 16, 0.4, [0.3, 0.3]);
    for _ in 0..16 {
        let first = random.below(triangles.len() - 40);
        rows.extend((0..16).map(|k| {
            let own = first + k * 2;
            (on(&triangles[own], [random.next(), random.next()]), own as u32)
        }));
    }
    assert!(compare("sphere", &triangles, &lights, &rows, 16) > 5_000);
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
        let triangles: Vec<Corners> = random.soup(100, 0.2).into_iter().map(|t| t.map(place)).collect();
        let lights: Vec<_> = random.light(17, [0.1, 1.4, 0.2], 0.3).into_iter().map(place).collect();
        let rows: Vec<_> = (0..120)
            .map(|_| {
                let own = random.below(triangles.len());
                (on(&triangles[own], [random.next(), random.next()]), own as u32)
            })
            .collect();
        assert!(compare(what, &triangles, &lights, &rows, 12) > 20, "{what}");
    }
}

#[test]
fn nothing_that_casts_nothing_kept_and_no_light_sample() {
    let scene = Receivers {
        triangles: &[],
        caster_state: &[],
        light_samples: &[[0.0; 3]],
        position: &[[1.0; 3], [f32::NAN, 0.0, 0.0]],
        triangle: &[3, 3],
        sample_state: &[KEPT, KEPT],
        image: [2, 1],
        patches: Choice::Auto,
        leaves: Leaves::Auto,
    };
    let masks = |scene: Receivers| answer(scene, Level::new(), &|_, _| {}).0;
    assert_eq!(masks(scene), [0, 0]);
    assert_eq!(masks(Receivers { light_samples: &[], ..scene }), [0u32; 0]);
    assert_eq!(masks(Receivers { sample_state: &[BACKGROUND, FACING_AWAY], ..scene }), [0, u32::MAX]);
    assert_eq!(masks(Receivers { position: &[], triangle: &[], sample_state: &[], image: [0, 0], ..scene }), [0u32; 0]);
    // One triangle across the only segment, and beside it.
    let over = [[-1.0, 0.5, -1.0], [3.0, 0.5, -1.0], [-1.0, 0.5, 3.0]];
    assert_eq!(masks(Receivers { triangles: &[over], caster_state: &[1], ..scene }), [1, 0]);
    assert_eq!(masks(Receivers { triangles: &[over], caster_state: &[0], ..scene }), [0, 0]);
    assert_eq!(masks(Receivers { triangles: &[over], caster_state: &[1], triangle: &[0, 0], ..scene }), [0, 0]);
}

#[test]
fn many_equal_triangles_build_in_time_and_agree() {
    let mut triangles = vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]; 20_000];
    triangles.push([[-1.0, -1.0, -1.0], [2.0, -1.0, -1.0], [-1.0, -1.0, 2.0]]);
    let last = triangles.len() as u32 - 1;
    let scene = Receivers {
        triangles: &triangles,
        caster_state: &vec![1; triangles.len()],
        light_samples: &[[0.2, 1.0, 0.2]],
        position: &[[0.2, -1.0, 0.2], [1.5, -1.0, -0.5]],
        triangle: &[last, last],
        sample_state: &[KEPT, KEPT],
        image: [2, 1],
        patches: Choice::Auto,
        leaves: Leaves::Auto,
    };
    assert_eq!(answer(scene, Level::new(), &|_, _| {}).0, [1, 0]);
}
