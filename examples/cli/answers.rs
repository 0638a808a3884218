//! What a run answered for each view-sample, and how far that is from the truth.

use crate::engine::{Given, Machine};
use crate::job::Job;
use crate::outcome::Outcome;
use shadowgraph_charts::model::Errors;
use shadowgraph_core::array::Array;
use shadowgraph_core::metric::{Leaks, Penumbra, grey_errors, mask_difference, penumbra_widths};
use shadowgraph_core::plan::{Plan, Producer, Slot};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::shared::{FACING_AWAY, NO_TRIANGLE};
use shadowgraph_cpu::Progress;
use shadowgraph_measure::flip;

/// Values of a finished run, by what they are.
#[derive(Clone, Debug)]
pub struct Answers {
    /// `position [P 3]`, world.
    pub position: Array,
    /// `normal [P 3]`, world.
    pub normal: Array,
    /// `triangle [P]`.
    pub triangle: Array,
    /// `pixel [P]`.
    pub pixel: Array,
    /// `sample_state [P]`.
    pub state: Array,
    /// `mask [P M]`, where the graph makes one bit for each light sample.
    pub mask: Option<Array>,
    /// `visible [P]`.
    pub visible: Option<Array>,
    /// `image [H W 4]`.
    pub image: Option<Array>,
    /// Light samples asked.
    pub light_samples: usize,
    /// Picture width and height, pixels.
    pub size: [usize; 2],
}

impl Answers {
    /// Finds them among the kept values of a run of `plan` on `job`.
    ///
    /// # Errors
    /// The graph keeps no view-samples, or neither masks nor visible fractions.
    pub fn of(plan: &Plan, outcome: &Outcome, job: &Job) -> Result<Self, Problem> {
        Self::of_values(plan, |name| plan.slot(name).and_then(|id| outcome.values.try_get(id)).cloned(), job)
    }

    /// Finds them among values by slot name.
    ///
    /// # Errors
    /// As [`Answers::of`].
    pub fn of_values(plan: &Plan, value: impl Fn(&str) -> Option<Array>, job: &Job) -> Result<Self, Problem> {
        let find = |quantity: &str| {
            let made = |slot: &&Slot| slot.port.quantity == quantity && slot.name.contains('.');
            plan.slots.iter().filter(made).find_map(|slot| value(&slot.name))
        };
        let need = |quantity: &str| {
            find(quantity).ok_or_else(|| {
                Problem::new(Kind::Missing, format!("the graph makes no {quantity}, so its answers cannot be judged"))
                    .expected("nodes view_samples, sample_filter, and visibility or shadow_lookup")
            })
        };
        let answers = Self {
            position: need("position")?,
            normal: need("normal")?,
            triangle: need("triangle_of_sample")?,
            pixel: need("pixel")?,
            state: need("sample_state")?,
            mask: find("mask").filter(|mask| mask.dim(1) * 32 >= job.light_samples_count() && has_bits(plan)),
            visible: find("fraction"),
            image: find("radiance"),
            light_samples: job.light_samples_count(),
            size: job.image,
        };
        match (&answers.mask, &answers.visible) {
            (None, None) => need("mask").map(|_| answers),
            _ => Ok(answers),
        }
    }

    /// The view-samples as graph inputs, so that another run answers for the very same.
    pub fn imports(&self) -> Vec<(String, Array)> {
        use shadowgraph_core::input;
        [
            (input::IMPORTED_POSITION, &self.position),
            (input::IMPORTED_NORMAL, &self.normal),
            (input::IMPORTED_TRIANGLE, &self.triangle),
            (input::IMPORTED_PIXEL, &self.pixel),
        ]
        .into_iter()
        .map(|(port, array)| (port.name.to_string(), array.clone()))
        .collect()
    }

    /// Whether the row is judged: it is a view-sample, and faces the light as `truth` says. Those that face away are dark whatever
    /// casts a shadow; graphs that mark them and graphs that test them like any other are judged on the same rows without them. Where
    /// both asked other light samples, those near the terminator may face away for one set and not for the other, which says nothing
    /// about shadows either: then a row must face the light for both.
    pub fn is_compared(&self, truth: &Self, row: usize) -> bool {
        let faces = |answers: &Self| answers.state.as_u32()[row] != FACING_AWAY;
        let is_same_set = self.light_samples == truth.light_samples;
        self.triangle.as_u32()[row] != NO_TRIANGLE && faces(truth) && (is_same_set || faces(self))
    }

