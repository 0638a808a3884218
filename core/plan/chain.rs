//! A plan for tests.

use crate::array::Element;
use crate::param::Params;
use crate::pass::{Contract, Pass};
use crate::plan::{Backend, Node, Plan, Producer, Slot};
use crate::port::{Direction, Port};
use crate::stage::Stage;

const STAGE: Stage = Stage {
    name: "step",
    doc: "",
    ports: &[
        Port::new(Direction::In, "from", Element::U32, "value", "N"),
        Port::new(Direction::Out, "to", Element::U32, "value", "N"),
    ],
};
const PASS: Pass = Pass {
    name: "step",
    stage: &STAGE,
    doc: "",
    source: "",
    ignores: &[],
    params: &[],
    counters: &[],
    contract: Contract::Exact,
    features: &[],
    size: |_| Vec::new(),
    cpu: None,
    gpu: None,
};

/// a -> b -> c, with b on the other backend; the last is the graph's output.
pub fn chain() -> Plan {
    let slot = |name: &str, producer, keep| Slot {
        name: name.into(),
        port: STAGE.ports[1],
        producer,
        lifetime: [0, 0],
        keep,
        on: [true; 2],
        alias: 0,
    };
    let node = |id: &str, at, on| Node {
        id: id.into(),
        pass: &PASS,
        params: Params::default(),
        on,
        inputs: vec![("from", at)],
        outputs: vec![("to", at + 1)],
    };
    let mut plan = Plan {
        nodes: vec![node("a", 0, Backend::Cpu), node("b", 1, Backend::Wgpu), node("c", 2, Backend::Cpu)],
        slots: vec![
            slot("in", Producer::Input, false),
            slot("a.to", Producer::Node(0), false),
            slot("b.to", Producer::Node(1), false),
            slot("c.to", Producer::Node(2), true),
        ],
        outputs: vec![("out".into(), 3)],
        ..Plan::default()
    };
    plan.steps = plan.ordered_steps();
    plan
}
