//! Which value each input port of a live node reads, and with it which nodes are live.

use crate::check::mismatch;
use crate::names::list;
use crate::resolve::{From, Resolved};
use crate::source::{Findings, Span};
use crate::world::Selection;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::port::{Direction, Port};
use shadowgraph_core::problem::{Kind, Problem};
use std::collections::HashMap;

/// Every value by the name of its port.
pub(crate) struct Values {
    by_name: HashMap<&'static str, Vec<From>>,
}

/// What live nodes read.
pub(crate) struct Wired {
    /// Inputs of each node; empty for one that is not live.
    pub inputs: Vec<Vec<(&'static str, From)>>,
    /// Whether some output of the graph needs the node.
    pub is_live: Vec<bool>,
}

impl Values {
    pub fn new(resolved: &Resolved) -> Self {
        let mut by_name: HashMap<&'static str, Vec<From>> = HashMap::new();
        for (index, node) in resolved.nodes.iter().enumerate() {
            for port in node.stage.into_iter().flat_map(|stage| stage.outputs()) {
                by_name.entry(port.name).or_default().push(From::Node(index, port));
            }
        }
        for (index, port) in resolved.inputs.iter().enumerate() {
            by_name.entry(port.name).or_default().push(From::Input(index));
        }
        Self { by_name }
    }
}

/// Walks from the outputs to what they need. Where an output is unknown, every node is taken to be needed.
pub(crate) fn wire(resolved: &Resolved, selection: &Selection, values: &Values, findings: &mut Findings) -> Wired {
    let count = resolved.nodes.len();
    let mut walk = Walk { resolved, selection, values, findings };
    let mut wired = Wired { inputs: vec![Vec::new(); count], is_live: vec![false; count] };
    let mut open: Vec<usize> = Vec::new();
    for (key, span, from) in &resolved.outputs {
        if let From::Node(node, _) = *from {
            if selection.has(resolved, node) {
                open.push(node);
            } else {
                let problem = Problem::new(Kind::Missing, format!("output `{key}` is of a node that is left out"));
                walk.findings.push(*span, problem.found(walk.absence(node)));
            }
        }
    }
    if !resolved.has_all_outputs {
        open.extend((0..count).filter(|node| selection.has(resolved, *node)));
    }
    while let Some(node) = open.pop() {
        let Some(choice) = selection.chosen[node].filter(|_| !wired.is_live[node]) else { continue };
        wired.is_live[node] = true;
        let choice = &resolved.nodes[node].choices[choice];
        for port in choice.pass.reads() {
            let Some(from) = walk.source(node, port, choice.is_sound) else { continue };
            wired.inputs[node].push((port.name, from));
            if let From::Node(source, _) = from {
                open.push(source);
            }
        }
    }
    wired
}

struct Walk<'a, 'g> {
    resolved: &'a Resolved<'g>,
    selection: &'a Selection,
    values: &'a Values,
    findings: &'a mut Findings,
}

impl Walk<'_, '_> {
    /// What `port` of `node` reads; on a mistake nothing, and it is told.
    fn source(&mut self, node: usize, port: &'static Port, is_sound: bool) -> Option<From> {
        let reader = &self.resolved.nodes[node];
        if let Some(explicit) = reader.explicit.iter().find(|explicit| explicit.port == port.name) {
            let absent = match explicit.from? {
                From::Node(source, _) if !self.selection.has(self.resolved, source) => source,
                from => return Some(from),
            };
            if port.direction == Direction::In {
                let problem = Problem::new(Kind::Missing, "port reads a node that is left out");
                let problem = problem.node(&reader.id.text).port(port.name).found(self.absence(absent));
                self.findings.push(explicit.span, problem);
            }
            return None;
        }
        let named: Vec<From> = self.values.by_name.get(port.name).into_iter().flatten().copied().collect();
        let named: Vec<From> = named.into_iter().filter(|from| self.is_there(*from, node)).collect();
        let fitting: Vec<From> = named.iter().copied().filter(|from| self.port(*from).fits(port)).collect();
        match (fitting.as_slice(), named.as_slice()) {
            ([only], _) => return Some(*only),
            ([], _) if port.direction == Direction::OptionalIn || !is_sound => {}
            // A node of unknown stage may be the one that was meant.
            ([], _) if self.resolved.nodes.iter().any(|node| node.stage.is_none()) => {}
            ([], [other, ..]) => {
                let fitting = self.fitting(node, port);
                let problem = mismatch(&reader.id.text, port, &self.text(*other), &self.port(*other), &fitting);
                self.findings.push(reader.id.span, problem);
            }
            ([], []) => {
                let problem = Problem::new(Kind::Missing, "nothing feeds this port").expected(port.type_text());
                let fitting = self.fitting(node, port);
                let remedy = match fitting.first() {
                    Some(first) => {
                        let all = list(fitting.iter().map(String::as_str), ", ");
                        format!("these fit: {all}; write in: {{{:?}: {first:?}}}", port.name)
                    }
                    None => "no node and no graph input gives such a value".into(),
                };
                let problem = problem.node(&reader.id.text).port(port.name).remedy(remedy);
                self.findings.push(self.place(node), problem);
            }
            (several, _) => {
                let candidates: Vec<String> = several.iter().map(|from| self.text(*from)).collect();
                let problem = Problem::new(Kind::Missing, "more than one value has this port's name and type");
                let found = list(candidates.iter().map(String::as_str), ", ");
                let remedy = format!("say which: in: {{{:?}: {:?}}}", port.name, candidates[0]);
                let problem = problem.node(&reader.id.text).port(port.name).found(found).remedy(remedy);
                self.findings.push(self.place(node), problem);
            }
        }
        None
    }

