//! A suite file: scenes, methods and axes, and how long to measure.
//!
//! ```ron
//! (
//!     version: 1,
//!     name: "overview",
//!     size: "256x256",             // default 256x256
//!     backends: [cpu],             // default: what --backend says
//!     reference: 65536,            // light samples that visible fractions are compared with, above 4096 in sets; default 1024
//!     rounds: 7,                   // timed rounds of each variant; default 7
//!     scenes: [
//!         (name: "columns", scene: "builtin:columns", options: ["--light-radius", "0.5"]),
//!         (name: "sponza", scene: "sponza_dabrovic.glb", views: "views.json", view: "overview"),   // looked up in --scenes
//!     ],
//!     methods: [
//!         (graph: "soft_shafts", light_samples: [16, 64, 256], quality: "light_samples"),
//!         (graph: "shadow_map", axes: {"light_depth.size": ["512", "2048"]}, quality: "light_depth.size"),
//!         (graph: "soft_lu_planar", light_samples: 64, when: "light_is_planar"),     // facts that a scene must have, or not
//!         (graph: "hard", axes: {"visibility": ["planes", "fused"]}, only: ["columns"], backends: [wgpu]),
//!     ],
//! )
//! ```

use super::variant::{Variant, combinations, tell_apart};
use crate::args::{GraphChoice, SceneChoice};
use crate::{file_problem, job};
use clap::Parser;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::{Data, Field, Name, Reader, Source, Tree, nearest, read_ron};
use std::path::Path;

/// Suites that come with the program.
const BUILTIN: &[(&str, &str)] = &[
    ("chart", include_str!("../../suites/chart.ron")),
    ("chart_small", include_str!("../../suites/chart_small.ron")),
    ("suggest", include_str!("../../suites/suggest.ron")),
];
/// Most variants of one method.
const MOST_VARIANTS: usize = 1000;

/// A suite as read.
#[derive(Clone, Debug)]
pub struct Suite {
    /// Its name.
    pub name: String,
    /// One line.
    pub doc: String,
    /// Picture size as `WxH`.
    pub size: String,
    /// Where nodes run that are not pinned; none: as the command line says.
    pub backends: Vec<&'static str>,
    /// Light samples of the truth that visible fractions are compared with.
    pub reference: u32,
    /// Timed rounds.
    pub rounds: u32,
    /// Scenes with their views.
    pub scenes: Vec<SceneEntry>,
    /// Variants of all methods.
    pub variants: Vec<Variant>,
}

/// A scene through one view.
#[derive(Clone, Debug)]
pub struct SceneEntry {
    /// Name in charts.
    pub name: String,
    /// Scene, views file, view and options as the command line takes them.
    pub choice: SceneChoice,
}

impl Suite {
    /// Reads a built-in suite by name, or a file; scene files are looked up in the folder `scenes`.
    ///
    /// # Errors
    /// No such file; every mistake in it, with its place.
    pub fn load(name: &str, scenes: Option<&Path>) -> Result<Self, Problems> {
        let source = match BUILTIN.iter().find(|(builtin, _)| *builtin == name) {
            Some((_, text)) => Source { name: format!("builtin:{name}"), text: (*text).into() },
            None => {
                let path = Path::new(name);
                if path.extension().is_none() && !path.exists() {
                    let known: Vec<&str> = BUILTIN.iter().map(|(name, _)| *name).collect();
                    let remedy = match nearest(name, known.iter().copied()) {
                        Some(near) => format!("did you mean {near}?"),
                        None => format!("built-in suites are {}; a file's name ends in .ron", known.join(", ")),
                    };
                    return Err(Problem::new(Kind::UnknownName, "no built-in suite has this name")
                        .found(name)
                        .remedy(remedy)
                        .into());
                }
                let text = std::fs::read_to_string(path).map_err(|error| file_problem(path, &error))?;
                Source { name: name.into(), text }
            }
        };
        Self::read(source, scenes)
    }

    /// Whether a suite of that name comes with the program.
    pub fn is_builtin(name: &str) -> bool {
        BUILTIN.iter().any(|(builtin, _)| *builtin == name)
    }

