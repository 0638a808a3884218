//! Traces obey their format whatever nodes are called and whatever clocks say.

use super::clocks::Clocks;
use super::times::{Readings, Series};
use super::{MeasuredFrame, NodeProfile, Profile, csv, trace};
use crate::args::{BackendChoice, Cli, Command};
use crate::engine::Machine;
use crate::graph_choice;
use crate::job::Job;
use crate::outcome::Outcome;
use crate::record::RunRecord;
use crate::stretch::{Frame, Ran};
use clap::Parser;
use proptest::prelude::*;
use serde_json::{Value, json};
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::reading::Reading;
use shadowgraph_graph::Keep;
use std::sync::{Arc, Mutex};
use tracing_subscriber::fmt::format::FmtSpan;

/// Names that break a writer that does not escape.
const ODD: [&str; 6] =
    ["<b>&\"quoted\"\\</b>", "tab\tnew\nline\u{0}\u{1f}", "Schatten ☂ \u{202e}", "", "'}],", "\u{7f}\u{2028}"];

fn node(name: &str, on: Backend) -> NodeProfile {
    NodeProfile {
        node: name.into(),
        stage: "stage",
        pass: "pass",
        on,
        clock: "a clock",
        in_frame: Series::default(),
        alone: None,
        disagrees: false,
        bytes: 12,
        scratch_bytes: None,
        counts: vec![("pairs", 7)],
        statistics: None,
    }
}

fn profile_of(nodes: Vec<NodeProfile>, frames: Vec<MeasuredFrame>) -> Profile {
    let Command::Render(args) = Cli::parse_from(["x", "render", "hard", "--scene", "builtin:one-triangle"]).command
    else {
        unreachable!("render was asked for")
    };
    let (job, machine) = (Job::load(&args.scene).unwrap(), Machine::new(BackendChoice::Cpu).unwrap());
    let plan = Plan { name: ODD[0].into(), ..Plan::default() };
    Profile {
        cold: RunRecord::new(&plan, &job, machine.record(), &Outcome::new(&plan)),
        warm_up_count: 0,
        clocks: Clocks {
            timers: true,
            node_clocks: vec!["a clock"],
            has_timestamps: None,
            is_software_rasteriser: false,
            in_frame: Readings::default(),
            alone: Readings::default(),
            cost: None,
        },
        frame: None,
        timed_frame: None,
        overlap: None,
        memory_bytes: None,
        nodes,
        frames,
        not_measured: Vec::new(),
    }
}

fn frame(begin_millis: f64, millis: f64, pieces: Vec<(usize, Reading)>) -> MeasuredFrame {
    MeasuredFrame { timers: true, begin_millis, millis, pieces }
}

fn events(profile: &Profile) -> Vec<Value> {
    let trace: Value = serde_json::from_str(&trace::text(profile)).unwrap();
    let events = trace["traceEvents"].as_array().unwrap().clone();
    assert_eq!(faults(&events), Vec::<String>::new());
    events
}

/// What Perfetto would drop or refuse.
fn faults(events: &[Value]) -> Vec<String> {
    let mut faults = Vec::new();
    let mut fault = |event: &Value, what: &str| faults.push(format!("{what}: {event}"));
    let nanos = |value: &Value| value.as_f64().filter(|x| x.is_finite() && *x >= 0.0).map(|x| (x * 1e3).round() as i64);
    let is_meta = |event: &Value, what: &str| event["ph"] == "M" && event["name"] == what;
    let mut by_thread: Vec<(u64, Vec<[i64; 2]>)> = Vec::new();
    for event in events {
        let (Some(thread), Some(_), Some(_)) = (event["tid"].as_u64(), event["pid"].as_u64(), event["name"].as_str())
        else {
            fault(event, "no name, pid or tid");
            continue;
        };
        let Some(ts) = nanos(&event["ts"]) else {
            fault(event, "ts is no time");
            continue;
        };
        match event["ph"].as_str() {
            Some("X") => match nanos(&event["dur"]) {
                None => fault(event, "dur is no length"),
                Some(dur) => match by_thread.iter_mut().find(|(known, _)| *known == thread) {
                    Some((_, spans)) => spans.push([ts, ts + dur]),
                    None => by_thread.push((thread, vec![[ts, ts + dur]])),
                },
            },
            Some("i") if ["g", "p", "t"].iter().any(|scope| event["s"] == *scope) => {}
            Some("M") if event["args"]["name"].is_string() || event["args"]["sort_index"].is_u64() => {}
            _ => fault(event, "no such kind of event"),
        }
        let has_name = |other: &Value| is_meta(other, "thread_name") && other["tid"] == thread;
        if !events.iter().any(has_name) {
            fault(event, "its thread has no name");
        }
    }
    for (thread, mut spans) in by_thread {
        spans.sort_by_key(|[begin, end]| (*begin, -end));
        let mut open: Vec<[i64; 2]> = Vec::new();
        for [begin, end] in spans {
            while open.last().is_some_and(|last| last[1] <= begin && *last != [begin, end]) {
                open.pop();
            }
            if open.last().is_some_and(|last| last[1] < end) {
                faults.push(format!("thread {thread}: {begin}..{end} overlaps {:?} in part", open.last()));
            }
            open.push([begin, end]);
        }
    }
    if !events.iter().any(|event| is_meta(event, "process_name")) {
        faults.push("the process has no name".into());
    }
    faults
}

