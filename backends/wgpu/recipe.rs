//! The recipes of a plan's wgpu nodes, made and checked without a device.

use shadowgraph_core::plan::{Backend, Node, Plan, Shapes};
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
        for target in written(command) {
            check_written(node, target);
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
fn check_written(node: &Node, target: Target) {
    if let Target::Port(port) = target {
        let is_output = node.outputs.iter().any(|(name, _)| *name == port);
        assert!(is_output, "node {} ({:?}) writes {port}, which is not an output", node.id, node.pass);
    }
}

/// Everything `command` names, for memory and its usages.
pub(crate) fn named(command: &Command) -> Vec<Target> {
    let of_bind = |bind: &[Bind]| -> Vec<Target> {
        bind.iter()
            .filter_map(|bind| match bind {
                Bind::Uniform(_) => None,
                Bind::Read(target) | Bind::ReadWrite(target) | Bind::Texture(target) => Some(*target),
            })
            .collect()
    };
    match command {
        Command::Zero(target) => vec![*target],
        Command::Copy { from, to, .. } => vec![*from, *to],
        Command::Dispatch(Dispatch { bind, groups, .. }) => {
            let mut all = of_bind(bind);
            if let Groups::Indirect(target, _) = groups {
                all.push(*target);
            }
            all
        }
        Command::Draw(Draw { bind, color, depth, .. }) => {
            let mut all = of_bind(bind);
            all.extend(color.iter().map(|color| color.target));
            all.extend(depth.iter().map(|depth| depth.target));
            all
        }
    }
}
