//! Every shader of every recipe parses and validates with the capabilities of plain WebGPU, and has its entry points.

use naga::valid::{Capabilities, ValidationFlags, Validator};
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::port::Port;
use shadowgraph_core::record::{Command, DeviceLimits, GpuCx, Shader};
use shadowgraph_core::size::SizeCx;

const LIMITS: DeviceLimits = DeviceLimits { storage_binding_bytes: 128 << 20, texture_side: 8192, storage_buffers: 8 };
const IMAGE: [usize; 2] = [8, 8];

pub fn every_recipe_validates() -> Vec<String> {
    let catalogue = shadowgraph_passes::catalogue();
    let recipes = catalogue.passes().filter(|pass| pass.gpu.is_some());
    let faults: Vec<String> = recipes.flat_map(faults_of).collect();
    faults
}

/// Last two dimensions of look-up tables: a pass reads one of them and refuses the others.
const TABLES: [[usize; 2]; 3] = [[8, 4], [8, 8], [1, 4]];

fn faults_of(pass: &'static Pass) -> Vec<String> {
    let reads_table = pass.reads().any(|port| port.name == "lu");
    let tables = if reads_table { &TABLES[..] } else { &TABLES[..1] };
    let of_tables: Vec<_> = tables.iter().map(|table| faults_with(pass, *table)).collect();
    of_tables.into_iter().min_by_key(Vec::len).unwrap_or_default()
}

fn faults_with(pass: &'static Pass, table: [usize; 2]) -> Vec<String> {
    let params = Params::defaults(pass.params);
    let shape = |port: &Port| {
        let mut shape = tiny(port.shape);
        if port.name == "lu" {
            shape[3..].copy_from_slice(&table);
        }
        (port.name, shape)
    };
    let mut shapes: Vec<_> = pass.reads().map(shape).collect();
    let cx = SizeCx { image: IMAGE, params: &params, inputs: &shapes, grown: &[] };
    let outputs = (pass.size)(&cx);
    shapes.extend(outputs);
    let mut cx = GpuCx::new(pass, &params, IMAGE, shapes, LIMITS);
    let Some(record) = pass.gpu else { return Vec::new() };
    if let Err(problem) = record(&mut cx) {
        return vec![format!("{pass:?}: {problem}")];
    }
    let (_, commands) = cx.finish();
    let mut faults = Vec::new();
    for command in &commands {
        let (label, shader, entries) = match command {
            Command::Dispatch(dispatch) => (dispatch.label, &dispatch.shader, vec![dispatch.entry]),
            Command::Draw(draw) => {
                (draw.label, &draw.shader, [Some(draw.vertex), draw.fragment].into_iter().flatten().collect())
            }
            Command::Zero(_) | Command::Copy { .. } => continue,
        };
        faults.extend(shader_faults(shader, &entries).into_iter().map(|fault| format!("{pass:?} {label}: {fault}")));
    }
    faults
}

/// Symbols of a port's shape as small numbers; a light sample is one.
fn tiny(shape: &str) -> Vec<usize> {
    let side = |symbol: &str| match symbol {
        "P" | "H" | "W" => 8,
        "F" | "L" | "M" | "K" => 1,
        "S" | "D" => 4,
        "C+1" => 17,
        other => other.parse().unwrap_or(8),
    };
    shape.split(' ').map(side).collect()
}

fn shader_faults(shader: &Shader, entries: &[&str]) -> Vec<String> {
    let source = shader.pieces.concat();
    let module = match naga::front::wgsl::parse_str(&source) {
        Ok(module) => module,
        Err(error) => return vec![error.emit_to_string(&source)],
    };
    if let Err(error) = Validator::new(ValidationFlags::all(), Capabilities::empty()).validate(&module) {
        return vec![error.emit_to_string(&source)];
    }
    let has = |entry: &str| module.entry_points.iter().any(|point| point.name == entry);
    entries.iter().filter(|entry| !has(entry)).map(|entry| format!("no entry point {entry}")).collect()
}

pub fn a_planted_error_is_found() -> Vec<String> {
    let good = Shader { pieces: &["@compute @workgroup_size(1) fn k() {}"], constants: Vec::new() };
    let bad = Shader { pieces: &["@compute @workgroup_size(1) fn k() { let x: u32 = 1.5f; }"], constants: Vec::new() };
    assert!(shader_faults(&good, &["k"]).is_empty());
    assert_eq!(shader_faults(&good, &["other"]), ["no entry point other"]);
    assert!(!shader_faults(&bad, &["k"]).is_empty());
    Vec::new()
}
