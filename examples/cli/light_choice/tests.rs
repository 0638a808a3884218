//! Flags to lights.

use super::*;
use crate::args::{Cli, Command, RenderArgs};
use clap::Parser;
use shadowgraph_core::array::Array;

fn args(words: &[&str]) -> RenderArgs {
    let cli = Cli::try_parse_from([&["shadowgraph", "render"], words].concat()).unwrap();
    let Command::Render(args) = cli.command else { panic!("{words:?}") };
    args
}

const CORNERS: [[f32; 3]; 4] = [[-1.0, 4.0, -1.0], [1.0, 4.0, -1.0], [1.0, 4.0, 3.0], [-1.0, 4.0, 3.0]];

fn made(words: &[&str]) -> Result<Light, Problem> {
    let view_light = Light::sphere("view", [0.0, 4.0, 0.0], 0.5).colored([1.0, 0.5, 0.25]);
    light(view_light, Some(CORNERS), [0.0; 3], &args(words).scene.light, &mut Vec::new())
}

fn refused(words: &[&str]) -> String {
    made(words).expect_err(&words.join(" ")).to_string()
}

#[test]
fn without_flags_the_light_is_the_views() {
    assert_eq!(made(&[]).unwrap(), Light::sphere("view", [0.0, 4.0, 0.0], 0.5).colored([1.0, 0.5, 0.25]));
    assert_eq!(made(&["--light-shape", "sphere"]).unwrap(), made(&[]).unwrap());
    let moved = made(&["--light", "1,-2,3", "--light-radius", "2", "--light-color", "1,1,0"]).unwrap();
    assert_eq!(moved, Light::sphere("view", [1.0, -2.0, 3.0], 2.0).colored([1.0, 1.0, 0.0]));
    assert_eq!(made(&["--light-radius", "0"]).unwrap().shape, LightShape::Point);
    assert_eq!(made(&["--light-shape", "point"]).unwrap().radius, 0.0);
}

#[test]
fn flat_lights_face_the_target_unless_told_otherwise() {
    let disc = made(&["--light-shape", "disc"]).unwrap();
    let LightShape::Disc { half_axes: [u, v] } = disc.shape else { panic!("{disc:?}") };
    let normal = Vec3::from(u).cross(Vec3::from(v)).normalize();
    assert!((normal - Vec3::NEG_Y).length() < 1e-6 && disc.radius == 0.5, "{normal}");
    let east = made(&["--light-shape", "disc", "--light-direction", "1,0,0", "--light", "-3,0,0"]).unwrap();
    let LightShape::Disc { half_axes: [u, v] } = east.shape else { panic!("{east:?}") };
    assert!((Vec3::from(u).cross(Vec3::from(v)).normalize() - Vec3::X).length() < 1e-6);
    assert_eq!(Vec3::from(v).normalize(), Vec3::Y, "the picture's top is up");
    assert_eq!(east.color, [1.0, 0.5, 0.25]);
}

#[test]
fn rectangles_come_from_axes_or_the_view_or_are_squares_as_large_as_the_disc() {
    let from_view = made(&["--light-shape", "rectangle"]).unwrap();
    assert_eq!((from_view.position, from_view.color), ([0.0, 4.0, 1.0], [1.0, 0.5, 0.25]));
    let axes = ["--light-shape", "rectangle", "--light-axis", "1,0,0", "--light-axis", "0,0,-2"];
    let from_axes = made(&axes).unwrap();
    assert_eq!(from_axes.shape, LightShape::Rectangle { half_axes: [[1.0, 0.0, 0.0], [0.0, 0.0, -2.0]] });
    for words in [&["--light-radius", "2"][..], &["--light-radius", "2", "--light-direction", "0,0,1"]] {
        let square = made(&[&["--light-shape", "rectangle"], words].concat()).unwrap();
        let LightShape::Rectangle { half_axes: [u, v] } = square.shape else { panic!("{square:?}") };
        let area = 4.0 * Vec3::from(u).cross(Vec3::from(v)).length();
        assert!((area - 4.0 * std::f32::consts::PI).abs() < 1e-5, "{area}");
    }
}

