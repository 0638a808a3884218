//! A file and its bases to one graph: `remove`, `replace` and `add` are applied, places stay.

use crate::builtin::{builtin, builtin_names};
use crate::names::{did_you_mean, nearest};
use crate::read::read;
use crate::schema::{FileWritten, Name, NodeWritten, Scalar};
use crate::source::{Files, Findings, Source, Span};
use crate::span::parse;
use indexmap::IndexMap;
use shadowgraph_core::problem::{Kind, Problem, Problems};

/// Longest chain of bases.
const MAX_BASES: usize = 16;

/// Gives the text of the file at a path, which is the `base` of a file joined to that file's folder.
pub type Loader<'a> = dyn Fn(&str) -> Result<String, Problem> + 'a;

/// A graph as written, its base applied. Names of stages and passes are not looked up yet: [`crate::plan()`] does.
///
/// Mistakes that leave the rest readable are kept and told by [`crate::plan()`] together with those it finds.
#[derive(Clone, Debug)]
pub struct Graph {
    pub(crate) name: String,
    pub(crate) doc: String,
    pub(crate) files: Files,
    pub(crate) inputs: Option<Vec<Name>>,
    pub(crate) nodes: Vec<NodeWritten>,
    pub(crate) outputs: Vec<(Name, Name)>,
    pub(crate) axes: Vec<(Name, Vec<Scalar>)>,
    pub(crate) light_samples: Option<u32>,
    pub(crate) findings: Findings,
}

impl Graph {
    /// The file's name without folder and ending.
    pub fn name(&self) -> &str {
        &self.name
    }
    /// What the file says it is; empty if it says nothing.
    pub fn doc(&self) -> &str {
        &self.doc
    }
    /// How many light samples it is made for; none if it does not say. Whoever supplies the samples may ask.
    pub fn light_samples(&self) -> Option<u32> {
        self.light_samples
    }
    /// Ids of all nodes, in the order of the file.
    pub fn node_ids(&self) -> impl Iterator<Item = &str> {
        self.nodes.iter().map(|node| node.id.text.as_str())
    }
    /// Names of the texts it was made of: the file, its base, the base's base.
    pub fn sources(&self) -> impl Iterator<Item = &str> {
        self.files.0.iter().map(|source| source.name.as_str())
    }
    /// Mistakes found while reading. [`crate::plan()`] tells them too.
    pub fn problems(&self) -> Problems {
        self.findings.clone().finish(&self.files, &[])
    }
}

/// Reads a graph and its bases.
///
/// # Errors
/// Text that is no RON or no struct, or a base that cannot be read.
pub fn load(source: Source, loader: &Loader) -> Result<Graph, Problems> {
    let name = graph_name(&source.name);
    let mut files = Files(vec![source]);
    let mut findings = Findings::default();
    let mut chain: Vec<FileWritten> = Vec::new();
    let mut is_whole = true;
    loop {
        let index = chain.len();
        let tree = parse(&files.0[index].text, index as u32, &mut findings);
        let Some(file) = tree.and_then(|tree| read(&tree, &mut findings)) else {
            is_whole = false;
            break;
        };
        let base = file.base.clone();
        chain.push(file);
        let Some(base) = base else { break };
        match open_base(&base, &files, loader) {
            Ok(source) => files.0.push(source),
            Err(problem) => {
                findings.push(base.span, problem);
                is_whole = false;
                break;
            }
        }
    }
    if !is_whole {
        return Err(findings.finish(&files, &[]));
    }
    let says_outputs = chain.iter().any(|file| file.outputs.is_some());
    let mut merge = Merge::default();
    for file in chain.into_iter().rev() {
        merge.apply(file, &mut findings);
    }
    let Merge { doc, inputs, nodes, outputs, axes, light_samples } = merge;
    // Outputs that are there and cannot be read are told already.
    if outputs.is_empty() && (!says_outputs || findings.is_empty()) {
        let problem = Problem::new(Kind::Missing, "graph has no outputs, so nothing would run");
        findings.push(Span::new(0, 0, 0), problem.expected("outputs: {\"image\": \"NODE.PORT\"}"));
    }
    Ok(Graph {
        name,
        doc,
        files,
        inputs,
        nodes: nodes.into_values().collect(),
        outputs: outputs.into_values().collect(),
        axes: axes.into_values().collect(),
        light_samples,
        findings,
    })
}

fn graph_name(source_name: &str) -> String {
    let name = source_name.strip_prefix("builtin:").unwrap_or(source_name);
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    name.strip_suffix(".ron").unwrap_or(name).into()
}

/// The text of `base`, named in the last of `files`.
fn open_base(base: &Name, files: &Files, loader: &Loader) -> Result<Source, Problem> {
    let missing = |message: &str| Problem::new(Kind::Missing, message.to_string()).found(format!("{:?}", base.text));
    let source = if let Some(text) = builtin(&base.text) {
        Source { name: format!("builtin:{}", base.text), text: text.into() }
    } else if !base.text.ends_with(".ron") {
        let remedy = did_you_mean(&base.text, builtin_names().into_iter());
        return Err(missing("no built-in graph of this name").remedy(format!("{remedy}; a file's name ends in .ron")));
    } else {
        let here = files.0.last().map_or("", |source| source.name.as_str());
        let folder = here.rfind(['/', '\\']).filter(|_| !base.text.starts_with('/')).map_or(0, |at| at + 1);
        let path = format!("{}{}", &here[..folder], base.text);
        let text = loader(&path)?;
        Source { name: path, text }
    };
    if files.0.iter().any(|earlier| earlier.name == source.name) {
        return Err(Problem::new(Kind::Cycle, "base comes back to a graph that builds on it").found(source.name));
    }
    if files.0.len() > MAX_BASES {
        return Err(Problem::new(Kind::BadValue, "too many bases").expected(format!("at most {MAX_BASES}")));
    }
    Ok(source)
}

