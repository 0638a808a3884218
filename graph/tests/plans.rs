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
            "light_frame/six_faces: light_inside_scene does not hold",
            "combine/weighted: light_is_textured does not hold"
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
        assert_eq!(
            on_wgpu.is_ok(),
            !name.starts_with("truth") && !["soft_shafts", "soft_silhouettes"].contains(&name),
            "{name}: {on_wgpu:?}"
        );
    }
}

/// Plans a graph that builds on another, with flags.
fn variant(base: &str, differences: &str, overrides: &Overrides) -> Plan {
    let text = format!("(version: 1, base: {base:?}, {differences})");
    plan_of(&load_text(&text).unwrap(), overrides).unwrap_or_else(|problems| panic!("{problems}"))
}

fn left_out<'p>(plan: &'p Plan, id: &str) -> Option<&'p str> {
    plan.left_out.iter().find(|(known, _)| known == id).map(|(_, reason)| reason.as_str())
}

fn node<'p>(plan: &'p Plan, id: &str) -> &'p shadowgraph_core::plan::Node {
    plan.nodes.iter().find(|node| node.id == id).unwrap_or_else(|| panic!("{id} is not in the plan"))
}

#[test]
fn what_a_pass_does_not_read_is_not_run() {
    let swap = Overrides { swaps: vec![("visibility".into(), "fused".into())], ..Overrides::default() };
    for plan in [plan_of(&load_builtin("hard_fused"), &swap).unwrap(), variant("hard", "", &swap)] {
        for (id, reason) in [
            ("conservative_raster", "caster_scan is not needed; caster_fill is not needed"),
            ("caster_scan", "caster_fill is not needed; visibility (fused) does not read caster_offset"),
            ("caster_fill", "visibility (fused) does not read caster_entries"),
        ] {
            assert!(!ids(&plan).contains(&id));
            assert_eq!(left_out(&plan, id), Some(reason));
        }
        assert!(ids(&plan).contains(&"list_fill"));
    }
}

#[test]
fn facts_choose() {
    let graph = load_builtin("hard");
    let facts = Facts { light_inside_scene: true, view_samples_imported: true, ..facts() };
    let plan = plan(&graph, &catalogue(), input::ALL, Some(&facts), &Overrides::default()).unwrap();
    assert_eq!(node(&plan, "light_frame").pass.name, "six_faces");
    assert_eq!(left_out(&plan, "light_frame/fitted"), Some("six_faces is used: light_inside_scene holds"));
    let imported = node(&plan, "view_samples");
    assert_eq!(imported.pass.name, "import");
    // Optional inputs are connected where something fits and the pass reads them.
    let ports: Vec<_> = imported.inputs.iter().map(|(port, _)| *port).collect();
    assert_eq!(ports, ["imported_position", "imported_normal", "imported_triangle"]);
}

#[test]
fn a_swap_wins_over_choose_and_a_pin_over_the_file() {
    let overrides = Overrides {
        swaps: vec![("light_frame".into(), "whole".into())],
        sets: vec![("list_build".into(), "size".into(), "64".into())],
        on: vec![("scan_a".into(), Backend::Wgpu)],
        ..Overrides::default()
    };
    let differences = "add: [(id: \"scan_a\", stage: \"scan\", on: Cpu, in: {\"length\": \"list_build.list_length\"})], outputs: {\"a\": \"scan_a.offset\"}";
    let graph = load_text(&format!("(version: 1, base: \"hard\", {differences})")).unwrap();
    let facts = Facts { light_inside_scene: true, ..facts() };
    let plan = plan(&graph, &catalogue(), input::ALL, Some(&facts), &overrides).unwrap();
    assert_eq!(node(&plan, "light_frame").pass.name, "whole");
    assert_eq!(node(&plan, "list_build").params.u32("size"), 64);
    assert_eq!(node(&plan, "scan_a").on, Backend::Wgpu);
}

