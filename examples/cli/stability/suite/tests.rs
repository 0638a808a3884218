use super::*;

fn read(text: &str) -> Result<Suite, Problems> {
    Suite::read(Source { name: "s.ron".into(), text: text.into() })
}

const GOOD: &str = r#"(
    version: 1,
    name: "small",
    scenes: [
        (name: "contact", scene: "builtin:contact", options: ["--light-radius", "0.3"]),
        (name: "open", scene: "builtin:open", said_closed: true),
    ],
    sequences: [
        (change: Still),
        (change: Zoom, values: [1, 0.5], scenes: ["open"]),
    ],
    methods: [
        (graph: "hard", judge: (by: "wrong_outside_share", at_most: 0)),
        (name: "coarse", graph: "shadow_map", set: ["light_depth.size=64", "casters=all"], judge: (by: "wrong_bit_share", at_most: 0.1)),
        (graph: "pcf", truth_light_samples: 16, judge: (by: "rmse_penumbra", at_most: 0.1)),
    ],
    expect: [
        (is: ExpectedToFail, methods: ["coarse"], changes: [Zoom], why: "few texels"),
        (is: MustHold, methods: ["hard"], scenes: ["open"], why: "exact"),
        (is: Open, methods: ["hard"], why: "said elsewhere"),
    ],
)"#;

#[test]
fn a_suite_is_scenes_times_sequences_times_methods_and_the_first_expectation_that_fits_counts() {
    let suite = read(GOOD).unwrap();
    assert_eq!(suite.cases(), [(0, 0), (1, 0), (1, 1)]);
    assert!(suite.scenes[1].said_closed && suite.scenes[0].choice.light.light_radius == Some(0.3));
    let coarse = &suite.methods[1];
    assert_eq!((coarse.choice.set.len(), coarse.choice.swap.len(), coarse.truth_light_samples), (1, 1, 1));
    assert_eq!(suite.methods[2].truth_light_samples, 16);
    assert_eq!(suite.expected(0, 1, Sequence::Still), (Expected::MustHold, "exact".into()));
    assert_eq!(suite.expected(0, 0, Sequence::Still), (Expected::Open, "said elsewhere".into()));
    assert_eq!(suite.expected(1, 1, Sequence::Zoom).0, Expected::ExpectedToFail);
    assert_eq!(suite.expected(1, 1, Sequence::Still), (Expected::Open, "nothing is claimed".into()));
}

#[test]
fn every_mistake_is_told_with_its_place() {
    let text = r#"(
    version: 2,
    nam: "x",
    scenes: [
        (name: "contact", scene: "builtin:contact", options: ["--light-radius", "wide"]),
        (name: "open", scene: "builtin:open", said_closed: 1),
        (name: "open", scene: "builtin:open"),
    ],
    sequences: [
        (change: Sill),
        (change: Still, values: [1]),
        (change: Tessellation, values: [0, 1.5, 9], scenes: ["opne"]),
        (change: Zoom),
        (change: LightOrbit, values: [0, 1], scenes: ["open"]),
        (change: LightOrbit, values: [0, 2], scenes: ["open"]),
    ],
    methods: [
        (graph: "hard", judge: (by: "wrong", at_most: 2)),
        (graph: "pcf", truth_light_samples: 64, needs: "light_is_plane", judge: (by: "wrong_bit_share", at_most: 0.1)),
        (name: "none", set: ["size"]),
    ],
    expect: [(is: MayHold, methods: ["hadr"], changes: [Zom])],
)"#;
    let problems = read(text).unwrap_err().to_string();
    let expected = r#"s.ron:1:1: a stability suite has no name; expected name: ..
s.ron:2:14: `version` is not allowed; expected a whole number in 1..=1; found 2
s.ron:3:5: a stability suite has no field `nam` (did you mean `name`?)
s.ron:5:9: options of this scene are not understood; expected flags of `shadowgraph render` for scene and light; found invalid value 'wide' for '--light-radius <RADIUS>': invalid float literal
s.ron:6:60: `said_closed` is of the wrong type; expected true or false; found 1
s.ron:7:9: scene "open" is named twice (give each a `name` of its own)
s.ron:10:18: `change` is of the wrong type; expected Still or LightOrbit or CameraPan or Zoom or WorldScale or FarFromOrigin or GrowingLight or Tessellation or ClosingContact or OpeningMeshes; found Sill
s.ron:11:33: nothing changes in `Still`, so it has no values (leave out `values`)
s.ron:12:44: not a value of divisions of every triangle; expected a whole number in 0.0..=6.0; found 1.5
s.ron:12:49: not a value of divisions of every triangle; expected a whole number in 0.0..=6.0; found 9
s.ron:12:62: the suite has no scene of this name; found opne (did you mean open?)
s.ron:13:9: a sequence has no values; expected values: ..
s.ron:15:9: scene "open" has two sequences LightOrbit (name the scenes of each with `scenes`)
s.ron:18:37: nothing can be judged by this; expected wrong_outside_share, wrong_bit_share, rmse_penumbra; found wrong
s.ron:18:55: `at_most` is no share; expected a number in 0..=1; found 2
s.ron:19:9: bits can only be compared on the same light samples; expected truth_light_samples: 1, or judge by rmse_penumbra; found 64
s.ron:19:56: there is no such fact; found light_is_plane (did you mean light_is_planar?)
s.ron:20:9: a method has no graph; expected graph: ..
s.ron:20:9: a method has no judge; expected judge: ..
s.ron:22:14: an expectation has no why; expected why: ..
s.ron:22:19: `is` is of the wrong type; expected MustHold or ExpectedToFail or Open; found MayHold
s.ron:22:38: the suite has no method of this name; found hadr (did you mean hard?)
s.ron:22:57: `change` is of the wrong type; expected Still or LightOrbit or CameraPan or Zoom or WorldScale or FarFromOrigin or GrowingLight or Tessellation or ClosingContact or OpeningMeshes; found Zom"#;
    assert_eq!(problems, expected);
}

#[test]
fn names_of_suites_and_empty_lists() {
    assert_eq!(
        Suite::load("stabilty").unwrap_err().to_string(),
        "no built-in stability suite has this name; found stabilty (did you mean stability?)"
    );
    assert!(Suite::load("no/such.ron").unwrap_err().to_string().starts_with("no/such.ron: "));
    let problems = read("(version: 1, name: \"a\", scenes: [], sequences: [], methods: [])").unwrap_err().to_string();
    assert_eq!(problems.matches("is empty: nothing would run").count(), 3, "{problems}");
}

#[test]
fn the_built_in_suite_is_right_and_large_enough() {
    let suite = Suite::load("stability").unwrap();
    assert!(suite.scenes.len() >= 20 && suite.methods.len() >= 12, "{} {}", suite.scenes.len(), suite.methods.len());
    for (_, change) in sequence::CHANGES {
        assert!(suite.sequences.iter().any(|entry| entry.change == change), "{change:?}");
    }
    assert!(suite.expect.iter().all(|rule| rule.why.len() > 10));
}
