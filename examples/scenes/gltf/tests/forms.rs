//! Forms of geometry, against triangles counted by hand.

use super::{CORNERS, File};
use serde_json::json;
use shadowgraph_core::scene::flag;

const QUAD: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

#[test]
fn indices_of_all_types_and_none() {
    let two = vec![[QUAD[0], QUAD[1], QUAD[2]], [QUAD[2], QUAD[1], QUAD[3]]];
    let order = [0u32, 1, 2, 2, 1, 3];
    for (component, size) in [(5121, 1), (5123, 2), (5125, 4)] {
        let mut file = File::with_primitive(&QUAD, json!({}));
        let bytes: Vec<u8> = order.iter().flat_map(|index| index.to_le_bytes()[..size].to_vec()).collect();
        let indices = file.accessor(&bytes, component, "SCALAR", 6);
        file.primitive()["indices"] = json!(indices);
        assert_eq!(file.scene().positions, two, "{component}");
    }
    let plain = File::with_primitive(&order.map(|index| QUAD[index as usize]), json!({}));
    assert_eq!(plain.scene().positions, two);
}

#[test]
fn strips_and_fans_keep_their_winding() {
    let strip = File::with_primitive(&QUAD, json!({ "mode": 5 })).scene();
    assert_eq!(strip.positions, [[QUAD[0], QUAD[1], QUAD[2]], [QUAD[1], QUAD[3], QUAD[2]]]);
    assert!(strip.normals.iter().flatten().all(|normal| *normal == [0.0, 0.0, 1.0]));
    let around = [QUAD[0], QUAD[1], QUAD[3], QUAD[2]];
    let fan = File::with_primitive(&around, json!({ "mode": 6 })).scene();
    assert_eq!(fan.positions, [[QUAD[1], QUAD[3], QUAD[0]], [QUAD[3], QUAD[2], QUAD[0]]]);
    assert!(fan.normals.iter().flatten().all(|normal| *normal == [0.0, 0.0, 1.0]));
    for mode in [0, 1, 2, 3] {
        let scene = File::with_primitive(&QUAD, json!({ "mode": mode })).scene();
        assert_eq!((scene.triangle_count(), scene.notes.len()), (0, 1));
        assert!(scene.notes[0].starts_with("1 primitives of points or lines"), "{:?}", scene.notes);
    }
    // A seventh corner is left over.
    let seven = File::with_primitive(&[QUAD[0], QUAD[1], QUAD[2], QUAD[0], QUAD[1], QUAD[2], QUAD[3]], json!({}));
    let scene = seven.scene();
    assert_eq!(scene.triangle_count(), 2);
    assert!(scene.notes.iter().any(|note| note.starts_with("1 corners left over")), "{:?}", scene.notes);
}

#[test]
fn sparse_entries_replace_elements_with_and_without_a_base() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let at = file.view(&[1, 0, 2, 0]);
    let values: Vec<u8> =
        [[2.0f32, 0.0, 0.0], [0.0, 2.0, 0.0]].iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    let values = file.view(&values);
    let sparse = json!({
        "count": 2, "indices": { "bufferView": at, "componentType": 5123 }, "values": { "bufferView": values },
    });
    file.root["accessors"][0]["sparse"] = sparse;
    let expected = [[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]];
    assert_eq!(file.scene().positions, expected);
    file.root["accessors"][0].as_object_mut().unwrap().remove("bufferView");
    assert_eq!(file.scene().positions, expected);
}

#[test]
fn interleaved_and_quantised_elements() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    // Two floats of something else between the positions.
    let mixed: Vec<u8> =
        CORNERS.iter().flat_map(|row| [7.0, row[0], row[1], row[2], 9.0]).flat_map(f32::to_le_bytes).collect();
    let view = file.view(&mixed);
    file.root["bufferViews"][view]["byteStride"] = json!(20);
    file.root["accessors"][0] =
        json!({ "bufferView": view, "byteOffset": 4, "componentType": 5126, "type": "VEC3", "count": 3 });
    assert_eq!(file.scene().positions, [CORNERS]);

    let mut file = File::with_primitive(&CORNERS, json!({}));
    let small: Vec<u8> = [[0i8, 0, 0, 0], [127, 0, 0, 0], [0, -128, 0, 0]].iter().flatten().map(|x| *x as u8).collect();
    let view = file.view(&small);
    file.root["bufferViews"][view]["byteStride"] = json!(4);
    file.root["accessors"][0] =
        json!({ "bufferView": view, "componentType": 5120, "normalized": true, "type": "VEC3", "count": 3 });
    file.root["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_eq!(file.scene().positions, [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]]);
    file.root["accessors"][0]["normalized"] = json!(false);
    assert_eq!(file.scene().positions, [[[0.0, 0.0, 0.0], [127.0, 0.0, 0.0], [0.0, -128.0, 0.0]]]);
}

#[test]
fn normals_are_normalised_or_made() {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    let flat = file.scene();
    assert_eq!(flat.normals, [[[0.0, 0.0, 1.0]; 3]]);
    assert!(flat.notes.iter().any(|note| note.starts_with("1 triangles have no normals")), "{:?}", flat.notes);
    let normals = file.vectors(&[[0.0, 3.0, 4.0], [0.0; 3], [f32::NAN, 0.0, 0.0]]);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    let scene = file.scene();
    assert_eq!(scene.normals, [[[0.0, 0.6, 0.8], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]]);
    assert!(scene.notes.iter().any(|note| note.starts_with("2 corner normals")), "{:?}", scene.notes);
}

#[test]
fn triangles_without_area_are_kept_and_counted() {
    let scene = File::with_primitive(&[CORNERS[0], CORNERS[1], CORNERS[1]], json!({})).scene();
    assert_eq!(scene.triangle_count(), 1);
    assert!(scene.notes.iter().any(|note| note.starts_with("1 triangles have no area")), "{:?}", scene.notes);
}

#[test]
fn materials_give_albedo_and_flags() {
    let mut file = File::with_primitive(&CORNERS, json!({ "material": 0 }));
    file.root["materials"] = json!([{
        "alphaMode": "MASK", "doubleSided": true, "pbrMetallicRoughness": { "baseColorFactor": [0.25, 2, 0.5, 1] },
    }]);
    let scene = file.scene();
    assert_eq!((scene.flags[0], scene.albedo[0]), (flag::ALPHA_MASK | flag::TWO_SIDED, [0.25, 1.0, 0.5]));
    assert!(scene.notes.iter().any(|note| note.starts_with("1 triangles have alphaMode MASK")), "{:?}", scene.notes);
    file.root["materials"] = json!([{ "alphaMode": "BLEND" }]);
    let scene = file.scene();
    assert_eq!((scene.flags[0], scene.albedo[0]), (flag::ALPHA_BLEND, [1.0; 3]));
    assert!(scene.notes.iter().any(|note| note.starts_with("1 triangles have alphaMode BLEND")), "{:?}", scene.notes);
}
