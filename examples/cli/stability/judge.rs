//! Figures of a method's answers frame by frame, and the verdict that follows.

use super::frame::Frame;
use super::suite::{Judge, Method};
use crate::answers::{Answers, Truth, errors};
use shadowgraph_charts::model::{StabilityFrame, Temporal, Verdict};
use shadowgraph_core::metric::{Fractions, FrameMasks, TemporalError, ToggledBits, mask_difference};
use shadowgraph_core::problem::Problem;
use shadowgraph_passes::shared::contact::contact_band;

/// What one frame's answers came to.
pub struct Judged {
    /// Figures.
    pub frame: StabilityFrame,
    /// By row, how wrong it is in the terms of the method's judge; 0 where it is right or not compared.
    pub wrong: Vec<f32>,
}

/// Compares one frame with the truth on the same view-samples.
///
/// # Errors
/// As [`errors`].
pub fn judge(method: &Method, frame: &Frame, test: &Answers, truth: &Truth, ulps: f32) -> Result<Judged, Problem> {
    let errors = errors(test, truth)?;
    let mut judged = StabilityFrame {
        value: frame.value,
        wrong_bit_share: errors.wrong_bit_share,
        light_leak_share: errors.light_leak_share,
        shadow_leak_share: errors.shadow_leak_share,
        rmse_penumbra: errors.rmse_penumbra,
        rmse_all: errors.rmse_all,
        ..StabilityFrame::default()
    };
    let (seen, right) = (test.fractions(), truth.grey.fractions());
    let difference = |row: usize| if test.is_compared(&truth.grey, row) { (seen[row] - right[row]).abs() } else { 0.0 };
    let mut wrong: Vec<f32> = (0..seen.len()).map(difference).collect();
    let bits = truth.bits.as_ref().unwrap_or(&truth.grey);
    if let Some((mask, right)) = test.mask.as_ref().zip(bits.mask.as_ref()).filter(|_| errors.wrong_bit_share.is_some())
    {
        let compared = |row: usize| test.is_compared(bits, row);
        let (words, count) = (mask.dim(1), method.light_samples as usize);
        let all = mask_difference(mask.as_u32(), right.as_u32(), words, count, compared);
        let rows: Vec<usize> = all.wrong_rows.iter().map(|row| *row as usize).collect();
        let in_band = in_contact(frame, test, &rows, method.light_samples, ulps)?;
        let outside: Vec<usize> =
            rows.iter().zip(&in_band).filter(|(_, in_band)| !**in_band).map(|(row, _)| *row).collect();
        let is_outside = |row: usize| outside.binary_search(&row).is_ok();
        let difference = mask_difference(mask.as_u32(), right.as_u32(), words, count, is_outside);
        judged.wrong_outside_share =
            (all.bits_count > 0).then(|| difference.wrong_count() as f64 / all.bits_count as f64);
        // A row may have as many bits too many as too few.
        for row in &outside {
            wrong[*row] = wrong[*row].max(0.5 / count as f32);
        }
        for row in rows.iter().filter(|row| !is_outside(**row)) {
            wrong[*row] = 0.0;
        }
    }
    Ok(Judged { frame: judged, wrong })
}

fn in_contact(
    frame: &Frame,
    test: &Answers,
    rows: &[usize],
    light_samples: u32,
    ulps: f32,
) -> Result<Vec<bool>, Problem> {
    if rows.is_empty() {
        return Ok(Vec::new());
    }
    let job = frame.job(light_samples)?;
    let casts = vec![1; job.scene.triangle_count()];
    let (position, triangle) = (test.position.as_vec3(), test.triangle.as_u32());
    Ok(contact_band(&job.scene.positions, &casts, &job.samples, position, triangle, rows, ulps))
}

/// Steps from frame to frame of one method, on rows that correspond.
pub struct Motion {
    grey: TemporalError,
    bits: Option<ToggledBits>,
    last: Option<(Answers, Truth, usize)>,
}