    /// Reads the text of a suite.
    ///
    /// # Errors
    /// Every mistake in it, with its place.
    pub fn read(source: Source, scenes: Option<&Path>) -> Result<Self, Problems> {
        read_ron(source, |tree, reader| suite(tree, reader, scenes))
    }
}

const FIELDS: &[&str] = &["version", "name", "doc", "size", "backends", "reference", "rounds", "scenes", "methods"];

fn suite(tree: &Tree, reader: &mut Reader, scenes_folder: Option<&Path>) -> Option<Suite> {
    let fields = reader.fields(tree, FIELDS, "a suite")?;
    let version = reader.needed(tree, &fields, "version", "a suite");
    version.and_then(|value| reader.whole(value, "version", 1..=1));
    let name = reader.needed(tree, &fields, "name", "a suite");
    let name = name.and_then(|value| reader.name(value, "name"));
    let text = |reader: &mut Reader, field: &str, default: &str| match value(&fields, field) {
        Some(value) => reader.name(value, field).map(|name| name.text).unwrap_or_default(),
        None => default.into(),
    };
    let (doc, size) = (text(reader, "doc", ""), text(reader, "size", "256x256"));
    if let (Err(problem), Some(value)) = (job::size(&size), value(&fields, "size")) {
        let problem = Problem { place: None, ..problem };
        reader.problem(value.span, Problem { message: "`size` is not a picture size".into(), ..problem });
    }
    let whole = |reader: &mut Reader, field: &str, range, default| match value(&fields, field) {
        Some(value) => reader.whole(value, field, range).unwrap_or(default),
        None => default,
    };
    let reference = whole(reader, "reference", 1..=1 << 20, 1024);
    if let Some(value) = value(&fields, "reference").filter(|_| reference > 4096 && reference % 4096 > 0) {
        let problem = Problem::new(Kind::BadValue, "light samples above 4096 come in sets of 4096");
        reader.problem(value.span, problem.expected("a multiple of 4096").found(reference.to_string()));
    }
    let rounds = whole(reader, "rounds", 1..=1000, 7);
    let backends = backends_of(&fields, reader);
    let mut scenes: Vec<SceneEntry> = Vec::new();
    if let Some(list) = reader.needed(tree, &fields, "scenes", "a suite") {
        for item in reader.items(list, "scenes") {
            let Some(entry) = scene(item, reader, &size, scenes_folder) else { continue };
            if scenes.iter().any(|earlier| earlier.name == entry.name) {
                let problem = Problem::new(Kind::Duplicate, format!("scene {:?} is named twice", entry.name));
                reader.problem(item.span, problem.remedy("give each scene and view a name of its own"));
            } else {
                scenes.push(entry);
            }
        }
    }
    let mut variants = Vec::new();
    if let Some(list) = reader.needed(tree, &fields, "methods", "a suite") {
        for item in reader.items(list, "methods") {
            variants.extend(method(item, reader, &scenes).unwrap_or_default());
        }
        if matches!(&list.data, Data::List(items) if items.is_empty()) {
            reader.problem(list.span, Problem::new(Kind::Missing, "a suite needs methods").expected("(graph: ..)"));
        }
    }
    tell_apart(&mut variants);
    Some(Suite { name: name?.text, doc, size, backends, reference, rounds, scenes, variants })
}

fn backends_of(fields: &[&Field], reader: &mut Reader) -> Vec<&'static str> {
    let mut backends = Vec::new();
    if let Some(value) = value(fields, "backends") {
        for item in reader.items(value, "backends") {
            backends.extend(reader.word(item, "backends", &["cpu", "wgpu"]));
        }
    }
    backends
}

fn value<'t>(fields: &[&'t Field], name: &str) -> Option<&'t Tree> {
    fields.iter().find(|field| field.name == name).map(|field| &field.value)
}

/// What clap makes of a scene's options.
#[derive(Debug, Parser)]
#[command(no_binary_name = true)]
struct Options {
    #[command(flatten)]
    scene: SceneChoice,
}

