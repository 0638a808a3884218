//! A recipe's commands with pipelines, memory and sizes: what is left is to record them.

use crate::group::Group;
use crate::limits::{check_buffers, storage_buffers};
use crate::pipeline::{DUMMY_FORMAT, Made, Pipelines};
use crate::pool::Part;
use crate::prepare::Prepared;
use crate::recipe::Recipe;
use crate::shader::{Class, bad_pass};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, Dispatch, Draw, Groups, Target};
use std::collections::HashMap;

/// One thing to record.
#[derive(Debug)]
pub(crate) enum Act {
    Zero(Part),
    Copy {
        from: Part,
        to: Part,
        bytes: u64,
    },
    /// Dispatches that follow one another, in one compute pass.
    Compute(Vec<Kernel>),
    Draw(Box<Raster>),
}

impl Act {
    /// Whether it is a pass, which has borders to stamp.
    pub fn is_pass(&self) -> bool {
        matches!(self, Self::Compute(_) | Self::Draw(_))
    }
}

/// A dispatch.
#[derive(Debug)]
pub(crate) struct Kernel {
    pub label: &'static str,
    pub pipeline: wgpu::ComputePipeline,
    pub group: Group,
    pub size: Size,
}

/// How many workgroups.
#[derive(Debug)]
pub(crate) enum Size {
    Direct([u32; 3]),
    Indirect(Part, u64),
}

/// A draw.
#[derive(Debug)]
pub(crate) struct Raster {
    pub draw: Draw,
    pub pipeline: wgpu::RenderPipeline,
    pub group: Group,
    pub color: Vec<Part>,
    pub depth: Option<Part>,
    pub dummy: Option<wgpu::TextureView>,
}

/// Makes what is recorded.
pub(crate) struct Maker<'a> {
    pub pipelines: &'a Pipelines,
    pub queue: &'a wgpu::Queue,
    /// Attachments that nothing is written to, by size.
    pub dummies: HashMap<[u32; 2], wgpu::TextureView>,
    pub limits: wgpu::Limits,
}

