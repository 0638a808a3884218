use super::PASS;
use super::cpu::run_at;
use crate::shared::hard_scenes::{Case, output, random, run};
use fearless_simd::Level;
use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::param::Params;

fn wrong(case: &Case) -> usize {
    let (outputs, _) = run(&PASS, &case.inputs()).unwrap();
    let mask = output(&outputs, "mask");
    assert_eq!(mask.shape(), [case.position.len(), 1]);
    case.mask().iter().zip(mask.as_u32()).filter(|(a, b)| a != b).count()
}

#[test]
fn random_scenes_have_no_wrong_bit() {
    let mut blocked = 0;
    for seed in 0..400 {
        let case = random(seed, 6 + 12 * (seed % 4) as usize, 300);
        assert_eq!(wrong(&case), 0, "seed {seed}");
        blocked += case.mask().iter().filter(|word| **word == 1).count();
    }
    // Far from none and far from all: the scenes say something.
    assert!((20_000..80_000).contains(&blocked), "{blocked}");
}

#[test]
fn long_lists_have_no_wrong_bit() {
    for seed in 0..60 {
        let mut case = random(1000 + seed, 10 + seed as usize % 30, 5000);
        case.side = 1 + seed as usize % 2;
        assert_eq!(wrong(&case), 0, "seed {seed}");
    }
}

#[test]
fn every_level_of_simd_gives_the_same_mask() {
    for seed in 0..40 {
        let case = random(seed, 30, 400);
        let inputs = case.inputs();
        let lent = inputs.iter().map(|(port, array)| (*port, array)).collect();
        let params = Params::default();
        let mut cx = CpuCx::new(&PASS, &params, [1, 1], lent, &|_, _| {});
        run_at(&mut cx, Level::baseline()).unwrap();
        assert_eq!(output(&cx.finish().0, "mask").as_u32(), case.mask(), "seed {seed}");
    }
}

#[test]
fn a_frame_from_elsewhere_and_a_second_light_sample_are_refused() {
    let mut inputs = random(1, 4, 10).inputs();
    for (port, array) in &mut inputs {
        if *port == "light_frame" {
            array.words_mut()[0] ^= 1;
        }
    }
    assert_eq!(run(&PASS, &inputs).unwrap_err().port.as_deref(), Some("light_frame"));
    for (port, array) in &mut inputs {
        if *port == "light_samples" {
            *array = Array::f32([2, 3], vec![0.0; 6]);
        }
    }
    assert_eq!(run(&PASS, &inputs).unwrap_err().port.as_deref(), Some("light_samples"));
}

#[test]
fn nothing_to_test_and_nothing_that_casts() {
    let empty = random(2, 5, 0);
    assert_eq!(wrong(&empty), 0);
    let mut bare = random(2, 5, 50);
    bare.casts.fill(0);
    assert!(!bare.mask().contains(&1));
    assert_eq!(wrong(&bare), 0);
}

#[test]
fn view_samples_beside_the_light_are_tested_one_by_one() {
    // The face looks down; the view-samples are level with the light but for a hair, behind a fence on the way to it.
    let mut case = random(5, 1, 0);
    case.light = [0.0, 1.0, 0.0];
    case.triangles = vec![[[1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [1.0, 2.0, 0.0]]];
    case.casts = vec![1];
    case.position = vec![[50.0, 1.0 - 1e-6, 0.0], [50.0, 1.0 - 1e-6, 60.0], [0.5, 1.0 - 1e-6, 0.0], [0.0, 0.0, 0.0]];
    case.triangle = vec![9; 4];
    case.state = vec![1; 4];
    case.side = 4;
    case.look(false, false);
    let face = &mut case.faces[0];
    (face.axis_x, face.axis_y, face.axis_z) = (glam::Vec3::X, glam::Vec3::Z, glam::Vec3::NEG_Y);
    (face.window_low, face.window_size, face.far) = ([-1.0; 2], [2.0; 2], 2.0);
    assert_eq!(case.mask(), [1, 0, 0, 0]);
    assert_eq!(wrong(&case), 0);
}
