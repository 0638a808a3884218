use super::*;
use crate::shared::hard::Scene;
use crate::shared::hard_scenes::{Case, output, random};
use fearless_simd::{Level, dispatch};

/// A case whose view-samples all lie in one cell.
fn crowded(seed: u64) -> Case {
    let mut case = random(seed, 12, 6000);
    case.look(false, false);
    case.side = 1;
    case
}

#[test]
fn boxes_hold_what_is_below_them() {
    let case = crowded(1);
    let inputs = case.inputs();
    let scene =
        Scene { triangles: &case.triangles, light: case.light, position: &case.position, triangle: &case.triangle };
    let [offsets, entries] = ["list_offset", "list_entries"].map(|port| output(&inputs, port).as_u32());
    let receivers = Receivers::gather(&scene, &case.faces, 1, offsets, entries);
    let trees = &receivers.trees;
    assert_eq!(trees.between(0, 0), [(0, 0)]);
    assert!(trees.between(1, 5).is_empty());
    assert_eq!(trees.nodes[0].places, [0, offsets[1]]);
    let mut listed = 0;
    for (index, node) in trees.nodes.iter().enumerate() {
        let spots: Vec<_> =
            (node.places[0]..node.places[1]).filter_map(|place| receivers.spot(place as usize)).collect();
        assert_eq!(trees.open[index].load(Relaxed) as usize, spots.len());
        for spot in spots {
            let [u, v] = node.ends;
            assert!(u[0] <= spot.u && spot.u <= u[1] && v[0] <= spot.v && spot.v <= v[1] && node.far <= spot.q);
        }
        if node.next as usize == index + 1 {
            assert!((node.places[1] - node.places[0]) as usize <= LEAF);
            listed += node.places[1] - node.places[0];
        }
    }
    assert_eq!(listed, offsets[1]);
}

#[test]
fn a_box_is_closed_once_all_of_it_is_blocked() {
    // One caster just below the light covers all.
    let mut case = random(0, 1, 0);
    case.light = [0.0, 2.0, 0.0];
    case.triangles = vec![[[-90.0, 1.9, -90.0], [90.0, 1.9, -90.0], [0.0, 1.9, 90.0]]];
    case.casts = vec![1];
    for index in 0..5000 {
        case.position.push([(index % 70) as f32 / 70.0, 0.0, (index / 70) as f32 / 70.0]);
    }
    case.triangle = vec![7; 5000];
    case.state = vec![1; 5000];
    case.look(false, false);
    case.side = 1;
    let inputs = case.inputs();
    let scene =
        Scene { triangles: &case.triangles, light: case.light, position: &case.position, triangle: &case.triangle };
    let [offsets, entries] = ["list_offset", "list_entries"].map(|port| output(&inputs, port).as_u32());
    let receivers = Receivers::gather(&scene, &case.faces, 1, offsets, entries);
    let range = &receivers.faces[0];
    let planes = Planes::of(&range.space.reach(&case.triangles[0]), receivers.extent(0));
    let mut settle = Settle::new(&scene, range, 0, None);
    assert!(!receivers.trees.is_full(0));
    dispatch!(Level::new(), simd => receivers.trees.test(simd, &receivers, 0, &planes, &EVERYWHERE, &mut settle));
    assert!(receivers.trees.open.iter().all(|open| open.load(Relaxed) == 0));
    assert_eq!(case.mask(), [1; 5000]);
}
