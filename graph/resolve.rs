//! Names to stages, passes, ports and parameters. Every alternative is looked up, taken or not.
//!
//! A name that is not found is told, then read as the nearest one there is, so that what follows can be checked too.

use crate::check;
use crate::load::Graph;
use crate::names::nearest;
use crate::overrides::Overrides;
use crate::schema::{Name, NodeWritten};
use crate::source::{Findings, Span};
use crate::world::Guard;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::{Catalogue, Pass};
use shadowgraph_core::plan::Backend;
use shadowgraph_core::port::Port;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::stage::Stage;
use std::collections::HashMap;

/// Who gives a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum From {
    /// An index into [`Resolved::inputs`].
    Input(usize),
    /// An output port of a node.
    Node(usize, &'static Port),
}

/// One way to run a node.
#[derive(Debug)]
pub(crate) struct Choice {
    pub guard: Guard,
    pub pass: &'static Pass,
    /// Where the pass is named.
    pub span: Span,
    pub params: Params,
    /// Parameters of the node that this pass does not have.
    pub dropped: Vec<String>,
    /// Parameters that flags set and this pass does not have.
    pub unset: Vec<(String, Span)>,
    /// Whether the pass is the one that the file names, not the nearest one.
    pub is_sound: bool,
}

/// An entry of `in`.
#[derive(Debug)]
pub(crate) struct Explicit {
    pub port: &'static str,
    /// None: wrong and told.
    pub from: Option<From>,
    pub span: Span,
}

/// A node of the file with everything looked up.
#[derive(Debug)]
pub(crate) struct ResolvedNode<'g> {
    pub id: &'g Name,
    /// None: unknown and told; nothing can be said of its ports.
    pub stage: Option<&'static Stage>,
    pub guard: Guard,
    /// Alternatives in the order of the file, then the node's own pass, which has no guard. Empty without a stage.
    pub choices: Vec<Choice>,
    pub explicit: Vec<Explicit>,
    pub on: Option<(Backend, Span)>,
}

/// The whole graph.
#[derive(Debug)]
pub(crate) struct Resolved<'g> {
    pub nodes: Vec<ResolvedNode<'g>>,
    pub inputs: Vec<&'g Port>,
    /// Name, place, who gives it.
    pub outputs: Vec<(&'g str, Span, From)>,
    /// Whether every output was found; else what is live cannot be told.
    pub has_all_outputs: bool,
}

/// What lookups need.
pub(crate) struct Names<'g> {
    pub by_id: HashMap<&'g str, usize>,
    pub ids: Vec<&'g str>,
    pub stages: Vec<Option<&'static Stage>>,
    pub inputs: Vec<&'g Port>,
    passes: HashMap<&'static str, Vec<&'static Pass>>,
}

impl Names<'_> {
    /// Passes of a stage in the order of the catalogue.
    pub fn passes_of(&self, stage: &Stage) -> &[&'static Pass] {
        self.passes.get(stage.name).map_or(&[], Vec::as_slice)
    }
    /// The node called `id`; unknown ones are told as `what` and read as the nearest.
    pub fn node(&self, id: &str) -> Result<usize, (Problem, Option<usize>)> {
        if let Some(index) = self.by_id.get(id) {
            return Ok(*index);
        }
        let near = nearest(id, self.ids.iter().copied());
        let mut problem = Problem::new(Kind::UnknownName, format!("there is no node `{id}`"));
        if let Some(near) = near {
            problem = problem.remedy(format!("did you mean `{near}`?"));
        }
        Err((problem, near.map(|near| self.by_id[near])))
    }
}

