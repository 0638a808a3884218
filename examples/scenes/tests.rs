//! Views files and the choice of a view.

use crate::builtin;
use crate::place::{choose_from, choose_view, short_name};
use crate::views::Views;
use shadowgraph_core::problem::Kind;

const VIEWS: &str = r#"{ "about": "tests", "scenes": { "columns": { "views": [
  { "name": "overview", "note": "x", "eye": [0, 1, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y_deg": 45,
    "light": { "position": [2, 8, 3], "radius": 0.5, "rect_corners": [[0,0,0],[1,0,0],[1,1,0],[0,1,0]] } },
  { "name": "bare", "eye": [0, 1, 5], "target": [0, 0, 0], "fov_y_deg": 30 } ] } } }"#;

fn problem(from: &str, to: &str) -> shadowgraph_core::problem::Problem {
    assert!(VIEWS.contains(from));
    Views::parse("v.json", &VIEWS.replacen(from, to, 1)).expect_err(to)
}

#[test]
fn a_views_file_gives_camera_and_light() {
    let views = Views::parse("v.json", VIEWS).unwrap();
    let scene = builtin::build("columns?count=2").unwrap();
    assert_eq!(short_name("builtin:columns?count=2"), "columns");
    assert_eq!(short_name("../some/folder/sponza.v2.glb"), "sponza.v2");

    let first = choose_from(&scene, "columns.glb", &views, None).unwrap();
    assert_eq!((first.camera.eye, first.camera.fov_y), ([0.0, 1.0, 5.0], 45.0_f32.to_radians()));
    assert_eq!((first.light.position, first.light.radius), ([2.0, 8.0, 3.0], 0.5));
    let corners = views.view("columns", Some("overview")).unwrap().rect_corners;
    assert_eq!(corners.map(|corners| corners[2]), Some([1.0, 1.0, 0.0]));
    assert!(first.note.is_empty());

    let bare = choose_from(&scene, "columns.glb", &views, Some("bare")).unwrap();
    assert_eq!(bare.light, scene.lights[0]);
    let unknown = choose_from(&scene, "columns.glb", &views, Some("overveiw")).unwrap_err();
    assert_eq!((unknown.kind, unknown.remedy.as_deref()), (Kind::UnknownName, Some("nearest: overview")));
    let unknown = choose_from(&scene, "colums.glb", &views, None).unwrap_err();
    assert_eq!((unknown.kind, unknown.remedy.as_deref()), (Kind::UnknownName, Some("nearest: columns")));
}

#[test]
fn what_is_wrong_in_a_views_file_is_located() {
    let text = problem("\"eye\": [0, 1, 5], \"target\"", "\"eye\": [0, 1], \"target\"");
    let place = text.place.clone().unwrap();
    assert_eq!((text.kind, place.file.as_str(), place.line), (Kind::Syntax, "v.json", 2));

    let path = |from: &str, to: &str| {
        let found = problem(from, to);
        assert_eq!(found.kind, Kind::BadValue, "{found}");
        found.place.unwrap().path
    };
    assert_eq!(path("[0, 1, 0]", "[0, -1, -5]"), "scenes.columns.views[0].up");
    assert_eq!(path("\"fov_y_deg\": 30", "\"fov_y_deg\": 180"), "scenes.columns.views[1].fov_y_deg");
    assert_eq!(path("\"target\": [0, 0, 0]", "\"target\": [0, 1, 5]"), "scenes.columns.views[0].target");
    assert_eq!(path("\"radius\": 0.5", "\"radius\": -1"), "scenes.columns.views[0].light.radius");
    assert_eq!(path("[2, 8, 3]", "[1e30, 8, 3]"), "scenes.columns.views[0].light.position");
    assert_eq!(Views::read(std::path::Path::new("no/such/file.json")).unwrap_err().kind, Kind::File);
}

