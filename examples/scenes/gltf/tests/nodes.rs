//! Transforms, instances, skins, morph targets, cameras and lights.

use super::{CORNERS, File, everything};
use serde_json::{Value, json};
use shadowgraph_core::scene::{Scene, flag};

/// The triangle shown by these nodes.
fn shown_by(nodes: Value) -> Scene {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let normals = file.vectors(&[[0.0, 0.0, 1.0]; 3]);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    file.root["nodes"] = nodes;
    file.scene()
}

#[test]
fn transforms_nest_whether_matrix_or_parts() {
    // A quarter turn about z, then twice as large, then moved.
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let expected = [[[10.0, 0.0, 1.0], [10.0, 2.0, 1.0], [8.0, 0.0, 1.0]]];
    let parts = shown_by(json!([
        { "translation": [10, 0, 0], "scale": [2, 2, 2], "rotation": [0, 0, half, half], "children": [1] },
        { "mesh": 0, "translation": [0, 0, 0.5] },
    ]));
    let matrix = shown_by(json!([
        { "matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1], "children": [1] },
        { "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0.5, 1] },
    ]));
    for scene in [parts, matrix] {
        for (found, wanted) in scene.positions.iter().flatten().flatten().zip(expected.iter().flatten().flatten()) {
            assert!((found - wanted).abs() < 1e-5, "{:?}", scene.positions);
        }
        assert_eq!(scene.normals, [[[0.0, 0.0, 1.0]; 3]]);
    }
}

#[test]
fn mirrored_nodes_keep_the_outside_outside() {
    for scale in [[-1, 1, 1], [1, -1, 1], [-1, -1, -1], [-1, -1, 1]] {
        let scene = shown_by(json!([{ "mesh": 0, "scale": scale }]));
        let normal = crate::soup::geometric_normal(scene.positions[0]);
        assert_eq!(normal, scene.normals[0][0], "{scale:?}");
        assert_eq!(normal[2], if scale[2] > 0 { 1.0 } else { -1.0 }, "{scale:?}");
    }
    // Uneven scale turns normals by the inverse transpose.
    let mut file = File::with_primitive(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, -1.0]], json!({}));
    let diagonal = std::f32::consts::FRAC_1_SQRT_2;
    let normals = file.vectors(&[[-diagonal, -diagonal, 0.0]; 3]);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    file.root["nodes"] = json!([{ "mesh": 0, "scale": [2, 1, 1] }]);
    let scene = file.scene();
    let flat = crate::soup::geometric_normal(scene.positions[0]);
    let cosine: f32 = flat.iter().zip(&scene.normals[0][0]).map(|(a, b)| a * b).sum();
    assert!((cosine.abs() - 1.0).abs() < 1e-6, "{flat:?} {:?}", scene.normals);
}

#[test]
fn a_mesh_shown_twice_is_two_shapes_and_other_scenes_are_not_shown() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    file.root["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0 }, { "mesh": 0 }]);
    file.root["scenes"] = json!([{ "nodes": [0, 1] }, { "nodes": [2] }, {}]);
    let scene = file.scene();
    assert_eq!((scene.triangle_count(), scene.face_offset.len() - 1), (2, 6));
    file.root["scene"] = json!(1);
    assert_eq!(file.scene().triangle_count(), 1);
    // A scene may leave out its list of nodes.
    file.root["scene"] = json!(2);
    assert_eq!(file.scene().triangle_count(), 0);
    file.root.as_object_mut().unwrap().remove("scene");
    assert_eq!(file.scene().triangle_count(), 2);
}

/// Two joints one above the other; the vertices belong to the first, the second, half to each.
fn skinned() -> File {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let joints = file.accessor(&[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0], 5121, "VEC4", 3);
    let weights = file.floats(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0], "VEC4", 3);
    let moved = glam::Mat4::from_translation(glam::vec3(0.0, 0.0, -1.0)).to_cols_array();
    let binds = file.floats(&[moved, moved].concat(), "MAT4", 2);
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.root["nodes"] = json!([
        { "mesh": 0, "skin": 0, "translation": [100, 100, 100] },
        { "translation": [0, 0, 1], "children": [2] },
        { "translation": [0, 4, 0] },
    ]);
    file.root["scenes"] = json!([{ "nodes": [0, 1] }]);
    file.root["skins"] = json!([{ "joints": [1, 2], "inverseBindMatrices": binds }]);
    file
}

#[test]
fn a_skin_poses_vertices_by_its_joints_and_not_by_the_node() {
    let mut file = skinned();
    assert_eq!(file.scene().positions, [[[0.0, 0.0, 0.0], [1.0, 4.0, 0.0], [0.0, 3.0, 0.0]]]);
    // Without inverse bind matrices the joints' own places count.
    file.root["skins"][0].as_object_mut().unwrap().remove("inverseBindMatrices");
    assert_eq!(file.scene().positions, [[[0.0, 0.0, 1.0], [1.0, 4.0, 1.0], [0.0, 3.0, 1.0]]]);
}

