//! A stability suite: failure scenes, what changes along them, methods, and what theory says about each, with its source.
//!
//! ```ron
//! (
//!     version: 1,
//!     name: "stability",
//!     size: "128x96",                     // default 128x96
//!     contact_ulps: 4.0,                  // half width of the contact band, as of `verify`; default 4
//!     scenes: [
//!         (name: "contact", scene: "builtin:contact", options: ["--light-radius", "0.3"]),
//!         (name: "open said closed", scene: "builtin:open", said_closed: true),    // a wrong flag on every triangle
//!     ],
//!     sequences: [
//!         (change: Still),                                                          // every scene
//!         (change: WorldScale, values: [1e-3, 1, 1e3], scenes: ["contact"]),
//!     ],
//!     methods: [
//!         (graph: "hard", judge: (by: "wrong_outside_share", at_most: 0.0)),
//!         (name: "shadow_map", graph: "shadow_map", set: ["light_depth.size=256"], judge: (by: "wrong_bit_share", at_most: 0.01)),
//!         (graph: "pcf", truth_light_samples: 64, judge: (by: "rmse_penumbra", at_most: 0.02)),
//!         (graph: "soft_lu_planar", light_samples: 64, needs: "light_is_planar", judge: (by: "rmse_penumbra", at_most: 0.02)),
//!     ],
//!     expect: [                           // the first that fits counts; what none fits is open
//!         (is: MustHold, methods: ["hard"], why: "exact predicates where single precision is not sure"),
//!         (is: ExpectedToFail, methods: ["shadow_map"], scenes: ["contact"], changes: [Still], why: "Williams 1978: bias"),
//!     ],
//! )
//! ```

mod expect;
mod method;
mod scene;
mod sequence;

pub use expect::Rule;
pub use method::{Figure, Judge, Method};
pub use scene::SceneEntry;
pub use sequence::{CHANGES, SequenceEntry, parameter};

use crate::file_problem;
use shadowgraph_charts::model::{Expected, Sequence};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::{Data, Field, Name, Reader, Source, Tree, nearest, read_ron};
use std::path::Path;

/// The suite that comes with the program.
const BUILTIN: (&str, &str) = ("stability", include_str!("../../suites/stability.ron"));

/// A suite as read.
#[derive(Clone, Debug)]
pub struct Suite {
    /// Its name.
    pub name: String,
    /// One sentence; may be empty.
    pub doc: String,
    /// Picture size as `WxH`.
    pub size: String,
    /// Half width of the contact band, units in the last place.
    pub contact_ulps: f32,
    /// Failure scenes.
    pub scenes: Vec<SceneEntry>,
    /// What changes, and where.
    pub sequences: Vec<SequenceEntry>,
    /// Methods.
    pub methods: Vec<Method>,
    /// What theory says.
    pub expect: Vec<Rule>,
}

impl Suite {
    /// Reads the built-in suite by name, or a file.
    ///
    /// # Errors
    /// No such file; every mistake in it, with its place.
    pub fn load(name: &str) -> Result<Self, Problems> {
        if name == BUILTIN.0 {
            return Self::read(Source { name: format!("builtin:{name}"), text: BUILTIN.1.into() });
        }
        let path = Path::new(name);
        if path.extension().is_none() && !path.exists() {
            let remedy = match nearest(name, [BUILTIN.0]) {
                Some(near) => format!("did you mean {near}?"),
                None => format!("the built-in suite is {}; a file's name ends in .ron", BUILTIN.0),
            };
            let problem = Problem::new(Kind::UnknownName, "no built-in stability suite has this name");
            return Err(problem.found(name).remedy(remedy).into());
        }
        let text = std::fs::read_to_string(path).map_err(|error| file_problem(path, &error))?;
        Self::read(Source { name: name.into(), text })
    }

    /// Reads the text of a suite.
    ///
    /// # Errors
    /// Every mistake in it, with its place.
    pub fn read(source: Source) -> Result<Self, Problems> {
        read_ron(source, suite)
    }

    /// Every scene along every sequence that takes it, in the order of sequences: positions in `scenes` and `sequences`.
    pub fn cases(&self) -> Vec<(usize, usize)> {
        let of = |(index, sequence): (usize, &SequenceEntry)| {
            sequence.scenes.iter().map(move |scene| (*scene, index)).collect::<Vec<_>>()
        };
        self.sequences.iter().enumerate().flat_map(of).collect()
    }

    /// What theory says about a method on a scene along a sequence, and why.
    pub fn expected(&self, method: usize, scene: usize, change: Sequence) -> (Expected, String) {
        let rule = self.expect.iter().find(|rule| rule.fits(method, scene, change));
        rule.map_or((Expected::Open, "nothing is claimed".into()), |rule| (rule.is, rule.why.clone()))
    }
}

const FIELDS: &[&str] = &["version", "name", "doc", "size", "contact_ulps", "scenes", "sequences", "methods", "expect"];
const SIZE: &str = "128x96";
/// As `verify` has it.
const CONTACT_ULPS: f32 = 4.0;

