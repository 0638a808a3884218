//! View-samples in parts: everything after the light frame runs over some rows of the view-samples at a time. Parts are
//! independent: each makes its own lists and caster table, and the answers are those of a single run, row by row. So masks of many
//! light samples fit the bindings of a device and the memory of a machine; and so pixels may have light samples of their own
//! ([`crate::jitter`]).

use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::input::{LIGHT_SAMPLES, LIGHT_WEIGHTS};
use shadowgraph_core::plan::{Plan, Producer, Shapes, SlotId};
use shadowgraph_core::port::Port;
use std::ops::Range;

/// Stages that look at all view-samples, and all light samples, at once; they and whatever depends on neither run once.
const WHOLE: &[&str] = &["view_samples", "sample_filter", "light_frame", "casters"];

/// Which nodes of a plan run once, and which over parts of the view-samples.
pub struct Ranges {
    /// For each node of the plan.
    is_ranged: Vec<bool>,
}

impl Ranges {
    /// Of `plan`: ranged is each node outside [`WHOLE`] that reads rows of view-samples, and each that reads what a ranged one
    /// makes; with several sample sets also each that reads light samples.
    pub fn of(plan: &Plan, has_sets: bool) -> Self {
        let mut is_ranged = vec![false; plan.nodes.len()];
        for (index, node) in plan.nodes.iter().enumerate() {
            let mut reads = node.inputs.iter().map(|(_, slot)| &plan.slots[*slot]);
            is_ranged[index] = !WHOLE.contains(&node.pass.stage.name)
                && reads.any(|slot| match slot.producer {
                    Producer::Node(producer) => is_ranged[producer] || is_rows(&slot.port),
                    Producer::Input => is_rows(&slot.port) || has_sets && is_of_set(&slot.name),
                });
        }
        Self { is_ranged }
    }

    /// Stretches of neighbouring nodes on one backend: those that run once, or those that run over ranges.
    pub fn stretches(&self, plan: &Plan, ranged: bool) -> Vec<Range<usize>> {
        let mut stretches: Vec<Range<usize>> = Vec::new();
        for (index, node) in plan.nodes.iter().enumerate().filter(|(index, _)| self.is_ranged[*index] == ranged) {
            match stretches.last_mut() {
                Some(range) if range.end == index && plan.nodes[range.start].on == node.on => range.end = index + 1,
                _ => stretches.push(index..index + 1),
            }
        }
        stretches
    }

    /// Slots that ranged nodes read and do not make.
    pub fn taken(&self, plan: &Plan) -> Vec<SlotId> {
        let ranged = plan.nodes.iter().zip(&self.is_ranged).filter(|(_, is_ranged)| **is_ranged);
        let mut taken: Vec<SlotId> = ranged
            .flat_map(|(node, _)| node.inputs.iter().map(|(_, slot)| *slot))
            .filter(|slot| !self.makes(plan, *slot))
            .collect();
        taken.sort_unstable();
        taken.dedup();
        taken
    }

    /// Slots that ranged nodes make and that outlive the run.
    pub fn kept(&self, plan: &Plan) -> Vec<SlotId> {
        (0..plan.slots.len()).filter(|slot| plan.slots[*slot].keep && self.makes(plan, *slot)).collect()
    }

    fn makes(&self, plan: &Plan, slot: SlotId) -> bool {
        matches!(plan.slots[slot].producer, Producer::Node(node) if self.is_ranged[node])
    }

    /// How many ranges it takes for every row-wise value that a ranged wgpu node makes, and its scratch, to stay within `most_bytes`.
    pub fn needed(&self, plan: &Plan, shapes: &Shapes, most_bytes: u64) -> usize {
        let made = (0..plan.slots.len()).filter(|slot| plan.slots[*slot].on[1] && self.makes(plan, *slot));
        let rows = made.filter(|slot| is_rows(&plan.slots[*slot].port));
        let bytes = |slot: SlotId| {
            let shape = &shapes.0[slot];
            let value = 4 * shape.iter().product::<usize>() as u64;
            (value + value / 2).max(SCRATCH_BYTES * shape.first().copied().unwrap_or(0) as u64)
        };
        rows.map(|slot| bytes(slot).div_ceil(most_bytes.max(1)) as usize).max().unwrap_or(1).max(1)
    }
}

/// Scratch that recipes keep for a row, at least; queues of masks take up to half of a mask more than the mask.
const SCRATCH_BYTES: u64 = 24;

/// `rows` rows in `count` nearly equal ranges; at least one, possibly empty.
pub fn split(rows: usize, count: usize) -> Vec<Range<usize>> {
    let count = count.clamp(1, rows.max(1));
    (0..count).map(|range| rows * range / count..rows * (range + 1) / count).collect()
}

/// Whether the graph input is one of those that differ from sample set to sample set.
pub fn is_of_set(name: &str) -> bool {
    name == LIGHT_SAMPLES.name || name == LIGHT_WEIGHTS.name
}

/// Rows by the sample set of their pixel, ascending within each; pixels are row-major in a picture of this width.
pub fn by_set(pixels: &[u32], width: usize, set_of: impl Fn(usize, usize) -> usize, sets: usize) -> Vec<Vec<usize>> {
    let mut rows = vec![Vec::new(); sets];
    for (row, pixel) in pixels.iter().enumerate() {
        let pixel = *pixel as usize;
        rows[set_of(pixel % width.max(1), pixel / width.max(1))].push(row);
    }
    rows
}

