//! Where to write a name beside a mark so that it hides neither marks nor names.

use super::canvas::{Anchor, LETTER};

/// Boxes that are taken.
#[derive(Default)]
pub struct Taken {
    /// Area, and how much it costs to cover a unit of it.
    boxes: Vec<([f64; 4], f64)>,
    marks: Vec<[f64; 2]>,
}

/// Half of a mark, with a little air.
const MARK: f64 = 7.0;
/// What it costs to cover a unit of area of a line, a mark, a name.
const COVER: [f64; 3] = [1.0, 3.0, 6.0];
/// Height of a line of text.
const LINE: f64 = 13.0;

impl Taken {
    /// A mark at this place.
    pub fn mark(&mut self, [x, y]: [f64; 2]) {
        self.boxes.push(([x - MARK, y - MARK, x + MARK, y + MARK], COVER[1]));
        self.marks.push([x, y]);
    }

    /// A line through these places: names may cross it, but rather do not.
    pub fn line(&mut self, places: &[[f64; 2]]) {
        for pair in places.windows(2) {
            let [[x, y], [to_x, to_y]] = [pair[0], pair[1]];
            let steps = ((to_x - x).abs().max((to_y - y).abs()) / 4.0).ceil().max(1.0);
            for step in 0..=steps as usize {
                let share = step as f64 / steps;
                let [x, y] = [x + (to_x - x) * share, y + (to_y - y) * share];
                self.boxes.push(([x - 1.5, y - 1.5, x + 1.5, y + 1.5], COVER[0]));
            }
        }
    }

    /// The least crowded place for `text` around a mark, within `bounds` (left, top, right, bottom): where to anchor it, and
    /// whether it is so far away that a line should lead there.
    pub fn place(&mut self, [x, y]: [f64; 2], text: &str, bounds: [f64; 4]) -> ([f64; 2], Anchor, bool) {
        let width = text.chars().count() as f64 * LETTER;
        let around = |away: f64| {
            [
                ([x + away, y - 0.7 * away], Anchor::Start, away),
                ([x + away, y + 0.7 * away + 8.0], Anchor::Start, away),
                ([x - away, y - 0.7 * away], Anchor::End, away),
                ([x - away, y + 0.7 * away + 8.0], Anchor::End, away),
                ([x + away + 2.0, y + 4.0], Anchor::Start, away),
                ([x - away - 2.0, y + 4.0], Anchor::End, away),
                ([x, y - away - 1.0], Anchor::Middle, away),
                ([x, y + away + 11.0], Anchor::Middle, away),
            ]
        };
        let candidates = [10.0, 18.0, 30.0, 46.0, 66.0, 90.0].into_iter().flat_map(around);
        let boxed = |[x, y]: [f64; 2], anchor| {
            let left = match anchor {
                Anchor::Start => x,
                Anchor::Middle => x - width / 2.0,
                Anchor::End => x - width,
            };
            [left, y - LINE + 3.0, left + width, y + 3.0]
        };
        // Units of area: far away costs as much as hiding a few letters of a line.
        let cost = |at, anchor, away: f64| {
            let area = boxed(at, anchor);
            let covered: f64 = self.boxes.iter().map(|(other, cost)| cost * overlap(area, *other)).sum();
            // A name that lies as near to another mark seems to be that one's.
            let own = distance(area, [x, y]);
            let others = self.marks.iter().filter(|mark| **mark != [x, y]);
            let mistaken = others.filter(|mark| distance(area, **mark) < own + 5.0).count() as f64;
            covered + 10.0 * (width * LINE - overlap(area, bounds)) + 60.0 * mistaken + 1.5 * away
        };
        let mut best = ([x, y], Anchor::Start, 0.0);
        let mut least = f64::MAX;
        for (at, anchor, away) in candidates {
            let cost = cost(at, anchor, away);
            if cost < least {
                (best, least) = ((at, anchor, away), cost);
            }
        }
        let (at, anchor, away) = best;
        self.boxes.push((boxed(at, anchor), COVER[2]));
        (at, anchor, away > 16.0)
    }
}

fn distance([left, top, right, bottom]: [f64; 4], [x, y]: [f64; 2]) -> f64 {
    let across = (left - x).max(x - right).max(0.0);
    let down = (top - y).max(y - bottom).max(0.0);
    across.hypot(down)
}

fn overlap(a: [f64; 4], b: [f64; 4]) -> f64 {
    let width = (a[2].min(b[2]) - a[0].max(b[0])).max(0.0);
    let height = (a[3].min(b[3]) - a[1].max(b[1])).max(0.0);
    width * height
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_neighbours_do_not_cover_each_other() {
        let mut taken = Taken::default();
        let marks = [[100.0, 100.0], [118.0, 104.0], [100.0, 120.0]];
        marks.iter().for_each(|mark| taken.mark(*mark));
        for mark in marks {
            taken.place(mark, "shadow_map 2048", [0.0, 0.0, 400.0, 300.0]);
        }
        let (marks, names) = taken.boxes.split_at(marks.len());
        for (index, (name, _)) in names.iter().enumerate() {
            for (other, _) in marks.iter().chain(&names[index + 1..]) {
                assert_eq!(overlap(*name, *other), 0.0, "{name:?} {other:?}");
            }
        }
    }

    #[test]
    fn names_stay_on_the_paper() {
        let mut taken = Taken::default();
        let ([x, _], anchor, _) = taken.place([390.0, 100.0], "shadow_map 2048", [0.0, 0.0, 400.0, 300.0]);
        assert!(anchor == Anchor::End && x < 390.0);
    }
}
