//! What theory says about methods, scenes and changes.

use super::{positions, sequence, value};
use shadowgraph_charts::model::{Expected, Sequence};
use shadowgraph_graph::{Name, Reader, Tree};

/// A statement about some methods on some scenes along some changes.
#[derive(Clone, Debug)]
pub struct Rule {
    /// What it says.
    pub is: Expected,
    /// Positions of the methods; none: all.
    methods: Option<Vec<usize>>,
    /// Positions of the scenes; none: all.
    scenes: Option<Vec<usize>>,
    /// Changes; none: all.
    changes: Option<Vec<Sequence>>,
    /// Where the statement comes from.
    pub why: String,
}

impl Rule {
    /// Whether it speaks of this method here.
    pub fn fits(&self, method: usize, scene: usize, change: Sequence) -> bool {
        self.methods.as_ref().is_none_or(|methods| methods.contains(&method))
            && self.scenes.as_ref().is_none_or(|scenes| scenes.contains(&scene))
            && self.changes.as_ref().is_none_or(|changes| changes.contains(&change))
    }
}

/// One entry of `expect`.
pub fn read(tree: &Tree, reader: &mut Reader, methods: &[&str], scenes: &[&str]) -> Option<Rule> {
    let what = "an expectation";
    let fields = reader.fields(tree, &["is", "methods", "scenes", "changes", "why"], what)?;
    let is = reader.needed(tree, &fields, "is", what);
    let is = is.and_then(|value| reader.word(value, "is", &["MustHold", "ExpectedToFail", "Open"]));
    let why: Option<Name> = reader.needed(tree, &fields, "why", what).and_then(|value| reader.name(value, "why"));
    let mut named = |field: &str, known: &[&str], what: &str| {
        let names = reader.names(value(&fields, field)?, field);
        Some(positions(&names, known, what, reader))
    };
    let (methods, scenes) = (named("methods", methods, "method"), named("scenes", scenes, "scene"));
    let changes = value(&fields, "changes").map(|value| {
        let items = reader.items(value, "changes").iter();
        items.filter_map(|item| sequence::change(item, reader)).collect()
    });
    let is = match is? {
        "MustHold" => Expected::MustHold,
        "ExpectedToFail" => Expected::ExpectedToFail,
        _ => Expected::Open,
    };
    Some(Rule { is, methods, scenes, changes, why: why?.text })
}
