//! Scenes of a suite.

use super::value;
use crate::args::SceneChoice;
use clap::Parser;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_graph::{Data, Reader, Tree};

/// A scene through one view.
#[derive(Clone, Debug)]
pub struct SceneEntry {
    /// Name in tables.
    pub name: String,
    /// Scene, view and options as the command line takes them.
    pub choice: SceneChoice,
    /// Every triangle is flagged as part of a closed mesh, whatever it is.
    pub said_closed: bool,
}

/// What clap makes of a scene's options.
#[derive(Debug, Parser)]
#[command(no_binary_name = true)]
struct Options {
    #[command(flatten)]
    scene: SceneChoice,
}

/// One entry of `scenes`.
pub fn read(tree: &Tree, reader: &mut Reader, size: &str) -> Option<SceneEntry> {
    let fields = reader.fields(tree, &["name", "scene", "views", "view", "options", "said_closed"], "a scene")?;
    let name = reader.needed(tree, &fields, "name", "a scene").and_then(|value| reader.name(value, "name"));
    let spec = reader.needed(tree, &fields, "scene", "a scene").and_then(|value| reader.name(value, "scene"));
    let mut words = vec!["--size".to_string(), size.to_string()];
    for flag in ["views", "view"] {
        let given = value(&fields, flag).and_then(|value| reader.name(value, flag));
        words.extend(given.into_iter().flat_map(|name| [format!("--{flag}"), name.text]));
    }
    if let Some(options) = value(&fields, "options") {
        for item in reader.items(options, "options") {
            words.extend(reader.name(item, "options").map(|name| name.text));
        }
    }
    let said_closed = match value(&fields, "said_closed") {
        None => false,
        Some(Tree { data: Data::Bool(said), .. }) => *said,
        Some(value) => {
            reader.wrong(value, "said_closed", "true or false");
            false
        }
    };
    let (name, spec) = (name?, spec?);
    words.extend(["--scene".to_string(), spec.text]);
    match Options::try_parse_from(words) {
        Ok(options) => Some(SceneEntry { name: name.text, choice: options.scene, said_closed }),
        Err(error) => {
            let text = error.to_string();
            let found = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
            let problem = Problem::new(Kind::BadValue, "options of this scene are not understood");
            reader
                .problem(tree.span, problem.expected("flags of `shadowgraph render` for scene and light").found(found));
            None
        }
    }
}
