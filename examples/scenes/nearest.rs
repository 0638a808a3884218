//! The nearest of some valid names.

/// A remedy that names it.
pub fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> String {
    let best = names.max_by(|a, b| strsim::jaro_winkler(name, a).total_cmp(&strsim::jaro_winkler(name, b)));
    best.map_or_else(|| "there are none".into(), |best| format!("nearest: {best}"))
}
