//! Tree to [`FileWritten`]: which fields there are and of which type. Every mistake is noted, reading goes on.

use crate::names::list;
use crate::schema::{AlternativeWritten, FileWritten, GuardWritten, Name, NodeWritten, Scalar, VERSION};
use crate::source::{Findings, Span};
use crate::span::{Data, Reader, Tree};
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::{Kind, Problem};

const FILE_FIELDS: &[&str] =
    &["version", "doc", "base", "inputs", "nodes", "replace", "add", "remove", "outputs", "axes", "light_samples"];
const NODE_FIELDS: &[&str] = &["id", "stage", "pass", "params", "on", "in", "choose", "when", "unless"];
const ALTERNATIVE_FIELDS: &[&str] = &["when", "unless", "pass", "params"];
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

impl Reader<'_> {
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
