//! Blocks counted by hand, and the verdict on simulated machines.

use super::Side::{A, B};
use super::noise::{ALL, Noise, differs_in_turn, run};
use super::*;
use crate::statistics::{median, quantile};
use shadowgraph_core::problem::Kind;

const ABBA: [Side; 4] = [A, B, B, A];
const BAAB: [Side; 4] = [B, A, A, B];

fn block(order: [Side; 4], millis: [f64; 4]) -> Block {
    Block { order, millis }
}

/// As many blocks as asked for at a ratio each, on a machine that slows down by half from one to the next.
fn blocks(ratios: impl IntoIterator<Item = f64>) -> Vec<Block> {
    let pair = |(index, ratio): (usize, f64)| {
        let order = if index % 2 == 0 { ABBA } else { BAAB };
        let pace = 1.5f64.powi(index as i32 % 5);
        block(order, order.map(|side| if side == A { pace } else { pace * ratio }))
    };
    ratios.into_iter().enumerate().map(pair).collect()
}

fn judge(ratios: impl IntoIterator<Item = f64>) -> Summary {
    summarise(&blocks(ratios), &Settings::default()).unwrap()
}

#[test]
fn a_block_is_a_ratio_of_the_less_disturbed_times() {
    let slower = block(ABBA, [10.0, 11.0, 30.0, 12.0]);
    assert!((slower.log_ratio() - 1.1f64.ln()).abs() < 1e-12);
    let swapped = block(BAAB, [10.0, 11.0, 30.0, 12.0]);
    assert!((swapped.log_ratio() + 1.1f64.ln()).abs() < 1e-12);
    assert_eq!((slower.of(A), slower.of(B), swapped.of(A)), ([10.0, 12.0], [11.0, 30.0], [11.0, 30.0]));
}

#[test]
fn equal_times_are_equivalent_and_a_planted_tenth_is_slower_or_swapped_faster() {
    let same = judge([1.0; 20]);
    assert_eq!((same.ratio, same.verdict, same.equivalent, same.spread), (1.0, Verdict::Undecided, true, 0.0));
    let slower = judge((0..20).map(|index| 1.1 + 0.001 * f64::from(index % 7)));
    assert_eq!((slower.verdict, slower.equivalent, slower.beyond_count), (Verdict::Slower, false, 20));
    assert!((slower.ratio - 1.103).abs() < 1e-9 && slower.interval.contains(1.103), "{slower:?}");
    let faster = judge((0..20).map(|index| 1.0 / (1.1 + 0.001 * f64::from(index % 7))));
    assert_eq!((faster.verdict, faster.beyond_count), (Verdict::Faster, 20));
    assert!((faster.ratio * slower.ratio - 1.0).abs() < 1e-12);
    assert!((faster.verdict_interval.low * slower.verdict_interval.high - 1.0).abs() < 1e-12);
}

#[test]
fn the_threshold_is_an_edge() {
    // Certain to be 1.5 % slower: no verdict at 2 %, and equivalent; slower at 1 %.
    let wide = judge([1.015; 20]);
    assert_eq!((wide.verdict, wide.equivalent), (Verdict::Undecided, true));
    let narrow = Settings { threshold: 0.01, ..Settings::default() };
    let found = summarise(&blocks([1.015; 20]), &narrow).unwrap();
    assert_eq!((found.verdict, found.equivalent), (Verdict::Slower, false));
    assert_eq!(summarise(&blocks([1.0 / 1.015; 20]), &narrow).unwrap().verdict, Verdict::Faster);
}

#[test]
fn few_blocks_and_blocks_at_odds_are_no_verdict() {
    assert_eq!(judge([1.5; 14]).verdict, Verdict::Undecided);
    assert_eq!(judge([1.5; 15]).verdict, Verdict::Slower);
    // 16 of 20: the median is sure, the sign test is not.
    let at_odds = judge((0..20).map(|index| if index % 5 == 0 { 0.9 } else { 1.1 }));
    assert_eq!(at_odds.beyond_count, 16);
    assert!((at_odds.beyond_chance - 0.005_909).abs() < 1e-6, "{}", at_odds.beyond_chance);
    assert_eq!((at_odds.verdict, at_odds.equivalent), (Verdict::Undecided, false));
}

