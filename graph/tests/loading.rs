//! Files and their bases.

use super::*;

/// Loads `files[0]`; the others are what the loader finds.
fn load_files(files: &[(&str, &str)]) -> Result<Graph, Problems> {
    let source = Source { name: files[0].0.into(), text: files[0].1.into() };
    load(source, &|path| match files.iter().find(|(name, _)| *name == path) {
        Some((_, text)) => Ok(text.to_string()),
        None => no_files(path),
    })
}

fn refused(files: &[(&str, &str)]) -> Vec<String> {
    let planned = load_files(files).and_then(|graph| plan_of(&graph, &Overrides::default()));
    planned.err().map_or(Vec::new(), |problems| problems.0.iter().map(ToString::to_string).collect())
}

const CASTERS: &str = r#"(version: 1, nodes: [(id: "casters", pass: "al")], outputs: {"c": "casters.caster_state"})"#;

#[test]
fn a_mistake_is_told_in_the_file_that_holds_it() {
    let files = [
        (
            "a/one.ron",
            "(version: 1, base: \"../b/two.ron\",\n replace: [(id: \"caster\"), (id: \"casters\", params: {\"x\": 1})])",
        ),
        ("a/../b/two.ron", CASTERS),
    ];
    assert_eq!(
        refused(&files),
        [
            "a/one.ron:2:17: caster: the file replaces a node that its base does not have (did you mean `casters`?)",
            "a/../b/two.ron:1:44: casters: stage `casters` has no pass `al` (did you mean `all`?)",
        ]
    );
}

#[test]
fn bases_that_cannot_be_had_are_told_where_they_are_asked_for() {
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"two.ron\")")]),
        ["one.ron:1:20: no such file; found two.ron"]
    );
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"hrad\")")]),
        ["one.ron:1:20: no built-in graph of this name; found \"hrad\" \
          (did you mean `hard`?; a file's name ends in .ron)"]
    );
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"two.ron\")"), ("two.ron", "(version: 1, base: \"one.ron\")")]),
        ["two.ron:1:20: base comes back to a graph that builds on it; found one.ron"]
    );
    // A base that is no RON ends the reading, with the place in the base.
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"two.ron\")"), ("two.ron", "(version")]),
        ["two.ron:1:1: bracket is never closed; expected `)`; found the end of the text"]
    );
    let endless = load(Source { name: "0.ron".into(), text: "(version: 1, base: \"1.ron\")".into() }, &|path| {
        let next: usize = path.trim_end_matches(".ron").parse::<usize>().unwrap() + 1;
        Ok(format!("(version: 1, base: \"{next}.ron\")"))
    });
    assert_eq!(endless.unwrap_err().to_string(), "16.ron:1:20: too many bases; expected at most 16");
}

#[test]
fn sections_belong_to_files_with_or_without_a_base() {
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"hard\", nodes: [])")]),
        ["one.ron:1:28: `nodes` with a base (write replace, add and remove instead)"]
    );
    let differences =
        "replace: [(id: \"x\")], remove: [\"y\"], add: [(id: \"casters\")], outputs: {\"c\": \"casters.caster_state\"}";
    assert_eq!(
        refused(&[("one.ron", &format!("(version: 1, {differences})"))]),
        [
            "one.ron:1:14: `replace` without a base (write nodes instead)",
            "one.ron:1:36: `remove` without a base (write nodes instead)",
            "one.ron:1:51: `add` without a base (write nodes instead)",
        ]
    );
    let twice = "remove: [\"shde\"], replace: [(id: \"scan\")], add: [(id: \"casters\")]";
    assert_eq!(
        refused(&[("one.ron", &format!("(version: 1, base: \"hard\", {twice})"))]),
        [
            "one.ron:1:37: shde: the file removes a node that its base does not have (did you mean `shade`?)",
            "one.ron:1:61: scan: the file replaces a node that its base does not have",
            "one.ron:1:82: casters: node id `casters` is given twice",
        ]
    );
}

#[test]
fn a_removed_node_is_missed_where_it_was_read() {
    assert_eq!(
        refused(&[("one.ron", "(version: 1, base: \"shadow_map\", remove: [\"bent_light\"])")]),
        ["builtin:shadow_map:12:14: shade.corner_light: nothing feeds this port; expected u32 corner_light [P] \
          (no node and no graph input gives such a value)"]
    );
}

#[test]
fn axes_are_checked() {
    let text = r#"(version: 1, base: "shadow_map", axes: {
"shadow_lookup": ["pfc", 3],
"light_depth.sise": [1],
"light_depth.size": [256, 9000],
"casterz": ["all"],
"light_depth.bias": [],
})"#;
    assert_eq!(
        refused(&[("one.ron", text)]),
        [
            "one.ron:2:19: shadow_lookup: stage `shadow_lookup` has no pass `pfc` (did you mean `pcf`?)",
            "one.ron:2:26: shadow_lookup: an axis over a node lists passes; expected text in quotes; found 3",
            "one.ron:3:1: light_depth: no pass of stage `light_depth` has a parameter `sise` (did you mean `size`?)",
            "one.ron:4:27: light_depth.size: parameter value not allowed; expected whole number 1..=8192; found 9000",
            "one.ron:5:1: there is no node `casterz` (did you mean `casters`?)",
            "one.ron:6:1: axis `light_depth.bias` has no values",
        ]
    );
    let values: Vec<String> = (0..101).map(|value| value.to_string()).collect();
    let list = values.join(", ");
    let text = format!(
        "(version: 1, base: \"shadow_map\", axes: {{\"light_depth.size\": [{list}], \"shadow_lookup.taps\": [{list}]}})"
    );
    let graph = load_files(&[("one.ron", &text)]).unwrap();
    let problems = crate::variants(&graph, &Overrides::default()).unwrap_err();
    assert_eq!(problems.to_string(), "one.ron:1:41: axes make too many variants; expected at most 10000; found 10201");
}

#[test]
fn light_samples_are_the_files_own_else_its_bases() {
    let count = |files: &[(&str, &str)]| load_files(files).unwrap().light_samples();
    let base = "(version: 1, light_samples: 256, nodes: [], outputs: {\"a\": \"triangles\"})";
    assert_eq!(count(&[("one.ron", base)]), Some(256));
    assert_eq!(count(&[("one.ron", "(version: 1, base: \"two.ron\")"), ("two.ron", base)]), Some(256));
    let own = "(version: 1, base: \"two.ron\", light_samples: 1)";
    assert_eq!(count(&[("one.ron", own), ("two.ron", base)]), Some(1));
    assert_eq!(count(&[("one.ron", "(version: 1, base: \"hard\")")]), None);
    for (value, found) in [("0", "0"), ("4097", "4097"), ("2.5", "2.5"), ("\"256\"", "\"256\"")] {
        let text = base.replace("256", value);
        assert_eq!(
            refused(&[("one.ron", &text)]),
            [format!(
                "one.ron:1:29: `light_samples` is no number of light samples; expected a whole number in 1..=4096; \
                 found {found}"
            )]
        );
    }
}
