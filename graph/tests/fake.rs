//! Every stage of the built-in graphs, with passes that do nothing.

use shadowgraph_core::array::Element::{F32, U32};
use shadowgraph_core::cpu::CpuCx;
use shadowgraph_core::input;
use shadowgraph_core::param::{ParamSpec, Range};
use shadowgraph_core::pass::{Catalogue, Contract, Pass};
use shadowgraph_core::port::{Direction::Out, Port, Space, Storage};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::GpuCx;
use shadowgraph_core::stage::Stage;
use std::sync::OnceLock;

/// Stage: inputs (`?` optional) -> outputs.
const STAGES: &str = "
view_samples: triangles camera imported_position? imported_normal? imported_triangle? -> position normal triangle pixel
sample_filter: position normal light_samples -> sample_state
light_frame: position sample_state light_samples scene_bounds -> light_frame
list_build: position sample_state light_frame -> cell slot list_length list_far
scan: length -> offset
list_fill: cell slot list_offset -> list_entries
casters: triangles triangle_flags light_samples -> caster_state
conservative_raster: triangles caster_state light_samples light_frame list_length list_far -> pair_cell pair_slot caster_length
caster_fill: pair_cell pair_slot caster_offset -> caster_entries
adjacency: triangles caster_state -> across
penumbra: triangles caster_state across light_samples light_frame position sample_state cell list_length list_far -> penumbra_state
lu_table: light_samples -> lu lu_layout
bvh_build: triangles caster_state -> bvh_nodes bvh_order
visibility: triangles caster_state light_samples position sample_state cell list_length list_offset list_entries caster_offset caster_entries lu? lu_layout? bvh_nodes? bvh_order? penumbra_state? -> mask
light_depth: triangles caster_state light_frame -> depth
shadow_lookup: depth light_frame position sample_state -> mask visible
combine: mask sample_state -> visible
bent_light: triangles corner_vertex face_offset faces light -> corner_light
shade: position normal pixel visible triangles corner_light camera light -> image
blur: mask -> blurred
";

/// Stage/pass, backends it runs on, inputs it ignores, parameters.
const PASSES: &str = "
view_samples/raster cw imported_position,imported_normal,imported_triangle -
view_samples/cast c imported_position,imported_normal,imported_triangle -
view_samples/import cw triangles,camera -
sample_filter/light_facing cw - -
sample_filter/all cw normal -
light_frame/fitted cw - margin
light_frame/whole cw - -
light_frame/six_faces cw - -
list_build/atomic_counters cw - size
list_build/sort cw - size
scan/work_efficient cw - -
scan/serial cw - -
list_fill/direct cw - -
casters/all cw - -
casters/light_back_facing cw - -
conservative_raster/binning cw - -
conservative_raster/influence cw - -
conservative_raster/device w - -
caster_fill/direct cw - -
adjacency/half_edges c - -
penumbra/silhouettes cw - -
lu_table/angles_distance cw - size
lu_table/planar cw - size
lu_table/certain_uncertain cw - size
visibility/planes cw lu,lu_layout,bvh_nodes,bvh_order,penumbra_state -
visibility/lu cw bvh_nodes,bvh_order -
visibility/lu_planar cw bvh_nodes,bvh_order -
visibility/lu_certain cw bvh_nodes,bvh_order -
visibility/fused cw caster_offset,caster_entries,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state -
visibility/fused_draw w caster_offset,caster_entries,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state -
visibility/half_planes cw list_length,lu,lu_layout,bvh_nodes,bvh_order -
visibility/bvh_rays cw cell,list_length,list_offset,list_entries,caster_offset,caster_entries,lu,lu_layout,penumbra_state -
visibility/exact c cell,list_length,list_offset,list_entries,caster_offset,caster_entries,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state contact_ulps
visibility/shafts c cell,list_length,list_offset,list_entries,caster_offset,caster_entries,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state patches,leaves
visibility/silhouettes c list_length,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state -
bvh_build/ploc c - -
visibility/multi_shadow_map cw cell,list_length,list_offset,list_entries,caster_offset,caster_entries,lu,lu_layout,bvh_nodes,bvh_order,penumbra_state -
light_depth/first_surface cw - size,bias
shadow_lookup/compare cw - -
shadow_lookup/pcf cw - taps
shadow_lookup/pcss cw - -
combine/popcount cw - -
combine/weighted cw - -
bent_light/adjacent_faces cw - -
shade/bent_lambert cw - -
blur/box cw - -
";

