//! Files that are wrong in one place each: the problem names that place.

use super::{CORNERS, File, everything};
use serde_json::{Value, json};
use shadowgraph_core::problem::{Kind, Problem};

/// A triangle with indices.
fn indexed() -> File {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let indices = file.shorts(&[0, 1, 2]);
    file.primitive()["indices"] = json!(indices);
    file.root["buffers"] = json!([{ "byteLength": file.bin.len() }]);
    file
}

/// The indexed triangle with `pointer` set to `value`.
fn edited(pointer: &str, value: Value) -> Problem {
    let mut file = indexed();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    let parent = file.root.pointer_mut(parent).unwrap_or_else(|| panic!("{pointer}"));
    match parent {
        Value::Array(array) => array[key.parse::<usize>().unwrap()] = value,
        parent => parent[key] = value,
    }
    file.load().expect_err(pointer)
}

fn path(problem: &Problem) -> &str {
    problem.place.as_ref().map_or("", |place| place.path.as_str())
}

#[test]
fn every_mistake_is_told_with_its_place() {
    let huge = json!(4_000_000_000u64);
    let cases = [
        ("/accessors/0/count", huge.clone(), Kind::BadValue, "accessors[0]"),
        ("/accessors/1/count", huge.clone(), Kind::BadValue, "accessors[1]"),
        ("/accessors/1/count", json!(u64::MAX), Kind::BadValue, "accessors[1]"),
        ("/accessors/0/byteOffset", json!(u64::MAX), Kind::BadValue, "accessors[0]"),
        ("/accessors/0/bufferView", json!(9), Kind::BadValue, "accessors[0].bufferView"),
        ("/accessors/0/bufferView", Value::Null, Kind::Missing, "accessors[0].bufferView"),
        ("/accessors/0/type", json!("VEC2"), Kind::BadValue, "accessors[0].type"),
        ("/accessors/0/type", json!("VEC9"), Kind::BadValue, "accessors[0].type"),
        ("/accessors/0/componentType", json!(5125), Kind::BadValue, "accessors[0].componentType"),
        ("/accessors/1/componentType", json!(5126), Kind::BadValue, "accessors[1].componentType"),
        ("/bufferViews/0/byteLength", huge.clone(), Kind::BadValue, "bufferViews[0]"),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), Kind::BadValue, "bufferViews[0]"),
        ("/bufferViews/0/byteStride", json!(4), Kind::BadValue, "bufferViews[0].byteStride"),
        ("/bufferViews/0/byteStride", json!(0), Kind::BadValue, "bufferViews[0].byteStride"),
        ("/bufferViews/0/buffer", json!(1), Kind::BadValue, "bufferViews[0].buffer"),
        ("/buffers/0/byteLength", huge, Kind::BadValue, "buffers[0].byteLength"),
        ("/buffers/0/byteLength", json!(u64::MAX), Kind::BadValue, "buffers"),
        ("/buffers/0/uri", json!("none.bin"), Kind::Unsupported, "buffers[0].uri"),
        ("/buffers", json!([{ "byteLength": 4 }]), Kind::BadValue, "bufferViews[0]"),
        ("/nodes/0/mesh", json!(3), Kind::BadValue, "nodes[0].mesh"),
        ("/nodes/0/children", json!([0]), Kind::Cycle, "nodes[0]"),
        ("/nodes/0/children", json!([7]), Kind::BadValue, "nodes[0].children[0]"),
        ("/nodes/0/skin", json!(0), Kind::BadValue, "nodes[0].skin"),
        ("/nodes/0/camera", json!(0), Kind::BadValue, "nodes[0].camera"),
        ("/nodes/0/rotation", json!([0, 0, 0, 0]), Kind::BadValue, "nodes[0].rotation"),
        ("/nodes/0/scale", json!([1, 1e39, 1]), Kind::BadValue, "nodes[0].scale[1]"),
        ("/nodes/0/matrix", json!([[1.0; 16]].concat()), Kind::BadValue, "nodes[0].matrix"),
        ("/scene", json!(4), Kind::BadValue, "scene"),
        ("/scenes/0/nodes", json!([0, 0]), Kind::BadValue, "scenes[0].nodes[1]"),
        ("/scenes/0/nodes", json!([5]), Kind::BadValue, "scenes[0].nodes[0]"),
        ("/meshes/0/primitives/0/indices", json!(5), Kind::BadValue, "meshes[0].primitives[0].indices"),
        ("/meshes/0/primitives/0/mode", json!(7), Kind::BadValue, "meshes[0].primitives[0].mode"),
        ("/meshes/0/primitives/0/material", json!(0), Kind::BadValue, "meshes[0].primitives[0].material"),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            json!(8),
            Kind::BadValue,
            "meshes[0].primitives[0].attributes.POSITION",
        ),
        (
            "/meshes/0/primitives/0/attributes/NORMAL",
            json!(8),
            Kind::BadValue,
            "meshes[0].primitives[0].attributes.NORMAL",
        ),
        ("/asset/version", json!("1.0"), Kind::Unsupported, "asset.version"),
    ];
    for (pointer, value, kind, expected) in cases {
        let problem = edited(pointer, value.clone());
        assert_eq!((problem.kind, path(&problem)), (kind, expected), "{pointer} = {value}: {problem}");
    }
}

