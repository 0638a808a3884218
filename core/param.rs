//! Parameters of a pass: one table holds name, range, default, unit and doc; values are checked against it once.

use crate::problem::{Kind, Problem};

/// A value.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Value {
    /// Whole number.
    U32(u32),
    /// Real number.
    F32(f32),
    /// Switch.
    Bool(bool),
    /// One of a fixed set of words.
    Word(String),
}

/// Type and range of a parameter.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Range {
    /// Whole number in `min..=max`.
    U32 {
        /// Smallest.
        min: u32,
        /// Largest.
        max: u32,
        /// Used when absent.
        default: u32,
    },
    /// Finite real number in `min..=max`.
    F32 {
        /// Smallest.
        min: f32,
        /// Largest.
        max: f32,
        /// Used when absent.
        default: f32,
    },
    /// Switch.
    Bool {
        /// Used when absent.
        default: bool,
    },
    /// One of `words`.
    Word {
        /// The set.
        words: &'static [&'static str],
        /// Used when absent.
        default: &'static str,
    },
}

/// One parameter of a pass.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ParamSpec {
    /// Name in RON and on the command line.
    pub name: &'static str,
    /// Type, range and default.
    pub range: Range,
    /// Unit, or empty.
    pub unit: &'static str,
    /// What gets better and worse as it grows.
    pub doc: &'static str,
}

/// Checked values, one for every [`ParamSpec`] of the pass, in its order.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Params(pub Vec<(&'static str, Value)>);

impl Range {
    /// The value used when none is given.
    pub fn default_value(&self) -> Value {
        match *self {
            Range::U32 { default, .. } => Value::U32(default),
            Range::F32 { default, .. } => Value::F32(default),
            Range::Bool { default } => Value::Bool(default),
            Range::Word { default, .. } => Value::Word(default.into()),
        }
    }

    /// `whole number 1..=8192`, as errors and listings show it.
    pub fn text(&self) -> String {
        match self {
            Range::U32 { min, max, .. } => format!("whole number {min}..={max}"),
            Range::F32 { min, max, .. } => format!("number {min}..={max}"),
            Range::Bool { .. } => "true or false".into(),
            Range::Word { words, .. } => format!("one of {}", words.join(", ")),
        }
    }

    /// `value` as this range's type (a whole number serves where a real one is wanted), or why not.
    pub fn check(&self, value: &Value) -> Result<Value, Problem> {
        let fits = match (self, value) {
            (Range::U32 { min, max, .. }, Value::U32(v)) => (min..=max).contains(&v).then_some(Value::U32(*v)),
            (Range::F32 { min, max, .. }, Value::F32(v)) => (min..=max).contains(&v).then_some(Value::F32(*v)),
            (Range::F32 { min, max, .. }, Value::U32(v)) => {
                let v = *v as f32;
                (*min..=*max).contains(&v).then_some(Value::F32(v))
            }
            (Range::Bool { .. }, Value::Bool(v)) => Some(Value::Bool(*v)),
            (Range::Word { words, .. }, Value::Word(v)) => words.contains(&v.as_str()).then(|| value.clone()),
            _ => None,
        };
        fits.ok_or_else(|| {
            Problem::new(Kind::BadValue, "parameter value not allowed").expected(self.text()).found(value.text())
        })
    }
}

impl Value {
    /// As written in RON.
    pub fn text(&self) -> String {
        match self {
            Value::U32(v) => v.to_string(),
            Value::F32(v) => format!("{v:?}"),
            Value::Bool(v) => v.to_string(),
            Value::Word(v) => format!("{v:?}"),
        }
    }
}

impl Params {
    /// Every parameter at its default.
    pub fn defaults(specs: &[ParamSpec]) -> Self {
        Self(specs.iter().map(|spec| (spec.name, spec.range.default_value())).collect())
    }

    /// The value of `name`; panics if the pass has no such parameter (our bug).
    pub fn get(&self, name: &str) -> &Value {
        match self.0.iter().find(|(key, _)| *key == name) {
            Some((_, value)) => value,
            None => unreachable!("no parameter {name} among {:?}", self.0),
        }
    }

    /// A whole number.
    pub fn u32(&self, name: &str) -> u32 {
        match self.get(name) {
            Value::U32(v) => *v,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// A real number.
    pub fn f32(&self, name: &str) -> f32 {
        match self.get(name) {
            Value::F32(v) => *v,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// A switch.
    pub fn bool(&self, name: &str) -> bool {
        match self.get(name) {
            Value::Bool(v) => *v,
            other => unreachable!("{name} is {other:?}"),
        }
    }

    /// A word of a set.
    pub fn word(&self, name: &str) -> &str {
        match self.get(name) {
            Value::Word(v) => v,
            other => unreachable!("{name} is {other:?}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_refuse_what_is_outside_and_say_so() {
        let range = Range::U32 { min: 1, max: 8, default: 4 };
        assert_eq!(range.check(&Value::U32(8)), Ok(Value::U32(8)));
        let problem = range.check(&Value::U32(9)).unwrap_err();
        assert_eq!(problem.expected.as_deref(), Some("whole number 1..=8"));
        assert!(range.check(&Value::Bool(true)).is_err());
        let real = Range::F32 { min: 0.0, max: 1.0, default: 0.5 };
        assert_eq!(real.check(&Value::U32(1)), Ok(Value::F32(1.0)));
        assert!(real.check(&Value::F32(f32::NAN)).is_err());
    }
}
