//! Passes so small that their outputs can be counted by hand.

use crate::adapter::Wanted;
use crate::features::{check_features, required_features};
use crate::segment::Segment;
use crate::timing::Clock;
use crate::{Options, Outcome, Prepared, Request, Session};
use shadowgraph_core::array::Array;
use shadowgraph_core::array::Element::U32;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Feature, Pass};
use shadowgraph_core::plan::{Backend, Node, Plan, Producer, Slot};
use shadowgraph_core::port::{Direction::Out, Port};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, Dispatch, GpuCx, GpuFn, Groups, Shader, Target};
use shadowgraph_core::shared::PRELUDE;
use shadowgraph_core::size::SizeFn;
use shadowgraph_core::stage::Stage;
use std::ops::Range;

const VALUE: Port = Port::new(Out, "value", U32, "number", "N");
const SUM: Port = Port::new(Out, "sum", U32, "number", "N");
static ADD: Stage = Stage { name: "add", doc: "Numbers to numbers.", ports: &[VALUE.read(), SUM] };

const SAME_SIZE: SizeFn = |cx| vec![("sum", vec![cx.dim("value", 0)])];

/// A pass with nothing but a recipe.
pub(crate) const fn pass(name: &'static str, stage: &'static Stage, size: SizeFn, gpu: GpuFn) -> Pass {
    Pass {
        name,
        stage,
        doc: "A test.",
        source: "none",
        ignores: &[],
        params: &[],
        counters: &[],
        contract: Contract::Exact,
        features: &[],
        size,
        cpu: None,
        gpu: Some(gpu),
    }
}

const ADD_ONE_WGSL: &str = "
@group(0) @binding(0) var<uniform> count: vec4<u32>;
@group(0) @binding(1) var<storage, read> value: array<u32>;
@group(0) @binding(2) var<storage, read_write> sum: array<u32>;
@compute @workgroup_size(64) fn add_one(@builtin(global_invocation_id) id: vec3<u32>) {
    let i = linear_index(id);
    if i < count.x { sum[i] = value[i] + 1u; }
}
";

pub(crate) static ADD_ONE: Pass = pass("add_one", &ADD, SAME_SIZE, |cx| {
    let count = cx.words("value");
    cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_one", add_one_bind(count), count, 64);
    Ok(())
});

fn add_one_bind(count: usize) -> Vec<Bind> {
    let [value, sum] = ["value", "sum"].map(Target::Port);
    vec![Bind::Uniform(vec![count as u32]), Bind::Read(value), Bind::ReadWrite(sum)]
}

/// `value` through so many copies of one pass; only the last sum is kept, the others share two pieces of memory.
pub(crate) fn chain(pass: &'static Pass, count: usize) -> Plan {
    let mut plan = Plan::default();
    let slot = |name: String, port, producer, lifetime, keep, alias| Slot {
        name,
        port,
        producer,
        lifetime,
        keep,
        on: [false, true],
        alias,
    };
    plan.slots.push(slot("value".into(), VALUE, Producer::Input, [0, 0], false, 9));
    for index in 0..count {
        let keep = index + 1 == count;
        let (last, alias) = if keep { (index, 8) } else { (index + 1, index % 2) };
        plan.slots.push(slot(format!("n{index}.sum"), SUM, Producer::Node(index), [index, last], keep, alias));
        plan.nodes.push(Node {
            id: format!("n{index}"),
            pass,
            params: Params::default(),
            on: Backend::Wgpu,
            inputs: vec![("value", index)],
            outputs: vec![("sum", index + 1)],
        });
    }
    plan.outputs.push(("result".into(), count));
    plan
}

fn run_chain(session: &Session, plan: &Plan, words: &[u32], options: &Options) -> Outcome {
    let inputs = [("value".to_owned(), Array::u32([words.len()], words.to_vec()))];
    session.run(plan, &inputs, [1, 1], options).unwrap()
}

#[test]
fn a_kernel_adds_one_at_every_size() {
    let Some(session) = Session::shared_or_skip("a_kernel_adds_one_at_every_size") else { return };
    for count in [0, 1, 63, 64, 65, 257, 5_000_003] {
        let words: Vec<u32> = (0..count).map(|word| word * 7).collect();
        let input = Array::u32([words.len()], words.clone());
        let (outputs, counts) = session.run_node(&ADD_ONE, &Params::default(), [1, 1], &[("value", input)]).unwrap();
        assert_eq!(outputs[0].0, "sum");
        assert!(outputs[0].1.as_u32().iter().zip(&words).all(|(sum, word)| *sum == word + 1), "{count} words");
        assert_eq!((outputs[0].1.shape(), counts), (&[words.len()][..], vec![]));
    }
}

