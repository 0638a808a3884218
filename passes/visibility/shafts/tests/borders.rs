//! Where joined casters end.

use super::*;

/// The twelve triangles of a box, seen from outside, each side divided along its diagonal.
fn sides(low: [f32; 3], high: [f32; 3]) -> Vec<Corners> {
    let corner = |bits: usize| [0, 1, 2].map(|k| if bits >> k & 1 == 1 { high[k] } else { low[k] });
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]]
        .into_iter()
        .flat_map(|[a, b, c, d]| [[corner(a), corner(b), corner(c)], [corner(a), corner(c), corner(d)]])
        .collect()
}

#[test]
fn view_samples_on_a_box_and_in_it_are_not_decided_by_one_segment() {
    // From inside, the far side blocks the light; from the top, whose triangles are own or level with it, nothing does: one segment
    // must not speak for both kinds.
    for seed in 0..24 {
        let mut random = Random(400 + seed);
        let high = [0.6 + 0.3 * random.next(), 0.2 + 0.5 * random.next(), 0.9];
        let triangles = [vec![], sides([-0.8, -1.0, -0.9], high)].concat();
        let light = [9.0, high[1] + 0.5 + random.next(), 0.2];
        let light_samples = random.light(64, light, 0.6);
        let top = (0..12).filter(|id| triangles[*id as usize].iter().all(|corner| corner[1] == high[1]));
        let top: Vec<u32> = top.collect();
        // So few that they are one block.
        let rows: Vec<_> = (0..16)
            .map(|at| {
                let place = [0.1 * random.next(), 0.1 * random.next()];
                if at % 2 == 0 {
                    let inside = [place[0] - 0.3, high[1] - 0.3 - 0.1 * random.next(), place[1]];
                    return (inside, NO_TRIANGLE);
                }
                let id = top[random.below(2)];
                (on(&triangles[id as usize], [0.3 + place[0], 0.3 + place[1]]), id)
            })
            .collect();
        let blocked = compare("box", &triangles, &light_samples, &rows, 4);
        assert!(blocked > 100, "seed {seed}: {blocked}");
    }
}

#[test]
fn a_wall_under_a_board_whose_one_triangle_single_cones_miss_is_not_decided_by_one_segment() {
    // Cut from a room: the top of a board and the wall beneath share an edge, and 2e-7 of height lies between the ends of it. The cones
    // of single view-samples miss the top, the common shaft does not: the wall ends there for some segments, so the shared edge is
    // a border. The least that gets a bit wrong where `Slot::is_sifted` is passed over.
    let triangles = [
        [[6.7098866, 2.6805184, -6.281172], [6.610608, 2.6805184, -6.281172], [6.7098866, 2.6805182, -2.6704144]],
        [[6.7098866, 1.5916824e-7, -2.6704147], [6.7098866, 2.6805184, -6.281172], [6.7098866, 2.6805182, -2.6704144]],
    ];
    let light_samples = [
        [27.969051, 4.858249, -8.164038],
        [27.736547, 5.1970243, -7.8151207],
        [26.692999, 4.794483, -8.067818],
        [27.021843, 5.651447, -8.250977],
        [27.302307, 4.9243693, -7.093184],
        [27.445097, 5.417682, -7.853367],
        [27.052505, 4.532007, -8.112757],
        [27.011105, 5.129331, -7.5732346],
        [27.649197, 4.8464837, -7.9770126],
        [27.610065, 5.342525, -8.209957],
        [27.055481, 4.8145165, -7.7689476],
        [27.015825, 5.2797184, -8.089978],
        [27.533064, 4.7364454, -8.3043],
        [27.269981, 5.137356, -7.3966074],
        [27.261698, 4.79993, -7.9647846],
        [27.059685, 5.0209894, -8.23045],
        [27.33876, 5.0141387, -7.6975455],
    ];
    let rows = [([4.996768, 2.6805182, -2.309597], NO_TRIANGLE), ([5.0420084, 2.0542955, -2.976223], NO_TRIANGLE)];
    assert!(compare("board", &triangles, &light_samples, &rows, 1) > 0);
}
