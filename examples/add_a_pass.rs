//! A pass of your own, registered from outside and used from RON: only triangles near the light cast.
//!
//! `cargo run --example add_a_pass`
//!
//! A pass is data and functions. It implements a stage that exists (here `casters`), so it can take the place of any other pass
//! of that stage in any graph; nothing in the graph crate or the backends knows of it.

use shadowgraph_core::array::Array;
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Contract, Counter, CounterKind, Pass};
use shadowgraph_core::plan::{Backend, Plan, Step};
use shadowgraph_core::problem::{Problem, Problems};
use shadowgraph_core::record::{Bind, GpuCx, Target};
use shadowgraph_core::shared::{GROUP, PRELUDE};
use shadowgraph_cpu::Store;
use shadowgraph_graph::{Overrides, Source, builtin, load, plan};
use shadowgraph_passes::casters;

/// Everything others see of the pass.
static NEAR_LIGHT: Pass = Pass {
    name: "near_light",
    stage: &casters::STAGE,
    doc: "Triangles with a corner within a radius of the light cast, all others do not.",
    source: "this example",
    ignores: &["triangle_flags"],
    params: &[ParamSpec {
        name: "radius",
        range: Range::F32 { min: 0.0, max: 1e9, default: 10.0 },
        unit: "scene units",
        doc: "larger casts more and costs more",
    }],
    counters: &[Counter { name: "kept", doc: "triangles that cast", kind: CounterKind::Info }],
    contract: Contract::Approximate,
    features: &[],
    size: |cx| vec![("caster_state", vec![cx.dim("triangles", 0)])],
    cpu: Some(on_cpu),
    gpu: Some(on_gpu),
};

/// The CPU function: inputs by port name, outputs put by port name.
fn on_cpu(cx: &mut CpuCx) -> Result<(), Problem> {
    let radius = cx.params().f32("radius");
    let light = cx.input("light_samples").as_vec3()[0];
    let is_near = |corner: &[f32; 3]| (0..3).map(|k| (corner[k] - light[k]).powi(2)).sum::<f32>() <= radius * radius;
    let corners = cx.input("triangles").as_vec3();
    let states: Vec<u32> = corners.chunks_exact(3).map(|triangle| u32::from(triangle.iter().any(is_near))).collect();
    cx.count("kept", states.iter().map(|state| u64::from(*state)).sum());
    cx.put("caster_state", Array::u32([states.len()], states));
    Ok(())
}

const KERNEL: &str = "
struct Settings { triangle_count: u32, radius: f32 }
@group(0) @binding(0) var<uniform> settings: Settings;
@group(0) @binding(1) var<storage, read> triangles: array<f32>;
@group(0) @binding(2) var<storage, read> light_samples: array<f32>;
@group(0) @binding(3) var<storage, read_write> caster_state: array<u32>;
@group(0) @binding(4) var<storage, read_write> counters: array<atomic<u32>>;

@compute @workgroup_size(64)
fn near_light(@builtin(global_invocation_id) id: vec3<u32>) {
    let triangle = linear_index(id);
    if triangle >= settings.triangle_count { return; }
    let light = vec3<f32>(light_samples[0], light_samples[1], light_samples[2]);
    var state = 0u;
    for (var corner = 0u; corner < 3u; corner++) {
        let at = triangle * 9u + corner * 3u;
        let away = vec3<f32>(triangles[at], triangles[at + 1u], triangles[at + 2u]) - light;
        if dot(away, away) <= settings.radius * settings.radius { state = 1u; }
    }
    caster_state[triangle] = state;
    atomicAdd(&counters[0], state);
}";

/// The GPU recipe: commands as data, no GPU API.
fn on_gpu(cx: &mut GpuCx) -> Result<(), Problem> {
    let count = cx.dim("triangles", 0);
    let bind = vec![
        Bind::Uniform(vec![count as u32, cx.params().f32("radius").to_bits()]),
        Bind::Read(Target::Port("triangles")),
        Bind::Read(Target::Port("light_samples")),
        Bind::ReadWrite(Target::Port("caster_state")),
        Bind::ReadWrite(Target::Counters),
    ];
    cx.dispatch("near_light", &[PRELUDE, KERNEL], "near_light", bind, count, GROUP);
    Ok(())
}

/// A graph that uses it: the built-in one, with one node's pass replaced.
const GRAPH: &str = r#"(
    version: 1,
    base: "hard",
    replace: [(id: "casters", pass: "near_light", params: {"radius": 8.0})],
)"#;

fn main() -> Result<(), Problems> {
    let mut catalogue = shadowgraph_passes::catalogue();
    catalogue.register(&NEAR_LIGHT);

    let scene = shadowgraph_scenes::load("builtin:columns")?;
    let view = shadowgraph_scenes::choose_view(&scene, "builtin:columns", None, None)?;
    let samples = [view.light.position];
    let facts = input::facts(&scene, &samples, false);

    let source = Source { name: "near_light.ron".into(), text: GRAPH.into() };
    let graph = load(source, &|name| Ok(builtin(name).unwrap_or_default().into()))?;
    let ports: Vec<_> = input::ALL.iter().filter(|port| !port.name.starts_with("imported_")).copied().collect();
    let plan = plan(&graph, &catalogue, &ports, Some(&facts), &Overrides::default())?;

    let image = [256, 256];
    let mut store = Store::new(&plan);
    for (name, array) in input::scene_arrays(&scene, &view.camera, image, &view.light, &samples, &[[1.0; 3]]) {
        if let Some(slot) = plan.slot(name) {
            store.put(slot, array);
        }
    }
    run(&plan, image, &mut store)
}

fn run(plan: &Plan, image: [usize; 2], store: &mut Store) -> Result<(), Problems> {
    for step in &plan.steps {
        let Step::Run(node) = step else { continue };
        assert_eq!(plan.nodes[*node].on, Backend::Cpu);
        let ran = shadowgraph_cpu::run(plan, *node, image, store, &|_, _, _| {})?;
        let node = &plan.nodes[*node];
        println!("{:<20} {:<18} {:>8.2} ms  {:?}", node.id, node.pass.name, ran.millis, ran.counts);
    }
    Ok(())
}
