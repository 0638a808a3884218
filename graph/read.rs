//! Tree to [`FileWritten`]: which fields there are and of which type. Every mistake is noted, reading goes on.

use crate::names::{did_you_mean, list};
use crate::schema::{AlternativeWritten, FileWritten, GuardWritten, Name, NodeWritten, Scalar, VERSION};
use crate::source::{Findings, Span};
use crate::span::{Data, Field, Tree};
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Kind, Problem};

const FILE_FIELDS: &[&str] =
    &["version", "doc", "base", "inputs", "nodes", "replace", "add", "remove", "outputs", "axes", "light_samples"];
const NODE_FIELDS: &[&str] = &["id", "stage", "pass", "params", "on", "in", "choose", "when", "unless"];
const ALTERNATIVE_FIELDS: &[&str] = &["when", "unless", "pass", "params"];
/// Most nodes of one list, entries of one map: far above any use, far below what hurts.
const MAX_ENTRIES: usize = 10_000;
/// Most light samples that a graph may say it is made for: as many as a light can have.
const MAX_LIGHT_SAMPLES: u32 = 4096;

/// What the tree of one file says; none when it is no struct.
pub(crate) fn read(tree: &Tree, findings: &mut Findings) -> Option<FileWritten> {
    let mut reader = Reader { findings };
    let mut file = FileWritten::default();
    let fields = reader.fields(tree, FILE_FIELDS, "a graph")?;
    if !fields.iter().any(|field| field.name == "version") {
        let problem = Problem::new(Kind::Missing, "graph states no version").expected(format!("version: {VERSION}"));
        reader.findings.push(tree.span, problem);
    }
    for field in fields {
        let value = &field.value;
        match field.name.as_str() {
            "version" => reader.version(value),
            "doc" => file.doc = reader.name(value, "doc"),
            "base" => file.base = reader.name(value, "base"),
            "inputs" => file.inputs = Some(reader.names(value, "inputs")),
            "nodes" => file.nodes = Some((field.span, reader.nodes(value, "nodes"))),
            "replace" => file.replace = Some((field.span, reader.nodes(value, "replace"))),
            "add" => file.add = Some((field.span, reader.nodes(value, "add"))),
            "remove" => file.remove = Some((field.span, reader.names(value, "remove"))),
            "outputs" => file.outputs = Some(reader.wires(value, "outputs", "output")),
            "light_samples" => file.light_samples = reader.light_samples(value),
            _ => file.axes = reader.axes(value),
        }
    }
    Some(file)
}

struct Reader<'a> {
    findings: &'a mut Findings,
}

