//! A picture that needs nothing but a browser.

use super::page::{BOX_FONT, LABEL_FONT, Page};
use super::{Drawing, Kind};
use layout::core::base::Orientation::TopToBottom;
use layout::core::color::Color;
use layout::core::geometry::Point;
use layout::core::style::{LineStyleKind, StyleAttr};
use layout::std_shapes::shapes::{Arrow, Element, LineEndKind, ShapeKind};
use layout::topo::layout::VisualGraph;
use shadowgraph_core::plan::Plan;

/// Above this the layout's search for fewer crossings takes too long.
const MAX_OPTIMISED: usize = 100;
const INK: u32 = 0x33_33_33_ff;
const LINE: u32 = 0x77_77_77_ff;

/// The plan as SVG.
pub fn svg(plan: &Plan) -> String {
    let drawing = Drawing::of(plan);
    let mut page = Page::default();
    // The layout refuses an empty graph.
    if drawing.shapes.is_empty() {
        return page.finish();
    }
    let mut graph = VisualGraph::new(TopToBottom);
    // The layout checks itself after every edge in time exponential in the graph; edges come in an order that keeps it
    // free of circles: every arrow leaves a box before it enters a later one.
    graph.dag.set_validate(false);
    let handles: Vec<_> = drawing
        .shapes
        .iter()
        .map(|shape| {
            let rounded = if shape.kind == Kind::Output { 20 } else { 6 };
            let look = StyleAttr::new(Color::new(INK), 1, Some(colour(shape.kind)), rounded, BOX_FONT);
            let box_ = ShapeKind::new_box(&shape.lines.join("\n"));
            graph.add_node(Element::create(box_, look, TopToBottom, size(&shape.lines)))
        })
        .collect();
    let look = StyleAttr::new(Color::new(LINE), 1, None, 0, LABEL_FONT);
    for arrow in &drawing.arrows {
        let style = if arrow.is_transfer { LineStyleKind::Dashed } else { LineStyleKind::Normal };
        let label = arrow.ports.join("\n");
        let line = Arrow::new(LineEndKind::None, LineEndKind::Arrow, style, &label, &look, &None, &None);
        graph.add_edge(line, handles[arrow.from], handles[arrow.to]);
    }
    graph.do_it(false, drawing.shapes.len() > MAX_OPTIMISED, false, &mut page);
    page.finish()
}

/// Room for the lines of a box, pixels.
fn size(lines: &[String]) -> Point {
    let widest = lines.iter().map(|line| line.chars().count()).max().unwrap_or(0);
    Point::new(widest as f64 * 7.4 + 20.0, lines.len() as f64 * 16.5 + 14.0)
}

/// `#rrggbb`, opaque, as the layout takes it.
fn colour(kind: Kind) -> Color {
    let rgb = u32::from_str_radix(&kind.colour()[1..], 16).unwrap_or(0xff_ff_ff);
    Color::new(rgb << 8 | 0xff)
}