#[test]
fn a_value_crosses_to_the_other_backend_once_before_its_first_use() {
    let overrides = Overrides {
        on: vec![("list_build".into(), Backend::Wgpu), ("list_scan".into(), Backend::Wgpu)],
        ..Overrides::default()
    };
    let plan = variant("hard", "", &overrides);
    let names: Vec<String> = plan
        .steps
        .iter()
        .map(|step| match step {
            Step::Run(index) => plan.nodes[*index].id.clone(),
            Step::Transfer { slot, to } => format!("{} to {to:?}", plan.slots[*slot].name),
        })
        .collect();
    assert_eq!(
        names,
        [
            "view_samples",
            "sample_filter",
            "light_frame",
            "view_samples.position to Wgpu",
            "sample_filter.sample_state to Wgpu",
            "light_frame.light_frame to Wgpu",
            "list_build",
            "list_scan",
            "list_build.cell to Cpu",
            "list_build.slot to Cpu",
            "list_scan.offset to Cpu",
            "list_fill",
            "casters",
            "list_build.list_length to Cpu",
            "list_build.list_far to Cpu",
            "conservative_raster",
            "caster_scan",
            "caster_fill",
            "visibility",
            "combine",
            "bent_light",
            "shade",
        ]
    );
    for slot in plan.slots.iter().filter(|slot| slot.on == [true, true]) {
        let shares = plan.slots.iter().filter(|other| other.alias == slot.alias).count();
        assert_eq!(shares, 1, "{} is on both backends and shares memory", slot.name);
    }
}

/// Slots that share memory must never be alive together, be on one backend, be transient buffers.
fn check_aliases(plan: &Plan) {
    for (index, a) in plan.slots.iter().enumerate() {
        for b in &plan.slots[index + 1..] {
            if a.alias == b.alias {
                let apart = a.lifetime[1] < b.lifetime[0] || b.lifetime[1] < a.lifetime[0];
                let names = format!("{} {} in {}", a.name, b.name, plan.name);
                assert!(apart, "{names}");
                assert!(
                    !a.keep && !b.keep && a.producer != Producer::Input && b.producer != Producer::Input,
                    "{names}"
                );
                assert_eq!(a.storage(), b.storage(), "{names}");
                assert_eq!(a.on, b.on, "{names}");
            }
        }
    }
}

#[test]
fn transients_share_memory_only_when_never_alive_together() {
    let groups = |plan: &Plan| plan.slots.iter().map(|slot| slot.alias).max().unwrap() + 1;
    for name in crate::builtin_names().into_iter().filter(|name| *name != "hard_draw") {
        let graph = load_builtin(name);
        let shared = plan_of(&graph, &Overrides::default()).unwrap();
        let apart = plan_of(&graph, &Overrides { alias: false, ..Overrides::default() }).unwrap();
        let kept = plan_of(&graph, &Overrides { keep: Keep::AllLivePorts, ..Overrides::default() }).unwrap();
        check_aliases(&shared);
        check_aliases(&apart);
        assert!(groups(&shared) < groups(&apart), "{name}");
        assert_eq!(groups(&apart), apart.slots.len());
        assert_eq!(groups(&kept), kept.slots.len());
        assert!(kept.slots.iter().all(|slot| slot.keep == (slot.producer != Producer::Input)));
    }
}

#[test]
fn lifetimes_cover_every_touch() {
    let plan = plan_of(&load_builtin("hard"), &Overrides::default()).unwrap();
    for (id, slot) in plan.slots.iter().enumerate() {
        let touches = plan
            .nodes
            .iter()
            .enumerate()
            .filter(|(_, node)| node.inputs.iter().chain(&node.outputs).any(|(_, touched)| *touched == id));
        let touches: Vec<usize> = touches.map(|(index, _)| index).collect();
        assert_eq!(slot.lifetime, [touches[0], touches[touches.len() - 1]], "{}", slot.name);
    }
}

#[test]
fn parameters_follow_the_pass_they_were_written_for() {
    let plan = variant("pcf", "replace: [(id: \"shadow_lookup\", params: {\"taps\": 5})]", &Overrides::default());
    assert_eq!(node(&plan, "shadow_lookup").params.u32("taps"), 5);
    // Written for the base's pass: kept where the new pass has it, told where it has not.
    let text = r#"(version: 1, base: "two.ron", replace: [(id: "shadow_lookup", pass: "compare")])"#;
    let base = r#"(version: 1, base: "pcf", replace: [(id: "shadow_lookup", params: {"taps": 5})])"#;
    let source = Source { name: "graphs/one.ron".into(), text: text.into() };
    let graph = load(source, &|path| {
        assert_eq!(path, "graphs/two.ron");
        Ok(base.into())
    })
    .unwrap();
    assert_eq!(
        graph.sources().collect::<Vec<_>>(),
        ["graphs/one.ron", "graphs/two.ron", "builtin:pcf", "builtin:shadow_map"]
    );
    let plan = plan_of(&graph, &Overrides::default()).unwrap();
    assert_eq!(left_out(&plan, "shadow_lookup.taps"), Some("was meant for another pass; compare takes no such value"));
}

