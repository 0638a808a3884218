use super::*;
use crate::shared::hard_scenes::{Random, output, random};
use crate::shared::pyramid::WILD;

#[test]
fn the_kernel_equals_its_scalar_twin() {
    let mut numbers = Random(7);
    let mut left = 0;
    for round in 0..20_000 {
        let mut row = || [0; 4].map(|_| numbers.signed());
        let (u, v, one) = (row(), row(), row());
        let planes = Planes { u, v, one, q: -numbers.signed().abs() };
        let mut chunk = Chunk::default();
        for lane in 0..LANES {
            let scale = if round % 5 == 0 { 1e4 } else { 1.0 };
            (chunk.u[lane], chunk.v[lane]) = (scale * numbers.signed(), scale * numbers.signed());
            chunk.q[lane] = numbers.signed().abs();
        }
        for level in [Level::new(), Level::baseline()] {
            let bits = dispatch!(level, simd => candidates(simd, &planes, &chunk));
            for lane in 0..LANES {
                let spot = Spot { u: chunk.u[lane], v: chunk.v[lane], q: chunk.q[lane] };
                assert_eq!(bits >> lane & 1 == 1, planes.may_cover(&spot));
            }
            left += bits.count_ones();
        }
    }
    assert!((20_000..200_000).contains(&left), "{left}");
}

#[test]
fn every_listed_view_sample_has_its_place() {
    for seed in 0..40 {
        let case = random(seed, 10, 1500);
        let inputs = case.inputs();
        let scene =
            Scene { triangles: &case.triangles, light: case.light, position: &case.position, triangle: &case.triangle };
        let offsets = output(&inputs, "list_offset").as_u32();
        let entries = output(&inputs, "list_entries").as_u32();
        let cell_count = case.side * case.side;
        let receivers = Receivers::gather(&scene, &case.faces, cell_count, offsets, entries);
        for (index, range) in receivers.faces.iter().enumerate() {
            assert_eq!(range.places[0] % LANES, 0);
            for cell in index * cell_count..(index + 1) * cell_count {
                let [from, to] = [cell, cell + 1].map(|at| offsets[at] as usize);
                // Order in a list is free, its content is not.
                let mut list = receivers.entries[from..to].to_vec();
                list.sort_unstable();
                let mut expected = entries[from..to].to_vec();
                expected.sort_unstable();
                assert_eq!(list, expected);
                for at in from..to {
                    let sample = receivers.entries[at];
                    let (spot, tame) = range.space.project(case.position[sample as usize]);
                    let expected = tame.then_some(spot);
                    assert_eq!(receivers.spot(at + range.shift), expected);
                    assert_eq!(receivers.wild.contains(&sample), !tame);
                    if tame {
                        let [u, v] = range.reach;
                        assert!(u[0] <= spot.u && spot.u <= u[1] && v[0] <= spot.v && spot.v <= v[1]);
                        assert!(f64::from(spot.u.abs()) <= WILD);
                    }
                }
            }
        }
        let total = offsets[offsets.len() - 1] as usize;
        let open: u32 = receivers.blocked.iter().map(|word| word.load(Relaxed).count_zeros()).sum();
        assert_eq!(open as usize + receivers.wild.len(), total, "padding is not a view-sample");
    }
}
