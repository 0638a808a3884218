//! The recipes of a plan's wgpu nodes, made and checked without a device.

use crate::shader::bad_pass;
use shadowgraph_core::plan::{Backend, Node, Plan, Shapes};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{Bind, Command, DeviceLimits, Dispatch, Draw, GpuCx, Groups, Scratch, Target};

/// What one node wants.
#[derive(Debug)]
pub(crate) struct Recipe {
    pub scratch: Vec<Scratch>,
    pub commands: Vec<Command>,
}

/// The recipe of every wgpu node, by node; none for nodes of another backend.
pub(crate) fn recipes(
    plan: &Plan,
    shapes: &Shapes,
    image: [usize; 2],
    limits: DeviceLimits,
) -> Result<Vec<Option<Recipe>>, Problem> {
    plan.nodes
        .iter()
        .map(|node| if node.on == Backend::Wgpu { recipe(node, shapes, image, limits).map(Some) } else { Ok(None) })
        .collect()
}

fn recipe(node: &Node, shapes: &Shapes, image: [usize; 2], limits: DeviceLimits) -> Result<Recipe, Problem> {
    let Some(make) = node.pass.gpu else {
        return Err(Problem::new(Kind::Unsupported, format!("pass {:?} does not run on wgpu", node.pass))
            .node(&node.id)
            .remedy("set `on: Cpu` for it, or choose another pass of the stage"));
    };
    let of_ports = node.inputs.iter().chain(&node.outputs).map(|(port, slot)| (*port, shapes.0[*slot].clone()));
    let mut cx = GpuCx::new(node.pass, &node.params, image, of_ports.collect(), limits);
    make(&mut cx).map_err(|problem| if problem.node.is_some() { problem } else { problem.node(&node.id) })?;
    let (scratch, commands) = cx.finish();
    for command in &commands {
        for (target, is_texture) in named(command) {
            check_named(node, &scratch, target, is_texture)?;
        }
        for target in written(command) {
            check_written(node, target)?;
        }
    }
    Ok(Recipe { scratch, commands })
}

/// Everything `command` writes.
fn written(command: &Command) -> Vec<Target> {
    fn by_bind(bind: &[Bind]) -> impl Iterator<Item = Target> + '_ {
        bind.iter().filter_map(|bind| if let Bind::ReadWrite(target) = bind { Some(*target) } else { None })
    }
    match command {
        Command::Zero(target) => vec![*target],
        Command::Copy { to, .. } => vec![*to],
        Command::Dispatch(dispatch) => by_bind(&dispatch.bind).collect(),
        Command::Draw(draw) => {
            let depth =
                draw.depth.iter().filter(|depth| depth.write || depth.clear.is_some()).map(|depth| depth.target);
            by_bind(&draw.bind).chain(draw.color.iter().map(|color| color.target)).chain(depth).collect()
        }
    }
}

/// An input belongs to its producer: writing it would change what other readers see.
fn check_written(node: &Node, target: Target) -> Result<(), Problem> {
    match target {
        Target::Port(port) if node.outputs.iter().all(|(name, _)| *name != port) => {
            Err(bad_pass(&node.id, format!("pass {:?} writes {port}, which is not an output", node.pass)))
        }
        _ => Ok(()),
    }
}

/// A command may name what its node has: connected ports it reads, outputs, scratch; each as the buffer or texture that it is.
fn check_named(node: &Node, scratch: &[Scratch], target: Target, is_texture: bool) -> Result<(), Problem> {
    let storage = match target {
        Target::Port(name) => {
            let mut connected = node.inputs.iter().chain(&node.outputs);
            connected.find(|(port, _)| *port == name).and_then(|_| node.pass.stage.port(name)).map(|port| port.storage)
        }
        Target::Scratch(index) => scratch.get(index).map(|scratch| scratch.storage),
        Target::Counters => (!node.pass.counters.is_empty()).then_some(Storage::Buffer),
    };
    let kind = |is_texture| if is_texture { "a texture" } else { "a buffer" };
    match storage {
        None => Err(bad_pass(&node.id, format!("pass {:?} names {target:?}, which it does not have", node.pass))),
        Some(storage) if (storage != Storage::Buffer) != is_texture => {
            let message = format!("pass {:?} names {target:?} as {}", node.pass, kind(is_texture));
            Err(bad_pass(&node.id, message).expected(kind(!is_texture)))
        }
        Some(_) => Ok(()),
    }
}

/// Everything `command` names, and whether as a texture.
pub(crate) fn named(command: &Command) -> Vec<(Target, bool)> {
    let of_bind = |bind: &[Bind]| -> Vec<(Target, bool)> {
        bind.iter()
            .filter_map(|bind| match bind {
                Bind::Uniform(_) => None,
                Bind::Read(target) | Bind::ReadWrite(target) => Some((*target, false)),
                Bind::Texture(target) => Some((*target, true)),
            })
            .collect()
    };
    match command {
        Command::Zero(target) => vec![(*target, false)],
        Command::Copy { from, to, .. } => vec![(*from, false), (*to, false)],
        Command::Dispatch(Dispatch { bind, groups, .. }) => {
            let mut all = of_bind(bind);
            if let Groups::Indirect(target, _) = groups {
                all.push((*target, false));
            }
            all
        }
        Command::Draw(Draw { bind, color, depth, .. }) => {
            let mut all = of_bind(bind);
            all.extend(color.iter().map(|color| (color.target, true)));
            all.extend(depth.iter().map(|depth| (depth.target, true)));
            all
        }
    }
}
