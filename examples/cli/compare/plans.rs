//! In what two plans differ, exactly, and which of their nodes must make the same values.

use serde::Serialize;
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::{Backend, Node, Plan, Producer};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// One thing in which B is another graph than A.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Difference {
    /// A node of A that B does not run.
    OnlyInA {
        /// Its id.
        node: String,
        /// Its stage and pass.
        pass: String,
    },
    /// A node of B that A does not run.
    OnlyInB {
        /// Its id.
        node: String,
        /// Its stage and pass.
        pass: String,
    },
    /// Another pass.
    Pass {
        /// Id in both.
        node: String,
        /// In A.
        a: String,
        /// In B.
        b: String,
    },
    /// Another value of a parameter that both passes have.
    Param {
        /// Id in both.
        node: String,
        /// The parameter.
        param: String,
        /// In A.
        a: String,
        /// In B.
        b: String,
    },
    /// Another backend.
    Backend {
        /// Id in both.
        node: String,
        /// In A.
        a: Backend,
        /// In B.
        b: Backend,
    },
    /// An input that comes from elsewhere.
    Input {
        /// Id in both.
        node: String,
        /// The port.
        port: String,
        /// What feeds it in A, if anything.
        a: Option<String>,
        /// What feeds it in B, if anything.
        b: Option<String>,
    },
}

impl Difference {
    /// `visibility: planes -> fused`.
    pub fn text(&self) -> String {
        let or_none = |name: &Option<String>| name.clone().unwrap_or_else(|| "nothing".into());
        match self {
            Self::OnlyInA { node, pass } => format!("{node} ({pass}): only in A"),
            Self::OnlyInB { node, pass } => format!("{node} ({pass}): only in B"),
            Self::Pass { node, a, b } => format!("{node}: {a} -> {b}"),
            Self::Param { node, param, a, b } => format!("{node}.{param}: {a} -> {b}"),
            Self::Backend { node, a, b } => format!("{node}: on {a:?} -> on {b:?}").to_lowercase(),
            Self::Input { node, port, a, b } => format!("{node}.{port} reads {} -> {}", or_none(a), or_none(b)),
        }
    }
}

/// Everything in which `b` differs from `a`, in the order of their nodes.
pub fn differences(a: &Plan, b: &Plan) -> Vec<Difference> {
    let find = |plan: &Plan, id: &str| plan.nodes.iter().position(|node| node.id == id);
    let mut found = Vec::new();
    for node in &a.nodes {
        match find(b, &node.id) {
            None => found.push(Difference::OnlyInA { node: node.id.clone(), pass: format!("{:?}", node.pass) }),
            Some(other) => of_node(a, node, b, &b.nodes[other], &mut found),
        }
    }
    for node in b.nodes.iter().filter(|node| find(a, &node.id).is_none()) {
        found.push(Difference::OnlyInB { node: node.id.clone(), pass: format!("{:?}", node.pass) });
    }
    found
}

fn of_node(a: &Plan, one: &Node, b: &Plan, other: &Node, found: &mut Vec<Difference>) {
    let node = one.id.clone();
    let same_stage = one.pass.stage.name == other.pass.stage.name;
    if !same_stage || one.pass.name != other.pass.name {
        let name = |node: &Node| if same_stage { node.pass.name.to_string() } else { format!("{:?}", node.pass) };
        found.push(Difference::Pass { node: node.clone(), a: name(one), b: name(other) });
    }
    for (param, value) in &one.params.0 {
        if let Some((_, other)) = other.params.0.iter().find(|(name, _)| name == param)
            && other != value
        {
            let (a, b) = (value_text(value), value_text(other));
            found.push(Difference::Param { node: node.clone(), param: param.to_string(), a, b });
        }
    }
    if one.on != other.on {
        found.push(Difference::Backend { node: node.clone(), a: one.on, b: other.on });
    }
    let feeds = |plan: &Plan, node: &Node, port: &str| {
        node.inputs.iter().find(|(name, _)| *name == port).map(|(_, slot)| plan.slots[*slot].name.clone())
    };
    let ports = one.inputs.iter().chain(&other.inputs).map(|(port, _)| *port);
    let mut seen = Vec::new();
    for port in ports {
        let (from_a, from_b) = (feeds(a, one, port), feeds(b, other, port));
        // A port that only one of two passes reads is a matter of the pass.
        let is_wiring = one.pass.name == other.pass.name || from_a.is_some() && from_b.is_some();
        if from_a != from_b && is_wiring && !seen.contains(&port) {
            let (a, b) = (from_a, from_b);
            found.push(Difference::Input { node: node.clone(), port: port.into(), a, b });
        }
        seen.push(port);
    }
}

fn value_text(value: &Value) -> String {
    match value {
        Value::U32(value) => value.to_string(),
        Value::F32(value) => value.to_string(),
        Value::Bool(value) => value.to_string(),
        Value::Word(word) => word.clone(),
    }
}

/// Nodes of `b` that do to equal inputs what a node of `a` does, as (node of `b`, node of `a`): they must make the same values.
/// `same_input` says whether a graph input has one value for both.
pub fn shared(a: &Plan, b: &Plan, same_input: impl Fn(&str) -> bool) -> Vec<(usize, usize)> {
    let keys_a = keys(a, |input| if same_input(input) { 0 } else { 1 });
    let keys_b = keys(b, |input| if same_input(input) { 0 } else { 2 });
    let by_key: HashMap<u64, usize> = keys_a.into_iter().enumerate().map(|(node, key)| (key, node)).collect();
    keys_b.into_iter().enumerate().filter_map(|(node, key)| Some((node, *by_key.get(&key)?))).collect()
}

/// A number for each node, equal where pass, parameters, backend and everything upstream are.
fn keys(plan: &Plan, side_of_input: impl Fn(&str) -> u8) -> Vec<u64> {
    let mut keys: Vec<u64> = Vec::with_capacity(plan.nodes.len());
    for node in &plan.nodes {
        let mut hasher = DefaultHasher::new();
        format!("{:?} {:?} {:?}", node.pass, node.params, node.on).hash(&mut hasher);
        for (port, slot) in &node.inputs {
            port.hash(&mut hasher);
            let slot = &plan.slots[*slot];
            match slot.producer {
                Producer::Input => (&slot.name, side_of_input(&slot.name)).hash(&mut hasher),
                Producer::Node(maker) => (keys[maker], slot.port.name).hash(&mut hasher),
            }
        }
        keys.push(hasher.finish());
    }
    keys
}
