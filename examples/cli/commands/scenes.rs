//! `shadowgraph scenes`: built-in scenes with their parameters, or the facts of one scene.

use crate::args::ScenesArgs;
use crate::report::table;
use serde_json::json;
use shadowgraph_core::problem::Problem;

/// The text asked for.
///
/// # Errors
/// The scene cannot be loaded.
pub fn text(args: &ScenesArgs) -> Result<String, Problem> {
    match &args.scene {
        Some(spec) => facts(spec, args.json),
        None => Ok(list(args.json)),
    }
}

fn list(as_json: bool) -> String {
    let scenes = shadowgraph_scenes::builtin::list();
    if as_json {
        return serde_json::to_string_pretty(&scenes).unwrap_or_default() + "\n";
    }
    let mut table = table(&["scene", "parameters", "what it is"]);
    for scene in scenes {
        let params: Vec<String> =
            scene.params.iter().map(|param| format!("{}={}", param.name, param.range.default_value().text())).collect();
        table.add_row([format!("builtin:{}", scene.name), params.join(" "), scene.doc.to_string()]);
    }
    format!("{table}\nParameters follow a question mark: builtin:random-triangles?count=10000&seed=2\n")
}

fn facts(spec: &str, as_json: bool) -> Result<String, Problem> {
    let scene = shadowgraph_scenes::load(spec)?;
    if as_json {
        let record = json!({
            "name": spec,
            "triangles": scene.triangle_count(),
            "parts": scene.parts_count,
            "closed_parts": scene.closed_parts_count,
            "bounds": scene.bounds(),
            "cameras": scene.cameras.iter().map(|camera| &camera.name).collect::<Vec<_>>(),
            "lights": scene.lights.iter().map(|light| &light.name).collect::<Vec<_>>(),
            "notes": scene.notes,
        });
        return Ok(serde_json::to_string_pretty(&record).unwrap_or_default() + "\n");
    }
    let mut text = format!(
        "{spec}: {} triangles, {} parts of which {} closed\n",
        scene.triangle_count(),
        scene.parts_count,
        scene.closed_parts_count
    );
    if let Some([low, high]) = scene.bounds() {
        text.push_str(&format!("bounds {low:?} to {high:?}\n"));
    }
    text.push_str(&format!("{} cameras, {} lights\n", scene.cameras.len(), scene.lights.len()));
    for note in &scene.notes {
        text.push_str(&format!("note: {note}\n"));
    }
    Ok(text)
}