impl Reader<'_> {
    fn wrong(&mut self, value: &Tree, what: &str, expected: &str) {
        let problem = Problem::new(Kind::BadValue, format!("`{what}` is of the wrong type"));
        self.findings.push(value.span, problem.expected(expected).found(value.data.text()));
    }

    /// The known fields of a struct, each once; none when `tree` is no struct.
    fn fields<'t>(&mut self, tree: &'t Tree, known: &[&str], what: &str) -> Option<Vec<&'t Field>> {
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

    fn version(&mut self, value: &Tree) {
        let whole = match &value.data {
            Data::Number(number) => number.whole,
            _ => None,
        };
        if whole != Some(i128::from(VERSION)) {
            let problem = Problem::new(Kind::BadValue, "graph format version is not known");
            self.findings.push(value.span, problem.expected(VERSION.to_string()).found(value.data.text()));
        }
    }

    fn light_samples(&mut self, value: &Tree) -> Option<u32> {
        let whole = match &value.data {
            Data::Number(number) => number.whole.and_then(|whole| u32::try_from(whole).ok()),
            _ => None,
        };
        let count = whole.filter(|count| (1..=MAX_LIGHT_SAMPLES).contains(count));
        if count.is_none() {
            let problem = Problem::new(Kind::BadValue, "`light_samples` is no number of light samples");
            let expected = format!("a whole number in 1..={MAX_LIGHT_SAMPLES}");
            self.findings.push(value.span, problem.expected(expected).found(value.data.text()));
        }
        count
    }

    fn name(&mut self, value: &Tree, what: &str) -> Option<Name> {
        match &value.data {
            Data::Text(text) => Some(Name { text: text.clone(), span: value.span }),
            _ => {
                self.wrong(value, what, "text in quotes");
                None
            }
        }
    }

    fn items<'t>(&mut self, value: &'t Tree, what: &str) -> &'t [Tree] {
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

    fn names(&mut self, value: &Tree, what: &str) -> Vec<Name> {
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
    fn entries<'t>(&mut self, value: &'t Tree, what: &str, key_is: &str) -> Vec<(Name, &'t Tree)> {
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

    fn wires(&mut self, value: &Tree, what: &str, key_is: &str) -> Vec<(Name, Name)> {
        let entries = self.entries(value, what, key_is);
        entries.into_iter().filter_map(|(key, value)| Some((key, self.name(value, what)?))).collect()
    }

    fn params(&mut self, value: &Tree) -> Vec<(Name, Scalar)> {
        let entries = self.entries(value, "params", "parameter");
        entries.into_iter().map(|(key, value)| (key, self.scalar(value))).collect()
    }

    fn scalar(&mut self, tree: &Tree) -> Scalar {
        let value = scalar_value(&tree.data);
        match (&value, &tree.data) {
            (Some(_), _) => {}
            (None, Data::Word(word)) => {
                let problem = Problem::new(Kind::BadValue, "words are written in quotes").expected(format!("{word:?}"));
                self.findings.push(tree.span, problem.found(word.as_str()));
            }
            (None, _) => self.wrong(tree, "parameter value", "a number, true, false or text in quotes"),
        }
        Scalar { value, text: tree.data.text(), span: tree.span }
    }

    fn nodes(&mut self, value: &Tree, what: &str) -> Vec<NodeWritten> {
        self.items(value, what).iter().filter_map(|item| self.node(item)).collect()
    }

    fn node(&mut self, tree: &Tree) -> Option<NodeWritten> {
        let fields = self.fields(tree, NODE_FIELDS, "a node")?;
        let id = match fields.iter().find(|field| field.name == "id") {
            Some(field) => self.name(&field.value, "id").and_then(|id| self.id(id)),
            None => {
                let problem = Problem::new(Kind::Missing, "node has no id").expected("id: \"NAME\"");
                self.findings.push(tree.span, problem);
                None
            }
        };
        // A node without a usable id is read all the same, for the mistakes inside it.
        let kept = id.is_some();
        let id = id.unwrap_or(Name { text: String::new(), span: tree.span });
        let mut node = NodeWritten {
            id,
            stage: None,
            pass: None,
            params: Vec::new(),
            on: None,
            inputs: Vec::new(),
            choose: None,
            guard: GuardWritten::default(),
        };
        for field in fields {
            let value = &field.value;
            match field.name.as_str() {
                "stage" => node.stage = self.name(value, "stage"),
                "pass" => node.pass = self.name(value, "pass"),
                "params" => node.params = self.params(value),
                "on" => node.on = self.backend(value),
                "in" => node.inputs = self.wires(value, "in", "port"),
                "choose" => {
                    let items = self.items(value, "choose");
                    node.choose = Some(items.iter().filter_map(|item| self.alternative(item)).collect());
                }
                "when" => node.guard.when = self.name(value, "when"),
                "unless" => node.guard.unless = self.name(value, "unless"),
                _ => {}
            }
        }
        kept.then_some(node)
    }

    /// Ids are names, so that `node.port` and `--set NODE.PARAM=VALUE` can be read in one way only.
    fn id(&mut self, id: Name) -> Option<Name> {
        let fine = |c: char| c == '_' || c == '-' || c.is_alphanumeric();
        if !id.text.is_empty() && id.text.len() <= 100 && id.text.chars().all(fine) {
            return Some(id);
        }
        let problem = Problem::new(Kind::BadValue, "not a node id").expected("letters, digits, `_` and `-`");
        self.findings.push(id.span, problem.found(format!("{:?}", id.text)));
        None
    }

    fn backend(&mut self, value: &Tree) -> Option<(Backend, Span)> {
        match &value.data {
            Data::Word(word) if word == "Cpu" => Some((Backend::Cpu, value.span)),
            Data::Word(word) if word == "Wgpu" => Some((Backend::Wgpu, value.span)),
            _ => {
                self.wrong(value, "on", &list(["Cpu", "Wgpu"].into_iter(), " or "));
                None
            }
        }
    }

    fn alternative(&mut self, tree: &Tree) -> Option<AlternativeWritten> {
        let fields = self.fields(tree, ALTERNATIVE_FIELDS, "an alternative")?;
        let mut alternative =
            AlternativeWritten { span: tree.span, guard: GuardWritten::default(), pass: None, params: Vec::new() };
        for field in fields {
            let value = &field.value;
            match field.name.as_str() {
                "when" => alternative.guard.when = self.name(value, "when"),
                "unless" => alternative.guard.unless = self.name(value, "unless"),
                "pass" => alternative.pass = self.name(value, "pass"),
                _ => alternative.params = self.params(value),
            }
        }
        if alternative.guard.is_empty() {
            let problem = Problem::new(Kind::Missing, "alternative has no guard");
            self.findings.push(tree.span, problem.expected("when: \"FACT\" or unless: \"FACT\""));
            return None;
        }
        Some(alternative)
    }

    fn axes(&mut self, value: &Tree) -> Vec<(Name, Vec<Scalar>)> {
        let entries = self.entries(value, "axes", "axis");
        let mut axes = Vec::new();
        for (key, value) in entries {
            let values: Vec<Scalar> = self.items(value, "axis").iter().map(|item| self.scalar(item)).collect();
            if values.is_empty() {
                let problem = Problem::new(Kind::Missing, format!("axis `{}` has no values", key.text));
                self.findings.push(key.span, problem);
            }
            axes.push((key, values));
        }
        axes
    }
}

/// A number, switch or text as a parameter value.
pub(crate) fn scalar_value(data: &Data) -> Option<Value> {
    Some(match data {
        Data::Number(number) => match number.whole.and_then(|whole| u32::try_from(whole).ok()) {
            Some(whole) => Value::U32(whole),
            None => Value::F32(number.real as f32),
        },
        Data::Bool(value) => Value::Bool(*value),
        Data::Text(text) => Value::Word(text.clone()),
        _ => return None,
    })
}
