//! Texts, places in them, and the problems found there.

use shadowgraph_core::problem::{Kind, Place, Problem, Problems};

/// Longest graph text that is read, bytes.
pub const MAX_TEXT_BYTES: usize = 1 << 20;
/// Most problems told in one go.
const MAX_PROBLEMS: usize = 200;
/// `Span::file` of what came from [`crate::Overrides`]; `start` is then an index into the list of flags.
const FLAG: u32 = u32::MAX;

/// Text of a graph file, and the name that errors give it: a path, or `builtin:NAME`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path as the user gave it, or `builtin:NAME`.
    pub name: String,
    /// The whole text.
    pub text: String,
}

/// Bytes `start..end` of text `file`. Ordered as a reader meets them: the file itself, its base, the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span {
    pub(crate) file: u32,
    pub(crate) start: u32,
    pub(crate) end: u32,
}

impl Span {
    pub(crate) fn new(file: u32, start: usize, end: usize) -> Self {
        Self { file, start: start as u32, end: end as u32 }
    }
    /// The place of flag `index`.
    pub(crate) fn flag(index: usize) -> Self {
        Self { file: FLAG, start: index as u32, end: index as u32 }
    }
    /// From here to the end of `last`.
    pub(crate) fn to(self, last: Span) -> Self {
        Self { end: last.end, ..self }
    }
    /// Whether this was said before `other`: a base is older than the file that builds on it, flags are the youngest.
    pub(crate) fn is_older_than(self, other: Span) -> bool {
        let age = |span: Span| if span.file == FLAG { 0 } else { u64::from(span.file) + 1 };
        age(self) > age(other)
    }
}

/// Every text that made a graph: the file first, then its base, and the base's base.
#[derive(Clone, Debug, Default)]
pub(crate) struct Files(pub Vec<Source>);

impl Files {
    /// File, line and column of `span`; both count from 1, columns in characters.
    pub fn place(&self, span: Span, flags: &[String]) -> Place {
        if span.file == FLAG {
            let path = flags.get(span.start as usize).cloned().unwrap_or_default();
            return Place { file: "command line".into(), line: 0, column: 0, path };
        }
        let source = &self.0[span.file as usize];
        let before = &source.text[..(span.start as usize).min(source.text.len())];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let column = before[line_start..].trim_start_matches('\u{feff}').chars().count() + 1;
        let line = before.bytes().filter(|byte| *byte == b'\n').count() + 1;
        Place { file: source.name.clone(), line, column, path: String::new() }
    }
}

/// Problems as they are found, each with its place.
#[derive(Clone, Debug, Default)]
pub(crate) struct Findings(Vec<(Span, Problem)>);

impl Findings {
    pub fn push(&mut self, span: Span, problem: Problem) {
        self.0.push((span, problem));
    }
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
    pub fn extend(&mut self, other: &Findings) {
        self.0.extend(other.0.iter().cloned());
    }
    /// In the order of the text, each once, with file, line and column.
    pub fn finish(mut self, files: &Files, flags: &[String]) -> Problems {
        self.0.sort_by_key(|(span, _)| *span);
        self.0.dedup();
        let more = self.0.len().saturating_sub(MAX_PROBLEMS);
        let mut problems: Vec<Problem> = Vec::new();
        for (span, mut problem) in self.0.into_iter().take(MAX_PROBLEMS) {
            problem.place.get_or_insert_with(|| files.place(span, flags));
            if !problems.contains(&problem) {
                problems.push(problem);
            }
        }
        if more > 0 {
            problems.push(Problem::new(Kind::Syntax, format!("and {more} more problems")));
        }
        Problems(problems)
    }
}
