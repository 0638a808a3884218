//! Help texts: every example in them and in the README is a command line that the program understands, and every flag says what it is.

use crate::root;
use clap::{CommandFactory, Parser};
use libtest_mimic::{Failed, Trial};
use shadowgraph::args::Cli;

/// All of them.
pub fn trials() -> Vec<Trial> {
    vec![
        Trial::test("help/every_example_is_understood", examples),
        Trial::test("help/every_flag_says_what_it_is", flags),
        Trial::test("help/commands_that_measure_are_pinned", pinned),
        Trial::test("help/control/a_wrong_example_is_found", || {
            match understood("shadowgraph compare hard --swop visibility=fused  # a comment") {
                Err(_) => Ok(()),
                Ok(()) => Err("a flag that does not exist is understood".into()),
            }
        }),
    ]
}

/// Whether the words before a comment or a pipe are a command line.
fn understood(line: &str) -> Result<(), Failed> {
    let words = line.split_whitespace().take_while(|word| !["#", "|", ">"].contains(word));
    Cli::try_parse_from(words).map(|_| ()).map_err(|error| format!("{line}\n{error}").into())
}

fn example_lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines().map(str::trim).filter(|line| line.starts_with("shadowgraph "))
}

fn examples() -> Result<(), Failed> {
    let mut count = 0;
    let readme = std::fs::read_to_string(root().join("README.md")).map_err(|error| error.to_string())?;
    for line in example_lines(&readme) {
        understood(line)?;
        count += 1;
    }
    let mut program = Cli::command();
    program.build();
    let of = |command: &clap::Command| command.get_after_help().map(ToString::to_string).unwrap_or_default();
    let texts = std::iter::once(of(&program)).chain(program.get_subcommands().map(of));
    for text in texts.collect::<Vec<_>>() {
        for line in example_lines(&text) {
            understood(line)?;
            count += 1;
        }
    }
    assert!(count > 25, "only {count} examples");
    for name in ["compare", "chart", "merge", "suggest"] {
        let word = format!("shadowgraph {name} ");
        assert!(example_lines(&readme).any(|line| line.starts_with(&word)), "the README has no example of {name}");
    }
    Ok(())
}

fn flags() -> Result<(), Failed> {
    let mut program = Cli::command();
    program.build();
    for command in program.get_subcommands() {
        assert!(command.get_about().is_some(), "{} says nothing", command.get_name());
        for flag in command.get_arguments() {
            assert!(flag.get_help().is_some(), "{} {} says nothing", command.get_name(), flag.get_id());
        }
    }
    Ok(())
}

/// What scripts rely on: arguments in their order, flags with their values and defaults; those of scene and light left out.
fn usage(name: &str) -> Result<String, Failed> {
    let mut program = Cli::command();
    program.build();
    let command = program.find_subcommand(name).ok_or_else(|| format!("no command {name}"))?;
    let scene = ["scene", "views", "view", "eye", "target", "fov", "size", "view_samples", "help"];
    let is_own = |flag: &&clap::Arg| {
        let is_scenes = scene.contains(&flag.get_id().as_str()) && !["chart", "stability"].contains(&name)
            || flag.get_id() == "help";
        !is_scenes && flag.get_help_heading() != Some("Light")
    };
    let mut words = Vec::new();
    for flag in command.get_arguments().filter(is_own) {
        let value = flag.get_value_names().map(|names| names.join(" ")).unwrap_or_default();
        let default = flag.get_default_values().iter().map(|text| text.to_string_lossy()).collect::<Vec<_>>().join(" ");
        let mut word = match flag.get_long() {
            Some(long) if flag.get_action().takes_values() => format!("--{long} {value}"),
            Some(long) => format!("--{long}"),
            None => format!("<{value}>"),
        };
        if flag.get_action().takes_values() && !default.is_empty() {
            word += &format!("={default}");
        }
        words.push(word);
    }
    Ok(words.join(", "))
}

fn pinned() -> Result<(), Failed> {
    let mut wrong = String::new();
    for (name, expected) in PINNED {
        let found = usage(name)?;
        if found != expected.split_whitespace().collect::<Vec<_>>().join(" ") {
            wrong += &format!("{name} takes\n{found}\n");
        }
    }
    if wrong.is_empty() { Ok(()) } else { Err(wrong.into()) }
}

const PINNED: &[(&str, &str)] = &[
    (
        "compare",
        "<A>, <B>, --swap NODE=PASS, --set NODE.PARAM=VALUE, --on NODE=cpu|wgpu, --swap-a NODE=PASS, --set-a NODE.PARAM=VALUE,
         --on-a NODE=cpu|wgpu, --backend BACKEND=auto, --threads THREADS=0, --threshold SHARE=0.02, --seconds SECONDS=60,
         --blocks N=400, --seed SEED=1, --no-timing, --truth GRAPH, --no-truth, --attribute, --bisect, --out DIR, --json, --quiet",
    ),
    (
        "chart",
        "<SUITE>, --out DIR, --scenes DIR, --scene NAME, --shard I/N=1/1, --backend BACKEND=auto, --threads THREADS=0,
         --page-only, --json, --quiet",
    ),
    ("merge", "<PARTS>, --out DIR"),
    (
        "stability",
        "<SUITE>=stability, --out DIR=stability_out, --scene NAME, --method NAME, --shard I/N=1/1, --backend BACKEND=auto,
         --threads THREADS=0, --quiet",
    ),
    (
        "suggest",
        "--error ERROR, --ms MILLIS, --metric NAME, --suite SUITE, --chart DIR, --on NAME, --out DIR, --backend BACKEND=auto,
         --threads THREADS=0, --json, --quiet",
    ),
];
