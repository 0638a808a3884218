//! The values of a tree, asked for by type: what graph files, and other files in RON, are read with.

use super::parse::parse;
use super::value::{Data, Field, Name, Tree};
use crate::names::{did_you_mean, list};
use crate::source::{Files, Findings, Source, Span};
use shadowgraph_core::problem::{Kind, Problem, Problems};
use std::ops::RangeInclusive;

/// Most items of one list, entries of one map: far above any use, far below what hurts.
const MAX_ENTRIES: usize = 10_000;

/// Reads the values of a tree and notes every mistake it meets, each with its place; reading goes on.
///
/// A function that returns nothing has told why.
pub struct Reader<'a> {
    pub(crate) findings: &'a mut Findings,
}

impl Reader<'_> {
    /// Notes `problem` at `span`.
    pub fn problem(&mut self, span: Span, problem: Problem) {
        self.findings.push(span, problem);
    }

    /// Notes that `what` is of the wrong type.
    pub fn wrong(&mut self, value: &Tree, what: &str, expected: &str) {
        let problem = Problem::new(Kind::BadValue, format!("`{what}` is of the wrong type"));
        self.findings.push(value.span, problem.expected(expected).found(value.data.text()));
    }

    /// The known fields of a struct, each once; none when `tree` is no struct.
    pub fn fields<'t>(&mut self, tree: &'t Tree, known: &[&str], what: &str) -> Option<Vec<&'t Field>> {
        let Data::Struct(fields) = &tree.data else {
            let problem = Problem::new(Kind::BadValue, format!("{what} is a struct")).expected("(name: value, ..)");
            self.findings.push(tree.span, problem.found(tree.data.text()));
            return None;
        };
        let mut kept: Vec<&Field> = Vec::new();
        for field in fields {
            if !known.contains(&field.name.as_str()) {
                let problem = Problem::new(Kind::UnknownName, format!("{what} has no field `{}`", field.name));
                self.findings.push(field.span, problem.remedy(did_you_mean(&field.name, known.iter().copied())));
            } else if kept.iter().any(|earlier| earlier.name == field.name) {
                let problem = Problem::new(Kind::Duplicate, format!("field `{}` is given twice", field.name));
                self.findings.push(field.span, problem);
            } else {
                kept.push(field);
            }
        }
        Some(kept)
    }

    /// Text in quotes.
    pub fn name(&mut self, value: &Tree, what: &str) -> Option<Name> {
        match &value.data {
            Data::Text(text) => Some(Name { text: text.clone(), span: value.span }),
            _ => {
                self.wrong(value, what, "text in quotes");
                None
            }
        }
    }

    /// The items of a list; none when it is no list.
    pub fn items<'t>(&mut self, value: &'t Tree, what: &str) -> &'t [Tree] {
        match &value.data {
            Data::List(items) if items.len() > MAX_ENTRIES => {
                self.too_many(value.span, what, items.len());
                &[]
            }
            Data::List(items) => items,
            _ => {
                self.wrong(value, what, "a list [..]");
                &[]
            }
        }
    }

    fn too_many(&mut self, span: Span, what: &str, count: usize) {
        let problem = Problem::new(Kind::BadValue, format!("`{what}` is too long"));
        self.findings.push(span, problem.expected(format!("at most {MAX_ENTRIES} entries")).found(count.to_string()));
    }

    /// A list of texts, each once.
    pub fn names(&mut self, value: &Tree, what: &str) -> Vec<Name> {
        let mut names: Vec<Name> = Vec::new();
        for item in self.items(value, what) {
            let Some(name) = self.name(item, what) else { continue };
            if names.iter().any(|earlier| earlier.text == name.text) {
                let problem = Problem::new(Kind::Duplicate, format!("{:?} stands twice in `{what}`", name.text));
                self.findings.push(name.span, problem);
            } else {
                names.push(name);
            }
        }
        names
    }

    /// Entries of a map with names as keys, each key once. A struct is read like a map, and told.
    pub fn entries<'t>(&mut self, value: &'t Tree, what: &str, key_is: &str) -> Vec<(Name, &'t Tree)> {
        let mut entries: Vec<(Name, &Tree)> = Vec::new();
        match &value.data {
            Data::Map(map) if map.len() > MAX_ENTRIES => self.too_many(value.span, what, map.len()),
            Data::Map(map) => {
                let named = map.iter().filter_map(|(key, value)| Some((self.name(key, key_is)?, value)));
                entries.extend(named);
            }
            Data::Struct(fields) => {
                self.wrong(value, what, "a map {\"name\": value, ..}");
                let name = |field: &Field| Name { text: field.name.clone(), span: field.span };
                entries.extend(fields.iter().take(MAX_ENTRIES).map(|field| (name(field), &field.value)));
            }
            _ => self.wrong(value, what, "a map {\"name\": value, ..}"),
        }
        let mut seen = std::collections::HashSet::new();
        entries.retain(|(key, _)| {
            let is_new = seen.insert(key.text.clone());
            if !is_new {
                let problem = Problem::new(Kind::Duplicate, format!("{key_is} `{}` is given twice", key.text));
                self.findings.push(key.span, problem);
            }
            is_new
        });
        entries
    }

    /// A number, whole or not.
    pub fn number(&mut self, value: &Tree, what: &str) -> Option<f64> {
        match &value.data {
            Data::Number(number) => Some(number.real),
            _ => {
                self.wrong(value, what, "a number");
                None
            }
        }
    }

    /// A whole number in `range`.
    pub fn whole(&mut self, value: &Tree, what: &str, range: RangeInclusive<u32>) -> Option<u32> {
        let whole = match &value.data {
            Data::Number(number) => number.whole.and_then(|whole| u32::try_from(whole).ok()),
            _ => None,
        };
        let within = whole.filter(|whole| range.contains(whole));
        if within.is_none() {
            let problem = Problem::new(Kind::BadValue, format!("`{what}` is not allowed"));
            let expected = format!("a whole number in {}..={}", range.start(), range.end());
            self.findings.push(value.span, problem.expected(expected).found(value.data.text()));
        }
        within
    }

    /// One of the `known` bare words.
    pub fn word<'k>(&mut self, value: &Tree, what: &str, known: &[&'k str]) -> Option<&'k str> {
        let word = match &value.data {
            Data::Word(word) => known.iter().copied().find(|known| known == word),
            _ => None,
        };
        if word.is_none() {
            self.wrong(value, what, &list(known.iter().copied(), " or "));
        }
        word
    }

    /// The field of that name; its absence in `tree` is noted.
    pub fn needed<'t>(&mut self, tree: &Tree, fields: &[&'t Field], name: &str, what: &str) -> Option<&'t Tree> {
        let found = fields.iter().find(|field| field.name == name);
        if found.is_none() {
            let problem = Problem::new(Kind::Missing, format!("{what} has no {name}")).expected(format!("{name}: .."));
            self.findings.push(tree.span, problem);
        }
        found.map(|field| &field.value)
    }
}