    /// Visible fractions as a picture `[H W]`, lit where there is no view-sample.
    pub fn picture(&self, fractions: &[f32]) -> Vec<f32> {
        let mut picture = vec![1.0; self.size[0] * self.size[1]];
        for (pixel, fraction) in self.pixel.as_u32().iter().zip(fractions) {
            if let Some(texel) = picture.get_mut(*pixel as usize) {
                *texel = *fraction;
            }
        }
        picture
    }

    /// Visible fractions: the graph's, else by counting the mask's bits.
    pub fn fractions(&self) -> Vec<f32> {
        match (&self.visible, &self.mask) {
            (Some(visible), _) => visible.as_f32().to_vec(),
            (None, Some(mask)) => {
                let blocked = |row: &[u32]| row.iter().map(|word| word.count_ones()).sum::<u32>();
                let lit = |row: &[u32]| 1.0 - blocked(row) as f32 / self.light_samples as f32;
                mask.as_u32().chunks_exact(mask.dim(1).max(1)).map(lit).collect()
            }
            (None, None) => Vec::new(),
        }
    }
}

/// Whether the mask has a bit of its own for each light sample: filtered shadow maps fill theirs with what a majority says.
fn has_bits(plan: &Plan) -> bool {
    let made_by = |slot: &Slot| match slot.producer {
        Producer::Node(node) => Some(&plan.nodes[node]),
        Producer::Input => None,
    };
    let maker = plan.slots.iter().filter(|slot| slot.port.quantity == "mask").find_map(made_by);
    maker.is_none_or(|node| !(node.pass.stage.name == "shadow_lookup" && node.pass.name != "compare"))
}

/// The truth about given view-samples.
#[derive(Clone, Debug)]
pub struct Truth {
    /// For the light samples that the method asked too: bits can be compared. None where no such run was made.
    pub bits: Option<Answers>,
    /// For visible fractions and pictures: of as many light samples as the comparison wants.
    pub grey: Answers,
}

impl Truth {
    /// The truth to compare bits with, if `test` asked the same number of light samples.
    fn bits_for(&self, test: &Answers) -> Option<&Answers> {
        let is_same = |truth: &&Answers| truth.light_samples == test.light_samples;
        self.bits.as_ref().filter(is_same).or(Some(&self.grey).filter(is_same))
    }
}

/// How wrong `test` is. Bits where both have them for the same light samples, all else by visible fractions and pictures.
///
/// # Errors
/// A value that is not finite, or view-samples that are not those of the truth.
pub fn errors(test: &Answers, truth: &Truth) -> Result<Errors, Problem> {
    errors_told(test, truth).map(|(errors, _)| errors)
}

/// The same, and why FLIP has no figure where it refused pictures of finite values.
///
/// # Errors
/// As [`errors`].
pub fn errors_told(test: &Answers, truth: &Truth) -> Result<(Errors, Vec<Problem>), Problem> {
    let grey = &truth.grey;
    if test.pixel != grey.pixel || test.position != grey.position {
        return Err(Problem::new(Kind::BadValue, "the truth answers for other view-samples")
            .expected("runs on the same imported view-samples"));
    }
    let mut errors = Errors::default();
    let compared = |row: usize| test.is_compared(grey, row);
    let bits = truth.bits_for(test).and_then(|truth| Some((test.mask.as_ref()?, truth.mask.as_ref()?, truth)));
    if let Some((mask, right, truth)) = bits.filter(|(mask, right, _)| mask.dim(1) == right.dim(1)) {
        let compared = |row: usize| test.is_compared(truth, row);
        let difference = mask_difference(mask.as_u32(), right.as_u32(), mask.dim(1), test.light_samples, compared);
        if let Some(leaks) = Leaks::of_masks(&difference) {
            errors.wrong_bit_share = Some(difference.wrong_share());
            (errors.light_leak_share, errors.shadow_leak_share) = (Some(leaks.light_share), Some(leaks.shadow_share));
        }
    }
    let (seen, right) = (test.fractions(), grey.fractions());
    if errors.wrong_bit_share.is_none()
        && let Some(leaks) = Leaks::of_fractions(&seen, &right, compared)?
    {
        (errors.light_leak_share, errors.shadow_leak_share) = (Some(leaks.light_share), Some(leaks.shadow_share));
    }
    // Shares of weighted light samples sum to one within rounding only.
    let spread = grey_errors(&seen, &right, Penumbra::Fraction { margin: 1e-6 }, compared)?;
    if let Some(all) = &spread.all {
        errors.rows_count = Some(all.rows_count);
        (errors.rmse_all, errors.p99, errors.max) = (Some(all.rmse), Some(all.p99), Some(all.max));
        errors.mean_signed = Some(all.mean_signed);
    }
    if let Some(penumbra) = &spread.penumbra {
        (errors.rmse_penumbra, errors.penumbra_rows_count) = (Some(penumbra.rmse), Some(penumbra.rows_count));
        let row_of = rows_by_pixel(test);
        let joined = |a: usize, b: usize| match (row_of[a], row_of[b]) {
            (Some(a), Some(b)) => compared(a) && compared(b) && is_one_surface(test, a, b),
            _ => false,
        };
        let widths = penumbra_widths(&test.picture(&seen), &grey.picture(&right), test.size, joined)?;
        errors.penumbra_width_ratio = widths.median_ratio;
    }
    let mut remarks = Vec::new();
    if let (Some(image), Some(right)) = (&test.image, &grey.image) {
        finite(image)?;
        let mut mean = |asked: Result<flip::Flip, Problem>| match asked {
            Ok(flip) => Some(flip.mean),
            Err(refusal) => {
                remarks.push(refusal);
                None
            }
        };
        errors.flip_tonemapped = mean(flip::tone_mapped(image, right, flip::DEFAULT_PPD).map(|made| made.flip));
        // Without light there is no range of exposures to look through.
        if right.as_f32().chunks_exact(4).any(|texel| texel[..3].iter().any(|value| *value > 0.0)) {
            errors.flip_linear = mean(flip::high_range(image, right, flip::DEFAULT_PPD).map(|made| made.flip));
        }
    }
    Ok((errors, remarks))
}

