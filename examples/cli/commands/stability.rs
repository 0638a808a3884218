//! `shadowgraph stability`.

use crate::args::{BackendChoice, StabilityArgs};
use crate::engine::Machine;
use crate::report::Bar;
use crate::shard::Shard;
use crate::stability::records::Records;
use crate::stability::run::Runner;
use crate::stability::suite::Suite;
use crate::stability::text;
use crate::{file_problem, usage_problem};
use shadowgraph_charts::front::front;
use shadowgraph_charts::model::Stability;
use shadowgraph_charts::page::{self, Options};
use shadowgraph_core::pass::Catalogue;
use shadowgraph_core::problem::{Kind, Problem, Problems};
use shadowgraph_graph::nearest;
use std::cell::Cell;
use std::io::IsTerminal;
use std::time::{Instant, SystemTime};

/// Lines for those who read along in a file.
const SECONDS_BETWEEN_LINES: f64 = 15.0;
/// Bytes of pictures that the page may hold.
const PICTURES_MAX_BYTES: usize = 24 << 20;

/// What to print, and whether every method that must hold does.
///
/// # Errors
/// What is wrong with the suite or the flags; files that cannot be read or written.
pub fn text(catalogue: &Catalogue, args: &StabilityArgs) -> Result<(String, bool), Problems> {
    let suite = Suite::load(&args.suite)?;
    known("--scene", &args.scene, suite.scenes.iter().map(|scene| scene.name.as_str()))?;
    known("--method", &args.method, suite.methods.iter().map(|method| method.name.as_str()))?;
    let shard = Shard::read(&args.shard)?;
    let mut machine = Machine::new(args.backend)?;
    let cpu = Machine::new(BackendChoice::Cpu)?;
    let mut records = Records::open(&args.out, shard)?;
    let progress = Progress::new(args.quiet);
    let mut runner = Runner {
        suite: &suite,
        catalogue,
        machine: &mut machine,
        cpu: &cpu,
        folder: &args.out,
        methods: &args.method,
        scenes: &args.scene,
        shard,
        started: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
        progress: &|what, done, total| progress.tell(what, done, total),
    };
    let asked = runner.run(&mut records)?;
    drop(progress);
    let found: Vec<&Stability> = asked.iter().filter_map(|asked| records.find(&asked.id)).collect();
    let path = |name: &str| args.out.join(name);
    let write =
        |name: &str, text: &str| std::fs::write(path(name), text).map_err(|error| file_problem(&path(name), &error));
    write("table.md", &text::markdown(&found))?;
    let read = |name: &str| std::fs::read(path(name)).map_err(|error| file_problem(&path(name), &error));
    let options = Options {
        title: &format!("Stability: {}", suite.name),
        about: &suite.doc,
        picture: &read,
        pictures_max_bytes: PICTURES_MAX_BYTES,
        front: &front,
    };
    let page = page::stability(&found.iter().map(|record| (*record).clone()).collect::<Vec<_>>(), &options)?;
    write("stability.html", &page.html)?;
    let mut printed = text::report(&found);
    for remark in records.remarks.iter().chain(&page.remarks) {
        printed.push_str(&format!("note: {remark}\n"));
    }
    let earlier = asked.iter().filter(|asked| asked.was_there).count();
    let page = path("stability.html").display().to_string();
    printed.push_str(&format!("{} records, {earlier} of them of earlier runs; {page}\n", found.len()));
    Ok((printed, text::is_accepted(&found)))
}

fn known<'a>(flag: &str, given: &[String], known: impl Iterator<Item = &'a str> + Clone) -> Result<(), Problem> {
    let Some(stranger) = given.iter().find(|given| known.clone().all(|known| known != *given)) else { return Ok(()) };
    let remedy = match nearest(stranger, known.clone()) {
        Some(near) => format!("did you mean {near}?"),
        None => format!("there are {}", known.collect::<Vec<_>>().join(", ")),
    };
    let problem = usage_problem(format!("{flag} names nothing in the suite")).found(stranger).remedy(remedy);
    Err(Problem { kind: Kind::UnknownName, ..problem })
}

/// How far a run is, on stderr: a bar on a terminal, else a line now and then.
struct Progress {
    bar: Bar,
    has_lines: bool,
    begun: Instant,
    /// Seconds after the beginning when the last line was written.
    last: Cell<f64>,
}

impl Progress {
    fn new(quiet: bool) -> Self {
        let has_lines = !quiet && !std::io::stderr().is_terminal();
        Self { bar: Bar::new(quiet), has_lines, begun: Instant::now(), last: Cell::new(0.0) }
    }

    fn tell(&self, what: &str, done: usize, total: usize) {
        self.bar.set(what, done as u64, total as u64);
        let gone = self.begun.elapsed().as_secs_f64();
        if self.has_lines && gone - self.last.get() >= SECONDS_BETWEEN_LINES {
            self.last.set(gone);
            let left = if done == 0 { f64::NAN } else { gone / done as f64 * (total - done) as f64 };
            eprintln!("{done} of {total} records after {gone:.0} s, about {left:.0} s left: {what}");
        }
    }
}