#[test]
fn the_text_of_a_problem_is_worth_reading() {
    let mut file = indexed();
    let last = file.bin.len() - 2;
    file.bin[last] = 17;
    assert_eq!(
        file.load().unwrap_err().to_string(),
        "test.glb: meshes[0].primitives[0].indices[2]: no such vertex; expected an index below 3; found 17 \
         (export the mesh again)"
    );
    assert_eq!(
        edited("/accessors/0/count", json!(4_000_000_000u64)).to_string(),
        "test.glb: accessors[0]: 4000000000 elements end behind bufferViews[0]; expected at most 36 bytes; \
         found 48000000000 bytes"
    );
    for (name, cure) in [
        ("KHR_draco_mesh_compression", "without compression"),
        ("EXT_meshopt_compression", "gltfpack"),
        ("EXT_mesh_gpu_instancing", "nodes"),
        ("ACME_unknown", "without this extension"),
    ] {
        let mut file = indexed();
        file.root["extensionsRequired"] = json!(["KHR_materials_unlit", name]);
        let problem = file.load().unwrap_err();
        assert_eq!((problem.kind, path(&problem)), (Kind::Unsupported, "extensionsRequired[1]"));
        let text = problem.to_string();
        assert!(text.contains(name) && text.contains(cure), "{text}");
    }
    let json =
        super::super::from_bytes("a.gltf", b"{\n  \"asset\": { \"version\": \"2.0\" },\n  \"nodes\": 5 }").unwrap_err();
    assert_eq!((json.kind, json.place.unwrap().line), (Kind::Syntax, 3));
}

#[test]
fn positions_that_cannot_be_computed_with_are_refused_where_they_are_used() {
    for bad in [f32::NAN, f32::INFINITY, -f32::INFINITY, 1e38, -1.1e12] {
        let mut corners = CORNERS;
        corners[1][2] = bad;
        let problem = File::with_primitive(&corners, json!({})).load().unwrap_err();
        let place = "meshes[0].primitives[0].attributes.POSITION[1]";
        assert_eq!((problem.kind, path(&problem)), (Kind::BadGeometry, place), "{problem}");
        // The same vertex in no triangle does no harm.
        let mut file = File::with_primitive(&[CORNERS[0], corners[1], CORNERS[1], CORNERS[2]], json!({}));
        let indices = file.shorts(&[0, 2, 3]);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(file.scene().positions, [CORNERS]);
    }
    // Transforms can carry a point out of the range as well.
    let mut file = File::with_primitive(&CORNERS, json!({}));
    file.root["nodes"] =
        json!([{ "scale": [1e30, 1e30, 1e30], "children": [1] }, { "scale": [1e30, 1, 1], "mesh": 0 }]);
    assert_eq!(file.load().unwrap_err().kind, Kind::BadGeometry);
}

