//! When a node ran within a frame, or why that is not known.

/// One node in one frame, by whatever clock its backend has.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Reading {
    /// From when to when, milliseconds since the frame's first reading; `begin` is before `end`.
    Span {
        /// Its start.
        begin: f64,
        /// Its end.
        end: f64,
    },
    /// Timers are off, or the node had nothing to time.
    #[default]
    Untimed,
    /// Begin and end are one: shorter than a tick, or a clock that stands still.
    Zero,
    /// The end comes before the begin: the clock cannot be trusted.
    Negative,
    /// The device was asked for stamps and wrote none.
    Dropped,
}

impl Reading {
    /// The reading of a node that ran from `begin` to `end`.
    pub fn of(begin: f64, end: f64) -> Self {
        match end.total_cmp(&begin) {
            std::cmp::Ordering::Greater => Self::Span { begin, end },
            std::cmp::Ordering::Equal => Self::Zero,
            std::cmp::Ordering::Less => Self::Negative,
        }
    }

    /// The same reading on a clock that began so much earlier.
    pub fn later(self, millis: f64) -> Self {
        match self {
            Self::Span { begin, end } => Self::Span { begin: begin + millis, end: end + millis },
            other => other,
        }
    }

    /// How long the node took, milliseconds, where that is known.
    pub fn millis(self) -> Option<f64> {
        match self {
            Self::Span { begin, end } => Some(end - begin),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readings_say_what_is_wrong_with_them() {
        assert_eq!(Reading::of(1.0, 3.5).millis(), Some(2.5));
        assert_eq!(Reading::of(1.0, 1.0), Reading::Zero);
        assert_eq!(Reading::of(1.0, 0.5), Reading::Negative);
        assert_eq!([Reading::Zero, Reading::Negative, Reading::Dropped].map(Reading::millis), [None; 3]);
    }
}