impl Motion {
    /// None yet.
    pub fn new(light_samples: u32) -> Self {
        // Half a light sample's share tells every bit.
        let pop = 0.5 / f64::from(light_samples);
        Self { grey: TemporalError::new(1e-6, pop), bits: None, last: None }
    }

    /// Takes in the next frame, whose rows from `steady_from` on are those of every other frame.
    ///
    /// # Errors
    /// Fractions that are not finite.
    pub fn add(&mut self, test: &Answers, truth: &Truth, steady_from: usize) -> Result<(), Problem> {
        if let Some((last_test, last_truth, last_from)) = &self.last {
            let count = test.triangle.dim(0) - steady_from;
            let compared = |row: &[usize; 2]| {
                last_test.is_compared(&last_truth.grey, row[0]) && test.is_compared(&truth.grey, row[1])
            };
            let rows = || (0..count).map(|row| [last_from + row, steady_from + row]).filter(compared);
            let (before, after) = (last_test.fractions(), test.fractions());
            let (right_before, right_after) = (last_truth.grey.fractions(), truth.grey.fractions());
            let of = |test, truth| Fractions { test, truth };
            self.grey.step(of(&before, &right_before), of(&after, &right_after), rows())?;
            let mask = |answers: &Answers| answers.mask.clone();
            let masks = [mask(last_test), bits_of(last_truth), mask(test), bits_of(truth)];
            if let [Some(before), Some(right_before), Some(after), Some(right_after)] = &masks
                && before.dim(1) == right_before.dim(1)
                && test.light_samples == truth_samples(truth)
            {
                let bits = match &mut self.bits {
                    Some(bits) => bits,
                    none => none.insert(ToggledBits::new(before.dim(1), test.light_samples)?),
                };
                let of = |test, truth| FrameMasks { test, truth };
                let before = of(before.as_u32(), right_before.as_u32());
                bits.step(before, of(after.as_u32(), right_after.as_u32()), rows())?;
            }
        }
        self.last = Some((test.clone(), truth.clone(), steady_from));
        Ok(())
    }

    /// Over all steps; none without a step.
    pub fn finish(self) -> Option<Temporal> {
        let t_rmse = self.grey.rmse()?;
        let bits = self.bits.as_ref();
        Some(Temporal {
            t_rmse: Some(t_rmse),
            toggled_share: bits.and_then(ToggledBits::toggled_share),
            toggled_count: bits.map(|bits| bits.toggled_count),
        })
    }
}

fn bits_of(truth: &Truth) -> Option<shadowgraph_core::array::Array> {
    truth.bits.as_ref().unwrap_or(&truth.grey).mask.clone()
}

fn truth_samples(truth: &Truth) -> usize {
    truth.bits.as_ref().unwrap_or(&truth.grey).light_samples
}

/// What a method is judged by in these frames: the figure's name, its largest value and in which frame, and the verdict.
pub struct Decision {
    /// Name of the figure.
    pub judged_by: &'static str,
    /// Its value; none where no frame has one.
    pub figure: Option<f64>,
    /// The frame.
    pub worst_frame: usize,
    /// Holds or fails.
    pub verdict: Verdict,
}

/// Decides.
pub fn decide(judge: &Judge, frames: &[StabilityFrame]) -> Decision {
    let (judged_by, of) = judge.by.of(frames);
    let figures = frames.iter().enumerate().filter_map(|(index, frame)| Some((index, of(frame)?)));
    let largest = figures.reduce(|best, next| if next.1 > best.1 { next } else { best });
    let verdict = match largest {
        Some((_, figure)) if figure > judge.at_most => Verdict::Fails,
        Some(_) => Verdict::Holds,
        None => Verdict::NotRun { why: format!("no frame has a {judged_by}: nothing could be compared") },
    };
    let (worst_frame, figure) = largest.map_or((0, None), |(frame, figure)| (frame, Some(figure)));
    Decision { judged_by, figure, worst_frame, verdict }
}
