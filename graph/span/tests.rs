//! The tree against `ron`, and places against the text.

use super::*;
use crate::source::Findings;

fn tree(text: &str) -> Tree {
    let mut findings = Findings::default();
    let tree = parse(text, 0, &mut findings);
    assert!(findings.is_empty(), "{text}: {findings:?}");
    tree.unwrap_or_else(|| panic!("{text}"))
}

#[test]
fn spans_cover_their_values() {
    let text = "( /* c */ a: [1, \"ü\"], // end\n b: {\"k\": (x: Cpu)})";
    let Data::Struct(fields) = tree(text).data else { panic!("no struct") };
    let slice = |span: crate::source::Span| &text[span.start as usize..span.end as usize];
    assert_eq!(slice(fields[0].span), "a");
    assert_eq!(slice(fields[0].value.span), "[1, \"ü\"]");
    let Data::List(items) = &fields[0].value.data else { panic!("no list") };
    assert_eq!((slice(items[1].span), &items[1].data), ("\"ü\"", &Data::Text("ü".into())));
    assert_eq!(slice(fields[1].value.span), "{\"k\": (x: Cpu)}");
    let Data::Map(entries) = &fields[1].value.data else { panic!("no map") };
    assert_eq!((slice(entries[0].0.span), slice(entries[0].1.span)), ("\"k\"", "(x: Cpu)"));
}

#[test]
fn equal_keys_stay_in_the_order_of_the_text() {
    let Data::Map(entries) = tree("{\"a\": 1, \"a\": 2}").data else { panic!("no map") };
    assert_eq!(entries.len(), 2);
}

#[test]
fn numbers_and_strings_are_those_of_ron() {
    for text in ["0", "-7", "+7", "1_000", "1.5", "-.5", "2.", "1e3", "1.5E-3", "inf", "-inf"] {
        let Data::Number(number) = tree(text).data else { panic!("{text}") };
        let theirs: f64 = ron::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(number.real, theirs, "{text}");
    }
    for text in ["0", "-7", "+7", "0x1F", "0b101", "0o17", "1_000"] {
        let Data::Number(number) = tree(text).data else { panic!("{text}") };
        let theirs: i64 = ron::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(number.whole, Some(i128::from(theirs)), "{text}");
    }
    for text in [r#""""#, r#""a\n\t\"\\""#, r#""\x41\u{1F600}""#, "\"a\\\n   b\"", "r\"a\\b\"", "r##\"a\"#b\"##"] {
        let theirs: String = ron::from_str(text).unwrap_or_else(|error| panic!("{text}: {error}"));
        assert_eq!(tree(text).data, Data::Text(theirs), "{text}");
    }
}

#[test]
fn what_only_we_would_read_is_refused_at_its_place() {
    let mut findings = Findings::default();
    let text = "\u{feff}(\n  a: 1._5)";
    assert!(parse(text, 0, &mut findings).is_none());
    let files = crate::source::Files(vec![crate::Source { name: "t".into(), text: text.into() }]);
    assert_eq!(findings.finish(&files, &[]).to_string(), "t:2:6: Unexpected underscore in float");
    assert_eq!(tree("\u{feff}true").data, Data::Bool(true));
}