#[test]
fn transients_share_memory_and_poison_does_not_show() {
    let Some(session) = Session::shared_or_skip("transients_share_memory_and_poison_does_not_show") else { return };
    let plan = chain(&ADD_ONE, 6);
    let words: Vec<u32> = (0..100).collect();
    let mut taken = Vec::new();
    for (alias, poison, timers) in [(true, false, true), (true, true, false), (false, true, true)] {
        let options = Options { alias, poison, timers, warm_up: 1, frames: 3, ..Options::default() };
        let outcome = run_chain(session, &plan, &words, &options);
        let [(slot, sum)] = &outcome.arrays[..] else { panic!("one slot is kept") };
        assert_eq!(*slot, 6);
        assert!(sum.as_u32().iter().zip(&words).all(|(sum, word)| *sum == word + 6));
        assert_eq!(outcome.nodes.len(), 6);
        assert_eq!(outcome.nodes.iter().all(|run| run.millis.is_some_and(|millis| millis > 0.0)), timers);
        assert!(outcome.nodes.iter().all(|run| run.bytes == 400 && run.scratch_bytes == 0));
        taken.push(outcome.memory_bytes);
    }
    assert_eq!(taken, [400 * 4, 400 * 4, 400 * 7], "input, two shared, one kept; or seven");
}

#[test]
fn device_timestamps_give_each_node_a_time_within_the_frame() {
    let Some(session) = Session::shared_or_skip("device_timestamps_give_each_node_a_time_within_the_frame") else {
        return;
    };
    if !session.device().features().contains(wgpu::Features::TIMESTAMP_QUERY) {
        return;
    }
    let plan = chain(&ADD_ONE, 4);
    let shapes = [("value".to_owned(), vec![1_000_000])];
    let prepared = Prepared::prepare(session.device(), session.queue(), &Request::new(&plan, &shapes, [1, 1])).unwrap();
    let times = session.frame(&prepared, Clock::Device).unwrap();
    assert_eq!(times.nodes.len(), 4);
    let millis: Vec<f64> = times.nodes.iter().filter_map(|reading| reading.millis()).collect();
    assert!(millis.iter().all(|millis| *millis > 0.0) && millis.iter().sum::<f64>() < times.all, "{:?}", times.nodes);
    assert!(!millis.is_empty(), "no node was stamped");
}

#[test]
fn a_range_of_nodes_takes_and_gives_what_crosses_its_borders() {
    let plan = chain(&ADD_ONE, 4);
    let segment = Segment::new(&plan, 1..3);
    assert_eq!(segment.slots, [1, 2, 3]);
    assert_eq!(segment.plan.slots.iter().map(|slot| slot.keep).collect::<Vec<_>>(), [false, false, true]);
    assert_eq!(segment.plan.inputs().map(|(_, slot)| slot.name.as_str()).collect::<Vec<_>>(), ["n0.sum"]);
    let Some(session) = Session::shared_or_skip("a_range_of_nodes_takes_and_gives_what_crosses_its_borders") else {
        return;
    };
    let given = Array::u32([2], vec![10, 20]);
    let value = |slot| (slot == 1).then_some(&given);
    let outcome = session.run_nodes(&plan, 1..3, &value, [1, 1], &Options::default()).unwrap();
    assert_eq!(outcome.arrays, [(3, Array::u32([2], vec![12, 22]))]);
    assert_eq!(outcome.nodes.iter().map(|run| run.node).collect::<Vec<_>>(), [1, 2]);
    let problem = session.run_nodes(&plan, 2..3, &value, [1, 1], &Options::default()).unwrap_err();
    assert_eq!((problem.kind, problem.port.as_deref()), (Kind::Missing, Some("n1.sum")));
}

/// Keeps what is above ten: a list of unknown length, in one serial invocation.
const KEEP_WGSL: &str = "
@group(0) @binding(0) var<storage, read> value: array<u32>;
@group(0) @binding(1) var<storage, read_write> sum: array<u32>;
@group(0) @binding(2) var<storage, read_write> counters: array<atomic<u32>>;
@compute @workgroup_size(64) fn keep(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= arrayLength(&value) { return; }
    if value[id.x] > 99u { atomicAdd(&counters[1], 1u); }
    if value[id.x] > 10u {
        let place = atomicAdd(&counters[0], 1u);
        if place < arrayLength(&sum) { sum[place] = value[id.x]; }
    }
}";

