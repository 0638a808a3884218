//! Recording into the host's encoder.

use crate::command::{Act, Kernel, Raster, Size};
use crate::externals::{Bound, Externals};
use crate::prepare::Prepared;
use crate::statistics::Invocations;
use crate::timing::Stamps;
use shadowgraph_core::pass::Pass;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::ColorTarget;
use std::ops::Range;

/// What is asked of the device while nodes run.
#[derive(Clone, Copy, Default)]
pub(crate) struct Queries<'a> {
    pub stamps: Option<&'a Stamps>,
    pub invocations: Option<&'a Invocations>,
}

impl Prepared {
    /// Records every wgpu node, in the order of the plan, in debug groups named by node. Nothing is submitted.
    ///
    /// # Errors
    /// What `externals` binds does not fit, or something is missing.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, externals: &Externals) -> Result<(), Problem> {
        self.record_range(encoder, externals, 0..self.nodes.len())
    }

    /// As [`Prepared::record`], for the nodes `nodes` alone: a host may record work of its own between.
    ///
    /// # Errors
    /// As there.
    pub fn record_range(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        externals: &Externals,
        nodes: Range<usize>,
    ) -> Result<(), Problem> {
        let bound = Bound::new(self, externals)?;
        self.record_nodes(encoder, &bound, nodes, Queries::default());
        Ok(())
    }

    /// Names of the nodes in order, for ranges.
    pub fn node_ids(&self) -> impl Iterator<Item = &str> {
        self.plan.nodes.iter().map(|node| node.id.as_str())
    }

    pub(crate) fn record_nodes(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        bound: &Bound,
        nodes: Range<usize>,
        queries: Queries,
    ) {
        for index in nodes {
            let Some(acts) = &self.nodes[index] else { continue };
            let node = &self.plan.nodes[index];
            let span = tracing::debug_span!("record", id = node.id, pass = node.pass.name);
            let _entered = span.enter();
            if self.labels {
                encoder.push_debug_group(&node.id);
            }
            if let Some(counters) = self.layout.counters(index) {
                zero(encoder, bound, counters);
            }
            let first = acts.iter().position(Act::is_pass);
            let last = acts.iter().rposition(Act::is_pass);
            for (place, act) in acts.iter().enumerate() {
                let (begin, end) = (first == Some(place), last == Some(place));
                match act {
                    Act::Zero(part) => zero(encoder, bound, part),
                    Act::Copy { from, to, bytes } => {
                        let ((from, from_start), (to, to_start)) = (bound.buffer(from), bound.buffer(to));
                        encoder.copy_buffer_to_buffer(from, from_start, to, to_start, *bytes);
                    }
                    Act::Compute(kernels) => {
                        let stamps = queries.stamps.and_then(|stamps| stamps.compute(index, begin, end));
                        let query = queries.invocations.and_then(|counted| counted.query(index, place));
                        compute(encoder, bound, node.pass, kernels, stamps, query);
                    }
                    Act::Draw(raster) => {
                        let stamps = queries.stamps.and_then(|stamps| stamps.render(index, begin, end));
                        let query = queries.invocations.and_then(|counted| counted.query(index, place));
                        draw(encoder, bound, raster, stamps, query);
                        if let Some(settle) = &self.settle {
                            settle.record(encoder);
                        }
                    }
                }
            }
            if self.labels {
                encoder.pop_debug_group();
            }
        }
    }
}

fn zero(encoder: &mut wgpu::CommandEncoder, bound: &Bound, part: &crate::pool::Part) {
    let (buffer, offset) = bound.buffer(part);
    encoder.clear_buffer(buffer, offset, Some(part.bytes()));
}

fn compute(
    encoder: &mut wgpu::CommandEncoder,
    bound: &Bound,
    node: &Pass,
    kernels: &[Kernel],
    timestamp_writes: Option<wgpu::ComputePassTimestampWrites>,
    query: Option<(&wgpu::QuerySet, u32)>,
) {
    let descriptor =
        wgpu::ComputePassDescriptor { label: bound.prepared.labels.then_some(node.name), timestamp_writes };
    let mut pass = encoder.begin_compute_pass(&descriptor);
    if let Some((set, index)) = query {
        pass.begin_pipeline_statistics_query(set, index);
    }
    for kernel in kernels {
        if bound.prepared.labels {
            pass.push_debug_group(kernel.label);
        }
        pass.set_pipeline(&kernel.pipeline);
        pass.set_bind_group(0, &kernel.group.get(bound, kernel.label), &[]);
        match &kernel.size {
            Size::Direct([x, y, z]) => pass.dispatch_workgroups(*x, *y, *z),
            Size::Indirect(part, start) => {
                let (buffer, offset) = bound.buffer(part);
                pass.dispatch_workgroups_indirect(buffer, offset + start);
            }
        }
        if bound.prepared.labels {
            pass.pop_debug_group();
        }
    }
    if query.is_some() {
        pass.end_pipeline_statistics_query();
    }
}

fn draw(
    encoder: &mut wgpu::CommandEncoder,
    bound: &Bound,
    raster: &Raster,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites>,
    query: Option<(&wgpu::QuerySet, u32)>,
) {
    let draw = &raster.draw;
    let color: Vec<_> = raster.color.iter().map(|part| bound.texture(part).create_view(&Default::default())).collect();
    let mut attachments: Vec<_> =
        color.iter().zip(&draw.color).map(|(view, target)| Some(attachment(view, target))).collect();
    if let Some(view) = &raster.dummy {
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Discard };
        attachments.push(Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }));
    }
    let depth = raster.depth.as_ref().zip(draw.depth.as_ref()).map(|(part, target)| {
        let view = bound.texture(part).create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: target.layer,
            array_layer_count: Some(1),
            ..Default::default()
        });
        // Depth that is neither cleared nor written is bound read-only, so the same draw may also read it as a texture.
        let load = target.clear.map_or(wgpu::LoadOp::Load, wgpu::LoadOp::Clear);
        let changed = target.write || target.clear.is_some();
        (view, changed.then_some(wgpu::Operations { load, store: wgpu::StoreOp::Store }))
    });
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: bound.prepared.labels.then_some(draw.label),
        color_attachments: &attachments,
        depth_stencil_attachment: depth.as_ref().map(|(view, depth_ops)| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: *depth_ops,
            stencil_ops: None,
        }),
        timestamp_writes,
        ..Default::default()
    });
    if let Some((set, index)) = query {
        pass.begin_pipeline_statistics_query(set, index);
    }
    if draw.vertices > 0 && draw.instances > 0 {
        pass.set_pipeline(&raster.pipeline);
        pass.set_bind_group(0, &raster.group.get(bound, draw.label), &[]);
        pass.draw(0..draw.vertices, 0..draw.instances);
    }
    if query.is_some() {
        pass.end_pipeline_statistics_query();
    }
}

fn attachment<'a>(view: &'a wgpu::TextureView, target: &ColorTarget) -> wgpu::RenderPassColorAttachment<'a> {
    let load = target.clear.map_or(wgpu::LoadOp::Load, |[r, g, b, a]| wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }));
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }
}
