//! Files written here, read back.

mod broken;
mod forms;
mod fuzz;
mod nodes;
mod outside;

use serde_json::{Value, json};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::scene::Scene;

/// A file under construction: its JSON, and its one buffer.
#[derive(Clone, Debug)]
struct File {
    root: Value,
    bin: Vec<u8>,
}

/// A triangle in the plane z = 0 that faces +z.
const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

impl File {
    /// A scene with the nodes given, and nothing that they name.
    fn new(nodes: Value) -> Self {
        let roots: Vec<usize> = (0..nodes.as_array().map_or(0, Vec::len))
            .filter(|node| {
                let named = |other: &Value| other["children"].as_array().is_some_and(|all| all.contains(&json!(node)));
                !nodes.as_array().is_some_and(|all| all.iter().any(named))
            })
            .collect();
        Self {
            root: json!({
                "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": roots }], "nodes": nodes,
                "meshes": [], "materials": [], "accessors": [], "bufferViews": [], "buffers": [],
            }),
            bin: Vec::new(),
        }
    }

    /// One node with a mesh of one primitive: positions and whatever else is given.
    fn with_primitive(positions: &[[f32; 3]], more: Value) -> Self {
        let mut file = Self::new(json!([{ "mesh": 0 }]));
        let accessor = file.vectors(positions);
        let mut primitive = json!({ "attributes": { "POSITION": accessor } });
        merge(&mut primitive, more);
        file.root["meshes"] = json!([{ "primitives": [primitive] }]);
        file
    }

    fn push(&mut self, array: &str, value: Value) -> usize {
        let array = self.root[array].as_array_mut().expect("an array");
        array.push(value);
        array.len() - 1
    }

    /// Appends bytes and returns their view.
    fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len() });
        self.bin.extend(bytes);
        self.push("bufferViews", view)
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    fn vectors(&mut self, rows: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, "VEC3", rows.len())
    }

    fn floats(&mut self, numbers: &[f32], kind: &str, count: usize) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, count)
    }

    fn shorts(&mut self, numbers: &[u16]) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, "SCALAR", numbers.len())
    }

    fn primitive(&mut self) -> &mut Value {
        &mut self.root["meshes"][0]["primitives"][0]
    }

    fn bytes(&self) -> Vec<u8> {
        let mut root = self.root.clone();
        if !self.bin.is_empty() && root["buffers"] == json!([]) {
            root["buffers"] = json!([{ "byteLength": self.bin.len() }]);
        }
        crate::export::glb(&root, &self.bin)
    }

    fn load(&self) -> Result<Scene, Problem> {
        super::from_bytes("test.glb", &self.bytes())
    }

    fn scene(&self) -> Scene {
        self.load().unwrap_or_else(|problem| panic!("{problem}"))
    }
}

fn merge(into: &mut Value, more: Value) {
    if let (Some(into), Value::Object(more)) = (into.as_object_mut(), more) {
        into.extend(more);
    }
}

/// Every feature in one file: nested and mirrored nodes, a skin, a morph target, sparse and interleaved accessors, a strip,
/// materials, a camera, a light.
fn everything() -> File {
    let mut file = File::new(json!([
        { "children": [1, 2], "translation": [1, 2, 3], "rotation": [0, 0.6, 0, 0.8] },
        { "mesh": 0, "scale": [-1, 2, 1] },
        { "mesh": 1, "skin": 0 },
        { "translation": [0, 1, 0], "children": [4] },
        { "translation": [0, 1, 0] },
        { "camera": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1] },
        { "extensions": { "KHR_lights_punctual": { "light": 0 } }, "translation": [0, 8, 0] },
        { "mesh": 2, "weights": [0.5] },
    ]));
    let quad = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let (position, normal) = (file.vectors(&quad), file.vectors(&[[0.0, 0.0, 1.0]; 4]));
    let indices = file.shorts(&[0, 1, 2, 2, 1, 3]);
    let joints = file.accessor(&[0, 1, 0, 0].repeat(4), 5121, "VEC4", 4);
    let weights = file.floats(&[0.5, 0.5, 0.0, 0.0].repeat(4), "VEC4", 4);
    let identity = glam::Mat4::IDENTITY.to_cols_array();
    let binds = file.floats(&[identity, identity].concat(), "MAT4", 2);
    let (at, to) = (file.view(&[1, 3]), file.view(&[0u8; 24]));
    file.root["accessors"][position]["sparse"] = json!({
        "count": 2, "indices": { "bufferView": at, "componentType": 5121 }, "values": { "bufferView": to },
    });
    let mixed: Vec<u8> =
        quad.iter().flat_map(|row| [*row, [0.0, 0.0, 1.0]]).flatten().flat_map(f32::to_le_bytes).collect();
    let view = file.view(&mixed);
    file.root["bufferViews"][view]["byteStride"] = json!(24);
    let interleaved = [0, 12].map(|offset| {
        let accessor =
            json!({ "bufferView": view, "byteOffset": offset, "componentType": 5126, "type": "VEC3", "count": 4 });
        file.push("accessors", accessor)
    });
    file.root["meshes"] = json!([
        { "primitives": [{ "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": 0 }] },
        { "primitives": [{
            "attributes": { "POSITION": interleaved[0], "JOINTS_0": joints, "WEIGHTS_0": weights }, "mode": 5 }] },
        { "primitives": [{
            "attributes": { "POSITION": interleaved[0], "NORMAL": interleaved[1] }, "mode": 6,
            "targets": [{ "POSITION": normal }], "material": 1 }], "weights": [0.0] },
    ]);
    file.root["materials"] = json!([
        { "alphaMode": "MASK", "doubleSided": true },
        { "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1, 0.5, 0, 0.2] } },
    ]);
    file.root["skins"] = json!([{ "joints": [3, 4], "inverseBindMatrices": binds }]);
    file.root["cameras"] = json!([{ "type": "perspective", "perspective": { "yfov": 0.8, "znear": 0.1 } }]);
    file.root["extensionsUsed"] = json!(["KHR_lights_punctual"]);
    file.root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    file
}