const SPECS: &[ParamSpec] = &[
    spec("size", Range::U32 { min: 1, max: 8192, default: 512 }),
    spec("contact_ulps", Range::F32 { min: 0.0, max: 1024.0, default: 1.0 }),
    spec("margin", Range::F32 { min: 0.0, max: 1.0, default: 0.25 }),
    spec("bias", Range::Word { words: &["constant", "slope"], default: "constant" }),
    spec("patches", Range::Word { words: &["auto", "always", "off"], default: "auto" }),
    spec("leaves", Range::Word { words: &["auto", "triangles", "rays"], default: "auto" }),
    spec("taps", Range::U32 { min: 1, max: 15, default: 3 }),
];

const fn spec(name: &'static str, range: Range) -> ParamSpec {
    ParamSpec { name, range, unit: "", doc: "" }
}

fn port(name: &'static str) -> Port {
    if let Some(port) = input::ALL.iter().find(|port| port.name == name) {
        return *port;
    }
    match name {
        "list_length" | "length" | "caster_length" => Port::new(Out, name, U32, "length", "F S S"),
        "list_offset" | "offset" | "caster_offset" => Port::new(Out, name, U32, "offset", "C+1"),
        "position" | "normal" => Port::new(Out, name, F32, name, "P 3").space(Space::World),
        "mask" | "blurred" => Port::new(Out, name, U32, "mask", "P M"),
        "depth" => Port::new(Out, name, F32, name, "F D D").storage(Storage::DepthTexture),
        "pair_cell" => Port::new(Out, name, U32, "cell", "E"),
        "pair_slot" => Port::new(Out, name, U32, "slot", "E"),
        "bvh_nodes" => Port::new(Out, name, U32, "bvh_node", "N 8"),
        "bvh_order" => Port::new(Out, name, U32, "bvh_triangle", "T"),
        "caster_entries" => Port::new(Out, name, U32, "caster", "E"),
        _ => Port::new(Out, name, U32, name, "P"),
    }
}

fn stage(line: &'static str) -> Stage {
    let (name, ports) = line.split_once(": ").expect("name: ports");
    let (inputs, outputs) = ports.split_once(" -> ").expect("inputs -> outputs");
    let inputs = inputs.split(' ').map(|name| match name.strip_suffix('?') {
        Some(name) => port(name).optional(),
        None => port(name).read(),
    });
    let ports: Vec<Port> = inputs.chain(outputs.split(' ').map(|name| port(name).write())).collect();
    Stage { name, doc: "", ports: ports.leak() }
}

fn cpu(_: &mut CpuCx) -> Result<(), Problem> {
    Ok(())
}

fn gpu(_: &mut GpuCx) -> Result<(), Problem> {
    Ok(())
}

fn words(text: &'static str) -> Vec<&'static str> {
    text.split(',').filter(|word| *word != "-").collect()
}

fn pass(line: &'static str, stages: &'static [Stage]) -> &'static Pass {
    let parts: Vec<&'static str> = line.split(' ').collect();
    let [path, runs_on, ignores, params] = parts[..] else { panic!("{line}") };
    let (stage, name) = path.split_once('/').expect("stage/pass");
    let specs = |name: &&str| *SPECS.iter().find(|spec| spec.name == *name).expect("a spec");
    let params: Vec<ParamSpec> = words(params).iter().map(specs).collect();
    Box::leak(Box::new(Pass {
        name,
        stage: stages.iter().find(|known| known.name == stage).expect("a stage"),
        doc: "",
        source: "",
        ignores: words(ignores).leak(),
        params: params.leak(),
        counters: &[],
        contract: Contract::Exact,
        features: &[],
        size: |_| Vec::new(),
        cpu: runs_on.contains('c').then_some(cpu as _),
        gpu: runs_on.contains('w').then_some(gpu as _),
    }))
}

pub fn catalogue() -> Catalogue {
    static CATALOGUE: OnceLock<Catalogue> = OnceLock::new();
    let make = || {
        let stages: Vec<Stage> = STAGES.trim().lines().map(stage).collect();
        let stages = stages.leak();
        Catalogue::new(PASSES.trim().lines().map(|line| pass(line, stages)))
    };
    CATALOGUE.get_or_init(make).clone()
}
