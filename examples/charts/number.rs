//! Numbers for people: three digits that count, no more.

/// `0`, `12.3`, `1,230`, `0.00123`, `1.2e-5`: three significant digits, two where the number needs an exponent.
pub fn figure(value: f64) -> String {
    let size = value.abs();
    if !value.is_finite() {
        return "not a number".into();
    }
    if size == 0.0 {
        return "0".into();
    }
    if !(1e-3..999_500.0).contains(&size) {
        let text = format!("{value:.1e}");
        return text.replace(".0e", "e");
    }
    let digits = (2 - size.log10().floor() as i32).max(0) as usize;
    let text = format!("{value:.digits$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    thousands(text)
}

/// A figure, or a dash where nothing was measured.
pub fn figure_or_dash(value: Option<f64>) -> String {
    value.map_or_else(|| "–".into(), figure)
}

/// `1,234,567`.
pub fn count(value: u64) -> String {
    thousands(&value.to_string())
}

fn thousands(text: &str) -> String {
    let (whole, rest) = text.split_once('.').map_or((text, None), |(whole, rest)| (whole, Some(rest)));
    let (sign, digits) = whole.strip_prefix('-').map_or(("", whole), |digits| ("-", digits));
    let mut out = String::from(sign);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    rest.map_or(out.clone(), |rest| format!("{out}.{rest}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_that_count() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (12.345, "12.3"),
            (0.5, "0.5"),
            (999.6, "1,000"),
            (1234.4, "1,234"),
            (-1234.4, "-1,234"),
            (0.001234, "0.00123"),
            (0.00012, "1.2e-4"),
            (1e-5, "1e-5"),
            (2.5e7, "2.5e7"),
            (f64::MAX, "1.8e308"),
            (5e-324, "4.9e-324"),
            (f64::NAN, "not a number"),
        ];
        for (value, text) in cases {
            assert_eq!(figure(value), text, "{value}");
        }
        assert_eq!((count(0), count(1_234_567)), ("0".into(), "1,234,567".into()));
    }
}
