//! What a record must satisfy before it is written or drawn.

use crate::model::{Point, Stability, Verdict};
use shadowgraph_core::problem::{Kind, Problem};

/// A record of a JSON Lines file.
pub trait Record: serde::Serialize + serde::de::DeserializeOwned {
    /// The number that tells records apart.
    fn id(&self) -> &str;
    /// The first thing that is wrong with it.
    fn check(&self) -> Result<(), Problem>;
}

impl Record for Point {
    fn id(&self) -> &str {
        &self.id
    }

    fn check(&self) -> Result<(), Problem> {
        id_is_hex(&self.id)?;
        for (name, text) in [("scene", &self.scene), ("graph", &self.graph), ("label", &self.label)] {
            present(name, text)?;
        }
        match (&self.millis, &self.failure) {
            (None, None) => {
                return Err(bad("millis", "a time, or the failure that kept it from being taken", "neither"));
            }
            (Some(time), _) => {
                within("millis.median", Some(time.median), [0.0, f64::MAX])?;
                within("millis.low", Some(time.low), [0.0, time.median])?;
                within("millis.high", Some(time.high), [time.median, f64::MAX])?;
            }
            (None, Some(_)) => {}
        }
        if let Some(axis) = &self.quality_axis
            && !self.choices.iter().any(|(name, _)| name == axis)
        {
            return Err(bad("quality_axis", "an axis of `choices`", format!("`{axis}`")));
        }
        for node in &self.nodes {
            within("millis", Some(node.millis), [0.0, f64::MAX]).map_err(|problem| problem.node(&node.node))?;
        }
        let errors = &self.errors;
        let shares = [
            ("errors.wrong_bit_share", errors.wrong_bit_share),
            ("errors.light_leak_share", errors.light_leak_share),
            ("errors.shadow_leak_share", errors.shadow_leak_share),
            ("errors.flip_tonemapped", errors.flip_tonemapped),
            ("errors.flip_linear", errors.flip_linear),
        ];
        shares.into_iter().try_for_each(|(name, value)| within(name, value, [0.0, 1.0]))?;
        let greys = [
            ("errors.rmse_penumbra", errors.rmse_penumbra),
            ("errors.rmse_all", errors.rmse_all),
            ("errors.p99", errors.p99),
            ("errors.max", errors.max),
        ];
        greys.into_iter().try_for_each(|(name, value)| within(name, value, [0.0, GREY]))?;
        within("errors.mean_signed", errors.mean_signed, [-GREY, GREY])?;
        within("errors.penumbra_width_ratio", errors.penumbra_width_ratio, [0.0, f64::MAX])
    }
}

/// Visible fractions lie in 0..1; their differences may pass 1 by rounding of summed weights.
const GREY: f64 = 1.0 + 1e-4;

impl Record for Stability {
    fn id(&self) -> &str {
        &self.id
    }

    fn check(&self) -> Result<(), Problem> {
        id_is_hex(&self.id)?;
        for (name, text) in [("scene", &self.scene), ("graph", &self.graph), ("label", &self.label)] {
            present(name, text)?;
        }
        for (index, frame) in self.frames.iter().enumerate() {
            let name = |field: &str| format!("frames[{index}].{field}");
            within(&name("value"), Some(frame.value), [-f64::MAX, f64::MAX])?;
            within(&name("wrong_bit_share"), frame.wrong_bit_share, [0.0, 1.0])?;
            within(&name("wrong_outside_share"), frame.wrong_outside_share, [0.0, 1.0])?;
            within(&name("light_leak_share"), frame.light_leak_share, [0.0, 1.0])?;
            within(&name("shadow_leak_share"), frame.shadow_leak_share, [0.0, 1.0])?;
            within(&name("rmse_penumbra"), frame.rmse_penumbra, [0.0, GREY])?;
            within(&name("rmse_all"), frame.rmse_all, [0.0, GREY])?;
            within(&name("millis"), frame.millis, [0.0, f64::MAX])?;
        }
        let temporal = self.temporal.unwrap_or_default();
        within("temporal.t_rmse", temporal.t_rmse, [0.0, 2.0 * GREY])?;
        within("temporal.toggled_share", temporal.toggled_share, [0.0, 1.0])?;
        within("figure", self.figure, [0.0, f64::MAX])?;
        within("threshold", self.threshold, [0.0, f64::MAX])?;
        if let Some(worst) = &self.worst
            && worst.frame >= self.frames.len()
        {
            let frames = format!("a frame below {}", self.frames.len());
            return Err(bad("worst.frame", frames, worst.frame.to_string()));
        }
        let Some((figure, threshold)) = self.figure.zip(self.threshold) else {
            let judged = !matches!(self.verdict, Verdict::NotRun { .. });
            let found = format!("figure {:?} and threshold {:?}", self.figure, self.threshold);
            return if judged { Err(bad("verdict", "the figure and threshold it rests on", found)) } else { Ok(()) };
        };
        let agrees = match self.verdict {
            Verdict::Holds => figure <= threshold,
            Verdict::Fails => figure > threshold,
            Verdict::NotRun { .. } => true,
        };
        let found = || format!("{:?} at {figure} with threshold {threshold}", self.verdict);
        if agrees { Ok(()) } else { Err(bad("verdict", "`holds` exactly when figure <= threshold", found())) }
    }
}

fn id_is_hex(id: &str) -> Result<(), Problem> {
    let is_hex = id.len() == 16 && id.bytes().all(|byte| byte.is_ascii_hexdigit());
    if is_hex { Ok(()) } else { Err(bad("id", "16 hexadecimal digits", format!("`{id}`"))) }
}

fn present(name: &str, text: &str) -> Result<(), Problem> {
    if text.is_empty() { Err(bad(name, "a name", "empty text")) } else { Ok(()) }
}

/// NaN is in no range.
fn within(name: &str, value: Option<f64>, [low, high]: [f64; 2]) -> Result<(), Problem> {
    let Some(value) = value else { return Ok(()) };
    if (low..=high).contains(&value) {
        return Ok(());
    }
    let expected = match (low, high) {
        (low, high) if low == -f64::MAX && high == f64::MAX => "a finite number".into(),
        (low, f64::MAX) => format!("a finite number from {low}"),
        (low, high) => format!("a number from {low} to {high}"),
    };
    Err(bad(name, expected, value.to_string()))
}

fn bad(name: &str, expected: impl Into<String>, found: impl Into<String>) -> Problem {
    Problem::new(Kind::BadValue, "a record that cannot be charted").port(name).expected(expected).found(found)
}