#[test]
fn flags_that_do_not_go_together_are_told() {
    let shape = |name: &'static str| ["--light-shape", name];
    assert!(refused(&[&shape("ellipsoid")[..], &["--light-axis", "1,0,0"]].concat()).contains("3 times, each X,Y,Z"));
    assert!(refused(&[&shape("disc")[..], &["--light-axis", "1,0,0"]].concat()).contains("2 times"));
    assert!(refused(&["--light-axis", "1,0,0"]).contains("--light-axis needs a shape"));
    assert!(refused(&["--light-direction", "1,0,0"]).contains("faces somewhere"));
    assert!(refused(&shape("points")).contains("--light-points FILE"));
    assert!(refused(&shape("volume")).contains("--light-mesh FILE"));
    assert!(refused(&[&shape("disc")[..], &["--light-radius", "0"]].concat()).contains("needs an extent"));
    assert!(refused(&["--light-radius", "NaN"]).contains("out of range"));
    assert!(refused(&["--light-color", "1,0,-1"]).contains("no colour"));
    assert!(refused(&["--light-mesh", "builtin:torus-knot", "--light-shape", "disc"]).contains("does not go with"));
    assert!(refused(&["--light-mesh", "builtin:torus-knot", "--light-texture", "x.png"]).contains("takes no"));
    assert!(Cli::try_parse_from(["shadowgraph", "render", "--light-axis", "1,0,0", "--light-radius", "1"]).is_err());
    assert!(Cli::try_parse_from(["shadowgraph", "render", "--light-samples", "4097"]).is_err());
}

#[test]
fn meshes_shine_by_surface_or_volume() {
    let closed = "builtin:random-triangles";
    let surface = made(&["--light-mesh", closed, "--light-radius", "0.25", "--light", "0,3,0"]).unwrap();
    assert_eq!((surface.shape.name(), surface.position), ("surface", [0.0, 3.0, 0.0]));
    assert!((surface.radius - 0.25).abs() < 1e-6);
    let open = refused(&["--light-mesh", closed, "--light-shape", "volume"]);
    assert!(open.starts_with("builtin:random-triangles: the light's mesh is not closed"), "{open}");
    assert!(open.contains("leave out --light-shape volume"), "{open}");
}

#[test]
fn points_are_read_and_all_of_them_are_samples() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, array: &Array| {
        let path = folder.path().join(name);
        npy::write(&path, array).unwrap();
        path.display().to_string()
    };
    let points = file("points.npy", &Array::f32([2, 3], vec![0.0, 1.0, 2.0, 4.0, 1.0, 2.0]));
    let colors = file("colors.npy", &Array::f32([2, 3], vec![1.0, 0.0, 0.0, 3.0, 1.0, 0.0]));
    let flags = args(&["--light-points", &points, "--light-point-colors", &colors]).scene.light;
    let light = light(Light::point("view", [9.0; 3]), None, [0.0; 3], &flags, &mut Vec::new()).unwrap();
    assert_eq!((light.position, light.radius), ([2.0, 1.0, 2.0], 2.0));
    assert_eq!(sampling(&light, &flags).unwrap().count, 2);
    let samples = shadowgraph_scenes::lights::sample(&light, &sampling(&light, &flags).unwrap()).unwrap();
    assert_eq!(samples.weights, [[0.25, 0.0, 0.5], [0.75, 1.0, 0.5]]);

    let nan = file("nan.npy", &Array::f32([1, 3], vec![f32::NAN, 0.0, 0.0]));
    let none = file("none.npy", &Array::f32([0, 3], Vec::new()));
    let wide = file("wide.npy", &Array::f32([1, 4], vec![0.0; 4]));
    let many = file("many.npy", &Array::f32([5000, 3], (0..15_000).map(|x| x as f32).collect()));
    for (path, says) in [(&nan, "point 0 is no point"), (&none, "no such number of points"), (&wide, "[P, 3]")] {
        let problem = refused(&["--light-points", path]);
        assert!(problem.starts_with(path.as_str()) && problem.contains(says), "{problem}");
    }
    assert!(refused(&["--light-points", &points, "--light-point-colors", &many]).contains("differ in number"));
    let flags = args(&["--light-points", &many]).scene.light;
    let light = super::light(Light::point("", [0.0; 3]), None, [0.0; 3], &flags, &mut Vec::new()).unwrap();
    let problem = sampling(&light, &flags).unwrap_err().to_string();
    assert!(problem.contains("--light-samples 4096"), "{problem}");
}

#[test]
fn the_count_is_the_flags_else_the_graphs_else_one() {
    let light = Light::sphere("", [0.0; 3], 1.0);
    let count = |words: &[&str], of_graph| {
        let choice = args(words).scene.for_graph(of_graph);
        sampling(&light, &choice.light).unwrap().count
    };
    assert_eq!([count(&[], None), count(&[], Some(256)), count(&["--light-samples", "7"], Some(256))], [1, 256, 7]);
}