fn suite(tree: &Tree, reader: &mut Reader) -> Option<Suite> {
    let what = "a stability suite";
    let fields = reader.fields(tree, FIELDS, what)?;
    let version = reader.needed(tree, &fields, "version", what);
    version.and_then(|value| reader.whole(value, "version", 1..=1));
    let name = reader.needed(tree, &fields, "name", what).and_then(|value| reader.name(value, "name"));
    let mut text = |field: &str, default: &str| match value(&fields, field) {
        Some(value) => reader.name(value, field).map(|name| name.text).unwrap_or_default(),
        None => default.into(),
    };
    let (doc, size) = (text("doc", ""), text("size", SIZE));
    let contact_ulps = value(&fields, "contact_ulps").and_then(|value| ulps(value, reader)).unwrap_or(CONTACT_ULPS);
    let list = |reader: &mut Reader, field: &str| {
        let list = reader.needed(tree, &fields, field, what)?;
        let items = reader.items(list, field);
        if items.is_empty() {
            reader.problem(list.span, Problem::new(Kind::Missing, format!("`{field}` is empty: nothing would run")));
        }
        Some(items)
    };
    let mut scenes: Vec<SceneEntry> = Vec::new();
    let scene_items = list(reader, "scenes").unwrap_or_default();
    for item in scene_items {
        let Some(entry) = scene::read(item, reader, &size) else { continue };
        unique(&entry.name, scenes.iter().map(|scene| scene.name.as_str()), "scene", item, reader);
        scenes.push(entry);
    }
    let mut methods: Vec<Method> = Vec::new();
    let method_items = list(reader, "methods").unwrap_or_default();
    for item in method_items {
        let Some(entry) = method::read(item, reader) else { continue };
        unique(&entry.name, methods.iter().map(|method| method.name.as_str()), "method", item, reader);
        methods.push(entry);
    }
    // Of entries that have mistakes too: who names one of those makes no mistake.
    let scene_names: Vec<&str> = scene_items.iter().filter_map(|item| written(item, &["name"])).collect();
    let method_names: Vec<&str> = method_items.iter().filter_map(|item| written(item, &["name", "graph"])).collect();
    let mut sequences: Vec<SequenceEntry> = Vec::new();
    for item in list(reader, "sequences").unwrap_or_default() {
        let Some(entry) = sequence::read(item, reader, &scene_names) else { continue };
        sequence::once(&entry, &sequences, &scene_names, item, reader);
        sequences.push(entry);
    }
    let mut rules = Vec::new();
    if let Some(value) = value(&fields, "expect") {
        for item in reader.items(value, "expect") {
            rules.extend(expect::read(item, reader, &method_names, &scene_names));
        }
    }
    Some(Suite { name: name?.text, doc, size, contact_ulps, scenes, sequences, methods, expect: rules })
}

fn ulps(value: &Tree, reader: &mut Reader) -> Option<f32> {
    let ulps = reader.number(value, "contact_ulps")?;
    if (0.0..=1024.0).contains(&ulps) {
        return Some(ulps as f32);
    }
    let problem = Problem::new(Kind::BadValue, "`contact_ulps` is out of range").expected("a number in 0..=1024");
    reader.problem(value.span, problem.found(value.data.text()));
    None
}

fn unique<'a>(name: &str, mut earlier: impl Iterator<Item = &'a str>, what: &str, at: &Tree, reader: &mut Reader) {
    if earlier.any(|earlier| earlier == name) {
        let problem = Problem::new(Kind::Duplicate, format!("{what} {name:?} is named twice"));
        reader.problem(at.span, problem.remedy("give each a `name` of its own"));
    }
}

/// The text of the first of these fields that an entry has.
fn written<'t>(entry: &'t Tree, fields: &[&str]) -> Option<&'t str> {
    let Data::Struct(all) = &entry.data else { return None };
    let found = fields.iter().find_map(|name| all.iter().find(|field| field.name == *name))?;
    match &found.value.data {
        Data::Text(text) => Some(text),
        _ => None,
    }
}

fn value<'t>(fields: &[&'t Field], name: &str) -> Option<&'t Tree> {
    fields.iter().find(|field| field.name == name).map(|field| &field.value)
}

/// Positions of `names` among the `known`; those not found are told.
fn positions(names: &[Name], known: &[&str], what: &str, reader: &mut Reader) -> Vec<usize> {
    let mut found = Vec::new();
    for name in names {
        match known.iter().position(|known| *known == name.text) {
            Some(position) => found.push(position),
            None => {
                let problem = Problem::new(Kind::UnknownName, format!("the suite has no {what} of this name"));
                let remedy = match nearest(&name.text, known.iter().copied()) {
                    Some(near) => format!("did you mean {near}?"),
                    None => format!("there are {}", known.join(", ")),
                };
                reader.problem(name.span, problem.found(&name.text).remedy(remedy));
            }
        }
    }
    found
}

#[cfg(test)]
mod tests;
