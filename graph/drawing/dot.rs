//! Graphviz.

use super::{Drawing, Kind};
use shadowgraph_core::plan::Plan;
use std::fmt::Write;

/// The plan in the language of Graphviz.
pub fn dot(plan: &Plan) -> String {
    let drawing = Drawing::of(plan);
    let mut out = format!("digraph {} {{\n", quoted(&[plan.name.as_str()]));
    out += "    node [shape=box, style=\"filled,rounded\", fontname=\"sans-serif\"];\n";
    out += "    edge [fontname=\"sans-serif\", fontsize=10];\n";
    for (index, shape) in drawing.shapes.iter().enumerate() {
        let form = if shape.kind == Kind::Output { ", shape=ellipse, style=filled" } else { "" };
        let colour = shape.kind.colour();
        let _ = writeln!(out, "    n{index} [label={}, fillcolor=\"{colour}\"{form}];", quoted(&shape.lines));
    }
    for arrow in &drawing.arrows {
        let dashed = if arrow.is_transfer { ", style=dashed" } else { "" };
        let (from, to, label) = (arrow.from, arrow.to, quoted(&arrow.ports));
        let _ = writeln!(out, "    n{from} -> n{to} [label={label}{dashed}];");
    }
    out + "}\n"
}

/// Lines as one quoted label.
fn quoted<T: AsRef<str>>(lines: &[T]) -> String {
    let lines: Vec<String> =
        lines.iter().map(|line| line.as_ref().replace('\\', "\\\\").replace('"', "\\\"").replace('\n', " ")).collect();
    format!("\"{}\"", lines.join("\\n"))
}
