//! Bad graphs, with the sentence that a user gets.

use super::*;

#[test]
fn ten_mistakes_are_told_in_one_go() {
    let text = r#"(
    version: 2,
    nodes: [
        (id: "view_samples", pass: "rastre"),
        (id: "sample_filter", pas: "all"),
        (id: "light_frame", choose: [(when: "light_inside_scen", pass: "six_faces")]),
        (id: "list_build", params: {"size": 9000, "sise": 4}),
        (id: "list_scan", stage: "scna", in: {"length": "list_build.list_length"}),
        (id: "list_scan", stage: "scan", in: {"length": "list_build.list_length"}),
        (id: "casters"),
        (id: "conservative_raster", in: {"list_length": "list_scan.offset"}),
        (id: "caster_scan", stage: "scan", in: {"length": "conservative_raster.caster_lenght"}),
    ],
    outputs: {"offset": "caster_scan.offset", "pixel": "view_sample.pixel"},
)
"#;
    let expected = [
        "test.ron:2:14: graph format version is not known; expected 1; found 2",
        "test.ron:4:36: view_samples: stage `view_samples` has no pass `rastre` (did you mean `raster`?)",
        "test.ron:5:31: a node has no field `pas` (did you mean `pass`?)",
        "test.ron:6:45: light_frame: there is no fact `light_inside_scen` (did you mean `light_inside_scene`?)",
        "test.ron:7:45: list_build.size: parameter value not allowed; expected whole number 1..=8192; found 9000",
        "test.ron:7:51: list_build: pass `atomic_counters` has no parameter `sise` (did you mean `size`?)",
        "test.ron:8:34: list_scan: there is no stage `scna` (did you mean `scan`?)",
        "test.ron:9:14: list_scan: node id `list_scan` is given twice",
        "test.ron:11:57: conservative_raster.list_length: port is fed a value of another type; \
         expected u32 length [F S S]; found list_scan.offset: u32 offset [C+1] \
         (these fit: list_build.list_length)",
        "test.ron:12:59: caster_scan.length: node `conservative_raster` has no output `caster_lenght` \
         (did you mean `caster_length`?)",
        "test.ron:14:56: output `pixel`: there is no node `view_sample` (did you mean `view_samples`?)",
    ];
    assert_eq!(complaints(text), expected);
}

/// `nodes` and `outputs` in a file that has no other mistake; positions count from line 3.
fn told(nodes: &str, outputs: &str) -> Vec<String> {
    complaints(&format!("(version: 1,\nnodes: [\n{nodes}\n],\noutputs: {{{outputs}}})"))
}