#[test]
fn what_turns_its_sign_with_the_order_is_no_verdict() {
    // Whatever is timed in the middle takes a fifth longer; by chance B was there nearly always.
    let middle = |index: usize| block(if index < 18 { ABBA } else { BAAB }, [10.0, 12.0, 12.0, 10.0]);
    let found = summarise(
        &(0..20).map(middle).collect::<Vec<_>>(),
        &Settings { verdict_confidence: 0.99, ..Settings::default() },
    );
    let found = found.unwrap();
    assert!(found.beyond_chance < 0.005 && found.verdict_interval.low > 1.1, "{found:?}");
    assert_eq!((found.ratio_by_order, found.verdict), ([Some(1.2), Some(1.0 / 1.2)], Verdict::Undecided));
    let only = summarise(&[block(ABBA, [10.0, 12.0, 12.0, 10.0]); 20], &Settings::default()).unwrap();
    assert_eq!((only.ratio_by_order[1], only.verdict), (None, Verdict::Undecided));
}

#[test]
fn times_of_a_side_are_its_own() {
    let found =
        summarise(&[block(ABBA, [1.0, 5.0, 6.0, 2.0]), block(BAAB, [7.0, 3.0, 4.0, 8.0])], &Settings::default());
    let found = found.unwrap();
    assert_eq!((found.a_millis.median, found.b_millis.median), (2.5, 6.5));
    assert_eq!(found.a_millis.interval, None);
    assert!(judge([1.0; 20]).a_millis.interval.is_some());
}

#[test]
fn orders_come_by_the_seed_and_both_come_alike() {
    let orders = |seed: u64| {
        let mut paired =
            Paired::new(Settings { seed, half_width: 1e-9, most_blocks: 400, ..Settings::default() }).unwrap();
        let mut orders = Vec::new();
        let mut noise = (1..).map(|index| 1.0 + f64::from(index * 37 % 101) / 101.0);
        while let Some(order) = paired.next_block() {
            assert_eq!(paired.next_block(), Some(order), "asking again gives the same block");
            paired.push([noise.next().unwrap(), 1.0, 1.0, 2.0]).unwrap();
            orders.push(order);
        }
        assert_eq!((paired.stop(), paired.blocks().len()), (Some(Stop::MostBlocks), 400));
        orders
    };
    assert_eq!(orders(5), orders(5));
    assert_ne!(orders(5), orders(6));
    let first = orders(5).iter().filter(|order| **order == ABBA).count();
    assert!((150..=250).contains(&first), "{first} of 400");
}

#[test]
fn measuring_ends_when_the_interval_is_narrow_and_says_why() {
    let end = |settings: Settings, noise: Noise| {
        let (summary, stop) = run(noise, 1.0, settings);
        (stop, summary.blocks_count, summary.interval.map(f64::ln).half_width())
    };
    let (stop, count, half_width) = end(Settings::default(), Noise::Calm);
    assert!(stop == Stop::Precise && count < 120 && half_width <= 0.01, "{stop:?} {count} {half_width}");
    let (stop, more, half_width) = end(Settings { half_width: 0.005, ..Settings::default() }, Noise::Calm);
    assert!(stop == Stop::Precise && more > count && half_width <= 0.005, "{stop:?} {more} {half_width}");
    let few = Settings { most_blocks: 30, ..Settings::default() };
    assert_eq!(end(few, Noise::Loud).0, Stop::MostBlocks);
    // Four frames of 20 ms a block; a budget for ten of them, pilot or not.
    let short = Settings { budget_millis: Some(860.0), ..Settings::default() };
    let (stop, count, _) = end(short, Noise::Calm);
    assert_eq!((stop, count), (Stop::Budget, 10));
}

#[test]
fn time_that_is_in_no_block_counts_against_the_budget_and_one_block_always_runs() {
    let settings = Settings { budget_millis: Some(100.0), ..Settings::default() };
    let mut paired = Paired::new(settings).unwrap();
    paired.spend(95.0);
    assert!(paired.next_block().is_some());
    paired.push([10.0; 4]).unwrap();
    assert_eq!((paired.stop(), paired.next_block()), (Some(Stop::Budget), None));
    assert_eq!(paired.summary().unwrap().verdict, Verdict::Undecided);
}

#[test]
fn bad_times_are_refused_and_the_block_can_be_timed_again() {
    let mut paired = Paired::new(Settings::default()).unwrap();
    assert_eq!(paired.push([1.0; 4]).unwrap_err().kind, Kind::Missing);
    assert_eq!(paired.summary().unwrap_err().to_string(), "nothing was timed; expected at least one block");
    let order = paired.next_block();
    for bad in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
        let problem = paired.push([1.0, 1.0, bad, 1.0]).unwrap_err();
        assert!(problem.to_string().contains("as timing 2 of a block"), "{problem}");
        assert_eq!((paired.next_block(), paired.blocks().len()), (order, 0));
    }
    let unpaired = block([A, A, B, B], [1.0; 4]);
    assert!(summarise(&[unpaired], &Settings::default()).is_err());
    assert!(summarise(&[], &Settings::default()).is_err());
}

