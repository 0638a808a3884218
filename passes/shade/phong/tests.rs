use crate::shade::reflection::Reflection;
use crate::shade::surface::{Surface, reflected};
use glam::Vec3;

#[test]
fn cosine_and_highlight_are_as_counted_by_hand() {
    let surface = Surface {
        position: Vec3::ZERO,
        triangle: 0,
        weights: Vec3::splat(1.0 / 3.0),
        is_flipped: false,
        // The triangle itself turns away from the light, its smooth normal does not: light leaks.
        geometric_normal: Vec3::X,
        shading_normal: Vec3::Y,
        toward_light: Vec3::new(-0.6, 0.8, 0.0),
        albedo: Vec3::new(1.0, 0.5, 0.0),
        light: Vec3::splat(2.0),
        visible: Vec3::ONE,
    };
    let eye = Vec3::new(6.0, 8.0, 0.0);
    let shaded = |surface: &Surface, eye: Vec3, specular: f32, shininess: f32| {
        reflected(surface, eye, Reflection { specular, shininess })
    };
    assert!((shaded(&surface, eye, 0.0, 8.0) - Vec3::new(1.6, 0.8, 0.0)).length() < 1e-6);
    // The eye is in the mirrored direction.
    assert!((shaded(&surface, eye, 0.25, 8.0) - Vec3::new(2.1, 1.3, 0.5)).length() < 1e-5);
    // cos of the angle to (0, 1, 0) is 0.8.
    let aside = shaded(&surface, Vec3::new(0.0, 9.0, 0.0), 1.0, 2.0) - shaded(&surface, eye, 0.0, 2.0);
    assert!((aside - Vec3::splat(1.28)).length() < 1e-5);
    let behind = Surface { toward_light: -Vec3::Y, ..surface };
    assert_eq!(shaded(&behind, eye, 1.0, 2.0), Vec3::ZERO);
}