#[test]
fn a_circle_is_named_hop_by_hop() {
    let nodes = r#"(id: "a", stage: "blur", in: {"mask": "b.blurred"}),
(id: "b", stage: "blur", in: {"mask": "c.blurred"}),
(id: "c", stage: "blur", in: {"mask": "a.blurred"}),
(id: "d", stage: "blur", in: {"mask": "a.blurred"})"#;
    assert_eq!(
        told(nodes, r#""mask": "d.blurred""#),
        ["test.ron:3:39: a: nodes feed each other in a circle; \
          found a.blurred -> c.mask, c.blurred -> b.mask, b.blurred -> a.mask"]
    );
    let own = r#"(id: "a", stage: "blur", in: {"mask": "a.blurred"})"#;
    assert_eq!(
        told(own, r#""mask": "a.blurred""#),
        ["test.ron:3:39: a: nodes feed each other in a circle; found a.blurred -> a.mask"]
    );
}

#[test]
fn an_open_port_names_what_fits() {
    assert_eq!(
        told(
            r#"(id: "view_samples"), (id: "sample_filter"), (id: "light_frame"), (id: "list_build"), (id: "scan")"#,
            r#""o": "scan.offset""#
        ),
        ["test.ron:3:92: scan.length: nothing feeds this port; expected u32 length [F S S] \
          (these fit: list_build.list_length; write in: {\"length\": \"list_build.list_length\"})"]
    );
    assert_eq!(
        told(r#"(id: "casters"), (id: "blur")"#, r#""m": "blur.blurred""#),
        ["test.ron:3:23: blur.mask: nothing feeds this port; expected u32 mask [P M] \
          (no node and no graph input gives such a value)"]
    );
}

#[test]
fn two_values_of_one_name_are_not_chosen_between() {
    let nodes = r#"(id: "view_samples"),
(id: "fine", stage: "sample_filter"),
(id: "coarse", stage: "sample_filter", pass: "all"),
(id: "light_frame")"#;
    assert_eq!(
        told(nodes, r#""f": "light_frame.light_frame""#),
        ["test.ron:6:6: light_frame.sample_state: more than one value has this port's name and type; \
          found fine.sample_state, coarse.sample_state (say which: in: {\"sample_state\": \"fine.sample_state\"})"]
    );
}

#[test]
fn wrong_types_are_told_where_they_stand() {
    assert_eq!(
        complaints("(version: \"1\", doc: 3, inputs: [4], nodes: {}, outputs: [])"),
        [
            "test.ron:1:11: graph format version is not known; expected 1; found \"1\"",
            "test.ron:1:21: `doc` is of the wrong type; expected text in quotes; found 3",
            "test.ron:1:33: `inputs` is of the wrong type; expected text in quotes; found 4",
            "test.ron:1:44: `nodes` is of the wrong type; expected a list [..]; found a map {..}",
            "test.ron:1:57: `outputs` is of the wrong type; expected a map {\"name\": value, ..}; found a list [..]",
        ]
    );
    assert_eq!(complaints("[]"), ["test.ron:1:1: a graph is a struct; expected (name: value, ..); found a list [..]"]);
    assert_eq!(
        complaints("()"),
        [
            "test.ron:1:1: graph has no outputs, so nothing would run; expected outputs: {\"image\": \"NODE.PORT\"}",
            "test.ron:1:1: graph states no version; expected version: 1"
        ]
    );
    assert_eq!(
        told(
            r#"(id: "a b"), (stage: "casters"), (id: "casters", on: Gpu, params: (size: slope))"#,
            r#""c": "casters.caster_state""#
        ),
        [
            "test.ron:3:6: not a node id; expected letters, digits, `_` and `-`; found \"a b\"",
            "test.ron:3:14: node has no id; expected id: \"NAME\"",
            "test.ron:3:54: `on` is of the wrong type; expected Cpu or Wgpu; found Gpu",
            "test.ron:3:67: `params` is of the wrong type; expected a map {\"name\": value, ..}; found a struct (name: ..)",
            "test.ron:3:68: casters: pass `all` has no parameter `size` (there are none)",
            "test.ron:3:74: words are written in quotes; expected \"slope\"; found slope",
        ]
    );
}

#[test]
fn equal_keys_are_found() {
    assert_eq!(
        told(
            r#"(id: "casters", id: "other"), (id: "list_scan", stage: "scan", in: {"length": "a.b", "length": "a.b"})"#,
            r#""c": "casters.caster_state", "c": "casters.caster_state""#
        ),
        [
            "test.ron:3:17: field `id` is given twice",
            "test.ron:3:79: list_scan.length: there is no node `a`",
            "test.ron:3:86: port `length` is given twice",
            "test.ron:5:40: output `c` is given twice",
        ]
    );
}

#[test]
fn text_that_is_no_ron_is_told_at_its_place() {
    for (text, expected) in [
        ("(version: 1", "test.ron:1:1: bracket is never closed; expected `)`; found the end of the text"),
        ("(version 1)", "test.ron:1:10: cannot read this; expected `:`; found `1`"),
        ("(version: 1]", "test.ron:1:12: cannot read this; expected `,` or `)`; found `]`"),
        ("(version: )", "test.ron:1:11: cannot read this; expected a value; found `)`"),
        ("(doc: \"ü\", \"a)", "test.ron:1:12: string is never closed"),
        ("(version: 1) 2", "test.ron:1:14: cannot read this; expected the end of the text; found `2`"),
        ("(version: 1,\n /* /* */ )", "test.ron:2:2: comment `/*` is never closed"),
        ("(version: 1.2.3)", "test.ron:1:11: `1.2.3` is not a number"),
        ("(doc: \"\\q\")", "test.ron:1:8: unknown escape in a string"),
        ("#![enable(implicit_some)] ()", "test.ron:1:1: attributes are not used in graph files"),
        ("(doc: ;)", "test.ron:1:7: unexpected character ';'"),
        ("", "test.ron:1:1: cannot read this; expected a value; found the end of the text"),
    ] {
        assert_eq!(complaints(text), [expected], "{text}");
    }
    let deep = "[".repeat(5000);
    assert_eq!(complaints(&deep), ["test.ron:1:33: nested deeper than 32 levels"]);
    let long = " ".repeat(crate::MAX_TEXT_BYTES + 1);
    assert_eq!(
        complaints(&long),
        ["test.ron:1:1: graph text is too long; expected at most 1048576 bytes; found 1048577 bytes"]
    );
}

#[test]
fn a_missing_comma_does_not_hide_the_rest() {
    assert_eq!(
        told("(id: \"casters\" pass: \"al\")", r#""c": "casters.caster_state""#),
        [
            "test.ron:3:16: cannot read this; expected `,` or `)`; found `pass`",
            "test.ron:3:22: casters: stage `casters` has no pass `al` (did you mean `all`?)"
        ]
    );
}

#[test]
fn a_pass_without_a_function_for_its_backend_names_its_peers() {
    let graph = load_builtin("hard_draw");
    assert_eq!(
        plan_of(&graph, &Overrides::default()).unwrap_err().to_string(),
        "builtin:hard_draw:5:40: visibility: pass `fused_draw` does not run on cpu \
         (these passes run there: planes, lu, lu_planar, lu_certain, fused, half_planes, bvh_rays, exact, shafts, silhouettes, multi_shadow_map; `on: Wgpu` runs this one)"
    );
    let problems = plan_of(&graph, &Overrides::default()).unwrap_err();
    assert_eq!(problems.0[0].kind, Kind::Unsupported);
}

#[test]
fn every_alternative_is_checked_when_facts_are_open() {
    // Only where the light is inside the scene is `cast` taken, and only where the scene is empty is `late` there.
    let nodes = r#"(id: "view_samples", on: Wgpu, choose: [(when: "light_inside_scene", pass: "cast")]),
(id: "late", stage: "sample_filter", when: "scene_is_empty"),
(id: "light_frame", in: {"sample_state": "late.sample_state"})"#;
    let outputs = r#""f": "light_frame.light_frame""#;
    assert_eq!(
        told(nodes, outputs),
        [
            "test.ron:3:26: view_samples: pass `cast` does not run on wgpu \
             (these passes run there: raster, import; `on: Cpu` runs this one)",
            "test.ron:5:42: light_frame.sample_state: port reads a node that is left out; \
             found `late` is left out: scene_is_empty does not hold",
        ]
    );
    // With facts, only what they leave is planned; names are looked up all the same.
    let text = format!("(version: 1, nodes: [{nodes}], outputs: {{{outputs}}})");
    let empty = Facts { scene_is_empty: true, ..facts() };
    let graph = load_text(&text).unwrap();
    let plan = plan(&graph, &catalogue(), input::ALL, Some(&empty), &Overrides::default()).unwrap();
    assert_eq!(ids(&plan), ["view_samples", "late", "light_frame"]);
}

#[test]
fn bad_flags_are_told_as_written() {
    let graph = load_builtin("shadow_map");
    let overrides = Overrides {
        swaps: vec![("shadow_lookup".into(), "pfc".into()), ("shadow_lookups".into(), "pcf".into())],
        sets: vec![
            ("light_depth".into(), "size".into(), "huge".into()),
            ("light_depth".into(), "bias".into(), "slop".into()),
            ("light_frame".into(), "marginn".into(), "1".into()),
        ],
        on: vec![("nowhere".into(), shadowgraph_core::plan::Backend::Cpu)],
        ..Overrides::default()
    };
    let problems = plan_of(&graph, &overrides).unwrap_err();
    assert_eq!(
        problems.to_string().lines().collect::<Vec<_>>(),
        [
            "command line: --swap shadow_lookup=pfc: shadow_lookup: stage `shadow_lookup` has no pass `pfc` (did you mean `pcf`?)",
            "command line: --swap shadow_lookups=pcf: there is no node `shadow_lookups` (did you mean `shadow_lookup`?)",
            "command line: --set light_depth.size=huge: light_depth.size: parameter value not allowed; \
             expected whole number 1..=8192; found \"huge\"",
            "command line: --set light_depth.bias=slop: light_depth.bias: parameter value not allowed; \
             expected one of constant, slope; found \"slop\" (did you mean \"slope\"?)",
            "command line: --set light_frame.marginn=1: light_frame: pass `fitted` has no parameter `marginn` (did you mean `margin`?)",
            "command line: --on nowhere=cpu: there is no node `nowhere`",
        ]
    );
}