#[test]
fn broken_traces_are_found() {
    let slice = |ts: f64, dur: f64| json!({ "name": "n", "ph": "X", "pid": 1, "tid": 1, "ts": ts, "dur": dur });
    let of = |mut more: Vec<Value>| {
        more.push(json!({ "name": "thread_name", "ph": "M", "pid": 1, "tid": 1, "ts": 0, "args": { "name": "t" } }));
        more.push(json!({ "name": "process_name", "ph": "M", "pid": 1, "tid": 1, "ts": 0, "args": { "name": "p" } }));
        faults(&more).len()
    };
    assert_eq!(of(vec![slice(0.0, 5.0), slice(1.0, 2.0), slice(3.0, 2.0), slice(5.0, 1.0)]), 0);
    assert_eq!(of(vec![slice(0.0, 5.0), slice(4.0, 2.0)]), 1, "overlap in part");
    assert_eq!(of(vec![slice(0.0, -1.0)]), 1, "negative");
    assert_eq!(of(vec![slice(f64::NAN, 1.0)]), 1, "not a number");
    assert_eq!(of(vec![json!({ "name": "n", "ph": "X", "pid": 1, "tid": 1, "ts": 0 })]), 1, "no length");
    assert_eq!(of(vec![json!({ "ph": "X", "pid": 1, "tid": 1, "ts": 0, "dur": 1 })]), 1, "no name");
    assert_eq!(
        of(vec![json!({ "name": "n", "ph": "X", "pid": 1, "tid": 2, "ts": 0, "dur": 1 })]),
        1,
        "thread without name"
    );
}

#[test]
fn odd_names_survive_in_trace_and_table() {
    let nodes: Vec<_> = ODD.iter().map(|name| node(name, Backend::Wgpu)).collect();
    let pieces = (0..ODD.len()).map(|index| (index, Reading::of(index as f64, index as f64 + 0.5))).collect();
    let profile = profile_of(nodes, vec![frame(0.0, 10.0, pieces)]);
    let events = events(&profile);
    let names: Vec<_> = events.iter().filter(|event| event["cat"] == "node").map(|event| &event["name"]).collect();
    assert_eq!(names, ODD.iter().collect::<Vec<_>>());
    assert!(events.iter().any(|event| event["args"]["counts"]["pairs"] == 7 && event["args"]["bytes"] == 12));
    // Every row of the table has as many cells as its header.
    let table = csv::text(&profile);
    let header = table.lines().next().unwrap().split(',').count();
    let (mut cells, mut is_quoted, mut rows) = (1, false, 0);
    for letter in table.chars() {
        match letter {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells += 1,
            '\n' if !is_quoted => {
                assert_eq!(cells, header);
                (cells, rows) = (1, rows + 1);
            }
            _ => {}
        }
    }
    assert_eq!(rows, 1 + ODD.len());
}

#[test]
fn readings_that_are_no_span_are_instants_that_say_so() {
    let readings = [Reading::Zero, Reading::Negative, Reading::Dropped, Reading::Untimed, Reading::of(1.0, 2.0)];
    let nodes = (0..readings.len()).map(|index| node(&format!("n{index}"), Backend::Wgpu)).collect();
    let events = events(&profile_of(nodes, vec![frame(3.0, 4.0, readings.into_iter().enumerate().collect())]));
    let texts: Vec<_> =
        events.iter().filter(|event| event["ph"] == "i").map(|event| event["args"]["reading"].to_string()).collect();
    assert_eq!(texts.len(), 4);
    for (text, word) in texts.iter().zip(["zero", "negative", "dropped", "not timed"]) {
        assert!(text.contains(word), "{text}");
    }
    let spans: Vec<_> = events.iter().filter(|event| event["cat"] == "node").map(|event| &event["name"]).collect();
    assert_eq!(spans, ["n4"]);
}

