//! Against NumPy 2.4.6 and SciPy 1.17.1 on the same values.

use super::*;

/// Milliseconds with a tail.
const TIMES: [f64; 15] = [12.1, 11.8, 12.6, 13.9, 11.9, 12.0, 12.2, 18.4, 12.3, 11.7, 12.4, 12.05, 12.15, 12.9, 11.95];

/// `rng = numpy.random.default_rng(7); [round(float(v), 4) for v in numpy.exp(.1 * rng.standard_t(3, size=40))]`
const RATIOS: [f64; 40] = [
    1.0001, 0.881, 1.0041, 0.9446, 1.0201, 1.1926, 0.6303, 0.9454, 1.0196, 0.9394, 0.8022, 0.9418, 0.9974, 0.988,
    0.8745, 0.884, 0.9653, 0.8768, 0.9841, 1.0446, 1.0295, 0.8345, 1.0669, 0.9337, 0.9465, 1.096, 0.9842, 0.9709,
    0.9588, 0.9688, 0.9979, 1.127, 0.8819, 0.7652, 1.0085, 0.9375, 0.9782, 1.1106, 1.0072, 0.9365,
];

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1e-6), "{found} is not {expected}");
}

fn interval(low: f64, high: f64) -> Interval {
    Interval { low, high }
}

#[test]
fn quantiles_are_those_of_numpy() {
    // numpy.quantile(TIMES, [0, .01, .25, .5, .9, .99, 1])
    let found = quantiles(&TIMES, &[0.0, 0.01, 0.25, 0.5, 0.9, 0.99, 1.0]).unwrap();
    let expected = [11.7, 11.714, 11.975, 12.15, 13.5, 17.77, 18.4];
    found.iter().zip(expected).for_each(|(found, expected)| near(*found, expected));
    near(median(&RATIOS).unwrap(), 0.96985);
}

#[test]
fn binomial_tails_are_those_of_scipy() {
    // scipy.stats.binom.sf(hits - 1, trials, each)
    for (trials, hits, each, expected) in [
        (12, 12, 0.5, 0.000_244_140_625),
        (30, 25, 0.5, 0.000_162_457_115_948_200_25),
        (200, 130, 0.5, 1.326_437_779_763_436_4e-5),
        (40, 3, 0.02, 0.045_670_230_440_716_65),
        (1000, 480, 0.5, 0.902_616_835_769_117_4),
        (7, 2, 0.3, 0.670_582_8),
    ] {
        let found = tail(trials, hits, each);
        assert!((found / expected - 1.0).abs() < 1e-10, "{trials} {hits} {each}: {found} is not {expected}");
    }
    // scipy.stats.binomtest(25, 30, .5, alternative='greater').pvalue
    assert!((sign_test(25, 30) / 0.000_162_457_115_948_200_25 - 1.0).abs() < 1e-10);
    assert_eq!((tail(5, 0, 0.3), tail(5, 6, 0.3), tail(5, 5, 1.0), tail(5, 1, 0.0)), (1.0, 0.0, 1.0, 0.0));
}

#[test]
fn order_intervals_are_those_of_scipy() {
    // scipy.stats.quantile_test(values, q=0, p=.5).confidence_interval(confidence)
    for (values, confidence, low, high) in [
        (&TIMES[..], 0.95, 11.95, 12.6),
        (&TIMES[..], 0.99, 11.9, 12.9),
        (&TIMES[..14], 0.95, 11.9, 12.9),
        (&TIMES[..14], 0.99, 11.8, 13.9),
        (&RATIOS[..], 0.95, 0.9418, 0.9979),
        (&RATIOS[..], 0.999, 0.9337, 1.0085),
    ] {
        assert_eq!(order_interval(values, confidence).unwrap(), Some(interval(low, high)), "{confidence}");
    }
    assert_eq!(order_interval(&TIMES[..5], 0.95).unwrap(), None);
    assert!(order_interval(&TIMES[..6], 0.95).unwrap().is_some());
}

#[test]
fn bootstrap_intervals_are_those_of_scipy() {
    // scipy.stats.bootstrap((values,), numpy.median, confidence_level=confidence, method='percentile', n_resamples=2000000,
    //                       batch=20000, rng=1).confidence_interval
    for (values, confidence, low, high) in [
        (&TIMES[..], 0.95, 11.95, 12.6),
        (&TIMES[..], 0.99, 11.95, 12.6),
        (&TIMES[..14], 0.95, 12.0, 12.6),
        (&TIMES[..14], 0.99, 11.95, 12.75),
        (&RATIOS[..], 0.95, 0.9432, 0.997_65),
        (&RATIOS[..], 0.999, 0.9365, 1.0072),
    ] {
        let found = bootstrap_interval(values, confidence).unwrap();
        near(found.low, low);
        near(found.high, high);
    }
}

#[test]
fn a_bootstrap_interval_covers_as_often_as_it_says() {
    let mut random = fastrand::Rng::with_seed(3);
    for (count, least) in [(15, 0.92), (40, 0.93), (101, 0.93)] {
        let mut covered = 0;
        for _ in 0..2000 {
            // The median of an exponential of rate 1 is the logarithm of 2.
            let values: Vec<f64> = (0..count).map(|_| -(1.0 - random.f64()).ln()).collect();
            covered += u32::from(bootstrap_interval(&values, 0.95).unwrap().contains(std::f64::consts::LN_2));
        }
        let share = f64::from(covered) / 2000.0;
        assert!(share >= least && share < 0.985, "{count} values: {share}");
    }
}

#[test]
fn intervals_mirror_and_do_not_depend_on_order() {
    let mut turned: Vec<f64> = RATIOS.iter().map(|ratio| -ratio).collect();
    turned.reverse();
    let found = bootstrap_interval(&RATIOS, 0.99).unwrap();
    assert_eq!(bootstrap_interval(&turned, 0.99).unwrap(), interval(-found.high, -found.low));
    assert_eq!(bootstrap_interval(&[3.0], 0.95).unwrap(), interval(3.0, 3.0));
    assert_eq!(bootstrap_interval(&[3.0; 8], 0.95).unwrap(), interval(3.0, 3.0));
}

#[test]
fn bad_input_is_refused() {
    assert_eq!(median(&[]).unwrap_err().kind, Kind::Missing);
    assert!(median(&[1.0, f64::NAN]).unwrap_err().to_string().contains("NaN as value 1"));
    assert!(quantile(&[1.0], 1.5).is_err());
    assert!(quantile(&[1.0], f64::NAN).is_err());
    for confidence in [0.0, 1.0, f64::NAN] {
        assert!(bootstrap_interval(&[1.0], confidence).is_err());
        assert!(order_interval(&[1.0], confidence).is_err());
    }
    assert!(bootstrap_interval(&[f64::INFINITY], 0.95).is_err());
    assert!(order_interval(&[f64::NAN; 9], 0.95).is_err());
}
