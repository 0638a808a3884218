use super::*;
use shadowgraph_core::array::Element::U32;
use shadowgraph_core::pass::{Contract, Counter};
use shadowgraph_core::plan::{Producer, Slot, Step};
use shadowgraph_core::port::{Direction::Out, Port};
use shadowgraph_core::stage::Stage;

const VALUE: Port = Port::new(Out, "value", U32, "number", "N");
const SUM: Port = Port::new(Out, "sum", U32, "number", "N");

static ADD_ONE: Stage = Stage { name: "add_one", doc: "Adds one to every word.", ports: &[VALUE.read(), SUM] };

static PLAIN: Pass = Pass {
    name: "plain",
    stage: &ADD_ONE,
    doc: "Adds one.",
    source: "none",
    ignores: &[],
    params: &[],
    counters: &[Counter { name: "zeros", doc: "words that were zero", kind: CounterKind::MustBeZero("give no zeros") }],
    contract: Contract::Exact,
    features: &[],
    size: |cx| vec![("sum", vec![cx.dim("value", 0)])],
    cpu: Some(|cx| {
        let words: Vec<u32> = cx.input("value").as_u32().iter().map(|word| word + 1).collect();
        let zeros = words.iter().filter(|word| **word == 1).count();
        cx.count("zeros", zeros as u64);
        cx.put("sum", Array::u32([words.len()], words));
        Ok(())
    }),
    gpu: None,
};

fn slot(name: &str, port: Port, producer: Producer, lifetime: [usize; 2], keep: bool) -> Slot {
    Slot { name: name.into(), port, producer, lifetime, keep, on: [true, false], alias: 0 }
}

/// value -> a -> b, where only b is kept.
fn chain() -> Plan {
    let node = |id: &str, from, to| Node {
        id: id.into(),
        pass: &PLAIN,
        params: Params::default(),
        on: Backend::Cpu,
        inputs: vec![("value", from)],
        outputs: vec![("sum", to)],
    };
    Plan {
        nodes: vec![node("a", 0, 1), node("b", 1, 2)],
        slots: vec![
            slot("value", VALUE, Producer::Input, [0, 0], false),
            slot("a.sum", SUM, Producer::Node(0), [0, 1], false),
            slot("b.sum", SUM, Producer::Node(1), [1, 1], true),
        ],
        steps: vec![Step::Run(0), Step::Run(1)],
        ..Plan::default()
    }
}

#[test]
fn values_travel_and_transients_are_dropped() {
    let plan = chain();
    let mut store = Store::new(&plan);
    store.put(0, Array::u32([3], vec![5, 6, 7]));
    for index in 0..2 {
        run(&plan, index, [1, 1], &mut store, &|_, _, _| {}).unwrap();
    }
    assert_eq!(store.get(2).as_u32(), [7, 8, 9]);
    assert!(store.try_get(1).is_none(), "a transient outlived its last reader");
    assert!(store.try_get(0).is_some(), "an input was dropped");
}

#[test]
fn a_count_that_must_be_zero_is_an_error_with_node_and_remedy() {
    let plan = chain();
    let mut store = Store::new(&plan);
    store.put(0, Array::u32([2], vec![0, 0]));
    let problem = run(&plan, 0, [1, 1], &mut store, &|_, _, _| {}).unwrap_err();
    assert_eq!(problem.to_string(), "a: words that were zero; expected 0; found 2 (give no zeros)");
}
