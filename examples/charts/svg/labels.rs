//! Where to write a name beside a mark so that it hides neither marks nor names.

use super::canvas::{Anchor, LETTER};

/// Boxes that are taken.
#[derive(Default)]
pub struct Taken {
    boxes: Vec<[f64; 4]>,
}

/// Half of a mark, with a little air.
const MARK: f64 = 7.0;
/// Height of a line of text.
const LINE: f64 = 13.0;

impl Taken {
    /// A mark at this place.
    pub fn mark(&mut self, [x, y]: [f64; 2]) {
        self.boxes.push([x - MARK, y - MARK, x + MARK, y + MARK]);
    }

    /// The least crowded place for `text` around a mark, within `bounds` (left, top, right, bottom): where to anchor it.
    pub fn place(&mut self, [x, y]: [f64; 2], text: &str, bounds: [f64; 4]) -> ([f64; 2], Anchor) {
        let width = text.chars().count() as f64 * LETTER;
        let candidates = [
            ([x + 10.0, y - 7.0], Anchor::Start),
            ([x + 10.0, y + 15.0], Anchor::Start),
            ([x - 10.0, y - 7.0], Anchor::End),
            ([x - 10.0, y + 15.0], Anchor::End),
            ([x + 12.0, y + 4.0], Anchor::Start),
            ([x - 12.0, y + 4.0], Anchor::End),
            ([x, y - 11.0], Anchor::Middle),
            ([x, y + 21.0], Anchor::Middle),
            ([x + 16.0, y - 20.0], Anchor::Start),
            ([x + 16.0, y + 28.0], Anchor::Start),
            ([x - 16.0, y - 20.0], Anchor::End),
            ([x - 16.0, y + 28.0], Anchor::End),
        ];
        let boxed = |([x, y], anchor): ([f64; 2], Anchor)| {
            let left = match anchor {
                Anchor::Start => x,
                Anchor::Middle => x - width / 2.0,
                Anchor::End => x - width,
            };
            [left, y - LINE + 3.0, left + width, y + 3.0]
        };
        let cost = |candidate: ([f64; 2], Anchor)| {
            let area = boxed(candidate);
            let covered: f64 = self.boxes.iter().map(|other| overlap(area, *other)).sum();
            covered + 10.0 * (width * LINE - overlap(area, bounds))
        };
        let costs = candidates.map(|candidate| (cost(candidate), candidate));
        let best = costs.into_iter().reduce(|best, next| if next.0 < best.0 - 0.5 { next } else { best });
        let (_, best) = best.unwrap_or((0.0, candidates[0]));
        self.boxes.push(boxed(best));
        best
    }
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
        for (index, a) in taken.boxes.iter().enumerate() {
            for b in taken.boxes[index + 1..].iter().filter(|b| a[2] - a[0] > 20.0 || b[2] - b[0] > 20.0) {
                assert_eq!(overlap(*a, *b), 0.0, "{a:?} {b:?}");
            }
        }
    }

    #[test]
    fn names_stay_on_the_paper() {
        let mut taken = Taken::default();
        let ([x, _], anchor) = taken.place([390.0, 100.0], "shadow_map 2048", [0.0, 0.0, 400.0, 300.0]);
        assert!(anchor == Anchor::End && x < 390.0);
    }
}
