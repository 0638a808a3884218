//! What the layout draws, as SVG text: arrows below boxes below words, on white.

use layout::core::format::{ClipHandle, RenderBackend};
use layout::core::geometry::Point;
use layout::core::style::StyleAttr;
use std::fmt::Write;

/// Free space around everything, pixels.
const MARGIN: f64 = 20.0;

/// Sizes of words in boxes and on arrows, pixels.
pub(super) const BOX_FONT: usize = 13;
pub(super) const LABEL_FONT: usize = 10;

/// A page that grows with what is drawn on it.
#[derive(Default)]
pub(super) struct Page {
    arrows: String,
    boxes: String,
    words: String,
    /// Left, top, right, bottom of all that is drawn.
    bounds: Option<[f64; 4]>,
}

impl Page {
    fn cover(&mut self, low: Point, high: Point) {
        let [left, top, right, bottom] = self.bounds.unwrap_or([low.x, low.y, high.x, high.y]);
        self.bounds = Some([left.min(low.x), top.min(low.y), right.max(high.x), bottom.max(high.y)]);
    }

    pub fn finish(self) -> String {
        let [left, top, right, bottom] = self.bounds.unwrap_or_default();
        let (left, top) = (left - MARGIN, top - MARGIN);
        let (width, height) = (right - left + MARGIN, bottom - top + MARGIN);
        let Self { arrows, boxes, words, .. } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"{left:.1} {top:.1} {width:.1} {height:.1}\">\n\
             <style>text {{ font-family: sans-serif; text-anchor: middle; fill: #222; paint-order: stroke; \
             stroke-linejoin: round; }}</style>\n\
             <defs><marker id=\"head\" markerWidth=\"9\" markerHeight=\"7\" refX=\"9\" refY=\"3.5\" orient=\"auto\">\
             <path d=\"M0 0 L9 3.5 L0 7 z\" fill=\"#777777\"/></marker></defs>\n\
             <rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             {arrows}{boxes}{words}</svg>\n"
        )
    }
}

/// A style's colour as SVG takes it.
fn fill(look: &StyleAttr) -> String {
    look.fill_color.as_ref().map_or("none".into(), |colour| colour.to_web_color())
}

impl RenderBackend for Page {
    fn draw_rect(&mut self, xy: Point, size: Point, look: &StyleAttr, _: Option<String>, _: Option<ClipHandle>) {
        self.cover(xy, xy.add(size));
        let (x, y, width, height) = (xy.x, xy.y, size.x, size.y);
        let (fill, line, radius) = (fill(look), look.line_color.to_web_color(), look.rounded);
        let _ = writeln!(
            self.boxes,
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" rx=\"{radius}\" \
             fill=\"{fill}\" stroke=\"{line}\"/>"
        );
    }

    fn draw_line(&mut self, start: Point, stop: Point, look: &StyleAttr, _: Option<String>) {
        let line = look.line_color.to_web_color();
        let (a, b, c, d) = (start.x, start.y, stop.x, stop.y);
        let _ = writeln!(self.boxes, "<path d=\"M {a:.1} {b:.1} L {c:.1} {d:.1}\" stroke=\"{line}\"/>");
    }

    fn draw_circle(&mut self, xy: Point, size: Point, look: &StyleAttr, _: Option<String>) {
        let half = size.scale(0.5);
        self.draw_rect(xy.sub(half), size, look, None, None);
    }

    fn draw_text(&mut self, xy: Point, text: &str, look: &StyleAttr) {
        // The layout styles some labels on its own.
        let is_label = look.font_size != BOX_FONT;
        let font = if is_label { LABEL_FONT } else { BOX_FONT } as f64;
        let count = text.lines().count() as f64;
        let widest = text.lines().map(|line| line.chars().count()).max().unwrap_or(0) as f64;
        let half = Point::new(widest * font * 0.3, count * font * 0.6);
        self.cover(xy.sub(half), xy.add(half));
        // A label on an arrow has no box to stand out from.
        let halo = if is_label { " stroke=\"#ffffff\" stroke-width=\"4\"" } else { "" };
        for (index, line) in text.lines().enumerate() {
            let y = xy.y + (index as f64 - (count - 1.0) / 2.0) * font * 1.25 + font * 0.35;
            let weight = if index == 0 && !is_label { " font-weight=\"bold\"" } else { "" };
            let (x, line) = (xy.x, escaped(line));
            let _ = writeln!(
                self.words,
                "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{font}\"{weight}{halo}>{line}</text>"
            );
        }
    }

    fn draw_arrow(
        &mut self,
        path: &[(Point, Point)],
        dashed: bool,
        _: (bool, bool),
        look: &StyleAttr,
        _: Option<String>,
        _: &str,
    ) {
        let [(start, leave), (enter, stop), rest @ ..] = path else { return };
        let mut line = format!(
            "M {:.1} {:.1} C {:.1} {:.1}, {:.1} {:.1}, {:.1} {:.1}",
            start.x, start.y, leave.x, leave.y, enter.x, enter.y, stop.x, stop.y
        );
        for (enter, stop) in rest {
            let _ = write!(line, " S {:.1} {:.1}, {:.1} {:.1}", enter.x, enter.y, stop.x, stop.y);
        }
        for (a, b) in path {
            self.cover(*a, *a);
            self.cover(*b, *b);
        }
        let dash = if dashed { " stroke-dasharray=\"5,4\"" } else { "" };
        let colour = look.line_color.to_web_color();
        let _ = writeln!(
            self.arrows,
            "<path d=\"{line}\" fill=\"none\" stroke=\"{colour}\"{dash} marker-end=\"url(#head)\"/>"
        );
    }

    fn create_clip(&mut self, _: Point, _: Point, _: usize) -> ClipHandle {
        0
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
