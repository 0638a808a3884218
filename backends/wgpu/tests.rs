//! Passes so small that their outputs can be counted by hand.

use crate::Session;
use shadowgraph_core::array::Array;
use shadowgraph_core::array::Element::U32;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::{Contract, Pass};
use shadowgraph_core::port::{Direction::Out, Port};
use shadowgraph_core::record::{Bind, GpuFn, Target};
use shadowgraph_core::shared::PRELUDE;
use shadowgraph_core::size::SizeFn;
use shadowgraph_core::stage::Stage;

const VALUE: Port = Port::new(Out, "value", U32, "number", "N");
const SUM: Port = Port::new(Out, "sum", U32, "number", "N");
static ADD: Stage = Stage { name: "add", doc: "Adds one to every word.", ports: &[VALUE.read(), SUM] };

/// A pass with nothing but a recipe.
const fn pass(name: &'static str, stage: &'static Stage, size: SizeFn, gpu: GpuFn) -> Pass {
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
}";

static ADD_ONE: Pass = pass(
    "add_one",
    &ADD,
    |cx| vec![("sum", vec![cx.dim("value", 0)])],
    |cx| {
        let count = cx.words("value");
        let bind = vec![
            Bind::Uniform(vec![count as u32]),
            Bind::Read(Target::Port("value")),
            Bind::ReadWrite(Target::Port("sum")),
        ];
        cx.dispatch("add", &[PRELUDE, ADD_ONE_WGSL], "add_one", bind, count, 64);
        Ok(())
    },
);

#[test]
fn a_kernel_adds_one_at_every_size() {
    let Some(session) = Session::shared_or_skip("a_kernel_adds_one_at_every_size") else { return };
    for count in [0, 1, 63, 64, 65, 257, 1_000_003] {
        let words: Vec<u32> = (0..count).map(|word| word * 7).collect();
        let input = Array::u32([words.len()], words.clone());
        let (outputs, counts) = session.run_node(&ADD_ONE, &Params::default(), [1, 1], &[("value", input)]).unwrap();
        assert_eq!(outputs[0].0, "sum");
        assert!(outputs[0].1.as_u32().iter().zip(&words).all(|(sum, word)| *sum == word + 1), "{count} words");
        assert_eq!((outputs[0].1.shape(), counts), (&[words.len()][..], vec![]));
    }
}