static KEEP: Pass = Pass {
    counters: &[
        Counter { name: "kept", doc: "kept numbers do not fit", kind: CounterKind::Rows("sum") },
        Counter { name: "large", doc: "numbers above 99", kind: CounterKind::MustBeZero("give smaller ones") },
    ],
    ..pass(
        "keep",
        &ADD,
        |cx| vec![("sum", vec![cx.capacity("sum", 1)])],
        |cx| {
            let [value, sum] = ["value", "sum"].map(Target::Port);
            let bind = vec![Bind::Read(value), Bind::ReadWrite(sum), Bind::ReadWrite(Target::Counters)];
            cx.dispatch("keep", &[KEEP_WGSL], "keep", bind, cx.words("value"), 64);
            Ok(())
        },
    )
};

#[test]
fn an_overflow_names_node_and_rows_or_grows() {
    let Some(session) = Session::shared_or_skip("an_overflow_names_node_and_rows_or_grows") else { return };
    let plan = chain(&KEEP, 1);
    let inputs = |words: &[u32]| [("value".to_owned(), Array::u32([words.len()], words.to_vec()))];
    let strict = Options { regrow: 0, ..Options::default() };
    let problem = session.run(&plan, &inputs(&[11, 12, 3, 13]), [1, 1], &strict).unwrap_err();
    assert_eq!(
        problem.to_string(),
        "n0.sum: kept numbers do not fit; expected at most 1 rows; found 3 (let the run grow it, or raise the capacity)"
    );
    let outcome = session.run(&plan, &inputs(&[11, 12, 3, 13]), [1, 1], &Options::default()).unwrap();
    let mut kept = outcome.arrays[0].1.as_u32().to_vec();
    kept.sort_unstable();
    assert_eq!((kept, outcome.nodes[0].counts.as_slice()), (vec![11, 12, 13], &[3, 0][..]));
    assert_eq!(outcome.grown, [("n0.sum".to_owned(), 3)]);

    let problem = session.run(&plan, &inputs(&[1, 100, 2]), [1, 1], &strict).unwrap_err();
    assert_eq!(problem.to_string(), "n0: numbers above 99; expected 0; found 1 (give smaller ones)");
    let (_, counts) =
        session.run_node(&KEEP, &Params::default(), [1, 1], &[("value", Array::u32([2], vec![100, 101]))]).unwrap();
    assert_eq!(counts, [2, 2]);
}

/// A first kernel decides how many groups the second runs.
const INDIRECT_WGSL: &str = "
@group(0) @binding(0) var<storage, read> value: array<u32>;
@group(0) @binding(1) var<storage, read_write> groups: array<u32>;
@group(0) @binding(2) var<storage, read_write> sum: array<u32>;
override step: u32 = 1u;
@compute @workgroup_size(1) fn plan() {
    groups[1] = value[0];
    groups[2] = 1u;
    groups[3] = 1u;
}
@compute @workgroup_size(1) fn add(@builtin(global_invocation_id) id: vec3<u32>) { sum[id.x] += step; }";

static INDIRECT: Pass = Pass {
    features: &[Feature::IndirectExecution],
    ..pass("indirect", &ADD, SAME_SIZE, |cx| {
        let [value, sum] = ["value", "sum"].map(Target::Port);
        let groups = cx.scratch("groups", 4);
        cx.push(Command::Copy { from: value, to: sum, words: cx.words("value") });
        let one = |entry, constants, bind, groups| {
            Command::Dispatch(Dispatch {
                label: entry,
                shader: Shader { pieces: &[INDIRECT_WGSL], constants },
                entry,
                bind,
                groups,
            })
        };
        let bind = vec![Bind::Read(value), Bind::ReadWrite(groups), Bind::ReadWrite(sum)];
        cx.push(one("plan", vec![], bind, Groups::Direct([1; 3])));
        // The arguments may not be bound for writing while they are read: the second kernel gets another buffer there.
        let other = cx.scratch("other", 4);
        let bind = vec![Bind::Read(value), Bind::ReadWrite(other), Bind::ReadWrite(sum)];
        cx.push(one("add", vec![("step", 5.0)], bind, Groups::Indirect(groups, 1)));
        Ok(())
    })
};

#[test]
fn an_indirect_dispatch_runs_as_many_groups_as_a_kernel_wrote() {
    let name = "an_indirect_dispatch_runs_as_many_groups_as_a_kernel_wrote";
    let Some(session) = Session::shared_or_skip(name) else { return };
    let input = Array::u32([4], vec![3, 10, 20, 30]);
    let (outputs, _) = session.run_node(&INDIRECT, &Params::default(), [1, 1], &[("value", input)]).unwrap();
    assert_eq!(outputs[0].1.as_u32(), [8, 15, 25, 30]);
}