/// Reads RON that is no graph with the care that graphs get: `read` gets the tree, and a [`Reader`] that notes what is wrong.
///
/// # Errors
/// Text that is no RON; everything that `read` noted, in the order of the text, with file, line and column.
pub fn read_ron<T>(source: Source, read: impl FnOnce(&Tree, &mut Reader) -> Option<T>) -> Result<T, Problems> {
    let mut findings = Findings::default();
    let tree = parse(&source.text, 0, &mut findings);
    let value = tree.and_then(|tree| read(&tree, &mut Reader { findings: &mut findings }));
    match value.filter(|_| findings.is_empty()) {
        Some(value) => Ok(value),
        None => Err(findings.finish(&Files(vec![source]), &[])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<(u32, Vec<String>, f64, &'static str), Problems> {
        read_ron(Source { name: "a.ron".into(), text: text.into() }, |tree, reader| {
            let fields = reader.fields(tree, &["count", "names", "share", "kind"], "a sheet")?;
            let count = reader.needed(tree, &fields, "count", "a sheet");
            let names = reader.needed(tree, &fields, "names", "a sheet");
            let share = reader.needed(tree, &fields, "share", "a sheet");
            let kind = reader.needed(tree, &fields, "kind", "a sheet");
            let count = count.and_then(|value| reader.whole(value, "count", 1..=9));
            let names = names.map(|value| reader.names(value, "names"));
            let share = share.and_then(|value| reader.number(value, "share"));
            let kind = kind.and_then(|value| reader.word(value, "kind", &["Big", "Small"]));
            Some((count?, names?.into_iter().map(|name| name.text).collect(), share?, kind?))
        })
    }

    #[test]
    fn values_are_read_by_type() {
        let sheet = read("(count: 3, names: [\"a\", \"b\"], share: 0.5, kind: Small)").unwrap();
        assert_eq!(sheet, (3, vec!["a".to_string(), "b".into()], 0.5, "Small"));
    }

    #[test]
    fn all_mistakes_of_a_file_are_told_with_their_places() {
        let problems = read("(count: 10, names: [\"a\", \"a\", 1],\n kind: Huge, shar: 1)").unwrap_err();
        let expected = "a.ron:1:1: a sheet has no share; expected share: ..
a.ron:1:9: `count` is not allowed; expected a whole number in 1..=9; found 10
a.ron:1:26: \"a\" stands twice in `names`
a.ron:1:31: `names` is of the wrong type; expected text in quotes; found 1
a.ron:2:8: `kind` is of the wrong type; expected Big or Small; found Huge
a.ron:2:14: a sheet has no field `shar` (did you mean `share`?)";
        assert_eq!(problems.to_string(), expected);
    }
}
