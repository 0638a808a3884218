//! Plans as pictures and text.

use super::*;
use crate::drawing::{dot, mermaid, svg};
use shadowgraph_core::plan::Backend;

fn small() -> Plan {
    let text = r#"(version: 1, nodes: [
        (id: "casters"),
        (id: "list_build", on: Wgpu), (id: "view_samples"), (id: "sample_filter"), (id: "light_frame"),
        (id: "idle", stage: "scan", in: {"length": "list_build.list_length"}),
    ], outputs: {"c": "casters.caster_state", "cell": "list_build.cell"})"#;
    plan_text(text).unwrap()
}

#[test]
fn dot_and_mermaid_show_nodes_ports_and_transfers() {
    let plan = small();
    let dot = dot(&plan);
    for line in [
        "digraph \"test\" {",
        "    n0 [label=\"casters\\nall on cpu\\ntriangles, triangle_flags\\nlight_samples\", fillcolor=\"#fde8c8\"];",
        "    n4 [label=\"list_build\\natomic_counters on wgpu\", fillcolor=\"#d5e8fb\"];",
        "    n1 -> n4 [label=\"position\", style=dashed];",
        "    n1 -> n2 [label=\"position\\nnormal\"];",
        "    n4 -> n6 [label=\"cell\"];",
    ] {
        assert!(dot.lines().any(|found| found == line), "{line}\n{dot}");
    }
    assert!(!dot.contains("idle"));
    let mermaid = mermaid(&plan);
    for line in [
        "flowchart TD",
        "    n4[\"list_build<br/>atomic_counters on wgpu\"]:::wgpu",
        "    n1 -.->|\"position\"| n4",
        "    n6([\"cell\"]):::output",
    ] {
        assert!(mermaid.lines().any(|found| found == line), "{line}\n{mermaid}");
    }
}

#[test]
fn svg_holds_every_box_and_label_once() {
    let plan = plan_of(&load_builtin("hard"), &Overrides::default()).unwrap();
    let svg = svg(&plan);
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    for node in &plan.nodes {
        assert_eq!(svg.matches(&format!("font-weight=\"bold\">{}</text>", node.id)).count(), 1, "{}", node.id);
    }
    // Background, a box a node, a box an output.
    assert_eq!(svg.matches("<rect ").count(), 1 + plan.nodes.len() + plan.outputs.len());
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn words_of_a_graph_cannot_break_a_drawing() {
    let text = r#"(version: 1, nodes: [(id: "casters")], outputs: {"<a href=\"x\">&\\": "casters.caster_state"})"#;
    let plan = plan_text(text).unwrap();
    assert!(svg(&plan).contains("&lt;a href=\"x\"&gt;&amp;\\"));
    assert!(dot(&plan).contains("\"<a href=\\\"x\\\">&\\\\\""));
    assert!(mermaid(&plan).contains("&lt;a href=&quot;x&quot;&gt;&amp;\\"));
    // Nothing to draw is no reason to fail.
    assert!(svg(&Plan::default()).contains("<svg "));
}

#[test]
fn a_described_plan_says_order_memory_transfers_and_reasons() {
    let text = crate::describe(&small());
    let expected = "\
test: 5 nodes, 16 values in 16 memories, 3 transfers

order
   0  cpu   casters        casters/all
   1  cpu   view_samples   view_samples/raster
   2  cpu   sample_filter  sample_filter/light_facing
   3  cpu   light_frame    light_frame/fitted  margin: 0.25
      wgpu  transfer of view_samples.position
      wgpu  transfer of sample_filter.sample_state
      wgpu  transfer of light_frame.light_frame
   4  wgpu  list_build     list_build/atomic_counters  size: 512
";
    assert!(text.starts_with(expected), "{text}");
    assert!(text.contains("\nleft out\n  idle: nothing reads its outputs\n"), "{text}");
    assert!(text.contains("cpu+wgpu      view_samples.position "), "{text}");
    assert_eq!(small().nodes[4].on, Backend::Wgpu);
}
