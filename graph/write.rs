//! A plan back to RON: nothing is left to a default, a fact or a base.

use ron::ser::{PrettyConfig, to_string_pretty};
use serde::Serialize;
use shadowgraph_core::param::Value;
use shadowgraph_core::plan::{Backend, Plan};

#[derive(Serialize)]
struct FileText<'p> {
    version: u32,
    #[serde(skip_serializing_if = "str::is_empty")]
    doc: &'p str,
    nodes: Vec<NodeText<'p>>,
    outputs: Entries<'p, &'p str>,
}

#[derive(Serialize)]
struct NodeText<'p> {
    id: &'p str,
    stage: &'p str,
    pass: &'p str,
    #[serde(skip_serializing_if = "Entries::is_empty")]
    params: Entries<'p, &'p Value>,
    on: OnText,
    #[serde(rename = "in")]
    inputs: Entries<'p, &'p str>,
}

#[derive(Serialize)]
enum OnText {
    Cpu,
    Wgpu,
}

/// A map in the order of its entries.
struct Entries<'p, V>(Vec<(&'p str, V)>);

impl<V> Entries<'_, V> {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<V: Serialize> Serialize for Entries<'_, V> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(key, value)| (key, value)))
    }
}

/// The plan as a graph file of its own: every pass, parameter, backend and connection written out. Reading it gives the
/// same plan again on any scene.
pub fn resolved_text(plan: &Plan) -> String {
    text(plan, &format!("resolved from {}", plan.name))
}

/// Sixteen hexadecimal digits that are equal for equal [`resolved_text`]s: 64-bit FNV-1a, without the plan's name.
pub fn plan_id(plan: &Plan) -> String {
    let hash = text(plan, "")
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3));
    format!("{hash:016x}")
}

fn text(plan: &Plan, doc: &str) -> String {
    let slot_name = |slot: &usize| plan.slots[*slot].name.as_str();
    let nodes = plan.nodes.iter().map(|node| NodeText {
        id: &node.id,
        stage: node.pass.stage.name,
        pass: node.pass.name,
        params: Entries(node.params.0.iter().map(|(name, value)| (*name, value)).collect()),
        on: match node.on {
            Backend::Cpu => OnText::Cpu,
            Backend::Wgpu => OnText::Wgpu,
        },
        inputs: Entries(node.inputs.iter().map(|(port, slot)| (*port, slot_name(slot))).collect()),
    });
    let file = FileText {
        version: crate::VERSION,
        doc,
        nodes: nodes.collect(),
        outputs: Entries(plan.outputs.iter().map(|(name, slot)| (name.as_str(), slot_name(slot))).collect()),
    };
    // One line a node.
    let config = PrettyConfig::new().depth_limit(2).new_line("\n").struct_names(false);
    match to_string_pretty(&file, config) {
        Ok(text) => text + "\n",
        Err(error) => unreachable!("plan {} cannot be written: {error}", plan.name),
    }
}
