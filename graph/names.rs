//! The nearest of the names there are.

/// Longest name that is compared: a longer one is no slip of the hand.
const MAX_COMPARED: usize = 64;
/// Most names a message lists.
const MAX_LISTED: usize = 16;

/// The nearest name, if it is near enough to be what was meant. Of equally near ones the first.
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if name.len() > MAX_COMPARED {
        return None;
    }
    let allowed = 1 + name.chars().count() / 4;
    known
        .into_iter()
        .filter(|candidate| candidate.len() <= MAX_COMPARED && *candidate != name)
        .map(|candidate| (strsim::damerau_levenshtein(name, candidate), candidate))
        .min_by_key(|(distance, _)| *distance)
        .filter(|(distance, _)| *distance <= allowed)
        .map(|(_, candidate)| candidate)
}

/// The nearest name as a question, else all there are.
pub(crate) fn did_you_mean<'a>(name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => match list(known, ", ") {
            all if all.is_empty() => "there are none".into(),
            all => format!("there are {all}"),
        },
    }
}

/// Names with `between` them, cut short when there are many.
pub(crate) fn list<'a>(names: impl Iterator<Item = &'a str> + Clone, between: &str) -> String {
    let count = names.clone().count();
    let shown: Vec<&str> = names.take(MAX_LISTED).collect();
    let more = if count > MAX_LISTED { format!(" and {} more", count - MAX_LISTED) } else { String::new() };
    shown.join(between) + &more
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_finds_its_name_and_a_stranger_does_not() {
        let known = ["visibility", "view_samples", "scan"];
        assert_eq!(nearest("visibilty", known), Some("visibility"));
        assert_eq!(nearest("sacn", known), Some("scan"));
        assert_eq!(nearest("shade", known), None);
        assert_eq!(did_you_mean("shade", known.into_iter()), "there are visibility, view_samples, scan");
        assert_eq!(nearest(&"v".repeat(500), known), None);
    }
}