    fn place(&self, node: usize) -> Span {
        self.resolved.nodes[node].id.span
    }

    fn port(&self, from: From) -> Port {
        match from {
            From::Input(index) => *self.resolved.inputs[index],
            From::Node(_, port) => *port,
        }
    }

    /// Whether the value exists where `reader` looks: its node is not left out, and is another.
    fn is_there(&self, from: From, reader: usize) -> bool {
        match from {
            From::Input(_) => true,
            From::Node(node, _) => node != reader && self.selection.has(self.resolved, node),
        }
    }

    fn text(&self, from: From) -> String {
        match from {
            From::Input(index) => self.resolved.inputs[index].name.into(),
            From::Node(node, port) => format!("{}.{}", self.resolved.nodes[node].id.text, port.name),
        }
    }

    /// Everything that may be fed to `port`, in the order of the file, then the inputs.
    fn fitting(&self, reader: usize, port: &Port) -> Vec<String> {
        let mut all: Vec<From> = self.values.by_name.values().flatten().copied().collect();
        all.retain(|from| self.is_there(*from, reader) && self.port(*from).fits(port));
        all.sort_by_key(|from| match from {
            From::Node(node, port) => (*node, port.name),
            From::Input(index) => (usize::MAX, self.resolved.inputs[*index].name),
        });
        all.into_iter().map(|from| self.text(from)).collect()
    }

    fn absence(&self, node: usize) -> String {
        let node = &self.resolved.nodes[node];
        format!("`{}` is left out: {}", node.id.text, node.guard.text(self.selection.world))
    }
}

/// For every node that is there but not live: why no output needs it.
pub(crate) fn idle_reason(node: usize, resolved: &Resolved, selection: &Selection, wired: &Wired) -> String {
    let outputs: Vec<&'static Port> =
        resolved.nodes[node].stage.into_iter().flat_map(|stage| stage.outputs()).collect();
    let mut reasons: Vec<String> = Vec::new();
    for (index, reader) in resolved.nodes.iter().enumerate() {
        let Some(choice) = selection.chosen[index].filter(|_| index != node) else { continue };
        let pass: &Pass = reader.choices[choice].pass;
        let would_read = |port: &&'static Port| match reader.explicit.iter().find(|wire| wire.port == port.name) {
            Some(wire) => matches!(wire.from, Some(From::Node(source, _)) if source == node),
            None => outputs.iter().any(|output| output.name == port.name && output.fits(port)),
        };
        let wanted: Vec<&str> = pass.stage.inputs().filter(would_read).map(|port| port.name).collect();
        if wanted.is_empty() {
            continue;
        }
        reasons.push(match wired.is_live[index] {
            true => format!("{} ({}) does not read {}", reader.id.text, pass.name, wanted.join(", ")),
            false => format!("{} is not needed", reader.id.text),
        });
    }
    if reasons.is_empty() { "nothing reads its outputs".into() } else { reasons.join("; ") }
}