#[test]
fn what_is_wrong_with_a_skin_is_told() {
    let mut file = skinned();
    file.root["skins"][0]["joints"] = json!([1]);
    let problem = file.load().unwrap_err();
    let path = problem.place.unwrap().path;
    assert_eq!(path, "meshes[0].primitives[0].attributes.JOINTS_0[1]");
    let mut file = skinned();
    file.primitive()["attributes"].as_object_mut().unwrap().remove("WEIGHTS_0");
    assert!(file.load().unwrap_err().to_string().contains("JOINTS_0 and WEIGHTS_0"));
    let mut file = skinned();
    let zero = file.floats(&[0.0; 12], "VEC4", 3);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(zero);
    assert_eq!(file.load().unwrap_err().place.unwrap().path, "meshes[0].primitives[0].attributes.WEIGHTS_0[0]");
}

#[test]
fn morph_targets_act_at_the_weights_of_the_node_then_of_the_mesh() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let (up, right) = (file.vectors(&[[0.0, 0.0, 2.0]; 3]), file.vectors(&[[4.0, 0.0, 0.0]; 3]));
    file.primitive()["targets"] = json!([{ "POSITION": up }, { "POSITION": right }]);
    assert_eq!(file.scene().positions, [CORNERS]);
    file.root["meshes"][0]["weights"] = json!([0.5, 0.25]);
    assert_eq!(file.scene().positions[0][0], [1.0, 0.0, 1.0]);
    file.root["nodes"][0]["weights"] = json!([1.0, 0.0]);
    assert_eq!(file.scene().positions[0][0], [0.0, 0.0, 2.0]);
}

#[test]
fn cameras_and_lights_come_with_their_nodes() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let half = std::f32::consts::FRAC_1_SQRT_2;
    file.root["nodes"] = json!([
        { "mesh": 0 },
        // Looks along -x: a quarter turn about y.
        { "name": "eye", "camera": 0, "translation": [5, 0, 0], "rotation": [0, half, 0, half] },
        { "camera": 1 },
        { "name": "bulb", "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [1, 2, 3] },
        { "name": "sun", "extensions": { "KHR_lights_punctual": { "light": 1 } }, "rotation": [-half, 0, 0, half] },
    ]);
    file.root["scenes"] = json!([{ "nodes": [0, 1, 2, 3, 4] }]);
    file.root["cameras"] = json!([
        { "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } },
        { "type": "orthographic", "orthographic": { "xmag": 1, "ymag": 1, "zfar": 2, "znear": 1 } },
    ]);
    file.root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [
        { "type": "spot", "color": [1, 0.5, 0], "spot": {} }, { "type": "directional" } ] } });
    let scene = file.scene();
    let [camera] = scene.cameras.as_slice() else { panic!("{:?}", scene.cameras) };
    assert_eq!((camera.name.as_str(), camera.eye, camera.fov_y), ("eye", [5.0, 0.0, 0.0], 0.8));
    assert!(camera.target[0] < 1.0 && camera.target[1].abs() < 1e-5 && camera.target[2].abs() < 1e-5, "{camera:?}");
    assert_eq!((scene.lights[0].name.as_str(), scene.lights[0].position), ("bulb", [1.0, 2.0, 3.0]));
    assert_eq!(scene.lights[0].color, [1.0, 0.5, 0.0]);
    // It shines down, so it is placed above: ten diagonals, 10 sqrt 2, from the middle (0.5, 0.5, 0).
    let sun = scene.lights[1].position;
    assert!((sun[1] - 14.642).abs() < 1e-3 && (sun[0] - 0.5).abs() < 1e-4, "{sun:?}");
    for start in ["1 cameras left out", "1 directional lights", "1 spot lights"] {
        assert!(scene.notes.iter().any(|note| note.starts_with(start)), "{start}: {:?}", scene.notes);
    }
}

#[test]
fn everything_at_once_loads() {
    let scene = everything().scene();
    assert_eq!((scene.triangle_count(), scene.cameras.len(), scene.lights.len()), (6, 1, 1));
    assert_eq!(scene.flags.iter().filter(|flags| **flags & flag::ALPHA_BLEND != 0).count(), 2);
}

#[test]
fn an_exported_scene_comes_back() {
    for spec in ["builtin:torus-knot?segments=24&sides=6", "builtin:transparent", "builtin:degenerate", "builtin:empty"]
    {
        let scene = crate::load(spec).unwrap();
        let back = super::super::from_bytes("back", &crate::export::write_glb(&scene)).unwrap();
        let sorted = |scene: &Scene| {
            let mut rows: Vec<_> = (0..scene.triangle_count())
                .map(|row| (scene.positions[row].map(|corner| corner.map(f32::to_bits)), scene.flags[row]))
                .collect();
            rows.sort_unstable();
            rows
        };
        assert_eq!(sorted(&back), sorted(&scene), "{spec}");
        assert_eq!(back.parts_count, scene.parts_count, "{spec}");
        assert_eq!((back.cameras.len(), back.lights.len()), (1, 1), "{spec}");
        assert_eq!(back.cameras[0].eye, scene.cameras[0].eye);
        assert_eq!(back.lights[0].position, scene.lights[0].position);
    }
}
