use super::*;
use shadowgraph_core::problem::Kind;

fn scene(text: &str) -> Scene {
    build(text).unwrap_or_else(|problem| panic!("{problem}"))
}

#[test]
fn every_scene_is_sound_at_its_defaults_and_the_same_twice() {
    for builtin in list() {
        let scene = scene(builtin.name);
        assert_eq!(scene, self::scene(builtin.name), "{}", builtin.name);
        assert!(scene.positions.iter().flatten().flatten().all(|x| x.is_finite()), "{}", builtin.name);
        for normal in scene.normals.iter().flatten() {
            let length = normal.iter().map(|x| x * x).sum::<f32>().sqrt();
            assert!((length - 1.0).abs() < 1e-5, "{}: normal {normal:?}", builtin.name);
        }
        let counts = [scene.normals.len(), scene.flags.len(), scene.albedo.len(), scene.corner_vertex.len()];
        assert_eq!(counts, [scene.triangle_count(); 4], "{}", builtin.name);
        assert!(!scene.cameras.is_empty() && !scene.lights.is_empty(), "{} has no view", builtin.name);
        for camera in &scene.cameras {
            assert_ne!(camera.eye, camera.target, "{}", builtin.name);
        }
        assert!(!builtin.doc.is_empty());
    }
}

#[test]
fn parameters_change_the_scene() {
    assert_eq!(scene("columns?count=2&flutes=8").parts_count, 3);
    assert_eq!(scene("columns?count=2&flutes=8").closed_parts_count, 2);
    assert_eq!(scene("random-triangles?count=100").triangle_count(), 102);
    assert_ne!(
        scene("random-triangles?count=100&seed=2").positions,
        scene("random-triangles?count=100&seed=1").positions
    );
    assert_eq!(scene("random-triangles?count=0").triangle_count(), 2);
    assert_eq!(scene("empty").triangle_count(), 0);
}

#[test]
fn mistakes_are_told_with_what_would_have_been_right() {
    let problem = |text: &str| build(text).expect_err(text);
    let name = problem("colums");
    assert_eq!((name.kind, name.remedy.as_deref()), (Kind::UnknownName, Some("nearest: columns")));
    let key = problem("columns?cuont=3");
    assert_eq!((key.kind, key.remedy.as_deref()), (Kind::UnknownName, Some("nearest: count")));
    let range = problem("columns?count=65");
    assert_eq!((range.kind, range.expected.as_deref()), (Kind::BadValue, Some("whole number 1..=64")));
    assert_eq!(problem("columns?count=-1").kind, Kind::BadValue);
    assert_eq!(problem("columns?count").kind, Kind::Syntax);
    assert_eq!(problem("columns?count=2&count=3").kind, Kind::Duplicate);
    assert_eq!(
        problem("empty?count=2").to_string(),
        "builtin:empty?count=2: empty has no such parameter; expected no parameters; found count"
    );
}