/// A first kernel writes what the second reads as a uniform, from its second place on.
const UNIFORM_WGSL: &str = "
@group(0) @binding(0) var<storage, read> value: array<u32>;
@group(0) @binding(1) var<storage, read_write> made: array<u32>;
@compute @workgroup_size(64) fn make(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < arrayLength(&made) { made[id.x] = id.x + value[0]; }
}";
const OF_UNIFORM_WGSL: &str = "
@group(0) @binding(0) var<uniform> made: array<vec4<u32>, 2>;
@group(0) @binding(1) var<storage, read_write> sum: array<u32>;
@compute @workgroup_size(8) fn take(@builtin(global_invocation_id) id: vec3<u32>) {
    sum[id.x] = made[id.x / 4u][id.x % 4u];
}";

fn uniform_of(cx: &mut GpuCx, words: Range<usize>) -> Result<(), Problem> {
    let [value, sum] = ["value", "sum"].map(Target::Port);
    let made = cx.scratch("made", 128);
    cx.dispatch("make", &[UNIFORM_WGSL], "make", vec![Bind::Read(value), Bind::ReadWrite(made)], 128, 64);
    let bind = vec![Bind::UniformOf(made, words), Bind::ReadWrite(sum)];
    cx.dispatch("take", &[OF_UNIFORM_WGSL], "take", bind, 8, 8);
    Ok(())
}

static UNIFORM: Pass = pass("uniform", &ADD, SAME_SIZE, |cx| uniform_of(cx, 64..72));
static UNIFORM_ASTRAY: Pass = pass("uniform_astray", &ADD, SAME_SIZE, |cx| uniform_of(cx, 60..68));
static UNIFORM_BEYOND: Pass = pass("uniform_beyond", &ADD, SAME_SIZE, |cx| uniform_of(cx, 64..132));
static UNIFORM_OF_PORT: Pass = pass("uniform_of_port", &ADD, SAME_SIZE, |cx| {
    let bind = vec![Bind::UniformOf(Target::Port("value"), 0..4), Bind::ReadWrite(Target::Port("sum"))];
    cx.dispatch("take", &[OF_UNIFORM_WGSL], "take", bind, 8, 8);
    Ok(())
});

#[test]
fn a_uniform_over_scratch_memory_holds_what_a_kernel_wrote() {
    let name = "a_uniform_over_scratch_memory_holds_what_a_kernel_wrote";
    let Some(session) = Session::shared_or_skip(name) else { return };
    let input = Array::u32([8], vec![1000; 8]);
    let (outputs, _) = session.run_node(&UNIFORM, &Params::default(), [1, 1], &[("value", input)]).unwrap();
    assert_eq!(outputs[0].1.as_u32(), [1064, 1065, 1066, 1067, 1068, 1069, 1070, 1071]);
}

static WRONG_ACCESS: Pass = pass("wrong_access", &ADD, SAME_SIZE, |cx| {
    let mut bind = add_one_bind(1);
    bind[2] = Bind::Read(Target::Port("sum"));
    cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_one", bind, 1, 64);
    Ok(())
});
static TOO_FEW: Pass = pass("too_few", &ADD, SAME_SIZE, |cx| {
    cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_one", add_one_bind(1)[..2].to_vec(), 1, 64);
    Ok(())
});
static WRITES_INPUT: Pass = pass("writes_input", &ADD, SAME_SIZE, |cx| {
    cx.zero(Target::Port("value"));
    Ok(())
});

static NAMES_NOTHING: Pass = pass("names_nothing", &ADD, SAME_SIZE, |cx| {
    cx.zero(Target::Port("total"));
    Ok(())
});
static BAD_WGSL: Pass = pass("bad_wgsl", &ADD, SAME_SIZE, |cx| {
    cx.dispatch("add", &[PRELUDE, "fn add_one( {"], "add_one", add_one_bind(1), 1, 64);
    Ok(())
});
static NO_ENTRY: Pass = pass("no_entry", &ADD, SAME_SIZE, |cx| {
    cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_two", add_one_bind(1), 1, 64);
    Ok(())
});
static AS_TEXTURE: Pass = pass("as_texture", &ADD, SAME_SIZE, |cx| {
    let mut bind = add_one_bind(1);
    bind[2] = Bind::Texture(Target::Port("sum"));
    cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_one", bind, 1, 64);
    Ok(())
});

