//! Mermaid, as pages of documentation render it.

use super::{Drawing, Kind};
use shadowgraph_core::plan::{Backend, Plan};
use std::fmt::Write;

/// The plan as a Mermaid flowchart.
pub fn mermaid(plan: &Plan) -> String {
    let drawing = Drawing::of(plan);
    let mut out = String::from("flowchart TD\n");
    for (index, shape) in drawing.shapes.iter().enumerate() {
        let label = escaped(&shape.lines.join("\n"));
        let (open, close) = if shape.kind == Kind::Output { ("([", "])") } else { ("[", "]") };
        let _ = writeln!(out, "    n{index}{open}\"{label}\"{close}:::{}", class(shape.kind));
    }
    for arrow in &drawing.arrows {
        let line = if arrow.is_transfer { "-.->" } else { "-->" };
        let (from, to, label) = (arrow.from, arrow.to, escaped(&arrow.ports.join("\n")));
        let _ = writeln!(out, "    n{from} {line}|\"{label}\"| n{to}");
    }
    for kind in [Kind::Node(Backend::Cpu), Kind::Node(Backend::Wgpu), Kind::Output] {
        let _ = writeln!(out, "    classDef {} fill:{},stroke:#555,color:#222", class(kind), kind.colour());
    }
    out
}

fn class(kind: Kind) -> &'static str {
    match kind {
        Kind::Node(Backend::Cpu) => "cpu",
        Kind::Node(Backend::Wgpu) => "wgpu",
        Kind::Output => "output",
    }
}

fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('"', "&quot;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('\n', "<br/>")
}