#[test]
fn files_state_their_differences() {
    let plan = variant(
        "hard",
        r#"doc: "d", remove: ["shade", "bent_light"],
           replace: [(id: "casters", pass: "light_back_facing"), (id: "combine", stage: "blur")],
           add: [(id: "more", stage: "combine", in: {"mask": "visibility.mask"})],
           outputs: {"image": "more.visible", "visible": "combine.blurred"}"#,
        &Overrides::default(),
    );
    assert_eq!(node(&plan, "casters").pass.name, "light_back_facing");
    assert_eq!(node(&plan, "combine").pass.stage.name, "blur");
    assert!(!ids(&plan).contains(&"shade"));
    let outputs: Vec<_> =
        plan.outputs.iter().map(|(name, slot)| (name.as_str(), plan.slots[*slot].name.as_str())).collect();
    assert_eq!(outputs, [("image", "more.visible"), ("mask", "visibility.mask"), ("visible", "combine.blurred")]);
}

#[test]
fn outputs_go_with_the_node_that_is_removed() {
    let names = |plan: &Plan| plan.outputs.iter().map(|(name, _)| name.clone()).collect::<Vec<_>>();
    let plan = variant("hard", r#"remove: ["shade"]"#, &Overrides::default());
    assert_eq!(names(&plan), ["mask", "visible"]);
    assert_eq!(left_out(&plan, "bent_light"), Some("nothing reads its outputs"));
    let anew = r#"remove: ["shade"], add: [(id: "shade", pass: "bent_lambert")]"#;
    assert_eq!(names(&variant("hard", anew, &Overrides::default())), ["image", "mask", "visible"]);
}

#[test]
fn inputs_can_be_narrowed() {
    let text = r#"(version: 1, inputs: ["triangles", "light_samples"], nodes: [(id: "casters")], outputs: {"c": "casters.caster_state"})"#;
    assert_eq!(
        complaints(text),
        ["test.ron:1:67: casters.triangle_flags: nothing feeds this port; expected u32 triangle_flags [T] \
          (no node and no graph input gives such a value)"]
    );
    // An input may be an output as it is.
    let text = r#"(version: 1, nodes: [(id: "casters")], outputs: {"c": "casters.caster_state", "t": "triangles"})"#;
    let plan = plan_text(text).unwrap();
    assert!(plan.slots[plan.slot("triangles").unwrap()].keep);
}

#[test]
fn a_plan_written_out_reads_back_as_itself() {
    for name in crate::builtin_names().into_iter().filter(|name| *name != "hard_draw") {
        let plan = plan_of(&load_builtin(name), &Overrides::default()).unwrap();
        let text = crate::resolved_text(&plan);
        let again = plan_text(&text).unwrap_or_else(|problems| panic!("{name}: {problems}\n{text}"));
        let same = |plan: &Plan| crate::describe(&Plan { name: String::new(), left_out: Vec::new(), ..plan.clone() });
        assert_eq!(same(&again), same(&plan), "{name}");
        assert_eq!(crate::plan_id(&again), crate::plan_id(&plan), "{name}");
    }
}

#[test]
fn axes_expand_to_variants_that_plan() {
    let text = r#"(version: 1, base: "shadow_map", axes: {
        "shadow_lookup": ["compare", "pcf"],
        "light_depth.size": [256, 512, 1024],
        "light_depth.bias": ["constant"],
    })"#;
    let graph = load_text(text).unwrap();
    let all = crate::variants(&graph, &Overrides::default()).unwrap();
    let labels: Vec<String> = all.iter().map(crate::Variant::label).collect();
    assert_eq!(labels.len(), 6);
    assert_eq!(labels[0], "shadow_lookup=compare, light_depth.size=256, light_depth.bias=constant");
    assert_eq!(labels[4], "shadow_lookup=pcf, light_depth.size=512, light_depth.bias=constant");
    let ids: std::collections::HashSet<String> =
        all.iter().map(|variant| crate::plan_id(&plan_of(&graph, &variant.overrides).unwrap())).collect();
    assert_eq!(ids.len(), 6);
    let again = crate::variants(&load_text(text).unwrap(), &Overrides::default()).unwrap();
    let id = crate::plan_id(&plan_of(&graph, &again[4].overrides).unwrap());
    assert_eq!(id, crate::plan_id(&plan_of(&graph, &all[4].overrides).unwrap()));
    assert_eq!(crate::variants(&load_builtin("hard"), &Overrides::default()).unwrap().len(), 1);
}
