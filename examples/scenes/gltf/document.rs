//! JSON text to the typed tree of the gltf crate, and what the file demands of its reader.
//!
//! The crate's own validation is not used: it stops on missing bounds that nothing here needs, and trusts some of the
//! indices it should check. Every index, count and number is checked where it is used instead.

use super::limits;
use super::source::Source;
use gltf::json::Root;
use serde_json::{Value, json};
use shadowgraph_core::problem::{Kind, Place, Problem};

/// Extensions that change nothing a shadow needs, besides those whose names begin with `KHR_materials_` or
/// `KHR_texture_`: a file may require them.
const HARMLESS: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
    "EXT_texture_webp",
    "EXT_texture_avif",
    "MSFT_texture_dds",
];

/// What to do about extensions that are known and absent here.
const CURES: &[(&str, &str)] = &[
    ("KHR_draco_mesh_compression", "load the file in an editor such as Blender and export it without compression"),
    ("EXT_meshopt_compression", "write it without compression: gltfpack -i IN -o OUT without -c does"),
    ("KHR_meshopt_compression", "write it without compression: gltfpack -i IN -o OUT without -c does"),
    ("EXT_mesh_gpu_instancing", "write the instances as nodes: gltfpack without -mi does"),
];

/// Parses the text and refuses what cannot be read rightly.
pub fn parse(source: &Source, text: &[u8]) -> Result<Root, Problem> {
    let objects = text.iter().filter(|byte| **byte == b'{').count();
    if objects > limits::OBJECTS {
        return Err(source
            .problem(Kind::BadValue, "", "too many JSON objects")
            .expected(format!("at most {}", limits::OBJECTS))
            .found(objects.to_string())
            .remedy("split the scene, or merge its meshes and nodes"));
    }
    let root = Root::from_slice(text).or_else(|error| with_empty_scenes(text).ok_or(error)).map_err(|error| {
        let (line, column) = (error.line(), error.column());
        let text = error.to_string();
        let message = text.split(" at line ").next().unwrap_or_default().to_owned();
        Problem::new(Kind::Syntax, format!("not glTF JSON: {message}"))
            .at(Place { file: source.name.clone(), line, column, path: String::new() })
            .remedy("line and column count in the JSON text; export the file again")
    })?;
    check_version(source, &root)?;
    check_extensions(source, &root)?;
    Ok(root)
}

/// A scene may leave out its list of nodes; the typed tree has no default for it.
fn with_empty_scenes(text: &[u8]) -> Option<Root> {
    let mut value: Value = serde_json::from_slice(text).ok()?;
    for scene in value.get_mut("scenes")?.as_array_mut()? {
        scene.as_object_mut()?.entry("nodes").or_insert_with(|| json!([]));
    }
    serde_json::from_value(value).ok()
}

fn check_version(source: &Source, root: &Root) -> Result<(), Problem> {
    let wanted = root.asset.min_version.as_ref().unwrap_or(&root.asset.version);
    match wanted.split('.').next() {
        Some("2") => Ok(()),
        _ => Err(source
            .problem(Kind::Unsupported, "asset.version", "not a glTF 2.0 file")
            .expected("2.0")
            .found(wanted.clone())
            .remedy("export the scene as glTF 2.0")),
    }
}

fn check_extensions(source: &Source, root: &Root) -> Result<(), Problem> {
    for (index, name) in root.extensions_required.iter().enumerate() {
        let family = ["KHR_materials_", "KHR_texture_"].iter().any(|prefix| name.starts_with(prefix));
        if family || HARMLESS.contains(&name.as_str()) {
            continue;
        }
        let cure = CURES.iter().find(|(known, _)| known == name).map_or("export it without this extension", |c| c.1);
        return Err(source
            .problem(
                Kind::Unsupported,
                format!("extensionsRequired[{index}]"),
                format!("the file requires {name}, which is not built"),
            )
            .found(name.clone())
            .remedy(cure));
    }
    Ok(())
}