#[derive(Default)]
struct Merge {
    doc: String,
    inputs: Option<Vec<Name>>,
    nodes: IndexMap<String, NodeWritten>,
    outputs: IndexMap<String, (Name, Name)>,
    axes: IndexMap<String, (Name, Vec<Scalar>)>,
    light_samples: Option<u32>,
}

impl Merge {
    /// Lays `file` over what its base says.
    fn apply(&mut self, file: FileWritten, findings: &mut Findings) {
        check_sections(&file, findings);
        let has_base = file.base.is_some();
        self.doc = file.doc.map_or(std::mem::take(&mut self.doc), |doc| doc.text);
        self.inputs = file.inputs.or(self.inputs.take());
        self.light_samples = file.light_samples.or(self.light_samples);
        let removed: Vec<Name> = file.remove.filter(|_| has_base).map_or(Vec::new(), |(_, names)| names);
        for name in &removed {
            if self.nodes.shift_remove(&name.text).is_none() {
                findings.push(name.span, self.unknown(&name.text, "removes"));
            }
        }
        for node in file.replace.filter(|_| has_base).into_iter().flat_map(|(_, nodes)| nodes) {
            match self.nodes.get_mut(&node.id.text) {
                Some(base) if base.id.span.file == node.id.span.file => findings.push(node.id.span, twice(&node.id)),
                Some(base) => lay_over(base, node),
                None => findings.push(node.id.span, self.unknown(&node.id.text, "replaces")),
            }
        }
        let nodes = file.nodes.into_iter().chain(file.add).flat_map(|(_, nodes)| nodes);
        for node in nodes {
            match self.nodes.entry(node.id.text.clone()) {
                indexmap::map::Entry::Occupied(_) => findings.push(node.id.span, twice(&node.id)),
                indexmap::map::Entry::Vacant(entry) => {
                    entry.insert(node);
                }
            }
        }
        for (key, value) in file.outputs.into_iter().flatten() {
            self.outputs.insert(key.text.clone(), (key, value));
        }
        // The base's outputs of a node that is gone go with it.
        self.outputs.retain(|_, (_, value)| {
            let id = value.text.split('.').next().unwrap_or_default();
            let is_removed = |name: &Name| name.text == id && value.span.is_older_than(name.span);
            self.nodes.contains_key(id) || !removed.iter().any(is_removed)
        });
        for (key, values) in file.axes {
            self.axes.insert(key.text.clone(), (key, values));
        }
    }

    fn unknown(&self, id: &str, verb: &str) -> Problem {
        let problem = Problem::new(Kind::UnknownName, format!("the file {verb} a node that its base does not have"));
        let near = nearest(id, self.nodes.keys().map(String::as_str));
        let problem = problem.node(id);
        match near {
            Some(near) => problem.remedy(format!("did you mean `{near}`?")),
            None => problem,
        }
    }
}

fn twice(id: &Name) -> Problem {
    Problem::new(Kind::Duplicate, format!("node id `{}` is given twice", id.text)).node(&id.text)
}

/// A file with a base states differences; one without states nodes.
fn check_sections(file: &FileWritten, findings: &mut Findings) {
    let has_base = file.base.is_some();
    let mut misplaced = |span: Option<Span>, name: &str, remedy: &str| {
        if let Some(span) = span {
            let message = format!("`{name}` {} a base", if has_base { "with" } else { "without" });
            findings.push(span, Problem::new(Kind::BadValue, message).remedy(remedy));
        }
    };
    if has_base {
        misplaced(file.nodes.as_ref().map(|(span, _)| *span), "nodes", "write replace, add and remove instead");
    } else {
        misplaced(file.replace.as_ref().map(|(span, _)| *span), "replace", "write nodes instead");
        misplaced(file.add.as_ref().map(|(span, _)| *span), "add", "write nodes instead");
        misplaced(file.remove.as_ref().map(|(span, _)| *span), "remove", "write nodes instead");
    }
}

/// What `over` states wins; what it does not state stays. Maps are laid over key by key.
fn lay_over(base: &mut NodeWritten, over: NodeWritten) {
    if over.stage.is_some() {
        // Another stage has other ports, passes and parameters: nothing of the base would mean the same.
        *base = over;
        return;
    }
    // A stage that the base left to its id stays what it was: ids are equal.
    base.id = over.id;
    base.pass = over.pass.or(base.pass.take());
    base.on = over.on.or(base.on);
    base.choose = over.choose.or(base.choose.take());
    base.guard.when = over.guard.when.or(base.guard.when.take());
    base.guard.unless = over.guard.unless.or(base.guard.unless.take());
    lay_over_map(&mut base.params, over.params);
    lay_over_map(&mut base.inputs, over.inputs);
}

fn lay_over_map<V>(base: &mut Vec<(Name, V)>, over: Vec<(Name, V)>) {
    for (key, value) in over {
        match base.iter_mut().find(|(known, _)| known.text == key.text) {
            Some(entry) => *entry = (key, value),
            None => base.push((key, value)),
        }
    }
}