fn scene(tree: &Tree, reader: &mut Reader, size: &str, folder: Option<&Path>) -> Option<SceneEntry> {
    let fields = reader.fields(tree, &["name", "scene", "views", "view", "options"], "a scene")?;
    let name = reader.needed(tree, &fields, "name", "a scene");
    let file = reader.needed(tree, &fields, "scene", "a scene");
    let (name, file) = (name.and_then(|v| reader.name(v, "name")), file.and_then(|v| reader.name(v, "scene")));
    let views = value(&fields, "views").and_then(|value| reader.name(value, "views"));
    let view = value(&fields, "view").and_then(|value| reader.name(value, "view"));
    let mut words = vec!["--size".to_string(), size.to_string()];
    if let Some(options) = value(&fields, "options") {
        // Words may repeat, so they are no names.
        for item in reader.items(options, "options") {
            words.extend(reader.name(item, "options").map(|name| name.text));
        }
    }
    let (name, file) = (name?, file?);
    let in_folder = |path: &str| match folder {
        Some(folder) if !path.starts_with("builtin:") && Path::new(path).is_relative() => {
            folder.join(path).display().to_string()
        }
        _ => path.to_string(),
    };
    words.extend(["--scene".to_string(), in_folder(&file.text)]);
    words.extend(views.iter().flat_map(|views| ["--views".to_string(), in_folder(&views.text)]));
    words.extend(view.iter().flat_map(|view| ["--view".to_string(), view.text.clone()]));
    match Options::try_parse_from(words) {
        Ok(options) => {
            if let Some(count) = options.scene.light.light_samples {
                let problem = Problem::new(Kind::BadValue, "light samples are a method's, not a scene's")
                    .found(format!("--light-samples {count}"))
                    .remedy("give them as light_samples of methods");
                reader.problem(tree.span, problem);
            }
            Some(SceneEntry { name: name.text, choice: options.scene })
        }
        Err(error) => {
            let text = error.to_string();
            let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ").to_string();
            let problem = Problem::new(Kind::BadValue, "options of this scene are not understood")
                .expected("flags as `shadowgraph render` takes them for scene and light")
                .found(first);
            reader.problem(tree.span, problem);
            None
        }
    }
}