/// Radiance that is no number is a fault of the graph, not of what compares.
fn finite(image: &Array) -> Result<(), Problem> {
    match image.as_f32().iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(index) => Err(Problem::new(Kind::BadValue, "the picture holds a value that is not finite")
            .expected("finite radiance")
            .found(format!("{} at texel {}, channel {}", image.as_f32()[index], index / 4, index % 4))),
    }
}

/// The row of each pixel that has one.
pub fn rows_by_pixel(answers: &Answers) -> Vec<Option<usize>> {
    let mut rows = vec![None; answers.size[0] * answers.size[1]];
    for (row, pixel) in answers.pixel.as_u32().iter().enumerate() {
        if let Some(place) = rows.get_mut(*pixel as usize) {
            *place = Some(row);
        }
    }
    rows
}

/// Neighbouring view-samples with nearly one normal, neither far out of the other's plane.
pub fn is_one_surface(answers: &Answers, a: usize, b: usize) -> bool {
    let (position, normal) = (answers.position.as_vec3(), answers.normal.as_vec3());
    let dot = |a: [f32; 3], b: [f32; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let step = [0, 1, 2].map(|k| position[b][k] - position[a][k]);
    let along = dot(step, step).sqrt();
    dot(normal[a], normal[b]) > 0.98 && dot(step, normal[a]).abs() <= 0.2 * along
}

/// View-samples of `job` as its graph's first node makes them: what every method of a comparison gets.
///
/// # Errors
/// As [`Machine::run`]; the graph makes no view-samples.
pub fn view_samples(
    machine: &Machine,
    plan: &Plan,
    job: &Job,
    progress: &Progress,
) -> Result<Vec<(String, Array)>, Problem> {
    use shadowgraph_core::input;
    let mut only = plan.clone();
    let makes = |node: usize| plan.nodes[node].pass.stage.name == "view_samples";
    for slot in &mut only.slots {
        slot.keep = matches!(slot.producer, Producer::Node(node) if makes(node));
    }
    only.outputs.clear();
    let only = only.given(|_| false);
    let nothing: &Given = &[];
    let outcome = machine.run_given(&only, job, nothing, 1, progress)?;
    let find = |quantity: &str| {
        let id = only.slots.iter().position(|slot| slot.port.quantity == quantity);
        id.and_then(|id| outcome.values.try_get(id)).cloned().ok_or_else(|| {
            Problem::new(Kind::Missing, format!("the graph makes no {quantity}")).expected("a node view_samples")
        })
    };
    Ok(vec![
        (input::IMPORTED_POSITION.name.into(), find("position")?),
        (input::IMPORTED_NORMAL.name.into(), find("normal")?),
        (input::IMPORTED_TRIANGLE.name.into(), find("triangle_of_sample")?),
        (input::IMPORTED_PIXEL.name.into(), find("pixel")?),
    ])
}
