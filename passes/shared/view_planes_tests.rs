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
