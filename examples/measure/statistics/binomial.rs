//! Sums of the binomial distribution.

/// Logarithm of `trials` over `hits`.
pub(super) fn ln_choose(trials: u64, hits: u64) -> f64 {
    let hits = hits.min(trials - hits);
    (1..=hits).map(|index| ((trials - hits + index) as f64 / index as f64).ln()).sum()
}

/// Chance of at least `hits` of `trials` at a chance of `each`, 0 to 1.
pub fn tail(trials: u64, hits: u64, each: f64) -> f64 {
    if hits == 0 || each >= 1.0 {
        return if hits <= trials { 1.0 } else { 0.0 };
    }
    if hits > trials || each <= 0.0 {
        return 0.0;
    }
    let at = |hits: u64| {
        (ln_choose(trials, hits) + hits as f64 * each.ln() + (trials - hits) as f64 * (-each).ln_1p()).exp()
    };
    let odds = each / (1.0 - each);
    // Away from the middle terms shrink, so that a first term of 0 has only zeros after it.
    if hits as f64 > trials as f64 * each {
        let next = |term: &(u64, f64)| {
            let (hits, chance) = *term;
            (hits < trials).then(|| (hits + 1, chance * (trials - hits) as f64 / (hits + 1) as f64 * odds))
        };
        std::iter::successors(Some((hits, at(hits))), next).map(|(_, chance)| chance).sum::<f64>().min(1.0)
    } else {
        let next = |term: &(u64, f64)| {
            let (hits, chance) = *term;
            (hits > 0).then(|| (hits - 1, chance * hits as f64 / (trials - hits + 1) as f64 / odds))
        };
        let fewer = std::iter::successors(Some((hits - 1, at(hits - 1))), next).map(|(_, chance)| chance).sum::<f64>();
        (1.0 - fewer).max(0.0)
    }
}

/// One-sided sign test: the chance of at least `above` of `count` fair coins, which is the chance that so many values lie above
/// what is in truth their median.
pub fn sign_test(above: u64, count: u64) -> f64 {
    tail(count, above, 0.5)
}