fn method(tree: &Tree, reader: &mut Reader, scenes: &[SceneEntry]) -> Option<Vec<Variant>> {
    let fields = reader.fields(
        tree,
        &["graph", "light_samples", "set", "axes", "quality", "only", "backends", "when", "unless"],
        "a method",
    )?;
    let graph = reader.needed(tree, &fields, "graph", "a method");
    let graph = graph.and_then(|value| reader.name(value, "graph"))?;
    let mut axes: Vec<(String, Vec<String>)> = Vec::new();
    let samples = match value(&fields, "light_samples") {
        Some(Tree { data: Data::List(items), span }) if items.is_empty() => {
            reader.problem(*span, no_values("light_samples"));
            Vec::new()
        }
        Some(Tree { data: Data::List(items), .. }) => {
            items.iter().filter_map(|item| reader.whole(item, "light_samples", 1..=4096)).collect()
        }
        Some(value) => reader.whole(value, "light_samples", 1..=4096).into_iter().collect(),
        None => vec![1],
    };
    axes.push(("light_samples".into(), samples.iter().map(u32::to_string).collect()));
    let mut fixed = GraphChoice { graph: graph.text.clone(), ..GraphChoice::default() };
    if let Some(value) = value(&fields, "set") {
        for name in reader.names(value, "set") {
            set(&mut fixed, &name, reader);
        }
    }
    if let Some(value) = value(&fields, "axes") {
        for (axis, values) in reader.entries(value, "axes", "axis") {
            if axis.text == "light_samples" {
                let problem = Problem::new(Kind::BadValue, "light samples are an axis of their own");
                reader.problem(axis.span, problem.remedy("give them as light_samples: [..] of the method"));
                continue;
            }
            let mut texts = Vec::new();
            for item in reader.items(values, &axis.text) {
                match &item.data {
                    Data::Text(text) | Data::Word(text) => texts.push(text.clone()),
                    Data::Number(number) => texts.push(number.text.clone()),
                    _ => reader.wrong(item, &axis.text, "a number, a word, or text in quotes"),
                }
            }
            if matches!(&values.data, Data::List(items) if items.is_empty()) {
                reader.problem(values.span, no_values(&axis.text));
            }
            axes.push((axis.text, texts));
        }
    }
    let quality = value(&fields, "quality").and_then(|value| reader.name(value, "quality"));
    if let Some(quality) = quality.as_ref().filter(|quality| axes.iter().all(|(axis, _)| *axis != quality.text)) {
        let known: Vec<&str> = axes.iter().map(|(axis, _)| axis.as_str()).collect();
        let problem = Problem::new(Kind::UnknownName, "the quality is no axis of the method")
            .expected(known.join(", "))
            .found(&quality.text);
        let near = nearest(&quality.text, known.iter().copied()).map(|near| format!("did you mean {near}?"));
        reader.problem(quality.span, Problem { remedy: near, ..problem });
    }
    let only = value(&fields, "only").map(|value| reader.names(value, "only")).unwrap_or_default();
    for name in only.iter().filter(|name| scenes.iter().all(|scene| scene.name != name.text)) {
        let known = scenes.iter().map(|scene| scene.name.as_str());
        let problem = Problem::new(Kind::UnknownName, "no scene of the suite has this name").found(&name.text);
        let near = nearest(&name.text, known.clone()).map(|near| format!("did you mean {near}?"));
        let remedy = near.unwrap_or_else(|| format!("scenes are {}", known.collect::<Vec<_>>().join(", ")));
        reader.problem(name.span, problem.remedy(remedy));
    }
    let count = axes.iter().fold(1usize, |count, (_, values)| count.saturating_mul(values.len()));
    if count > MOST_VARIANTS {
        let problem = Problem::new(Kind::BadValue, "axes make too many variants");
        reader.problem(tree.span, problem.expected(format!("at most {MOST_VARIANTS}")).found(count.to_string()));
        return None;
    }
    let first = Variant {
        fixed: fixed.swap.iter().chain(&fixed.set).cloned().collect(),
        choice: fixed,
        choices: Vec::new(),
        quality: quality.map(|quality| quality.text),
        light_samples: 1,
        only: only.into_iter().map(|name| name.text).collect(),
        backends: backends_of(&fields, reader),
        when: fact(&fields, "when", reader),
        unless: fact(&fields, "unless", reader),
        is_long: false,
    };
    Some(combinations(first, &axes))
}

fn no_values(axis: &str) -> Problem {
    Problem::new(Kind::Missing, format!("axis `{axis}` has no values")).expected("one or more")
}

/// The name of a fact, as graph files have them.
fn fact(fields: &[&Field], field: &str, reader: &mut Reader) -> Option<String> {
    let name = reader.name(value(fields, field)?, field)?;
    let known = Facts::NAMES.iter().map(|(name, _)| *name);
    if !known.clone().any(|known| known == name.text) {
        let problem = Problem::new(Kind::UnknownName, "there is no such fact").found(&name.text);
        let near = nearest(&name.text, known.clone()).map(|near| format!("did you mean {near}?"));
        let remedy = near.unwrap_or_else(|| format!("facts are {}", known.collect::<Vec<_>>().join(", ")));
        reader.problem(name.span, problem.remedy(remedy));
    }
    Some(name.text)
}

/// `NODE=PASS` or `NODE.PARAM=VALUE`.
fn set(choice: &mut GraphChoice, name: &Name, reader: &mut Reader) {
    match name.text.split_once('=') {
        Some((place, _)) if place.contains('.') => choice.set.push(name.text.clone()),
        Some(_) => choice.swap.push(name.text.clone()),
        None => {
            let problem = Problem::new(Kind::BadValue, "this sets nothing")
                .expected("NODE=PASS or NODE.PARAM=VALUE")
                .found(&name.text);
            reader.problem(name.span, problem);
        }
    }
}
