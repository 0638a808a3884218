//! Drawings of a plan. Boxes are nodes with their pass, coloured by backend; arrows carry the names of the ports they
//! leave. Graph inputs are listed in the boxes that read them: as boxes of their own they would be most of the picture.

mod dot;
mod mermaid;
mod page;
mod svg;

pub use dot::dot;
pub use mermaid::mermaid;
pub use svg::svg;

use crate::overrides::backend_name;
use shadowgraph_core::plan::{Backend, Plan, Producer};

/// What a box stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Node(Backend),
    Output,
}

impl Kind {
    /// Fill colour, `#rrggbb`.
    fn colour(self) -> &'static str {
        match self {
            Kind::Node(Backend::Cpu) => "#fde8c8",
            Kind::Node(Backend::Wgpu) => "#d5e8fb",
            Kind::Output => "#e3f3dc",
        }
    }
}

struct Shape {
    lines: Vec<String>,
    kind: Kind,
}

/// All that goes from one box to another.
struct Arrow {
    from: usize,
    to: usize,
    ports: Vec<&'static str>,
    /// Between backends.
    is_transfer: bool,
}

struct Drawing {
    shapes: Vec<Shape>,
    /// In the order of the boxes they leave.
    arrows: Vec<Arrow>,
}

impl Drawing {
    fn of(plan: &Plan) -> Self {
        let mut shapes = Vec::new();
        let mut arrows: Vec<Arrow> = Vec::new();
        let mut connect = |slot: usize, to: usize, on: Option<Backend>| {
            let Producer::Node(from) = plan.slots[slot].producer else { return };
            let port = plan.slots[slot].port.name;
            match arrows.iter_mut().find(|arrow| (arrow.from, arrow.to) == (from, to)) {
                Some(arrow) if arrow.ports.contains(&port) => {}
                Some(arrow) => arrow.ports.push(port),
                None => {
                    let is_transfer = on.is_some_and(|on| on != plan.nodes[from].on);
                    arrows.push(Arrow { from, to, ports: vec![port], is_transfer });
                }
            }
        };
        for (index, node) in plan.nodes.iter().enumerate() {
            let mut lines = vec![node.id.clone(), format!("{} on {}", node.pass.name, backend_name(node.on))];
            let inputs = node.inputs.iter().filter(|(_, slot)| plan.slots[*slot].producer == Producer::Input);
            let inputs: Vec<&str> = inputs.map(|(_, slot)| plan.slots[*slot].name.as_str()).collect();
            lines.extend(inputs.chunks(2).map(|pair| pair.join(", ")));
            shapes.push(Shape { lines, kind: Kind::Node(node.on) });
            node.inputs.iter().for_each(|(_, slot)| connect(*slot, index, Some(node.on)));
        }
        for (name, slot) in &plan.outputs {
            connect(*slot, shapes.len(), None);
            shapes.push(Shape { lines: vec![name.clone()], kind: Kind::Output });
        }
        arrows.sort_by_key(|arrow| (arrow.from, arrow.to));
        Self { shapes, arrows }
    }
}
