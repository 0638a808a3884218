//! Nodes must not feed each other in a circle.

use crate::resolve::Resolved;
use crate::source::{Findings, Span};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};
use petgraph::visit::EdgeRef;
use shadowgraph_core::problem::{Kind, Problem};
use std::collections::HashMap;

/// Names one circle of every strongly connected part. Edges carry the ports at their two ends.
pub(crate) fn cycles(
    edges: &DiGraph<usize, (&'static str, &'static str)>,
    resolved: &Resolved,
    findings: &mut Findings,
) {
    for part in tarjan_scc(edges) {
        let is_circle = part.len() > 1 || edges.contains_edge(part[0], part[0]);
        let Some(start) = part.iter().copied().min_by_key(|node| edges[*node]).filter(|_| is_circle) else { continue };
        let path = circle(edges, start);
        let id = |node: NodeIndex| resolved.nodes[edges[node]].id.text.as_str();
        let hops: Vec<String> = path
            .iter()
            .map(|(from, (output, input), to)| format!("{}.{output} -> {}.{input}", id(*from), id(*to)))
            .collect();
        let problem = Problem::new(Kind::Cycle, "nodes feed each other in a circle").node(id(start));
        findings.push(place(resolved, edges[start]), problem.found(hops.join(", ")));
    }
}

type Hop = (NodeIndex, (&'static str, &'static str), NodeIndex);

/// The shortest way from `start` back to it.
fn circle(edges: &DiGraph<usize, (&'static str, &'static str)>, start: NodeIndex) -> Vec<Hop> {
    let mut came_by: HashMap<NodeIndex, Hop> = HashMap::new();
    let mut queue = std::collections::VecDeque::from([start]);
    while let Some(node) = queue.pop_front() {
        for edge in edges.edges(node) {
            let hop = (node, *edge.weight(), edge.target());
            if edge.target() == start {
                let mut path = vec![hop];
                while path[0].0 != start {
                    path.insert(0, came_by[&path[0].0]);
                }
                return path;
            }
            came_by.entry(edge.target()).or_insert_with(|| {
                queue.push_back(edge.target());
                hop
            });
        }
    }
    unreachable!("a strongly connected part without a way back to {start:?}")
}

/// Where the node says what it reads, else where it is named.
fn place(resolved: &Resolved, node: usize) -> Span {
    let node = &resolved.nodes[node];
    node.explicit.first().map_or(node.id.span, |explicit| explicit.span)
}