#[test]
fn settings_out_of_range_are_named() {
    let right = Settings::default();
    for (name, wrong) in [
        ("threshold", Settings { threshold: 0.0, ..right }),
        ("threshold", Settings { threshold: f64::NAN, ..right }),
        ("confidence", Settings { confidence: 1.0, ..right }),
        ("verdict_confidence", Settings { verdict_confidence: -0.5, ..right }),
        ("half_width", Settings { half_width: f64::INFINITY, ..right }),
        ("pilot_blocks", Settings { pilot_blocks: 0, ..right }),
        ("most_blocks", Settings { most_blocks: 19, ..right }),
        ("budget_millis", Settings { budget_millis: Some(0.0), ..right }),
    ] {
        assert_eq!(Paired::new(wrong).unwrap_err().port.as_deref(), Some(name));
    }
}

/// Runs of the same graph against itself, for each kind of noise.
const RUNS: u64 = 250;

/// The defaults, but no more blocks than the tests have time for.
fn settings(seed: u64) -> Settings {
    Settings { seed, most_blocks: 400, ..Settings::default() }
}

#[test]
fn the_same_graph_is_never_called_different_on_any_machine() {
    for noise in ALL {
        for seed in 0..RUNS {
            let (summary, stop) = run(noise, 1.0, settings(seed));
            assert_eq!(summary.verdict, Verdict::Undecided, "{noise:?}, seed {seed}, {stop:?}: {summary:?}");
        }
    }
}

#[test]
fn a_lasting_difference_within_the_threshold_is_not_called_one() {
    for noise in ALL {
        for seed in 0..100 {
            let (summary, _) = run(noise, 1.012, settings(seed));
            assert_eq!(summary.verdict, Verdict::Undecided, "{noise:?}, seed {seed}: {summary:?}");
        }
    }
}

#[test]
fn a_tenth_slower_is_called_slower_and_a_tenth_faster_faster() {
    // What comes in step with the blocks leaves nothing certain.
    for noise in ALL.into_iter().filter(|noise| !matches!(noise, Noise::InStep)) {
        let (mut counts, mut covered) = (Vec::new(), 0);
        for seed in 0..150 {
            for (factor, verdict) in [(1.1, Verdict::Slower), (1.0 / 1.1, Verdict::Faster)] {
                let (summary, stop) = run(noise, factor, settings(seed));
                assert_eq!(summary.verdict, verdict, "{noise:?}, seed {seed}, {stop:?}: {summary:?}");
                counts.push(summary.blocks_count as f64);
                covered += u32::from(summary.interval.contains(factor));
            }
        }
        // The interval reported holds the truth about as often as it says; 150 runs say so to about 0.02.
        let share = f64::from(covered) / counts.len() as f64;
        let (middle, most) = (median(&counts).unwrap(), quantile(&counts, 0.95).unwrap());
        println!("{noise:?}: median {middle} blocks, 95 in 100 within {most}; interval holds in {share:.3}");
        assert!(share > 0.88, "{noise:?}: {share}");
    }
}

#[test]
fn in_turn_instead_of_by_the_coin_the_same_graph_would_be_called_different() {
    // The control of the simulation: noise in step with blocks that all have one order looks like a difference, and only that one
    // order is there tells.
    let verdicts = |orders: &[[Side; 4]]| {
        let differs = |seed: &u64| differs_in_turn(Noise::InStep, orders, 60, settings(*seed));
        (0..100).filter(differs).count()
    };
    assert!(verdicts(&[ABBA]) > 90);
    assert_eq!(verdicts(&[ABBA, BAAB]), 0);
}

#[test]
fn a_verdict_at_first_sight_would_call_the_same_graph_different() {
    // The control of the rule to stop by width alone: a 95 % interval looked at after each block, without a threshold to speak of.
    let hasty = Settings { threshold: 1e-9, verdict_confidence: 0.95, ..Settings::default() };
    let differs = |seed: &u64| {
        let mut machine = super::noise::Machine::new(Noise::Shared, 1.0, *seed);
        let mut paired = Paired::new(Settings { seed: *seed, half_width: 1e-9, most_blocks: 100, ..hasty }).unwrap();
        while let Some(order) = paired.next_block() {
            paired.push(order.map(|side| machine.frame(side))).unwrap();
            if paired.summary().unwrap().verdict != Verdict::Undecided {
                return true;
            }
        }
        false
    };
    let count = (0..100).filter(differs).count();
    assert!(count > 15, "{count} of 100");
}
