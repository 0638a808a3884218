use super::*;

const CASTER: Corners = [[-1.0, 1.0, -1.0], [1.0, 1.0, -1.0], [0.0, 1.0, 1.0]];

fn kind(position: [f32; 3], samples: &[[f32; 3]]) -> &'static str {
    match hidden(&CASTER, position, &LightBox::new(samples), &mut { Planes::EMPTY }) {
        Hidden::Nothing => "nothing",
        Hidden::All => "all",
        Hidden::Within => "within",
    }
}

#[test]
fn a_light_wholly_behind_is_hidden_and_one_beside_or_before_is_not() {
    let light = [[-0.1, 3.0, -0.1], [0.1, 3.2, 0.1]];
    assert_eq!(kind([0.0, 0.0, 0.0], &light), "all");
    assert_eq!(kind([0.0, 0.0, 9.0], &light), "nothing");
    assert_eq!(kind([0.0, 0.0, 1.5], &light), "within");
    // The light is below the caster, on the view-sample's side.
    assert_eq!(kind([0.0, 0.0, 0.0], &[[0.0, 0.5, 0.0], [0.1, 0.6, 0.0]]), "nothing");
    // Edge-on.
    assert_eq!(kind([5.0, 1.0, 0.0], &light), "nothing");
}

#[test]
fn neighbours_at_an_edge_share_its_plane_and_have_opposite_signs() {
    let light = [[-0.3, 3.0, -2.1], [0.4, 3.2, 1.7], [0.1, 2.5, 0.0]];
    let light = LightBox::new(&light);
    let other = [CASTER[1], CASTER[0], [0.0, 1.3, -3.0]];
    let position = [0.05, 0.0, -0.9];
    let planes = |caster| {
        let mut planes = Planes::EMPTY;
        assert_eq!(hidden(caster, position, &light, &mut planes), Hidden::Within);
        planes
    };
    let (one, two) = (planes(&CASTER), planes(&other));
    assert_eq!((one.normal[0], one.constant[0]), (two.normal[0], two.constant[0]));
    assert_ne!(one.turned[0], two.turned[0]);
}

#[test]
fn a_plane_that_does_not_cut_the_light_has_it_on_one_side() {
    let samples = [[-1.0, 5.0, 0.0], [2.0, 6.0, 1.0]];
    let light = LightBox::new(&samples);
    let flat = |y: f32| [[0.0, y, 0.0], [1.0, y, 0.0], [0.0, y, 1.0]];
    for y in [1.0, 7.0, 5.5, 5.0] {
        let whole = side_of_light(&flat(y), &light);
        let each = samples.map(|sample| predicate::side(&flat(y), sample));
        let expected = if each[0] == each[1] { each[0] } else { 0 };
        assert_eq!(whole, expected, "{y}");
    }
}

/// A ball of light samples around (0, 4, 0), and casters at random places around its cone from the origin.
#[test]
fn a_caster_beside_the_light_hides_nothing_and_is_found_though_its_lines_cut_the_light() {
    let mut state = 7u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 23) as f32 - 1.0
    };
    let samples: Vec<[f32; 3]> = std::iter::repeat_with(|| [next(), next(), next()])
        .filter(|[x, y, z]| x * x + y * y + z * z <= 1.0)
        .map(|[x, y, z]| [x, 4.0 + y, z])
        .take(300)
        .collect();
    let light = LightBox::new(&samples);
    let (mut beside, mut blocking) = (0, 0);
    for _ in 0..2000 {
        let middle = [next(), 2.0 + next(), next()];
        let caster = [[(); 3]; 3].map(|corner| corner.map(|()| 0.3 * next()));
        let caster = caster.map(|corner| [0, 1, 2].map(|k| middle[k] + corner[k]));
        let corners = caster.map(|corner| minus(corner, [0.0; 3]));
        let is_blocking = samples.iter().any(|sample| predicate::blocks([0.0; 3], None, &caster, *sample));
        let is_beside = is_beside(&corners, minus(light.middle, [0.0; 3]), light.radius);
        assert!(!(is_beside && is_blocking), "{caster:?}");
        // What the three lines alone would have left open.
        let cuts = (0..3).all(|k| {
            let line = minus(caster[(k + 1) % 3], caster[k]);
            let normal = cross(corners[k], line);
            dot(normal, minus(light.middle, [0.0; 3])).abs() <= light.spread(normal)
        });
        beside += usize::from(is_beside && cuts);
        blocking += usize::from(is_blocking);
    }
    assert!(beside > 50 && blocking > 200, "{beside} beside, {blocking} blocking");
}
