//! Points put in blocks by halving: nothing is lost, and the halves of every group are in order.

use super::super::LANES;
use super::super::groups::{Blocks, Frame, every};
use super::super::halving::Points;
use super::Random;
use fearless_simd::{Level, dispatch};

/// As in `split`: what depth counts for, and the share of a side that halving leaves open.
const WEIGHTS: [f32; 3] = [1.0, 1.0, 0.25];
const STEP: f32 = 1.0 / 256.0;

/// `points` in blocks, with one word for each, which the blocks are to keep with it.
fn blocks_of(points: &[[f32; 3]], level: Level) -> (Frame, Blocks) {
    let frame = Frame::new(if points.is_empty() { &[[0.0; 3]] } else { points }, [0.3, 9.0, -0.2]);
    let (mut filled, mut blocks) = (Points::default(), Blocks::default());
    let index: Vec<u32> = (0..points.len() as u32).map(|at| 7 * at + 1).collect();
    // What was there before is forgotten.
    for points in [&[[5.0; 3]; 40][..], points] {
        filled.fill(points.iter().copied());
        let words = if points.len() == index.len() { index.clone() } else { vec![0; points.len()] };
        dispatch!(level, simd => blocks.fill(simd, &frame, &filled, &words));
    }
    (frame, blocks)
}

/// How many groups hold a half that is out of order.
fn disordered(blocks: &Blocks) -> usize {
    let mut wrong = 0;
    every(blocks.root(), &mut |range| {
        if range.len() < 2 {
            return;
        }
        let places = |first: usize, last: usize| first * LANES..(last * LANES).min(blocks.count);
        let ends = |axis: usize, first: usize, last: usize| {
            let along = &blocks.at[axis][places(first, last)];
            (along.iter().copied().fold(f32::MAX, f32::min), along.iter().copied().fold(f32::MIN, f32::max))
        };
        let extent = [0, 1, 2].map(|axis| {
            let (low, high) = ends(axis, range.first, range.last);
            high - low
        });
        let weighted = |axis: usize| extent[axis] * WEIGHTS[axis];
        // The first of the longest.
        let axis = if weighted(0) >= weighted(1) && weighted(0) >= weighted(2) {
            0
        } else if weighted(1) >= weighted(2) {
            1
        } else {
            2
        };
        let [lower, upper] = range.halves().map(|half| ends(axis, half.first, half.last));
        wrong += usize::from(lower.1 > upper.0 + 1.001 * STEP * extent[axis]);
    });
    wrong
}

const COUNTS: [usize; 9] = [0, 1, 15, 16, 17, 255, 256, 1000, 4096];

#[test]
fn halving_loses_nothing_and_orders_halves() {
    for level in [Level::new(), Level::baseline()] {
        for (seed, count) in COUNTS.into_iter().enumerate() {
            for shape in [[1.0, 1.0, 1.0], [1.0, 0.1, 0.0], [0.0, 0.0, 0.0]] {
                let mut random = Random(seed as u64);
                let points: Vec<[f32; 3]> = (0..count)
                    .map(|_| {
                        let point = random.point();
                        [0, 1, 2].map(|k| shape[k] * point[k] + 0.5)
                    })
                    .collect();
                let (frame, blocks) = blocks_of(&points, level);
                let what = format!("{level:?}, {count} points, shape {shape:?}");
                assert_eq!(blocks.count, count, "{what}");
                assert_eq!(blocks.index.len(), count.next_multiple_of(LANES), "{what}");
                let mut seen: Vec<u32> = blocks.index[..count].to_vec();
                seen.sort_unstable();
                assert!(seen.iter().copied().eq((0..count as u32).map(|at| 7 * at + 1)), "{what}: a permutation");
                for (place, index) in blocks.index.iter().enumerate() {
                    let at = frame.point(points[*index as usize / 7]);
                    let found = blocks.point(place);
                    assert!((0..3).all(|k| (at[k] - found[k]).abs() < 1e-5), "{what}: {found:?} is not {at:?}");
                    assert!(found.iter().map(|x| x * x).sum::<f32>().sqrt() <= blocks.reach, "{what}: reach");
                    assert!(place < count || *index == blocks.index[count - 1], "{what}: filling");
                }
                assert_eq!(disordered(&blocks), 0, "{what}");
            }
        }
    }
}

#[test]
fn points_out_of_order_are_seen() {
    let mut random = Random(3);
    let points: Vec<[f32; 3]> = (0..1000).map(|_| random.point()).collect();
    let (_, mut blocks) = blocks_of(&points, Level::new());
    for along in &mut blocks.at {
        along[..1000].rotate_left(500);
    }
    assert!(disordered(&blocks) > 1);
}
