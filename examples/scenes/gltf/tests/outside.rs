//! Buffers outside of a GLB: data URIs and files.

use super::{CORNERS, File};
use serde_json::json;
use shadowgraph_core::problem::Kind;

/// The JSON of a one-triangle scene whose buffer is at `uri`.
fn with_uri(uri: &str) -> Vec<u8> {
    let mut file = File::with_primitive(&CORNERS, json!({}));
    file.root["buffers"] = json!([{ "byteLength": file.bin.len(), "uri": uri }]);
    file.root.to_string().into_bytes()
}

fn triangle_bytes() -> Vec<u8> {
    File::with_primitive(&CORNERS, json!({})).bin
}

fn base64(bytes: &[u8]) -> String {
    let letters = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let word = group.iter().fold(0u32, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - group.len()));
        for place in 0..4 {
            let letter = letters[(word >> (18 - 6 * place)) as usize & 63] as char;
            text.push(if place <= group.len() { letter } else { '=' });
        }
    }
    text
}

#[test]
fn data_uris_are_read() {
    let text = base64(&triangle_bytes());
    let load = |text: &str| {
        super::super::from_bytes("data.gltf", &with_uri(&format!("data:application/octet-stream;base64,{text}")))
    };
    assert_eq!(load(&text).unwrap().positions, [CORNERS]);
    assert_eq!(load(text.trim_end_matches('=')).unwrap().positions, [CORNERS]);
    let cut = load(&text[..text.len() - 8]).unwrap_err();
    assert_eq!((cut.kind, cut.place.unwrap().path.as_str()), (Kind::BadValue, "buffers[0].byteLength"));
    for wrong in ["!", "A", "AA=A", "="] {
        let found = load(&format!("{}{wrong}", &text[..44])).unwrap_err();
        assert_eq!(found.place.unwrap().path.split('.').next(), Some("buffers[0]"), "{wrong}");
    }
    for length in 0..7 {
        let bytes: Vec<u8> = (0..length).map(|byte| 37 * byte).collect();
        assert_eq!(super::super::buffers::base64(base64(&bytes).as_bytes()), Ok(bytes));
    }
}

#[test]
fn files_beside_the_scene_are_read_and_others_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.gltf");
    std::fs::write(folder.path().join("a triangle.bin"), triangle_bytes()).unwrap();
    let load = |uri: &str| {
        std::fs::write(&scene, with_uri(uri)).unwrap();
        crate::load(scene.to_str().unwrap())
    };
    let found = load("a%20triangle.bin").unwrap();
    assert_eq!((found.name.as_str(), found.positions), ("scene", vec![CORNERS]));
    let missing = load("other.bin").unwrap_err();
    assert_eq!((missing.kind, missing.place.unwrap().path.as_str()), (Kind::Missing, "buffers[0].uri"));
    for outside in ["/dev/zero", "../a%20triangle.bin", "https://host/a.bin", "%zz", ".", "", "%00"] {
        let problem = load(outside).unwrap_err();
        assert!(matches!(problem.kind, Kind::Unsupported | Kind::Missing), "{outside}: {problem}");
    }
    let short = folder.path().join("short.bin");
    std::fs::write(short, &triangle_bytes()[..35]).unwrap();
    assert!(load("short.bin").unwrap_err().to_string().contains("expected 36 bytes; found 35 bytes"));
    assert_eq!(super::super::load(&folder.path().join("no.glb")).unwrap_err().kind, Kind::File);
    assert_eq!(super::super::load(folder.path()).unwrap_err().kind, Kind::File);
}
