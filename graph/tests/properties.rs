//! Whatever the text, the answer is a plan or problems.

use super::*;
use proptest::prelude::*;

const MAX_CASES: u32 = 300;

/// Loads and plans, looks at every drawing of what comes out; problems must have a place in the text.
fn try_text(text: &str) {
    let outcome = load_text(text).and_then(|graph| plan(&graph, &catalogue(), input::ALL, None, &Overrides::default()));
    match outcome {
        Ok(plan) => {
            let text = crate::resolved_text(&plan);
            assert!(plan_text(&text).is_ok(), "{text}");
            let _ = (crate::describe(&plan), crate::drawing::svg(&plan));
        }
        Err(problems) => {
            assert!(!problems.0.is_empty());
            for problem in &problems.0 {
                let place = problem.place.as_ref().unwrap_or_else(|| panic!("no place: {problem}"));
                assert!(place.line >= 1 && place.column >= 1, "{problem}");
                assert!(place.file != "test.ron" || place.line <= text.split('\n').count(), "{problem}");
            }
        }
    }
}

/// One change of a text.
#[derive(Clone, Debug)]
enum Change {
    Cut(usize, usize),
    Insert(usize, String),
    Repeat(usize, usize, usize),
}

fn change() -> impl Strategy<Value = Change> {
    let piece = prop_oneof![
        "[\\PC\n]{0,6}",
        proptest::sample::select(vec![
            "(",
            ")",
            "[",
            "]",
            "{",
            "}",
            ",",
            ":",
            "\"",
            "\\",
            "//",
            "/*",
            "*/",
            "r#\"",
            "-",
            "0x",
            "1e999",
            "inf",
            "in",
            "params: {\"size\": ",
            "id: \"shade\"",
            "base: \"hard\",",
            "\u{feff}",
            "é",
            "\n",
        ])
        .prop_map(String::from),
    ];
    prop_oneof![
        (0..10_000usize, 0..40usize).prop_map(|(at, length)| Change::Cut(at, length)),
        (0..10_000usize, piece).prop_map(|(at, text)| Change::Insert(at, text)),
        (0..10_000usize, 0..200usize, 0..10_000usize).prop_map(|(from, length, to)| Change::Repeat(from, length, to)),
    ]
}

fn apply(text: &mut Vec<char>, change: Change) {
    let place = |at: usize, text: &[char]| at % (text.len() + 1);
    match change {
        Change::Cut(at, length) => {
            let at = place(at, text);
            let end = (at + length).min(text.len());
            text.drain(at..end);
        }
        Change::Insert(at, piece) => {
            let at = place(at, text);
            text.splice(at..at, piece.chars());
        }
        Change::Repeat(from, length, to) => {
            let from = place(from, text);
            let piece: Vec<char> = text[from..(from + length).min(text.len())].to_vec();
            let to = place(to, text);
            text.splice(to..to, piece);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: MAX_CASES, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn changed_graphs_never_panic(
        name in proptest::sample::select(crate::builtin_names()),
        changes in proptest::collection::vec(change(), 1..6),
    ) {
        let mut text: Vec<char> = crate::builtin(name).unwrap_or_default().chars().collect();
        changes.into_iter().for_each(|change| apply(&mut text, change));
        try_text(&text.into_iter().collect::<String>());
    }

    #[test]
    fn any_text_never_panics(text in "[\\PC\n\"(){}\\[\\]:,]{0,200}") {
        try_text(&text);
    }
}