impl Maker<'_> {
    /// The commands of a node's recipe.
    ///
    /// # Errors
    /// Recipe and kernels disagree; a draw or dispatch is larger than the device allows.
    pub fn acts(&mut self, prepared: &Prepared, node: usize, recipe: &Recipe) -> Result<Vec<Act>, Problem> {
        let part = |target: Target| prepared.layout.part(&prepared.plan, node, target).clone();
        let mut acts: Vec<Act> = Vec::new();
        for command in &recipe.commands {
            match command {
                Command::Zero(target) => acts.push(Act::Zero(part(*target))),
                Command::Copy { words: 0, .. } => {}
                Command::Copy { from, to, words } => {
                    acts.push(Act::Copy { from: part(*from), to: part(*to), bytes: *words as u64 * 4 });
                }
                Command::Dispatch(dispatch) => {
                    let kernel = self.kernel(prepared, node, dispatch)?;
                    match acts.last_mut() {
                        Some(Act::Compute(kernels)) => kernels.push(kernel),
                        _ => acts.push(Act::Compute(vec![kernel])),
                    }
                }
                Command::Draw(draw) => acts.push(Act::Draw(Box::new(self.raster(prepared, node, draw)?))),
            }
        }
        Ok(acts)
    }

    fn kernel(&self, prepared: &Prepared, node: usize, dispatch: &Dispatch) -> Result<Kernel, Problem> {
        check_buffers(&prepared.plan.nodes[node], storage_buffers(&dispatch.bind), &self.limits)?;
        let who = who(prepared, node, dispatch.label);
        let parts = classes(prepared, node, &dispatch.bind);
        let classes: Vec<Class> = parts.iter().map(|(class, _)| *class).collect();
        let Made { pipeline, bind } = self.pipelines.compute(&who, dispatch, &classes)?;
        let size = match &dispatch.groups {
            Groups::Direct(size) => {
                let most = self.limits.max_compute_workgroups_per_dimension;
                if size.iter().any(|count| *count > most) {
                    return Err(Problem::new(Kind::Overflow, "a dispatch is larger than the device allows")
                        .node(who)
                        .expected(format!("at most {most} workgroups along an axis"))
                        .found(format!("{size:?}")));
                }
                Size::Direct(*size)
            }
            Groups::Indirect(target, word) => {
                Size::Indirect(prepared.layout.part(&prepared.plan, node, *target).clone(), *word as u64 * 4)
            }
        };
        let group = Group::new(prepared, self.queue, &who, bind, &dispatch.bind, parts);
        Ok(Kernel { label: dispatch.label, pipeline, group, size })
    }

    fn raster(&mut self, prepared: &Prepared, node: usize, draw: &Draw) -> Result<Raster, Problem> {
        check_buffers(&prepared.plan.nodes[node], storage_buffers(&draw.bind), &self.limits)?;
        let who = who(prepared, node, draw.label);
        let part = |target: Target| prepared.layout.part(&prepared.plan, node, target).clone();
        let color: Vec<Part> = draw.color.iter().map(|color| part(color.target)).collect();
        let depth = draw.depth.as_ref().map(|depth| part(depth.target));
        let size = draw.size.map(|side| side.max(1));
        for target in color.iter().chain(&depth) {
            let [width, height, _] = target.extent();
            if [width, height] != size {
                return Err(bad_pass(&who, "an attachment does not have the size of the draw")
                    .expected(format!("{}x{}", size[0], size[1]))
                    .found(format!("{width}x{height}")));
            }
        }
        let most = self.limits.max_texture_dimension_2d;
        if size.iter().any(|side| *side > most) {
            return Err(Problem::new(Kind::Overflow, "a draw is larger than the device allows")
                .node(&prepared.plan.nodes[node].id)
                .expected(format!("a side of {}", size[0].max(size[1])))
                .found(format!("at most {most}")));
        }
        let parts = classes(prepared, node, &draw.bind);
        let classes: Vec<Class> = parts.iter().map(|(class, _)| *class).collect();
        let storages: Vec<Storage> = color.iter().map(|part| part.storage).collect();
        let Made { pipeline, bind } = self.pipelines.render(&who, draw, &classes, &storages)?;
        let group = Group::new(prepared, self.queue, &who, bind, &draw.bind, parts);
        let dummy = (color.is_empty() && depth.is_none()).then(|| self.dummy(&prepared.device, size));
        Ok(Raster { draw: draw.clone(), pipeline, group, color, depth, dummy })
    }

    /// An attachment that nothing is written to.
    fn dummy(&mut self, device: &wgpu::Device, size: [u32; 2]) -> wgpu::TextureView {
        let make = || {
            let descriptor = wgpu::TextureDescriptor {
                label: Some("dummy attachment"),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: DUMMY_FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
                view_formats: &[],
            };
            device.create_texture(&descriptor).create_view(&Default::default())
        };
        self.dummies.entry(size).or_insert_with(make).clone()
    }
}

/// `node/label`, for problems and captures.
fn who(prepared: &Prepared, node: usize, label: &str) -> String {
    format!("{}/{label}", prepared.plan.nodes[node].id)
}

/// What a recipe binds at each place, with its memory.
pub(crate) fn classes(prepared: &Prepared, node: usize, bind: &[Bind]) -> Vec<(Class, Option<Part>)> {
    let part = |target: Target| prepared.layout.part(&prepared.plan, node, target).clone();
    bind.iter()
        .map(|bind| match bind {
            Bind::Uniform(words) => (Class::Uniform((words.len().max(1) as u32 * 4).next_multiple_of(16)), None),
            Bind::UniformOf(target, words) => (Class::Uniform(words.len() as u32 * 4), Some(part(*target))),
            Bind::Read(target) => (Class::Read, Some(part(*target))),
            Bind::ReadWrite(target) => (Class::ReadWrite, Some(part(*target))),
            Bind::Texture(target) => {
                let part = part(*target);
                (Class::Texture(part.storage), Some(part))
            }
        })
        .collect()
}
