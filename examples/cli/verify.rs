//! A graph against the truth on the very same view-samples: wrong bits, of which kind, where, and how many lie so close to a
//! decisive plane that the rounding of their stored position decides.

use crate::outcome::Outcome;
use serde::Serialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::metric::{MaskDifference, mask_difference};
use shadowgraph_core::plan::{Plan, Producer};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{FACING_AWAY, KEPT, NO_TRIANGLE};

/// The view-samples of a run and its masks.
pub struct Answer<'a> {
    /// Positions.
    pub position: &'a Array,
    /// Normals.
    pub normal: &'a Array,
    /// Triangles.
    pub triangle: &'a Array,
    /// Pixels.
    pub pixel: &'a Array,
    /// States.
    pub state: &'a Array,
    /// Masks.
    pub mask: &'a Array,
}

impl<'a> Answer<'a> {
    /// Finds them among the kept values of a run.
    ///
    /// # Errors
    /// The graph has no such value.
    pub fn of(plan: &Plan, outcome: &'a Outcome) -> Result<Self, Problem> {
        let find = |quantity: &str| {
            let made = |slot: &&(usize, &shadowgraph_core::plan::Slot)| {
                slot.1.port.quantity == quantity && matches!(slot.1.producer, Producer::Node(_))
            };
            let slots: Vec<_> = plan.slots.iter().enumerate().collect();
            let slot = slots.iter().find(made).and_then(|(id, _)| outcome.values.try_get(*id));
            slot.ok_or_else(|| {
                Problem::new(Kind::Missing, format!("the graph makes no {quantity}, so it cannot be verified"))
                    .expected("nodes view_samples, sample_filter, and visibility or shadow_lookup")
            })
        };
        Ok(Self {
            position: find("position")?,
            normal: find("normal")?,
            triangle: find("triangle_of_sample")?,
            pixel: find("pixel")?,
            state: find("sample_state")?,
            mask: find("mask")?,
        })
    }

    /// As graph inputs of the passes that import view-samples.
    pub fn imports(&self) -> Vec<(String, Array)> {
        use shadowgraph_core::input;
        [
            (input::IMPORTED_POSITION, self.position),
            (input::IMPORTED_NORMAL, self.normal),
            (input::IMPORTED_TRIANGLE, self.triangle),
            (input::IMPORTED_PIXEL, self.pixel),
        ]
        .into_iter()
        .map(|(port, array)| (port.name.to_string(), array.clone()))
        .collect()
    }
}

/// One wrong view-sample.
#[derive(Clone, Debug, Serialize)]
pub struct WrongSample {
    /// Row of the view-sample arrays.
    pub row: u32,
    /// Pixel column and row.
    pub pixel: [usize; 2],
    /// Triangle it lies on.
    pub triangle: u32,
    /// World position.
    pub position: [f32; 3],
    /// `false shadow`, `false lit` or `both`.
    pub kind: &'static str,
    /// Whether it lies in the contact band.
    pub contact: bool,
}

/// What `verify` reports.
#[derive(Clone, Debug, Serialize)]
pub struct Verdict {
    /// All wrong bits.
    pub all: MaskDifference,
    /// View-samples: neither background nor left out of the comparison.
    pub view_samples_count: u64,
    /// Wrong view-samples within the contact band.
    pub contact_count: u64,
    /// Wrong bits outside the contact band.
    pub wrong_outside_count: u64,
    /// Wrong bits outside the contact band over bits compared.
    pub wrong_outside_share: f64,
    /// Rows where truth faces away but the graph tests everything (`sample_filter` pass `all`): not compared.
    pub facing_away_not_compared_count: u64,
    /// The wrong view-samples, at most a hundred.
    pub wrong: Vec<WrongSample>,
    /// All wrong rows outside the contact band.
    #[serde(skip)]
    pub wrong_rows: Vec<u32>,
}

/// Compares masks in view order. `in_contact` says which of some rows lie in the contact band.
pub fn judge(
    test: &Answer,
    truth_mask: &Array,
    truth_state: &Array,
    light_samples: usize,
    filters_facing: bool,
    width: usize,
    in_contact: impl Fn(&[u32]) -> Vec<bool>,
) -> Verdict {
    let triangles = test.triangle.as_u32();
    let (states, truth_states) = (test.state.as_u32(), truth_state.as_u32());
    let tests_all = |row: usize| !filters_facing && truth_states[row] == FACING_AWAY && states[row] == KEPT;
    let compared = |row: usize| triangles[row] != NO_TRIANGLE && !tests_all(row);
    let row_words = test.mask.dim(1);
    let (mask, truth) = (test.mask.as_u32(), truth_mask.as_u32());
    let all = mask_difference(mask, truth, row_words, light_samples, compared);
    let contact = in_contact(&all.wrong_rows);
    let outside = |row: usize| !all.wrong_rows.binary_search(&(row as u32)).is_ok_and(|index| contact[index]);
    let wrong_outside = mask_difference(mask, truth, row_words, light_samples, |row| compared(row) && outside(row));
    let kind = |row: usize| {
        let one = mask_difference(mask, truth, row_words, light_samples, |other| other == row);
        match (one.false_shadow_count > 0, one.false_lit_count > 0) {
            (true, true) => "both",
            (true, false) => "false shadow",
            _ => "false lit",
        }
    };
    let wrong = all.wrong_rows.iter().zip(&contact).take(100).map(|(row, contact)| {
        let at = *row as usize;
        let pixel = test.pixel.as_u32()[at] as usize;
        WrongSample {
            row: *row,
            pixel: [pixel % width.max(1), pixel / width.max(1)],
            triangle: triangles[at],
            position: test.position.as_vec3()[at],
            kind: kind(at),
            contact: *contact,
        }
    });
    Verdict {
        view_samples_count: all.rows_count,
        contact_count: contact.iter().filter(|contact| **contact).count() as u64,
        wrong_outside_count: wrong_outside.wrong_count(),
        wrong_outside_share: if all.bits_count == 0 {
            0.0
        } else {
            wrong_outside.wrong_count() as f64 / all.bits_count as f64
        },
        facing_away_not_compared_count: (0..triangles.len()).filter(|row| tests_all(*row)).count() as u64,
        wrong: wrong.collect(),
        wrong_rows: wrong_outside.wrong_rows,
        all,
    }
}
