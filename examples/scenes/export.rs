//! Scenes as glTF binary files, for other programs and for tests.

use serde_json::{Value, json};
use shadowgraph_core::scene::{Scene, flag};
use std::collections::BTreeMap;

/// A GLB with one mesh, a primitive for every look, vertices shared where position and shading normal are equal, and the
/// scene's cameras and lights. Triangles of one look keep their order.
pub fn write_glb(scene: &Scene) -> Vec<u8> {
    let mut bin = Binary::default();
    let positions = by_vertex(scene, &scene.positions);
    let normals = by_vertex(scene, &scene.normals);
    let (mut materials, mut primitives) = (Vec::new(), Vec::new());
    if !positions.is_empty() {
        let position = bin.push_vectors(&positions);
        let normal = bin.push_vectors(&normals);
        for ((bits, albedo), corners) in by_look(scene) {
            let indices = bin.push_indices(&corners);
            primitives.push(json!({
                "attributes": { "POSITION": position, "NORMAL": normal }, "indices": indices, "material": materials.len(),
            }));
            materials.push(material(bits, albedo.map(f32::from_bits)));
        }
    }
    let mut nodes = Vec::new();
    let mut meshes = Vec::new();
    if !primitives.is_empty() {
        nodes.push(json!({ "name": scene.name, "mesh": 0 }));
        meshes.push(json!({ "primitives": primitives }));
    }
    let mut cameras = Vec::new();
    for camera in &scene.cameras {
        nodes.push(json!({ "name": camera.name, "camera": cameras.len(), "matrix": camera_matrix(camera) }));
        cameras.push(json!({
            "type": "perspective", "name": camera.name, "perspective": { "yfov": camera.fov_y, "znear": 1e-3 },
        }));
    }
    let mut lights = Vec::new();
    for light in &scene.lights {
        nodes.push(json!({
            "name": light.name, "translation": light.position,
            "extensions": { "KHR_lights_punctual": { "light": lights.len() } },
        }));
        lights.push(json!({ "type": "point", "name": light.name, "color": light.color }));
    }

    let mut root = serde_json::Map::new();
    root.insert("asset".into(), json!({ "version": "2.0", "generator": "shadowgraph" }));
    root.insert("scene".into(), json!(0));
    root.insert("scenes".into(), json!([{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }]));
    if !lights.is_empty() {
        root.insert("extensionsUsed".into(), json!(["KHR_lights_punctual"]));
        root.insert("extensions".into(), json!({ "KHR_lights_punctual": { "lights": lights } }));
    }
    let buffers = if bin.bytes.is_empty() { Vec::new() } else { vec![json!({ "byteLength": bin.bytes.len() })] };
    // The format refuses empty arrays.
    let arrays = [
        ("nodes", nodes),
        ("meshes", meshes),
        ("materials", materials),
        ("cameras", cameras),
        ("accessors", bin.accessors),
        ("bufferViews", bin.views),
        ("buffers", buffers),
    ];
    for (name, array) in arrays.into_iter().filter(|(_, array)| !array.is_empty()) {
        root.insert(name.into(), Value::Array(array));
    }
    glb(&Value::Object(root), &bin.bytes)
}

/// Header and chunks around JSON and binary contents.
pub(crate) fn glb(root: &Value, bin: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let json = padded(root.to_string().as_bytes(), b' ');
    let bin = padded(bin, 0);
    let mut chunks = Vec::new();
    for (kind, contents) in [(b"JSON", &json), (b"BIN\0", &bin)] {
        if kind == b"JSON" || !contents.is_empty() {
            chunks.extend((contents.len() as u32).to_le_bytes());
            chunks.extend(kind);
            chunks.extend(contents);
        }
    }
    let mut file = b"glTF".to_vec();
    file.extend(2u32.to_le_bytes());
    file.extend((12 + chunks.len() as u32).to_le_bytes());
    file.extend(chunks);
    file
}

fn material(bits: u32, [red, green, blue]: [f32; 3]) -> Value {
    let mode = match bits {
        bits if bits & flag::ALPHA_MASK != 0 => "MASK",
        bits if bits & flag::ALPHA_BLEND != 0 => "BLEND",
        _ => "OPAQUE",
    };
    json!({
        "alphaMode": mode, "doubleSided": bits & flag::TWO_SIDED != 0,
        "pbrMetallicRoughness": { "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0 },
    })
}

/// Columns right, up, backward, eye.
fn camera_matrix(camera: &shadowgraph_core::scene::Camera) -> [f32; 16] {
    let [eye, target, up] = [camera.eye, camera.target, camera.up].map(|v| glam::Vec3::from(v).as_dvec3());
    let backward = (eye - target).normalize();
    let right = up.cross(backward).normalize();
    let world_from_camera = glam::DMat4::from_cols(
        right.extend(0.0),
        backward.cross(right).extend(0.0),
        backward.extend(0.0),
        eye.extend(1.0),
    );
    world_from_camera.to_cols_array().map(|x| x as f32)
}

/// A row for every smooth vertex, from any of its corners.
fn by_vertex(scene: &Scene, rows: &[[[f32; 3]; 3]]) -> Vec<[f32; 3]> {
    let mut vertices = vec![[0.0; 3]; scene.face_offset.len().saturating_sub(1)];
    for (corners, row) in scene.corner_vertex.iter().zip(rows) {
        for corner in 0..3 {
            vertices[corners[corner] as usize] = row[corner];
        }
    }
    vertices
}

/// Vertex numbers of the triangles of each look, which is flags without `CLOSED` and the bits of the albedo.
fn by_look(scene: &Scene) -> BTreeMap<(u32, [u32; 3]), Vec<u32>> {
    let mut groups: BTreeMap<_, Vec<u32>> = BTreeMap::new();
    for (triangle, corners) in scene.corner_vertex.iter().enumerate() {
        let look = (scene.flags[triangle] & !flag::CLOSED, scene.albedo[triangle].map(f32::to_bits));
        groups.entry(look).or_default().extend(corners);
    }
    groups
}

/// The one buffer, with its views and accessors.
#[derive(Default)]
struct Binary {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Binary {
    fn push_vectors(&mut self, rows: &[[f32; 3]]) -> usize {
        let bound = |pick: fn(f32, f32) -> f32| {
            rows.iter().copied().reduce(|a, b| [0, 1, 2].map(|axis| pick(a[axis], b[axis]))).unwrap_or_default()
        };
        let bounds = json!({ "min": bound(f32::min), "max": bound(f32::max) });
        let bytes = rows.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        self.push(bytes, 5126, "VEC3", rows.len(), bounds)
    }

    fn push_indices(&mut self, vertices: &[u32]) -> usize {
        let bytes = vertices.iter().flat_map(|vertex| vertex.to_le_bytes()).collect();
        self.push(bytes, 5125, "SCALAR", vertices.len(), json!({}))
    }

    fn push(&mut self, bytes: Vec<u8>, component: u32, kind: &str, count: usize, bounds: Value) -> usize {
        self.views.push(json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() }));
        self.bytes.extend(bytes);
        let mut accessor =
            json!({ "bufferView": self.views.len() - 1, "componentType": component, "type": kind, "count": count });
        if let (Some(accessor), Value::Object(bounds)) = (accessor.as_object_mut(), bounds) {
            accessor.extend(bounds);
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}
