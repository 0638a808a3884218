//! What a machine can list is generated, and fresh. `SHADOWGRAPH_BLESS=1` writes it.

use crate::root;
use libtest_mimic::{Failed, Trial};

/// One trial a generated file, and limits of the written ones.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("docs/passes_md_is_fresh", || {
            fresh("docs/PASSES.md", &shadowgraph::commands::passes::markdown(&shadowgraph_passes::catalogue()))
        }),
        Trial::test("docs/architecture_is_short", || {
            let text =
                std::fs::read_to_string(root().join("docs/ARCHITECTURE.md")).map_err(|error| error.to_string())?;
            if text.lines().count() < 150 { Ok(()) } else { Err("150 lines or more".into()) }
        }),
        Trial::test("docs/the_paper_map_names_folders_that_exist", paper_map),
    ]
}

fn fresh(path: &str, text: &str) -> Result<(), Failed> {
    let file = root().join(path);
    if std::env::var("SHADOWGRAPH_BLESS").is_ok_and(|value| value == "1") {
        return std::fs::write(&file, text).map_err(|error| error.to_string().into());
    }
    let found = std::fs::read_to_string(&file).unwrap_or_default();
    if found == text { Ok(()) } else { Err(format!("{path} is stale; run ./test with SHADOWGRAPH_BLESS=1").into()) }
}

/// Every `passes/...` in backquotes is a folder or file; `{a,b}` stands for several.
fn paper_map() -> Result<(), Failed> {
    let text = std::fs::read_to_string(root().join("docs/PAPER.md")).map_err(|error| error.to_string())?;
    let mut count = 0;
    let mut missing = Vec::new();
    for word in text.split('`').filter(|word| word.starts_with("passes/")) {
        for path in expand(word) {
            count += 1;
            if !root().join(&path).exists() {
                missing.push(path);
            }
        }
    }
    assert!(count > 20, "only {count} folders are named");
    if missing.is_empty() { Ok(()) } else { Err(format!("no such folder: {}", missing.join(", ")).into()) }
}

fn expand(word: &str) -> Vec<String> {
    match word.split_once('{').zip(word.split_once('}')) {
        Some(((before, rest), (_, after))) => {
            let inside = rest.split('}').next().unwrap_or_default();
            inside.split(',').map(|part| format!("{before}{part}{after}")).collect()
        }
        None => vec![word.to_string()],
    }
}
