use super::*;
use glam::{dvec2, dvec3};

fn form(text: &str) -> ClosedForm {
    of_builtin(text).expect("parses").expect("has a closed form")
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-6, "{found} not {expected}");
}

#[test]
fn a_half_plane_makes_a_linear_ramp() {
    let form = form("half-plane");
    // The edge at height 1.2 of 3 is seen 1.5 times as far behind as the receiver is before it; the light is 1 wide.
    for x in [-0.5, -0.3, -0.1, 0.0, 0.05, 0.2, 0.3, 1.0] {
        for z in [-1.0, 0.0, 0.7] {
            close(form.visible(dvec3(x, 0.0, z)), (0.5 + 1.5 * x).clamp(0.0, 1.0));
        }
    }
}

#[test]
fn halves_fuse_to_all_and_stay_a_half() {
    let other = form("fusion");
    let same = form("fusion?halves=same");
    for z in [-2.0, -0.3, 0.0, 1.1] {
        close(other.visible(dvec3(0.0, 0.0, z)), 0.0);
        close(same.visible(dvec3(0.0, 0.0, z)), 0.5);
    }
    // Beside x = 0 the edges part: 1.5 and 0.875 times as far behind, a gap on one side and an overlap on the other.
    close(other.visible(dvec3(0.2, 0.0, 0.0)), 0.2 * (1.5 - 0.875));
    close(other.visible(dvec3(-0.2, 0.0, 0.0)), 0.0);
    close(same.visible(dvec3(0.2, 0.0, 0.0)), 0.5 + 0.2 * 0.875);
    close(same.visible(dvec3(-0.2, 0.0, 0.0)), 0.5 - 0.2 * 1.5);
}

#[test]
fn parts_add_and_the_nested_one_changes_nothing() {
    let alone = |form: &ClosedForm, caster: usize, at: DVec3| {
        1.0 - ClosedForm { casters: vec![form.casters[caster].clone()], ..form.clone() }.visible(at)
    };
    let (apart, nested) = (form("apart"), form("nested"));
    let mut seen = 0;
    for (x, z) in (-6..=6).flat_map(|x| (-6..=6).map(move |z| (f64::from(x) * 0.1, f64::from(z) * 0.1))) {
        let at = dvec3(x, 0.0, z);
        let both = [0, 1].map(|caster| alone(&apart, caster, at));
        close(1.0 - apart.visible(at), both[0] + both[1]);
        seen += usize::from(both[0] > 0.05 && both[1] > 0.05);
        let both = [0, 1].map(|caster| alone(&nested, caster, at));
        close(1.0 - nested.visible(at), both[0].max(both[1]));
    }
    assert!(seen > 20, "both cover some of the light at {seen} places only");
}

#[test]
fn a_round_caster_over_a_disc_makes_the_lens_of_two_circles() {
    // A horizontal disc is a disc from everywhere: here twice as far from the light as from the receiver.
    let corners = 2048;
    let round = |k: usize| {
        let (z, x) = (k as f64 / f64::from(corners) * std::f64::consts::TAU).sin_cos();
        dvec3(0.3 * x, 1.0, 0.3 * z)
    };
    let form = ClosedForm { casters: vec![(0..corners as usize).map(round).collect()], ..form("sphere-over-disc") };
    for x in [0.0, 0.1, 0.35, 0.5, 0.9] {
        let blocked = lens([0.6, 0.9], 2.0 * x) / (std::f64::consts::PI * 0.36);
        assert!((form.visible(dvec3(x, 0.0, 0.0)) - (1.0 - blocked)).abs() < 1e-5, "{x}");
    }
}

#[test]
fn right_below_a_fine_sphere_the_light_is_a_ring() {
    // From the ground the sphere of radius 0.4 at height 1.2 is a cone; 3 high, its circle has radius 3 tan(asin(1/3)).
    let cone = 3.0 * (1.0f64 / 3.0).asin().tan();
    assert!(cone > 0.6, "the disc is covered");
    let fine = ClosedForm { half_axes: [DVec3::X * 2.0, DVec3::Z * 2.0], ..form("sphere-over-disc?facets=512") };
    let ring = 1.0 - cone * cone / 4.0;
    assert!((fine.visible(DVec3::ZERO) - ring).abs() < 1e-4);
}

#[test]
fn shares_do_not_depend_on_how_the_axes_lie() {
    let form = form("polygon");
    let sheared = [form.half_axes[0] + form.half_axes[1] * 0.0, form.half_axes[1] + form.half_axes[0] * 0.5];
    let at = dvec3(0.15, 0.0, -0.2);
    let sheared = ClosedForm { half_axes: sheared, ..form.clone() };
    let corner = sheared.centre + sheared.half_axes[0] - sheared.half_axes[1];
    assert!((sheared.in_half_axes(corner - sheared.centre) - dvec2(1.0, -1.0)).length() < 1e-12);
    assert!((0.0..=1.0).contains(&sheared.visible(at)) && (0.0..=1.0).contains(&form.visible(at)));
}

#[test]
fn other_scenes_have_none() {
    assert_eq!(of_builtin("columns").expect("is a scene"), None);
    assert!(of_builtin("half-plan").is_err());
}
