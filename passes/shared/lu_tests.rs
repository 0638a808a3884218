use super::*;

#[test]
fn the_angle_is_close_to_atan2_everywhere() {
    for step in 0..100_000 {
        let turn = (f64::from(step) / 50_000.0 - 1.0) * std::f64::consts::PI;
        for scale in [1.0, 1e-12, 1e12] {
            let (y, x) = ((turn.sin() * scale) as f32, (turn.cos() * scale) as f32);
            let error = (f64::from(angle(y, x)) - f64::from(y).atan2(f64::from(x))).abs();
            // Half a turn either way is one angle.
            let error = error.min((error - std::f64::consts::TAU).abs());
            assert!(error < f64::from(ANGLE_ERROR), "{turn}: {error}");
        }
    }
    assert_eq!([angle(0.0, 0.0), angle(0.0, 2.0)], [0.0, 0.0]);
}

#[test]
fn bins_cover_their_ends() {
    assert_eq!([bin(-0.1, 8), bin(0.0, 8), bin(0.49, 8), bin(0.5, 8), bin(1.0, 8), bin(1.5, 8)], [0, 0, 3, 4, 7, 7]);
    assert_eq!(direction_bins([0.0, 0.0, 1.0], 8)[0], 0);
    assert_eq!(direction_bins([0.0, 0.0, -1.0], 8)[0], 7);
    assert_eq!(direction_bins([1.0, 0.1, 0.01], 8), [3, 4]);
}

#[test]
fn a_table_too_large_names_what_would_fit() {
    assert!(check_bytes(&[2, 128, 128, 128, 4], 64 << 20).is_ok());
    let problem = check_bytes(&[8, 128, 128, 128, 4], 128 << 20).unwrap_err().to_string();
    assert!(problem.contains("at most 134217728 bytes") && problem.contains("found 268435456 bytes"), "{problem}");
    assert!(problem.contains("set `size` to 100 or less"), "{problem}");
    let problem = check_bytes(&[8192, 32, 32, 32, 4], 128 << 20).unwrap_err().to_string();
    assert!(problem.contains("half_planes"), "{problem}");
}

#[test]
fn a_layout_survives_its_words() {
    let axes = [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8], [0.0, -0.8, 0.6]];
    let layout = Layout { middle: [1.0, 2.0, 3.0], radius: 0.5, axes, height: 0.25 };
    assert_eq!(layout.to_words().len(), LAYOUT_WORDS);
    assert_eq!(Layout::from_words(&layout.to_words()), layout);
}

#[test]
fn another_table_is_refused_by_name() {
    let form = Form { pass: "angles_distance", is_solid: true, entry_words: 4 };
    assert!(form.check(Some(&[1, 32, 32, 32, 4])).is_ok());
    for shape in [&[1, 32, 32, 32, 8][..], &[1, 32, 32, 1, 4]] {
        let problem = form.check(Some(shape)).unwrap_err().to_string();
        assert!(problem.contains("lu_table/angles_distance"), "{problem}");
    }
    assert!(form.check(None).unwrap_err().to_string().contains("nothing connected"));
}
