//! Good graphs.

use super::*;
use shadowgraph_core::plan::{Backend, Producer, Step};

#[test]
fn hard_runs_in_the_order_of_its_file() {
    let graph = load_builtin("hard");
    let plan = plan_of(&graph, &Overrides::default()).unwrap();
    assert_eq!(plan.name, "hard");
    assert_eq!(ids(&plan), graph.node_ids().collect::<Vec<_>>());
    assert!(plan.steps.iter().all(|step| matches!(step, Step::Run(_))));
    let visibility = plan.nodes.iter().find(|node| node.id == "visibility").unwrap();
    let reads =
        |port: &str| visibility.inputs.iter().find(|(name, _)| *name == port).map(|(_, slot)| &plan.slots[*slot]);
    assert_eq!(reads("caster_offset").unwrap().name, "caster_scan.offset");
    assert_eq!(reads("list_offset").unwrap().name, "list_scan.offset");
    assert_eq!(reads("triangles").unwrap().producer, Producer::Input);
    let alternatives: Vec<_> = plan.left_out.iter().map(|(id, reason)| format!("{id}: {reason}")).collect();
    assert_eq!(
        alternatives,
        [
            "view_samples/import: view_samples_imported does not hold",
            "light_frame/six_faces: light_inside_scene does not hold"
        ]
    );
}

#[test]
fn every_built_in_graph_plans_where_its_passes_run() {
    for name in crate::builtin_names() {
        let graph = load_builtin(name);
        let wgpu = Overrides { default_backend: Backend::Wgpu, ..Overrides::default() };
        let (on_cpu, on_wgpu) = (plan_of(&graph, &Overrides::default()), plan_of(&graph, &wgpu));
        assert_eq!(on_cpu.is_ok(), name != "hard_draw", "{name}: {on_cpu:?}");
        assert_eq!(on_wgpu.is_ok(), name != "truth_hard", "{name}: {on_wgpu:?}");
    }
}