/// Looks every name up.
pub(crate) fn resolve<'g>(
    graph: &'g Graph,
    catalogue: &Catalogue,
    inputs: &'g [Port],
    overrides: &Overrides,
    findings: &mut Findings,
) -> Resolved<'g> {
    let mut passes: HashMap<&'static str, Vec<&'static Pass>> = HashMap::new();
    for pass in catalogue.passes() {
        passes.entry(pass.stage.name).or_default().push(pass);
    }
    let names = Names {
        by_id: graph.nodes.iter().enumerate().map(|(index, node)| (node.id.text.as_str(), index)).collect(),
        ids: graph.node_ids().collect(),
        stages: graph.nodes.iter().map(|node| check::stage(node, &passes, catalogue, findings)).collect(),
        inputs: check::inputs(graph.inputs.as_deref(), inputs, findings),
        passes,
    };
    let flags = NodeFlags::sort(overrides, &names, findings);
    let mut nodes = Vec::with_capacity(graph.nodes.len());
    for (index, written) in graph.nodes.iter().enumerate() {
        nodes.push(resolve_node(index, written, &names, &flags, findings));
    }
    let mut has_all_outputs = !graph.outputs.is_empty();
    let mut outputs = Vec::with_capacity(graph.outputs.len());
    for (key, value) in &graph.outputs {
        match check::output(key, value, &names, findings) {
            Some(from) => outputs.push((key.text.as_str(), value.span, from)),
            None => has_all_outputs = false,
        }
    }
    check::axes(&graph.axes, &names, findings);
    Resolved { nodes, inputs: names.inputs, outputs, has_all_outputs }
}

/// Swaps, sets and pins by node.
#[derive(Default)]
struct NodeFlags<'o> {
    swap: HashMap<usize, (&'o str, Span)>,
    sets: HashMap<usize, Vec<check::Set<'o>>>,
    on: HashMap<usize, (Backend, Span)>,
}

impl<'o> NodeFlags<'o> {
    fn sort(overrides: &'o Overrides, names: &Names, findings: &mut Findings) -> Self {
        let mut flags = Self::default();
        let mut node_of = |id: &str, span: Span| match names.node(id) {
            Ok(node) => Some(node),
            Err((problem, _)) => {
                findings.push(span, problem);
                None
            }
        };
        for (index, (id, pass)) in overrides.swaps.iter().enumerate() {
            let span = overrides.swap_span(index);
            node_of(id, span).map(|node| flags.swap.insert(node, (pass, span)));
        }
        for (index, (id, param, text)) in overrides.sets.iter().enumerate() {
            let span = overrides.set_span(index);
            if let Some(node) = node_of(id, span) {
                flags.sets.entry(node).or_default().push(check::Set { param, text, span });
            }
        }
        for (index, (id, backend)) in overrides.on.iter().enumerate() {
            let span = overrides.on_span(index);
            node_of(id, span).map(|node| flags.on.insert(node, (*backend, span)));
        }
        flags
    }
}

fn resolve_node<'g>(
    index: usize,
    written: &'g NodeWritten,
    names: &Names<'g>,
    flags: &NodeFlags,
    findings: &mut Findings,
) -> ResolvedNode<'g> {
    let id = &written.id;
    let guard = check::guard(&written.guard, id, findings);
    let on = flags.on.get(&index).copied().or(written.on);
    let stage = names.stages[index];
    let mut node = ResolvedNode { id, stage, guard, choices: Vec::new(), explicit: Vec::new(), on };
    let Some(stage) = stage else { return node };
    let passes = names.passes_of(stage);
    let sets = flags.sets.get(&index).map_or(&[][..], Vec::as_slice);
    let own = match &written.pass {
        Some(name) => check::pass(&name.text, name.span, id, passes, findings),
        None => (passes[0], id.span, true),
    };
    // Alternatives are looked up even where a swap makes them idle: a mistake in them is still a mistake.
    for alternative in written.choose.iter().flatten() {
        let guard = check::guard(&alternative.guard, id, findings);
        let (pass, span, is_sound) = match &alternative.pass {
            Some(name) => check::pass(&name.text, name.span, id, passes, findings),
            None => (own.0, alternative.span, own.2),
        };
        let mut reader = check::ParamReader::new(id, pass, passes, is_sound, findings);
        reader.inherit(&written.params);
        reader.take(&alternative.params);
        reader.set(sets);
        node.choices.push(reader.finish(guard, span));
    }
    let (pass, span, is_sound) = match flags.swap.get(&index) {
        Some((name, span)) => {
            node.choices.clear();
            check::pass(name, *span, id, passes, findings)
        }
        None => own,
    };
    let mut reader = check::ParamReader::new(id, pass, passes, is_sound, findings);
    reader.take_from_layers(&written.params, span);
    reader.set(sets);
    node.choices.push(reader.finish(Guard::default(), span));
    node.explicit = check::wires(index, &written.inputs, names, findings);
    node
}
