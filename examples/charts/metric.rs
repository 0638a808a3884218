//! The errors a chart can have on its axis, each a distance: 0 is right, more is worse.

use crate::model::{Errors, StabilityFrame};

/// One kind of error.
#[derive(Debug)]
pub struct Metric {
    /// Name in files, options and addresses.
    pub name: &'static str,
    /// Name on axes and in selectors.
    pub title: &'static str,
    /// What it is, in a sentence without a full stop.
    pub doc: &'static str,
    /// Why a point may lack it.
    pub absent: &'static str,
    of: fn(&Errors) -> Option<f64>,
}

impl Metric {
    /// The distance, 0 or more; `None` when not measured.
    pub fn of(&self, errors: &Errors) -> Option<f64> {
        (self.of)(errors)
    }

    /// The metric of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        METRICS.iter().find(|metric| metric.name == name)
    }
}

const NO_PENUMBRA: &str = "no view-sample lies in true penumbra";
const NOT_MEASURED: &str = "not measured";

/// Every error, in the order of selectors.
pub static METRICS: &[Metric] = &[
    Metric {
        name: "rmse_penumbra",
        title: "RMSE over true penumbra",
        doc: "root mean square error of the visible fraction over view-samples that the truth puts in penumbra",
        absent: NO_PENUMBRA,
        of: |errors| errors.rmse_penumbra,
    },
    Metric {
        name: "wrong_bit_share",
        title: "wrong bits",
        doc: "mask bits that differ from the truth, over all bits compared",
        absent: "the method answers with a fraction, not with a mask",
        of: |errors| errors.wrong_bit_share,
    },
    Metric {
        name: "rmse_all",
        title: "RMSE over all view-samples",
        doc: "root mean square error of the visible fraction over all view-samples compared",
        absent: NOT_MEASURED,
        of: |errors| errors.rmse_all,
    },
    Metric {
        name: "p99",
        title: "P99 error",
        doc: "99th percentile of the absolute error of the visible fraction",
        absent: NOT_MEASURED,
        of: |errors| errors.p99,
    },
    Metric {
        name: "max",
        title: "largest error",
        doc: "largest absolute error of the visible fraction",
        absent: NOT_MEASURED,
        of: |errors| errors.max,
    },
    Metric {
        name: "light_leak_share",
        title: "light leak",
        doc: "share of the light that the truth blocks and the method lets through",
        absent: NOT_MEASURED,
        of: |errors| errors.light_leak_share,
    },
    Metric {
        name: "shadow_leak_share",
        title: "shadow leak",
        doc: "share of the light that the method blocks and the truth lets through",
        absent: NOT_MEASURED,
        of: |errors| errors.shadow_leak_share,
    },
    Metric {
        name: "mean_signed",
        title: "|mean error|",
        doc: "size of the mean error of the visible fraction: whether the picture as a whole is too light or too dark",
        absent: NOT_MEASURED,
        of: |errors| errors.mean_signed.map(f64::abs),
    },
    Metric {
        name: "flip_tonemapped",
        title: "FLIP, tone-mapped",
        doc: "mean FLIP of the tone-mapped picture",
        absent: NOT_MEASURED,
        of: |errors| errors.flip_tonemapped,
    },
    Metric {
        name: "flip_linear",
        title: "HDR-FLIP, linear",
        doc: "mean HDR-FLIP of the linear picture",
        absent: NOT_MEASURED,
        of: |errors| errors.flip_linear,
    },
    Metric {
        name: "penumbra_width_ratio",
        title: "|penumbra width / truth - 1|",
        doc: "how far the width of penumbrae, 10 to 90 per cent of the ramp, is from the truth's",
        absent: NO_PENUMBRA,
        of: |errors| errors.penumbra_width_ratio.map(|ratio| (ratio - 1.0).abs()),
    },
];

/// A figure that a stability record has for each frame.
#[derive(Debug)]
pub struct FrameFigure {
    /// Name in files.
    pub name: &'static str,
    /// Name on axes.
    pub title: &'static str,
    of: fn(&StabilityFrame) -> Option<f64>,
}

impl FrameFigure {
    /// The figure, 0 or more; `None` when not measured.
    pub fn of(&self, frame: &StabilityFrame) -> Option<f64> {
        (self.of)(frame)
    }
}

/// Every figure of a frame, in the order of selectors.
pub static FRAME_FIGURES: &[FrameFigure] = &[
    FrameFigure { name: "wrong_bit_share", title: "wrong bits", of: |frame| frame.wrong_bit_share },
    FrameFigure {
        name: "wrong_outside_share",
        title: "wrong bits outside the contact band",
        of: |frame| frame.wrong_outside_share,
    },
    FrameFigure { name: "rmse_penumbra", title: "RMSE over true penumbra", of: |frame| frame.rmse_penumbra },
    FrameFigure { name: "rmse_all", title: "RMSE over all view-samples", of: |frame| frame.rmse_all },
    FrameFigure { name: "light_leak_share", title: "light leak", of: |frame| frame.light_leak_share },
    FrameFigure { name: "shadow_leak_share", title: "shadow leak", of: |frame| frame.shadow_leak_share },
    FrameFigure { name: "millis", title: "milliseconds a frame", of: |frame| frame.millis },
    FrameFigure {
        name: "longest_list_count",
        title: "entries of the longest list",
        of: |frame| frame.longest_list_count.map(|count| count as f64),
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_metric_is_a_distance_from_right() {
        let right = Errors {
            wrong_bit_share: Some(0.0),
            light_leak_share: Some(0.0),
            shadow_leak_share: Some(0.0),
            rmse_penumbra: Some(0.0),
            rmse_all: Some(0.0),
            p99: Some(0.0),
            max: Some(0.0),
            mean_signed: Some(0.0),
            flip_tonemapped: Some(0.0),
            flip_linear: Some(0.0),
            penumbra_width_ratio: Some(1.0),
            penumbra_rows_count: Some(1),
            rows_count: Some(1),
        };
        for metric in METRICS {
            assert_eq!(metric.of(&right), Some(0.0), "{}", metric.name);
            assert_eq!(metric.of(&Errors::default()), None, "{}", metric.name);
            assert!(std::ptr::eq(Metric::named(metric.name).unwrap(), metric), "{}", metric.name);
        }
        let dark = Errors { mean_signed: Some(-0.5), penumbra_width_ratio: Some(0.25), ..right };
        let distances = ["mean_signed", "penumbra_width_ratio"].map(|name| Metric::named(name).unwrap().of(&dark));
        assert_eq!(distances, [Some(0.5), Some(0.75)]);
    }
}
