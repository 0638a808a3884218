use super::*;

#[test]
fn depth_runs_from_0_near_to_1_far_and_comes_back() {
    let far = 20.0;
    assert!(depth_from_linear(far * NEAR_SHARE, far).abs() < 1e-6);
    assert!((depth_from_linear(far, far) - 1.0).abs() < 1e-6);
    for w in [0.03f32, 0.5, 1.0, 7.0, 19.0] {
        let depth = depth_from_linear(w, far);
        assert!((linear_from_depth(depth, far) - w).abs() <= 2.0 * step(w, far) + 1e-6 * w, "{w}");
    }
    assert_eq!(linear_from_depth(1.0, far), f32::INFINITY);
    // The step of the doc: four units in the last place at the far plane.
    assert!((step(far, far) / far - 2.4e-4).abs() < 1e-5);
}

#[test]
fn the_kernel_states_the_same_numbers() {
    for (name, value) in [("NEAR_SHARE", NEAR_SHARE), ("SECOND_STEP", SECOND_STEP)] {
        let line = WGSL.lines().find(|line| line.starts_with(&format!("const {name}:"))).unwrap();
        let text = line.rsplit(' ').next().unwrap().trim_end_matches(';');
        assert_eq!(text.parse::<f32>().unwrap(), value, "{name}");
    }
    assert!(WGSL.contains("0.00000023841858"));
    assert_eq!("0.00000023841858".parse::<f32>().unwrap(), 1.0 / (1 << 22) as f32);
}
