//! A table in colours: methods by cases.

use super::bars::shortened;
use super::canvas::{Anchor, Canvas, LETTER, px};

/// What a cell says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cell {
    /// What it is, which gives the colour.
    pub standing: Standing,
    /// A few letters.
    pub text: String,
    /// Whether a corner is marked: not what was expected.
    pub marked: bool,
    /// The whole story.
    pub tooltip: String,
}

/// Colour of a cell, as attribute for light pages and class for dark ones; what is graver is greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Standing {
    /// Nothing is known.
    #[default]
    Unknown,
    /// Right.
    Holds,
    /// Wrong.
    Fails,
}

impl Standing {
    /// Class in pages.
    pub fn class(self) -> &'static str {
        match self {
            Self::Unknown => "unknown",
            Self::Holds => "holds",
            Self::Fails => "fails",
        }
    }

    fn fill(self) -> &'static str {
        match self {
            Self::Unknown => "#efefef",
            Self::Holds => "#cfe5f5",
            Self::Fails => "#f8d3b8",
        }
    }
}

const ROW: f64 = 22.0;

/// The table: `cell(row, column)` for each row and column name.
pub fn heat(title: &str, rows: &[String], columns: &[String], cell: impl Fn(usize, usize) -> Cell) -> String {
    let longest = |names: &[String]| names.iter().map(|name| name.chars().count()).max().unwrap_or(0) as f64;
    let left = (longest(rows) * LETTER + 26.0).min(320.0);
    let tall = (longest(columns) * LETTER * 0.75 + 14.0).min(180.0);
    let cells: Vec<Vec<Cell>> =
        (0..rows.len()).map(|row| (0..columns.len()).map(|column| cell(row, column)).collect()).collect();
    let letters = cells.iter().flatten().map(|cell| cell.text.chars().count()).max().unwrap_or(0) as f64;
    let column_width = (letters * LETTER + 12.0).max(44.0);
    let top = 40.0 + tall;
    let width = (left + columns.len() as f64 * column_width + tall * 0.8).max(360.0);
    let mut canvas = Canvas::new(width, top + rows.len() as f64 * ROW + 34.0, title);
    canvas.bold(14.0, 22.0, Anchor::Start, title);
    for (column, name) in columns.iter().enumerate() {
        let [x, y] = [left + (column as f64 + 0.5) * column_width, top - 6.0];
        let turn = format!("rotate(-45 {} {})", px(x), px(y));
        canvas.styled_text(x, y, Anchor::Start, &shortened(name, 34), &[("transform", &turn)]);
    }
    for (row, name) in rows.iter().enumerate() {
        let y = top + row as f64 * ROW;
        canvas.text(left - 8.0, y + 15.0, Anchor::End, &shortened(name, (left / LETTER) as usize));
        for (column, cell) in cells[row].iter().enumerate() {
            let x = left + column as f64 * column_width;
            draw(&mut canvas, [x, y, column_width], cell);
        }
    }
    let foot = top + rows.len() as f64 * ROW + 20.0;
    canvas.muted(14.0, foot, Anchor::Start, "blue holds, orange fails, grey not run; black corner: not as expected");
    canvas.finish()
}

fn draw(canvas: &mut Canvas, [x, y, width]: [f64; 3], cell: &Cell) {
    let class = format!("{} cell", cell.standing.class());
    canvas.markup.open("g", &[]);
    canvas.markup.element("title", &[], &cell.tooltip);
    let [left, top, wide, high] = [x + 1.0, y + 1.0, width - 2.0, ROW - 2.0].map(px);
    let fill = cell.standing.fill();
    canvas.markup.leaf(
        "rect",
        &[("class", &class), ("x", &left), ("y", &top), ("width", &wide), ("height", &high), ("fill", fill)],
    );
    canvas.text(x + width / 2.0, y + 15.0, Anchor::Middle, &cell.text);
    if cell.marked {
        let corner = format!("M{} {}h-9l9 9z", px(x + width - 1.0), px(y + 1.0));
        canvas.markup.leaf("path", &[("class", "ink f"), ("d", &corner)]);
    }
    canvas.markup.close().line();
}