/// Whether the port has a row for every view-sample.
pub fn is_rows(port: &Port) -> bool {
    port.shape.split(' ').next() == Some("P")
}

/// Some rows of an array, in the order given; one without rows stays so.
pub fn gather(array: &Array, rows: &[usize]) -> Array {
    if array.dim(0) == 0 {
        return array.clone();
    }
    let columns: usize = array.shape()[1..].iter().product();
    let mut shape = array.shape().to_vec();
    shape[0] = rows.len();
    let words = rows.iter().flat_map(|row| &array.words()[row * columns..(row + 1) * columns]).copied().collect();
    Array::from_words(array.element(), shape, words)
}

/// The value of a whole run from those of its parts and the rows that each had: rows where they came from; a picture's covered
/// pixels over one another. None for tables by cell, of which every part has its own.
pub fn join(port: &Port, parts: Vec<(Array, &[usize])>) -> Option<Array> {
    if is_rows(port) {
        // A value that a pass gives no rows has none in any part.
        if parts.iter().all(|(part, _)| part.dim(0) == 0) {
            return parts.into_iter().next().map(|(part, _)| part);
        }
        let mut shape = parts.first()?.0.shape().to_vec();
        let columns: usize = shape[1..].iter().product();
        shape[0] = parts.iter().map(|(_, rows)| rows.len()).sum();
        let mut words = vec![0; shape[0] * columns];
        for (part, rows) in parts {
            for (words_of_row, row) in part.words().chunks_exact(columns.max(1)).zip(rows) {
                words[row * columns..(row + 1) * columns].copy_from_slice(words_of_row);
            }
        }
        return Some(Array::from_words(port.element, shape, words));
    }
    if port.shape != "H W 4" || port.element != Element::F32 {
        return None;
    }
    let mut parts = parts.into_iter().map(|(part, _)| part);
    let mut picture = parts.next()?;
    for part in parts {
        for (pixel, other) in picture.words_mut().chunks_exact_mut(4).zip(part.words().chunks_exact(4)) {
            if f32::from_bits(other[3]) > 0.0 {
                pixel.copy_from_slice(other);
            }
        }
    }
    Some(picture)
}

#[cfg(test)]
mod tests {
    use super::*;
    use shadowgraph_core::port::Direction::Out;

    #[test]
    fn ranges_cover_all_rows_once() {
        for (rows, count) in [(0, 3), (1, 4), (7, 3), (100, 1), (100, 7)] {
            let ranges = split(rows, count);
            assert_eq!(ranges.iter().map(Range::len).sum::<usize>(), rows, "{rows} {count}");
            assert!(ranges.windows(2).all(|pair| pair[0].end == pair[1].start) && ranges[0].start == 0);
        }
    }

    #[test]
    fn rows_go_to_the_set_of_their_pixel() {
        let rows = by_set(&[0, 1, 2, 3, 4, 5], 3, |column, row| (column + row) % 2, 2);
        assert_eq!(rows, [vec![0, 2, 4], vec![1, 3, 5]]);
    }

    #[test]
    fn rows_are_cut_and_joined_again() {
        let port = Port::new(Out, "mask", Element::U32, "mask", "P M");
        let array = Array::u32([5, 2], (0..10).collect());
        let rows: [&[usize]; 3] = [&[3], &[0, 4], &[1, 2]];
        let parts: Vec<_> = rows.into_iter().map(|rows| (gather(&array, rows), rows)).collect();
        assert_eq!(parts[1].0.words(), [0, 1, 8, 9]);
        assert_eq!(join(&port, parts), Some(array));
    }

    #[test]
    fn a_value_without_rows_has_none_whole() {
        let port = Port::new(Out, "visible_color", Element::F32, "light_share", "P 3");
        let none = Array::f32([0, 3], Vec::new());
        assert_eq!(gather(&none, &[1, 2]), none);
        let parts: Vec<(Array, &[usize])> = vec![(none.clone(), &[0, 2]), (none.clone(), &[1])];
        assert_eq!(join(&port, parts), Some(none));
    }

    #[test]
    fn pictures_are_joined_by_coverage_and_tables_are_not() {
        let port = Port::new(Out, "image", Element::F32, "radiance", "H W 4");
        let picture = |pixels: [[f32; 4]; 2]| Array::f32([1, 2, 4], pixels.concat());
        let (left, right) = ([0.1, 0.2, 0.3, 1.0], [0.4, 0.5, 0.6, 1.0]);
        let parts: [[[f32; 4]; 2]; 2] = [[left, [9.0, 9.0, 9.0, 0.0]], [[8.0, 8.0, 8.0, 0.0], right]];
        let parts = parts.map(|part| (picture(part), &[] as &[usize])).to_vec();
        assert_eq!(join(&port, parts), Some(picture([left, right])));
        let table = Port::new(Out, "list_length", Element::U32, "length", "F S S");
        assert_eq!(join(&table, vec![(Array::u32([1, 1, 1], vec![3]), &[] as &[usize])]), None);
    }
}