#[test]
fn a_views_file_may_shape_and_colour_its_light() {
    let light = |fields: &str| {
        let text = VIEWS.replacen("\"radius\": 0.5,", fields, 1);
        Views::parse("v.json", &text).map(|views| views.view("columns", None).unwrap().light.clone().unwrap())
    };
    let plain = light("").unwrap();
    assert_eq!((plain.shape.name(), plain.color), ("point", [1.0; 3]));
    let corners = light(r#""shape": "rectangle", "color": [1, 0.5, 0],"#).unwrap();
    assert_eq!(
        (corners.shape.name(), corners.position, corners.color),
        ("rectangle", [0.5, 0.5, 0.0], [1.0, 0.5, 0.0])
    );
    let disc = light(r#""shape": "disc", "half_axes": [[2, 0, 0], [0, 0, 2]],"#).unwrap();
    assert_eq!((disc.shape.name(), disc.position, disc.radius), ("disc", [2.0, 8.0, 3.0], 2.0));
    let ball = light(r#""shape": "ellipsoid", "half_axes": [[1, 0, 0], [0, 4, 0], [0, 0, 0.25]],"#).unwrap();
    assert_eq!((ball.shape.name(), ball.radius), ("ellipsoid", 4.0));
    let wrong = |fields: &str| light(fields).expect_err(fields).to_string();
    assert_eq!(
        wrong(r#""shape": "disk","#),
        "v.json: scenes.columns.views[0].light.shape: no such shape; expected point, sphere, disc, rectangle, ellipsoid; \
         found disk (nearest: disc)"
    );
    assert!(wrong(r#""shape": "disc", "half_axes": [[1, 0, 0]],"#).contains("2 half axes; found 1 half axes"));
    assert!(wrong(r#""shape": "ellipsoid","#).contains("3 half axes; found 0"));
    assert!(wrong(r#""color": [1, -1, 0],"#).contains("light.color: no such colour"));
}

#[test]
fn without_any_view_the_box_is_framed_and_the_light_is_outside() {
    let mut scene = builtin::build("columns").unwrap();
    assert_eq!(choose_view(&scene, "x.glb", None, None).unwrap().camera, scene.cameras[0]);
    assert_eq!(choose_view(&scene, "x.glb", None, Some("default")).unwrap().camera, scene.cameras[0]);
    assert_eq!(choose_view(&scene, "x.glb", None, Some("other")).unwrap_err().kind, Kind::UnknownName);

    scene.cameras.clear();
    scene.lights.clear();
    // Flat, tall, tiny and far, a point, nothing.
    let corners = |low: [f32; 3], high: [f32; 3]| vec![[low, high, low]];
    let cases = [
        scene.positions.clone(),
        corners([0.0; 3], [1.0, 0.0, 1.0]),
        corners([0.0; 3], [0.01, 100.0, 0.01]),
        corners([1e6, 0.0, 1e6], [1e6 + 0.125, 0.0, 1e6]),
        corners([3.0; 3], [3.0; 3]),
        Vec::new(),
    ];
    for positions in cases {
        scene.positions = positions;
        let view = choose_view(&scene, "x.glb", None, None).unwrap();
        assert_eq!(view.note.len(), 2);
        assert_ne!(view.camera.eye, view.camera.target);
        let [low, high] = scene.bounds().unwrap_or_default();
        let inside = |point: [f32; 3]| (0..3).all(|axis| low[axis] <= point[axis] && point[axis] <= high[axis]);
        assert!(!inside(view.light.position) && !inside(view.camera.eye), "{view:?}");
        assert!(view.light.position[1] > high[1]);
        // Every corner lies inside the camera's cone.
        let eye = glam::Vec3::from(view.camera.eye);
        let forward = (glam::Vec3::from(view.camera.target) - eye).normalize();
        for corner in scene.positions.iter().flatten() {
            let cosine = (glam::Vec3::from(*corner) - eye).normalize().dot(forward);
            assert!(cosine >= (view.camera.fov_y / 2.0).cos() - 1e-3, "{corner:?}");
        }
    }
}
