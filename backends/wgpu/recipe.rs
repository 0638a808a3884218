//! The recipes of a plan's wgpu nodes, made and checked without a device.

use crate::shader::bad_pass;
use shadowgraph_core::plan::{Backend, Node, Plan, Shapes};
use shadowgraph_core::port::Storage;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::record::{
    Bind, Command, DeviceLimits, Dispatch, Draw, GpuCx, Groups, Scratch, Target, UNIFORM_WORDS,
};

/// The least that devices bind as a uniform.
const MOST_UNIFORM_WORDS: usize = 4096;

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
        check_uniforms(node, &scratch, command)?;
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

/// The memory that `command` binds as uniforms.
pub(crate) fn uniforms(command: &Command) -> impl Iterator<Item = Target> + '_ {
    bound(command).iter().filter_map(|bind| if let Bind::UniformOf(target, _) = bind { Some(*target) } else { None })
}

fn bound(command: &Command) -> &[Bind] {
    match command {
        Command::Dispatch(dispatch) => &dispatch.bind,
        Command::Draw(draw) => &draw.bind,
        Command::Zero(_) | Command::Copy { .. } => &[],
    }
}

/// A uniform over memory is over scratch memory: a host's buffer need not be made for it.
fn check_uniforms(node: &Node, scratch: &[Scratch], command: &Command) -> Result<(), Problem> {
    for bind in bound(command) {
        let Bind::UniformOf(target, words) = bind else { continue };
        let room = match target {
            Target::Scratch(index) => scratch.get(*index).map_or(0, |scratch| scratch.shape.iter().product()),
            Target::Port(_) | Target::Counters => 0,
        };
        let is_aligned = words.start.is_multiple_of(UNIFORM_WORDS) && words.len().is_multiple_of(4);
        if words.is_empty() || words.end > room || words.len() > MOST_UNIFORM_WORDS || !is_aligned {
            return Err(bad_pass(&node.id, format!("pass {:?} binds words {words:?} of {target:?} as a uniform", node.pass))
                .expected(format!(
                    "words of scratch memory from a multiple of {UNIFORM_WORDS}, a multiple of 4 and at most {MOST_UNIFORM_WORDS} of them"
                ))
                .found(format!("{room} words")));
        }
    }
    Ok(())
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
                Bind::UniformOf(target, _) | Bind::Read(target) | Bind::ReadWrite(target) => Some((*target, false)),
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
