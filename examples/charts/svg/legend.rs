//! Methods by mark and name, in rows.

use super::canvas::{Anchor, Canvas, LETTER};
use crate::markup::Markup;
use crate::style::{METHOD_COLOURS, Styles};

const ROW: f64 = 20.0;

/// Units that a legend of this width takes.
pub fn height(methods: &[&str], width: f64) -> f64 {
    rows(methods, width).len() as f64 * ROW + 16.0
}

/// Draws it with its first row at `top`, up to the right edge.
pub(super) fn draw(canvas: &mut Canvas, methods: &[&str], styles: &Styles, [left, top]: [f64; 2]) {
    let rows = rows(methods, canvas.width - left);
    for (row, methods) in rows.iter().enumerate() {
        let y = top + row as f64 * ROW;
        let mut x = left;
        for method in methods {
            canvas.mark([x + 5.0, y - 4.0], styles, method, false, "");
            canvas.text(x + 16.0, y, Anchor::Start, method);
            x += entry(method);
        }
    }
    if let Some(key) = styles.backend_key() {
        canvas.muted(left, top + rows.len() as f64 * ROW, Anchor::Start, &key);
    }
}

fn entry(method: &str) -> f64 {
    method.chars().count() as f64 * LETTER + 36.0
}

fn rows<'a>(methods: &[&'a str], width: f64) -> Vec<Vec<&'a str>> {
    let mut rows: Vec<Vec<&str>> = vec![Vec::new()];
    let mut used = 0.0;
    for method in methods {
        if used > 0.0 && used + entry(method) > width {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += entry(method);
        rows.last_mut().into_iter().for_each(|row| row.push(method));
    }
    rows
}

/// A method's mark alone, to stand in HTML text.
pub fn mark(styles: &Styles, method: &str) -> String {
    let colour = styles.colour(method);
    let (class, path) = (format!("m{colour} f"), format!("M7 7{}", styles.shape(method)));
    let mut markup = Markup::default();
    markup.open("svg", &[("class", "mark"), ("viewBox", "0 0 14 14"), ("aria-hidden", "true")]);
    markup.leaf("path", &[("class", &class), ("d", &path), ("fill", METHOD_COLOURS[colour][0])]).close();
    markup.finish()
}