#[test]
fn node_graphs_must_be_trees() {
    let nodes = |nodes: Value, roots: Value| {
        let mut file = File::with_primitive(&CORNERS, json!({}));
        file.root["nodes"] = nodes;
        file.root["scenes"] = json!([{ "nodes": roots }]);
        file.load()
    };
    let circle =
        nodes(json!([{ "mesh": 0 }, { "children": [2] }, { "children": [3] }, { "children": [1] }]), json!([0]));
    let circle = circle.unwrap_err();
    assert_eq!((circle.kind, path(&circle)), (Kind::Cycle, "nodes[1]"));
    let shared = nodes(json!([{ "children": [2] }, { "children": [2] }, { "mesh": 0 }]), json!([0, 1])).unwrap_err();
    assert_eq!((shared.kind, path(&shared)), (Kind::BadValue, "nodes[1].children[0]"));
    let twice = nodes(json!([{ "children": [1, 1] }, { "mesh": 0 }]), json!([0])).unwrap_err();
    assert_eq!(path(&twice), "nodes[0].children[1]");
    let child_as_root = nodes(json!([{ "children": [1] }, { "mesh": 0 }]), json!([0, 1])).unwrap_err();
    assert_eq!(path(&child_as_root), "scenes[0].nodes[1]");
    // Depth costs nothing: a chain of two hundred thousand.
    let chain: Vec<Value> =
        (0..200_000).map(|node| json!({ "children": [node + 1] })).chain([json!({ "mesh": 0 })]).collect();
    assert_eq!(nodes(json!(chain), json!([0])).unwrap().triangle_count(), 1);
}

#[test]
fn instances_and_objects_without_bound_are_refused_before_they_are_built() {
    // A mesh of ten thousand primitives of a hundred triangles, shown by a hundred nodes.
    let mut file = File::with_primitive(&[[0.0; 3]; 300], json!({}));
    let primitive = file.primitive().clone();
    file.root["meshes"][0]["primitives"] = json!(vec![primitive; 10_000]);
    file.root["nodes"] = json!(vec![json!({ "mesh": 0 }); 100]);
    file.root["scenes"] = json!([{ "nodes": (0..100).collect::<Vec<_>>() }]);
    let started = std::time::Instant::now();
    let problem = file.load().unwrap_err();
    assert_eq!((problem.kind, path(&problem)), (Kind::BadGeometry, "nodes[16].mesh"));
    assert!(started.elapsed().as_secs() < 20);

    let objects = format!("{{\"asset\":{{\"version\":\"2.0\"}},\"materials\":[{}{{}}]}}", "{},".repeat(1 << 21));
    let problem = super::super::from_bytes("many.gltf", objects.as_bytes()).unwrap_err();
    assert!(problem.to_string().contains("too many JSON objects"), "{problem}");
    let deep = "[".repeat(1 << 20);
    assert_eq!(super::super::from_bytes("deep.gltf", deep.as_bytes()).unwrap_err().kind, Kind::Syntax);
}

#[test]
fn sparse_entries_are_checked() {
    let sparse = |edit: fn(&mut Value)| {
        let mut file = everything();
        let accessor = file.root["accessors"].as_array_mut().unwrap().iter_mut().find(|one| one["sparse"].is_object());
        edit(&mut accessor.unwrap()["sparse"]);
        file.load().unwrap_err()
    };
    assert_eq!(path(&sparse(|sparse| sparse["count"] = json!(4_000_000_000u64))), "accessors[0].sparse.indices");
    assert_eq!(path(&sparse(|sparse| sparse["count"] = json!(3))), "accessors[0].sparse.indices");
    assert_eq!(
        path(&sparse(|sparse| sparse["indices"]["componentType"] = json!(5126))),
        "accessors[0].sparse.indices.componentType"
    );
    assert_eq!(
        path(&sparse(|sparse| sparse["values"]["bufferView"] = json!(99))),
        "accessors[0].sparse.values.bufferView"
    );
    let mut file = everything();
    let at = file.view(&[3, 1]);
    file.root["accessors"][0]["sparse"]["indices"]["bufferView"] = json!(at);
    assert_eq!(path(&file.load().unwrap_err()), "accessors[0].sparse.indices[1]");
}

#[test]
fn a_file_cut_anywhere_is_told_to_be_cut() {
    let bytes = everything().bytes();
    assert!(super::super::from_bytes("whole.glb", &bytes).is_ok());
    for length in 0..bytes.len() {
        let problem = super::super::from_bytes("cut.glb", &bytes[..length]).expect_err("a cut file");
        assert_eq!(problem.kind, Kind::Syntax, "{length}: {problem}");
    }
}
