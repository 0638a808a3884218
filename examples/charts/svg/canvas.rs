//! Paper with a light background, and the few strokes that all charts are made of.

use super::axis::Axis;
use crate::markup::{Attribute, Markup};
use crate::style::{METHOD_COLOURS, Styles};

/// Ink, fainter ink, grid, axis, paper.
const INK: &str = "#1c1c1c";
const MUTED: &str = "#5c5c5c";
const GRID: &str = "#e4e4e4";
const AXIS: &str = "#8c8c8c";
pub const PAPER: &str = "#ffffff";

/// Width of a chart: narrow enough that a telephone shows it whole and readable.
pub const WIDTH: f64 = 640.0;

/// Mean width of a letter of the 12-unit text in a wide font (DejaVu Sans): fonts differ from reader to reader.
pub const LETTER: f64 = 7.2;

/// An SVG document in the making. Units are those of its view box.
pub struct Canvas {
    pub markup: Markup,
    pub width: f64,
}

/// A coordinate, to a tenth. Panics when it is not finite: figures are sifted before they are drawn.
pub fn px(value: f64) -> String {
    assert!(value.is_finite(), "{value} as a coordinate");
    let text = format!("{value:.1}");
    match text.strip_suffix(".0") {
        Some("-0") => "0".into(),
        Some(whole) => whole.into(),
        None => text,
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

impl Anchor {
    fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

impl Canvas {
    /// `label` is what a screen reader says.
    pub fn new(width: f64, height: f64, label: &str) -> Self {
        let mut markup = Markup::default();
        let view_box = format!("0 0 {} {}", px(width), px(height));
        markup.open(
            "svg",
            &[
                ("xmlns", "http://www.w3.org/2000/svg"),
                ("class", "chart ink"),
                ("viewBox", &view_box),
                ("width", &px(width)),
                ("height", &px(height)),
                ("role", "img"),
                ("aria-label", label),
                ("font-family", "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif"),
                ("font-size", "12"),
                ("fill", INK),
            ],
        );
        markup.leaf("rect", &[("class", "paper f"), ("width", "100%"), ("height", "100%"), ("fill", PAPER)]).line();
        Self { markup, width }
    }

    pub fn finish(mut self) -> String {
        self.markup.close();
        self.markup.finish()
    }

    pub fn text(&mut self, x: f64, y: f64, anchor: Anchor, text: &str) {
        self.styled_text(x, y, anchor, text, &[]);
    }

    pub fn bold(&mut self, x: f64, y: f64, anchor: Anchor, text: &str) {
        self.styled_text(x, y, anchor, text, &[("font-weight", "600")]);
    }

    pub fn muted(&mut self, x: f64, y: f64, anchor: Anchor, text: &str) {
        self.styled_text(x, y, anchor, text, &[("class", "muted f"), ("fill", MUTED)]);
    }

    pub fn styled_text(&mut self, x: f64, y: f64, anchor: Anchor, text: &str, style: &[Attribute]) {
        let (x, y) = (px(x), px(y));
        let mut attributes = vec![("x", x.as_str()), ("y", &y)];
        if anchor != Anchor::Start {
            attributes.push(("text-anchor", anchor.name()));
        }
        attributes.extend(style);
        self.markup.element("text", &attributes, text).line();
    }

    fn line(&mut self, from: [f64; 2], to: [f64; 2], style: &[Attribute]) {
        let [x1, y1, x2, y2] = [from[0], from[1], to[0], to[1]].map(px);
        let mut attributes = vec![("x1", x1.as_str()), ("y1", &y1), ("x2", &x2), ("y2", &y2)];
        attributes.extend(style);
        self.markup.leaf("line", &attributes).line();
    }

    pub fn grid_line(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.line(from, to, &[("class", "grid"), ("stroke", GRID)]);
    }

    pub fn axis_line(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.line(from, to, &[("class", "axis"), ("stroke", AXIS)]);
    }

    pub fn dashed_line(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.line(from, to, &[("class", "axis"), ("stroke", AXIS), ("stroke-dasharray", "5 4")]);
    }

    pub fn ink_line(&mut self, from: [f64; 2], to: [f64; 2], width: &str) {
        self.line(from, to, &[("class", "inked"), ("stroke", INK), ("stroke-width", width)]);
    }

    /// A line through `points` in ink.
    pub fn ink_path(&mut self, points: &[[f64; 2]], width: &str) {
        let path = [("class", "inked"), ("stroke", INK), ("stroke-width", width), ("stroke-linejoin", "round")];
        self.poly_line(points, &path);
    }

    /// A line through `points` in a method's colour.
    pub fn method_path(&mut self, points: &[[f64; 2]], styles: &Styles, method: &str, width: &str) {
        let colour = styles.colour(method);
        let class = format!("m{colour} s");
        let stroke = METHOD_COLOURS[colour][0];
        self.poly_line(points, &[("class", &class), ("stroke", stroke), ("stroke-width", width)]);
    }

    /// An interval in a method's colour.
    pub fn whisker(&mut self, [low, high]: [f64; 2], y: f64, styles: &Styles, method: &str) {
        let colour = styles.colour(method);
        let class = format!("m{colour} s");
        let path = format!("M{0} {1}v6m0-3H{2}m0-3v6", px(low), px(y - 3.0), px(high));
        let stroke = METHOD_COLOURS[colour][0];
        self.markup.leaf("path", &[("class", &class), ("d", &path), ("fill", "none"), ("stroke", stroke)]).line();
    }

    fn poly_line(&mut self, points: &[[f64; 2]], style: &[Attribute]) {
        let places: Vec<String> = points.iter().map(|[x, y]| format!("{},{}", px(*x), px(*y))).collect();
        let places = places.join(" ");
        let mut attributes = vec![("points", places.as_str()), ("fill", "none")];
        attributes.extend(style);
        self.markup.leaf("polyline", &attributes).line();
    }

    /// A method's mark with a tooltip; hollow for the second backend of a data set.
    pub fn mark(&mut self, [x, y]: [f64; 2], styles: &Styles, method: &str, hollow: bool, tooltip: &str) {
        let colour = styles.colour(method);
        let path = format!("M{} {}{}", px(x), px(y), styles.shape(method));
        let ink = METHOD_COLOURS[colour][0];
        let class = format!("m{colour} {}", if hollow { "s paper-filled" } else { "f" });
        let hollow_style = [("fill", PAPER), ("stroke", ink), ("stroke-width", "1.8")];
        let style: &[Attribute] = if hollow { &hollow_style } else { &[("fill", ink)] };
        let mut attributes = vec![("class", class.as_str()), ("d", &path)];
        attributes.extend(style);
        self.markup.open("path", &attributes);
        if !tooltip.is_empty() {
            self.markup.element("title", &[], tooltip);
        }
        self.markup.close().line();
    }

    /// Vertical lines and figures of a horizontal axis whose foot is at `bottom`.
    pub fn axis_below(&mut self, axis: &Axis, [top, bottom]: [f64; 2], most: usize) {
        for tick in axis.ticks(most) {
            let x = axis.at(tick.value);
            self.grid_line([x, top], [x, bottom]);
            if let Some(label) = tick.label {
                self.text(x, bottom + 16.0, Anchor::Middle, &label);
            }
        }
    }

    /// Horizontal lines and figures of a vertical axis.
    pub fn axis_beside(&mut self, axis: &Axis, [left, right]: [f64; 2], most: usize) {
        for tick in axis.ticks(most) {
            let y = axis.at(tick.value);
            self.grid_line([left, y], [right, y]);
            if let Some(label) = tick.label {
                self.text(left - 7.0, y + 4.0, Anchor::End, &label);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_short() {
        assert_eq!([1.0, -0.04, 2.25, 1e3].map(px), ["1", "0", "2.2", "1000"]);
    }

    #[test]
    #[should_panic(expected = "as a coordinate")]
    fn a_coordinate_that_is_not_a_number_is_a_fault() {
        px(f64::NAN);
    }
}
