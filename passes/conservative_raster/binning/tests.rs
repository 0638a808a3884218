use super::PASS;
use super::cpu::run_within;
use crate::shared::hard_scenes::{Case, output, pairs, random, run};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

#[test]
fn every_pair_that_matters_is_listed() {
    let mut share = 0.0;
    for seed in 0..300 {
        let case = random(seed, 6 + 12 * (seed % 4) as usize, 200);
        let inputs = case.inputs();
        let (outputs, counts) = run(&PASS, &inputs).unwrap();
        let listed = pairs(&outputs);
        assert_eq!(counts[0] as usize, listed.len());
        let cell = output(&inputs, "cell").as_u32();
        let length = output(&inputs, "list_length").as_u32();
        for (at, caster) in &listed {
            assert!(length[*at as usize] > 0 && case.casts[*caster as usize] != 0);
        }
        for sample in (0..cell.len()).filter(|sample| cell[*sample] != u32::MAX) {
            for caster in (0..case.triangles.len()).filter(|caster| case.blocks(sample, *caster)) {
                assert!(listed.contains(&(cell[sample], caster as u32)), "seed {seed} {sample} {caster}");
            }
        }
        let cells = length.iter().filter(|length| **length > 0).count();
        share += listed.len() as f64 / (cells * case.triangles.len()).max(1) as f64 / 300.0;
    }
    // Listing everything everywhere would pass the rest of this test.
    assert!(share < 0.7, "{share}");
}

/// A roof 1 wide at height 1 under a light at height 2 that looks down: it covers 2 of the 4 units of floor.
fn roof() -> Case {
    let mut case = random(0, 1, 0);
    case.triangles = vec![[[-0.25, 1.0, -0.25], [0.25, 1.0, -0.25], [-0.25, 1.0, 0.25]]];
    case.casts = vec![1];
    case.light = [0.0, 2.0, 0.0];
    for row in 0..4 {
        for column in 0..4 {
            case.position.push([column as f32 - 1.5, 0.0, row as f32 - 1.5]);
        }
    }
    case.triangle = vec![7; 16];
    case.state = vec![1; 16];
    case.side = 4;
    case.look(false, false);
    // Looking down, columns along x, rows along z; tangents are half the positions on the floor.
    let face = &mut case.faces[0];
    (face.axis_x, face.axis_y, face.axis_z) = (glam::Vec3::X, glam::Vec3::Z, glam::Vec3::NEG_Y);
    (face.window_low, face.window_size, face.far) = ([-1.0; 2], [2.0; 2], 2.0);
    case
}

#[test]
fn a_small_roof_touches_the_four_middle_cells() {
    let (outputs, _) = run(&PASS, &roof().inputs()).unwrap();
    let mut cells: Vec<u32> = output(&outputs, "pair_cell").as_u32().to_vec();
    cells.sort_unstable();
    assert_eq!(cells, [5, 6, 9, 10]);
}

#[test]
fn empty_cells_and_nearer_cells_get_no_pair() {
    let mut case = roof();
    // Lift the view-sample of cell 5 above the roof; take away that of cell 10.
    case.position[5] = [-0.1, 1.5, -0.1];
    case.state[10] = 0;
    let (outputs, counts) = run(&PASS, &case.inputs()).unwrap();
    let mut cells: Vec<u32> = output(&outputs, "pair_cell").as_u32().to_vec();
    cells.sort_unstable();
    assert_eq!((cells.as_slice(), counts[1]), ([6, 9].as_slice(), 1));
}

#[test]
fn too_many_pairs_are_an_error_with_numbers() {
    let case = roof();
    let inputs = case.inputs();
    let params = Params::default();
    let lent = inputs.iter().map(|(port, array)| (*port, array)).collect();
    let mut cx = CpuCx::new(&PASS, &params, [4, 4], lent, &|_, _| {});
    let problem = run_within(&mut cx, 3).unwrap_err();
    assert!(problem.to_string().contains("expected at most 3 pairs; found 4 pairs"), "{problem}");
}
