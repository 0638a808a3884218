use super::PASSES;
use crate::ports;
use shadowgraph_core::param::Params;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::record::{Bind, Command, DeviceLimits, GpuCx};

/// What WebGPU promises on every device.
const LIMITS: DeviceLimits = DeviceLimits { storage_binding_bytes: 128 << 20, texture_side: 8192, storage_buffers: 8 };

/// Commands of a pass for one view-sample and one light sample; `visible_color` has so many rows.
fn commands(pass: &'static Pass, colored: usize) -> Vec<Command> {
    let shape = |port: &str| match port {
        "visible_color" => vec![colored, 3],
        "triangles" | "triangle_normals" => vec![1, 3, 3],
        "camera" => vec![20],
        "light" => vec![8],
        "position" | "normal" | "triangle_albedo" | "corner_light" | "light_samples" | "light_weights" => vec![1, 3],
        _ => vec![1, 1],
    };
    let mut shapes: Vec<_> = pass.reads().map(|port| (port.name, shape(port.name))).collect();
    shapes.push((ports::IMAGE.name, vec![1, 1, 4]));
    let params = Params::defaults(pass.params);
    let mut cx = GpuCx::new(pass, &params, [1, 1], shapes, LIMITS);
    pass.gpu.expect("has a recipe")(&mut cx).expect("records");
    cx.finish().1
}

#[test]
fn no_dispatch_binds_more_storage_buffers_than_every_device_has() {
    for pass in PASSES {
        for command in commands(pass, 1) {
            let Command::Dispatch(dispatch) = command else { panic!("{pass:?} does more than dispatch") };
            let storage = dispatch.bind.iter().filter(|bind| matches!(bind, Bind::Read(_) | Bind::ReadWrite(_)));
            assert!(storage.count() <= LIMITS.storage_buffers as usize, "{pass:?}: {}", dispatch.label);
        }
    }
}

#[test]
fn colour_is_read_where_there_is_some() {
    for pass in PASSES.iter().filter(|pass| !pass.ignores.contains(&"visible")) {
        let reads = |colored: usize, port: &'static str| {
            let port = Bind::Read(shadowgraph_core::record::Target::Port(port));
            let dispatches = commands(pass, colored);
            dispatches.iter().any(|command| matches!(command, Command::Dispatch(one) if one.bind.contains(&port)))
        };
        assert!(reads(1, "visible_color") && !reads(1, "visible"), "{pass:?}");
        assert!(reads(0, "visible") && !reads(0, "visible_color"), "{pass:?}");
    }
}
