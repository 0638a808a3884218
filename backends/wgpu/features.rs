//! Features of a plan in wgpu's terms, known before a device exists.

use shadowgraph_core::pass::Feature;
use shadowgraph_core::plan::{Backend, Plan};
use shadowgraph_core::problem::{Kind, Problem};

/// Features to ask for when the host makes its device. Those of [`Feature`] that WebGPU calls downlevel capabilities need no
/// asking, but may be absent: [`check_features`] finds both.
pub fn required_features(plan: &Plan) -> wgpu::Features {
    plan.required_features().into_iter().map(wgpu_feature).fold(wgpu::Features::empty(), |all, one| all | one)
}

/// The feature to ask a device for; empty where it is no feature but a capability.
fn wgpu_feature(feature: Feature) -> wgpu::Features {
    match feature {
        Feature::ConservativeRasterization => wgpu::Features::CONSERVATIVE_RASTERIZATION,
        _ => wgpu::Features::empty(),
    }
}

/// The capability an adapter must report; empty for features.
fn wgpu_capability(feature: Feature) -> wgpu::DownlevelFlags {
    match feature {
        Feature::IndirectExecution => wgpu::DownlevelFlags::INDIRECT_EXECUTION,
        Feature::FragmentWritableStorage => wgpu::DownlevelFlags::FRAGMENT_WRITABLE_STORAGE,
        _ => wgpu::DownlevelFlags::empty(),
    }
}

/// wgpu's name of a feature, as users know it.
pub fn feature_name(feature: Feature) -> &'static str {
    match feature {
        Feature::ConservativeRasterization => "CONSERVATIVE_RASTERIZATION",
        Feature::IndirectExecution => "INDIRECT_EXECUTION",
        Feature::FragmentWritableStorage => "FRAGMENT_WRITABLE_STORAGE",
        _ => "unknown",
    }
}

/// Whether `have` and `can` (an adapter's, or a device's features) suffice for every wgpu node of `plan`.
///
/// # Errors
/// The first node whose pass needs what is absent, with pass and feature.
pub fn check_features(plan: &Plan, have: wgpu::Features, can: wgpu::DownlevelFlags) -> Result<(), Problem> {
    for node in plan.nodes.iter().filter(|node| node.on == Backend::Wgpu) {
        for feature in node.pass.features {
            if !have.contains(wgpu_feature(*feature)) || !can.contains(wgpu_capability(*feature)) {
                let name = feature_name(*feature);
                return Err(Problem::new(Kind::Unsupported, format!("pass {:?} needs feature {name}", node.pass))
                    .node(&node.id)
                    .expected(format!("a device with {name}"))
                    .found("a device without it")
                    .remedy("choose another pass of the stage, another adapter, or `on: Cpu`"));
            }
        }
    }
    Ok(())
}
