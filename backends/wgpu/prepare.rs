//! A plan made ready for a device: memory allocated, pipelines made, small numbers uploaded.

use crate::command::{Act, Maker};
use crate::errors::scoped;
use crate::externals::slot_named;
use crate::features::check_features;
use crate::limits::device_limits;
use crate::pipeline::Pipelines;
use crate::pool::{Home, Layout, Memory, allocate};
use crate::recipe::{Recipe, recipes};
use crate::settle::Settle;
use shadowgraph_core::plan::{Grown, Plan, Shapes};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::record::DeviceLimits;
use std::collections::HashMap;

/// What to prepare.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// Shape of every graph input, by name.
    pub inputs: &'a [(String, Vec<usize>)],
    /// Picture width and height, pixels.
    pub image: [usize; 2],
    /// Capacities that an earlier run found to be needed.
    pub grown: &'a Grown,
    /// Graph inputs and outputs that the host binds in [`crate::Externals`]: no memory is made for them.
    pub external: &'a [&'a str],
    /// Whether transients share memory as the plan says; off, each has its own.
    pub alias: bool,
    /// Most device memory to take, bytes; none: as much as single buffers allow.
    pub budget_bytes: Option<u64>,
}

impl<'a> Request<'a> {
    /// `plan` for inputs of these shapes; nothing grown, nothing external, aliasing on, no budget.
    pub fn new(plan: &'a Plan, inputs: &'a [(String, Vec<usize>)], image: [usize; 2]) -> Self {
        const NOTHING: &Grown = &Grown::new();
        Self { plan, inputs, image, grown: NOTHING, external: &[], alias: true, budget_bytes: None }
    }
}

/// A plan ready to be recorded, any number of times.
#[derive(Debug)]
pub struct Prepared {
    pub(crate) device: wgpu::Device,
    pub(crate) plan: Plan,
    pub(crate) shapes: Shapes,
    /// What the request said.
    pub(crate) grown: Grown,
    pub(crate) layout: Layout,
    pub(crate) memories: Vec<Memory>,
    /// Whether nodes and commands are labelled in the encoder: Mesa's llvmpipe crashes on the second label of an encoder.
    pub(crate) labels: bool,
    /// What follows every draw, on a device that needs it.
    pub(crate) settle: Option<Settle>,
    /// What to record for each node; none for nodes of another backend.
    pub(crate) nodes: Vec<Option<Vec<Act>>>,
}

impl Prepared {
    /// Allocates and compiles everything `request` needs on the host's device. Writes to `queue` take effect with the host's
    /// next submission.
    ///
    /// # Errors
    /// A feature the device lacks, an input that is missing, memory that does not fit, or what the device itself reports.
    pub fn prepare(device: &wgpu::Device, queue: &wgpu::Queue, request: &Request) -> Result<Self, Problem> {
        Self::prepare_with(&Pipelines::new(device), device, queue, request)
    }

    /// As [`Prepared::prepare`], with pipelines that were made before.
    pub(crate) fn prepare_with(
        pipelines: &Pipelines,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        request: &Request,
    ) -> Result<Self, Problem> {
        let plan = request.plan;
        // A device does not tell its downlevel capabilities; the session checks those of its adapter.
        check_features(plan, device.features(), wgpu::DownlevelFlags::all())?;
        let limits = device.limits();
        let Laid { shapes, recipes, layout } = lay_out(request, device_limits(&limits))?;
        layout.check(&limits, request.budget_bytes)?;
        scoped(device, || {
            let memories = allocate(device, &layout);
            let mut prepared = Self {
                device: device.clone(),
                plan: plan.clone(),
                shapes,
                grown: request.grown.clone(),
                layout,
                memories,
                labels: device.adapter_info().driver != "llvmpipe",
                settle: Settle::new(device),
                nodes: Vec::new(),
            };
            let mut maker = Maker { pipelines, queue, dummies: HashMap::new(), limits };
            for (index, recipe) in recipes.iter().enumerate() {
                let acts = recipe.as_ref().map(|recipe| maker.acts(&prepared, index, recipe)).transpose();
                prepared.nodes.push(acts?);
            }
            Ok(prepared)
        })
    }

    /// Shape of the slot called `name`, or of the graph output of that name.
    ///
    /// # Errors
    /// There is no such slot.
    pub fn shape(&self, name: &str) -> Result<&[usize], Problem> {
        Ok(&self.shapes.0[slot_named(&self.plan, name)?])
    }

    /// The buffer of an input, a kept slot or a graph output; none when the host binds it, when it is a texture, or when no
    /// wgpu node touches it. Transients may share theirs with others.
    pub fn buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        match self.own(name)? {
            Memory::Buffer(buffer) => Some(buffer),
            Memory::Texture(_) => None,
        }
    }

    /// As [`Prepared::buffer`], for textures.
    pub fn texture(&self, name: &str) -> Option<&wgpu::Texture> {
        match self.own(name)? {
            Memory::Texture(texture) => Some(texture),
            Memory::Buffer(_) => None,
        }
    }

    fn own(&self, name: &str) -> Option<&Memory> {
        match self.layout.slot(slot_named(&self.plan, name).ok()?)?.home {
            Home::Own(index) => Some(&self.memories[index]),
            Home::External(_) => None,
        }
    }

    /// Device memory taken, bytes.
    pub fn bytes(&self) -> u64 {
        self.layout.bytes()
    }
}

/// A request worked out without a device.
pub(crate) struct Laid {
    pub shapes: Shapes,
    pub recipes: Vec<Option<Recipe>>,
    pub layout: Layout,
}

pub(crate) fn lay_out(request: &Request, limits: DeviceLimits) -> Result<Laid, Problem> {
    let plan = request.plan;
    let shapes = plan.shapes(request.inputs, request.image, request.grown)?;
    let recipes = recipes(plan, &shapes, request.image, limits)?;
    let external: Vec<_> = request.external.iter().map(|name| slot_named(plan, name)).collect::<Result<_, _>>()?;
    let layout = Layout::new(plan, &shapes, &recipes, &external, request.alias);
    Ok(Laid { shapes, recipes, layout })
}