#[test]
fn a_recipe_that_disagrees_with_its_kernel_is_a_problem_with_node_and_binding() {
    let name = "a_recipe_that_disagrees_with_its_kernel_is_a_problem_with_node_and_binding";
    let Some(session) = Session::shared_or_skip(name) else { return };
    for (pass, text) in [
        (&WRONG_ACCESS, "wrong_access/add: binding 2 sum: the recipe says Read"),
        (&TOO_FEW, "too_few/add: add_one uses @group(0) @binding(2) sum, which the recipe does not bind"),
        (&WRITES_INPUT, "writes_input: pass add/writes_input writes value, which is not an output"),
        (&NAMES_NOTHING, "names_nothing: pass add/names_nothing names Port(\"total\"), which it does not have"),
        (&UNIFORM_ASTRAY, "uniform_astray: pass add/uniform_astray binds words 60..68 of Scratch(0) as a uniform"),
        (&UNIFORM_BEYOND, "uniform_beyond: pass add/uniform_beyond binds words 64..132 of Scratch(0) as a uniform"),
        (
            &UNIFORM_OF_PORT,
            "uniform_of_port: pass add/uniform_of_port binds words 0..4 of Port(\"value\") as a uniform",
        ),
        (&BAD_WGSL, "bad_wgsl/add: the kernel does not parse: error: "),
        (&NO_ENTRY, "no_entry/add: the kernel has no Compute entry point add_two; found add_one"),
        (&AS_TEXTURE, "as_texture: pass add/as_texture names Port(\"sum\") as a texture; expected a buffer"),
    ] {
        let input = [("value", Array::u32([1], vec![1]))];
        let problem = session.run_node(pass, &Params::default(), [1, 1], &input).expect_err(pass.name);
        assert_eq!(problem.kind, Kind::BadPass);
        assert!(problem.to_string().starts_with(text), "{problem}");
    }
    // The session is still good for the next test.
    let (outputs, _) =
        session.run_node(&ADD_ONE, &Params::default(), [1, 1], &[("value", Array::u32([1], vec![1]))]).unwrap();
    assert_eq!(outputs[0].1.as_u32(), [2]);
}

#[test]
fn a_missing_adapter_and_a_missing_feature_are_problems_that_say_what_to_do() {
    let problem = Session::new(&Wanted { name: Some("no such adapter".into()) }).unwrap_err();
    assert_eq!(problem.kind, Kind::Device);
    assert!(problem.remedy.is_some_and(|remedy| remedy.starts_with("use the CPU backend")));

    static NEEDY: Pass = Pass {
        features: &[Feature::ConservativeRasterization, Feature::FragmentWritableStorage],
        ..pass("needy", &ADD, SAME_SIZE, |_| Ok(()))
    };
    let plan = chain(&NEEDY, 2);
    let wanted = wgpu::Features::CONSERVATIVE_RASTERIZATION;
    assert_eq!(required_features(&plan), wanted);
    assert_eq!(check_features(&plan, wanted, wgpu::DownlevelFlags::all()), Ok(()));
    let problem = check_features(&plan, wgpu::Features::empty(), wgpu::DownlevelFlags::all()).unwrap_err();
    assert_eq!((problem.kind, problem.node.as_deref()), (Kind::Unsupported, Some("n0")));
    assert_eq!(problem.message, "pass add/needy needs feature CONSERVATIVE_RASTERIZATION");
    let problem = check_features(&plan, wanted, wgpu::DownlevelFlags::empty()).unwrap_err();
    assert!(problem.message.ends_with("FRAGMENT_WRITABLE_STORAGE"), "{problem}");
}

#[test]
fn memory_beyond_a_limit_or_a_budget_is_an_overflow_with_node_and_sizes() {
    let Some(session) = Session::shared_or_skip("memory_beyond_a_limit_or_a_budget") else { return };
    static HUGE: Pass = pass("huge", &ADD, |_| vec![("sum", vec![1 << 34])], |_| Ok(()));
    let input = [("value", Array::u32([1], vec![1]))];
    let problem = session.run_node(&HUGE, &Params::default(), [1, 1], &input).unwrap_err();
    assert_eq!(
        (problem.kind, problem.node.as_deref(), problem.port.as_deref()),
        (Kind::Overflow, Some("huge"), Some("sum"))
    );
    assert_eq!(problem.expected.as_deref(), Some("room for a buffer of 68719476736 bytes"));

    let inputs = [("value".to_owned(), Array::u32([256], vec![1; 256]))];
    let options = Options { budget_bytes: Some(2048), ..Options::default() };
    let problem = session.run(&chain(&ADD_ONE, 3), &inputs, [1, 1], &options).unwrap_err();
    assert_eq!(problem.found.as_deref(), Some("at most 2048 bytes"));
    assert!(problem.expected.is_some_and(|text| text.contains("4096 bytes for the whole graph")));
}
