//! Measured frames in the Chrome trace format, as Perfetto reads it.
//!
//! Thread 1 is the host's clock: every frame, and the nodes that run on the CPU. From thread 2 on are the nodes of the device, each
//! frame as their parent; what runs beside another node has a thread of its own, because Perfetto drops slices of one thread that overlap
//! without one holding the other. Clocks of host and device are not synchronised: a device's first stamp is put where the host began
//! the frame. Readings that are no span are instants that say what they are.
//!
//! Format: "Trace Event Format" (complete, instant and metadata events); times are microseconds, here whole nanoseconds.

use super::{MeasuredFrame, NodeProfile, Profile};
use serde_json::{Map, Value, json};
use shadowgraph_core::plan::Backend;
use shadowgraph_core::reading::Reading;

/// All events belong to this process.
const PROCESS: u64 = 1;
/// Thread of the host's clock; the device's threads follow.
const HOST: u64 = 1;

/// The file's text.
pub fn text(profile: &Profile) -> String {
    let mut events = Events::default();
    let mut free_ns = 0;
    let (mut timed, mut untimed) = (0, 0);
    for frame in &profile.frames {
        let count = if frame.timers { &mut timed } else { &mut untimed };
        *count += 1;
        let name = format!("frame {count}{}", if frame.timers { "" } else { ", timers off" });
        // Where a device's clock runs longer than the host's, what follows is moved so far that frames stay apart.
        free_ns = events.frame(profile, frame, &name, free_ns.max(nanos(frame.begin_millis)));
    }
    let mut all = events.names(profile);
    all.append(&mut events.all);
    let cold = &profile.cold;
    let trace = json!({
        "displayTimeUnit": "ms",
        "otherData": {
            "version": cold.version,
            "graph": cold.graph,
            "graph_hash": cold.graph_hash,
            "scene": cold.scene.name,
            "adapter": cold.device.adapter,
            "driver": cold.device.driver,
            "software_rasteriser": profile.clocks.is_software_rasteriser,
        },
        "traceEvents": all,
    });
    format!("{trace}\n")
}

#[derive(Default)]
struct Events {
    all: Vec<Value>,
    /// Threads of the device that were used, at most.
    device_threads: usize,
}

/// A node's span, nanoseconds since the trace began.
struct Slice {
    node: usize,
    begin: i64,
    end: i64,
}

impl Events {
    /// All events of a frame that begins at `start`; the end of the last.
    fn frame(&mut self, profile: &Profile, frame: &MeasuredFrame, name: &str, start: i64) -> i64 {
        let mut end = start + nanos(frame.millis);
        // By thread, the host's first.
        let mut threads: Vec<Vec<Slice>> = vec![Vec::new()];
        let mut pieces: Vec<&(usize, Reading)> = frame.pieces.iter().collect();
        pieces.sort_by(|(_, one), (_, other)| begin_of(*one).total_cmp(&begin_of(*other)));
        for (node, reading) in pieces {
            let on_device = profile.nodes[*node].on == Backend::Wgpu;
            let Reading::Span { begin, end } = *reading else {
                let thread = HOST + u64::from(on_device);
                self.device_threads = self.device_threads.max(usize::from(on_device));
                self.instant(&profile.nodes[*node], reading_text(*reading), thread, start);
                continue;
            };
            let slice = Slice { node: *node, begin: start + nanos(begin), end: start + nanos(end) };
            let fits = |slices: &Vec<Slice>| slices.last().is_none_or(|last| last.end <= slice.begin);
            let place = match on_device {
                // What the CPU does comes one after another.
                false => 0,
                true => 1 + threads[1..].iter().take_while(|slices| !fits(slices)).count(),
            };
            if place == threads.len() {
                threads.push(Vec::new());
            }
            threads[place].push(slice);
        }
        self.device_threads = self.device_threads.max(threads.len() - 1);
        for (place, slices) in threads.iter().enumerate() {
            let thread = HOST + place as u64;
            let last = slices.iter().map(|slice| slice.end).max().unwrap_or(start);
            let parent = if place == 0 { end.max(last) } else { last };
            let first = if place == 0 { start } else { slices.iter().map(|slice| slice.begin).min().unwrap_or(start) };
            let args = json!({ "millis": frame.millis, "timers": frame.timers });
            self.slice(name, "frame", thread, [first, parent], args);
            for slice in slices {
                let node = &profile.nodes[slice.node];
                self.slice(&node.node, "node", thread, [slice.begin, slice.end], args_of(node));
            }
            end = end.max(parent);
        }
        end
    }

    fn slice(&mut self, name: &str, category: &str, thread: u64, [begin, end]: [i64; 2], args: Value) {
        self.all.push(json!({
            "name": name,
            "cat": category,
            "ph": "X",
            "pid": PROCESS,
            "tid": thread,
            "ts": micros(begin),
            "dur": micros(end - begin),
            "args": args,
        }));
    }

    fn instant(&mut self, node: &NodeProfile, why: &str, thread: u64, at: i64) {
        let mut args = args_of(node);
        args["reading"] = why.into();
        self.all.push(json!({
            "name": node.node,
            "cat": "reading",
            "ph": "i",
            "s": "t",
            "pid": PROCESS,
            "tid": thread,
            "ts": micros(at),
            "args": args,
        }));
    }

    /// Names of the process and of the threads that were used.
    fn names(&self, profile: &Profile) -> Vec<Value> {
        let meta = |what: &str, thread: u64, args: Value| json!({ "name": what, "ph": "M", "pid": PROCESS, "tid": thread, "ts": 0, "args": args });
        let cold = &profile.cold;
        let process = format!("shadowgraph: {} on {}", cold.graph, cold.scene.name);
        let mut events = vec![meta("process_name", HOST, json!({ "name": process }))];
        for place in 0..=self.device_threads {
            let thread = HOST + place as u64;
            let name = match place {
                0 => "CPU, host clock".to_string(),
                1 => format!("GPU: {}{}", cold.device.adapter, clock_of(profile)),
                _ => format!("GPU, beside other nodes {}", place - 1),
            };
            events.push(meta("thread_name", thread, json!({ "name": name })));
            events.push(meta("thread_sort_index", thread, json!({ "sort_index": place })));
        }
        events
    }
}

fn clock_of(profile: &Profile) -> String {
    let clock = profile.nodes.iter().find(|node| node.on == Backend::Wgpu).map(|node| node.clock);
    clock.filter(|clock| !clock.is_empty()).map(|clock| format!(" ({clock})")).unwrap_or_default()
}

fn args_of(node: &NodeProfile) -> Value {
    let counts: Map<String, Value> =
        node.counts.iter().map(|(name, count)| (name.to_string(), (*count).into())).collect();
    let stage_pass = format!("{}/{}", node.stage, node.pass);
    json!({ "pass": stage_pass, "clock": node.clock, "bytes": node.bytes, "counts": counts })
}

fn reading_text(reading: Reading) -> &'static str {
    match reading {
        Reading::Span { .. } => "a span",
        Reading::Untimed => "not timed",
        Reading::Zero => "zero: begin and end are one",
        Reading::Negative => "negative: the end comes before the begin",
        Reading::Dropped => "dropped: the device wrote no stamps",
    }
}

fn begin_of(reading: Reading) -> f64 {
    match reading {
        Reading::Span { begin, .. } => begin,
        _ => 0.0,
    }
}

fn nanos(millis: f64) -> i64 {
    (millis * 1e6).round() as i64
}

fn micros(nanos: i64) -> f64 {
    nanos as f64 / 1e3
}