#[test]
fn nodes_beside_one_another_have_threads_of_their_own_and_frames_are_parents() {
    let nodes = ["a", "b", "c"].map(|name| node(name, Backend::Wgpu)).to_vec();
    let pieces = vec![(0, Reading::of(0.0, 3.0)), (1, Reading::of(2.0, 4.0)), (2, Reading::of(3.0, 9.0))];
    // The device says that the first frame took longer than the host does, past the begin of the second.
    let frames = vec![frame(0.0, 5.0, pieces.clone()), frame(5.5, 9.5, pieces)];
    let events = events(&profile_of(nodes, frames));
    let at = |name: &str, tid: u64| {
        let found = events.iter().filter(|event| event["name"] == name && event["tid"] == tid);
        found.map(|event| event["ts"].as_f64().unwrap()).collect::<Vec<_>>()
    };
    assert_eq!((at("a", 2), at("b", 3), at("c", 2)), (vec![0.0, 9000.0], vec![2000.0, 11000.0], vec![3000.0, 12000.0]));
    assert_eq!((at("frame 1", 1), at("frame 2", 1)), (vec![0.0], vec![9000.0]));
    assert_eq!((at("frame 1", 2), at("frame 2", 3)), (vec![0.0], vec![11000.0]));
}

fn reading() -> impl Strategy<Value = Reading> {
    prop_oneof![
        4 => (0.0..20.0f64, 0.0..20.0f64).prop_map(|(one, other)| Reading::of(one, other)),
        1 => Just(Reading::Dropped),
        1 => Just(Reading::Untimed),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_clocks_say_the_trace_obeys_its_format(
        frames in prop::collection::vec((0.0..3.0f64, 0.0..9.0f64, prop::collection::vec((0usize..3, reading()), 0..9)), 1..6),
    ) {
        // Nodes of the CPU come one after another.
        let nodes = ["a", "b", "c"].map(|name| node(name, Backend::Wgpu)).to_vec();
        let mut begin = 0.0;
        let mut measured = Vec::new();
        for (pause, millis, pieces) in frames {
            begin += pause;
            measured.push(frame(begin, millis, pieces));
        }
        events(&profile_of(nodes, measured));
    }
}

struct Seen(Arc<Mutex<Vec<u8>>>);

impl std::io::Write for Seen {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// Nodes of a device that the host times one by one have gaps between them, which their sum has not.
#[test]
fn stretches_come_one_after_another() {
    let ran = |node, begin, end| Ran {
        node,
        millis: Some(end - begin),
        reading: Reading::of(begin, end),
        bytes: 0,
        clock: "",
        counts: Vec::new(),
    };
    let plan = plan_on(BackendChoice::Cpu).0;
    let mut frame = Frame::new(&plan);
    frame.add(&plan, 3.0, vec![ran(0, 0.0, 1.0), ran(1, 2.0, 4.0)]);
    frame.add(&plan, 1.0, vec![ran(2, 0.0, 1.0)]);
    assert_eq!((frame.millis, frame.pieces[2]), (4.0, (2, Reading::of(4.0, 5.0))));
}

/// A plan on one backend, with its job and machine.
fn plan_on(choice: BackendChoice) -> (Plan, Job, Machine) {
    let Command::Render(args) =
        Cli::parse_from(["x", "render", "hard", "--scene", "builtin:one-triangle", "--size", "8x8"]).command
    else {
        unreachable!("render was asked for")
    };
    let (job, machine) = (Job::load(&args.scene).unwrap(), Machine::new(choice).unwrap());
    let catalogue = shadowgraph_passes::catalogue();
    let facts = Some(&job.facts);
    let plan = graph_choice::plan(&args.graph, &catalogue, facts, machine.default_backend, Keep::OutputsOnly).unwrap();
    (plan, job, machine)
}

/// What a host's subscriber sees of a run.
fn spans_of(choice: BackendChoice) -> String {
    let (plan, job, machine) = plan_on(choice);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let subscriber = tracing_subscriber::fmt()
        .with_ansi(false)
        .with_max_level(tracing::Level::INFO)
        .with_span_events(FmtSpan::NEW)
        .with_writer({
            let seen = seen.clone();
            move || Seen(seen.clone())
        })
        .finish();
    tracing::subscriber::with_default(subscriber, || machine.run(&plan, &job, 1, &|_, _, _| {}).unwrap());
    let seen = seen.lock().unwrap().clone();
    String::from_utf8(seen).unwrap()
}

#[test]
fn a_subscriber_sees_frames_and_nodes_of_both_backends() {
    let cpu = spans_of(BackendChoice::Cpu);
    assert!(cpu.contains("frame{graph=\"builtin:hard\"") || cpu.contains("frame{graph=\"hard\""), "{cpu}");
    assert!(cpu.contains("node{id=\"visibility\" pass=\"planes\"}"), "{cpu}");
    if shadowgraph_wgpu::Session::shared_or_skip("a_subscriber_sees_frames_and_nodes_of_both_backends").is_some() {
        let wgpu = spans_of(BackendChoice::Wgpu);
        assert!(wgpu.contains("stretch{"), "{wgpu}");
        // On a device's own clock an event says when a node ran.
        assert!(wgpu.contains("node{id=\"visibility\"") || wgpu.contains("node id=\"visibility\""), "{wgpu}");
    }
}
