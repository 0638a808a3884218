//! Which side is faster: whole frames with node timers off in blocks A B B A or B A A B, and each node in the same blocks or, where
//! timing a node costs, in blocks of their own.

use crate::stretch::Frame;
use crate::trial::Trial;
use serde::Serialize;
use shadowgraph_core::plan::Backend;
use shadowgraph_core::problem::Problem;
use shadowgraph_measure::paired::{Block, Paired, Settings, Side, Stop, Summary, summarise};
use std::collections::HashMap;
use std::time::Instant;

/// A timing shorter than this, milliseconds, is of several frames: clocks and schedulers are no finer.
const SHORTEST_MILLIS: f64 = 2.0;
/// Most frames of one timing.
const MOST_FRAMES: usize = 64;
/// A frame longer than this finds its memory cold anyway, and is not run untimed first.
const WARMED_MILLIS: f64 = 50.0;
/// Blocks with node timers, where they cost.
const NODE_BLOCKS: usize = 20;

/// What timing says.
#[derive(Clone, Debug, Serialize)]
pub struct Timing {
    /// Whole frames, node timers off.
    pub frame: Summary,
    /// Why it ended.
    pub stop: Stop,
    /// Frames in each timing.
    pub frames_count: usize,
    /// Each node of either side.
    pub nodes: Vec<NodeTiming>,
    /// Whose clock timed nodes, and whether it was in the frames that were compared.
    pub nodes_clock: String,
}

/// A node's times.
#[derive(Clone, Debug, Serialize)]
pub struct NodeTiming {
    /// Its id.
    pub node: String,
    /// Median in A, milliseconds.
    pub a_millis: Option<f64>,
    /// Median in B, milliseconds.
    pub b_millis: Option<f64>,
    /// B against A, where both have it.
    pub summary: Option<Summary>,
}

/// Times both sides. `told` hears of blocks done and blocks at most.
///
/// # Errors
/// What a node reports; settings out of range.
pub fn time<'t>(
    a: &mut Trial<'t>,
    b: &mut Trial<'t>,
    settings: Settings,
    told: &dyn Fn(u64, u64),
) -> Result<Timing, Problem> {
    let once = |trial: &mut Trial| {
        let millis = trial.frame(false).map(|frame| frame.millis);
        trial.forget();
        millis
    };
    let once = [once(a)?, once(b)?];
    let shortest = once[0].min(once[1]).max(1e-3);
    let frames_count = ((SHORTEST_MILLIS / shortest).ceil() as usize).clamp(1, MOST_FRAMES);
    let is_warmed = once[0].max(once[1]) < WARMED_MILLIS;
    let mut nodes = Nodes::default();
    let mut paired = Paired::new(settings)?;
    let free = [&*a, &*b].iter().all(|trial| trial.plan().nodes.iter().all(|node| node.on == Backend::Cpu));
    let mut clock = String::new();
    while let Some(order) = paired.next_block() {
        let begin = Instant::now();
        let mut millis = [0.0; 4];
        for (place, side) in order.into_iter().enumerate() {
            let trial = match side {
                Side::A => &mut *a,
                Side::B => &mut *b,
            };
            if is_warmed {
                trial.frame(false)?;
            }
            let mut frames = Vec::with_capacity(frames_count);
            for _ in 0..frames_count {
                frames.push(trial.frame(false)?);
            }
            trial.forget();
            millis[place] = (frames.iter().map(|frame| frame.millis).sum::<f64>() / frames_count as f64).max(1e-6);
            if free {
                nodes.add(order, place, trial, &frames);
            }
        }
        // Warm-up, further frames and making ready count against the budget too.
        paired.spend(begin.elapsed().as_secs_f64() * 1e3 - millis.iter().sum::<f64>());
        paired.push(millis)?;
        told(paired.blocks().len() as u64, u64::from(settings.most_blocks));
    }
    if free {
        clock = "host clock around each function, in the frames compared".into();
    } else {
        let mut coin =
            Paired::new(Settings { most_blocks: settings.most_blocks.max(settings.pilot_blocks), ..settings })?;
        for block in 0..NODE_BLOCKS.min(paired.blocks().len()) {
            let Some(order) = coin.next_block() else { break };
            let mut millis = [0.0; 4];
            for (place, side) in order.into_iter().enumerate() {
                let trial = match side {
                    Side::A => &mut *a,
                    Side::B => &mut *b,
                };
                let frame = trial.frame(true)?;
                trial.forget();
                millis[place] = frame.millis.max(1e-6);
                clock = frame
                    .nodes
                    .iter()
                    .flatten()
                    .map(|ran| ran.clock)
                    .find(|clock| *clock != "off")
                    .unwrap_or("")
                    .into();
                nodes.add(order, place, trial, std::slice::from_ref(&frame));
            }
            coin.push(millis)?;
            told(block as u64, NODE_BLOCKS as u64);
        }
        clock += ", in frames of their own";
    }
    let stop = paired.stop().unwrap_or(Stop::MostBlocks);
    let frame = paired.summary()?;
    Ok(Timing { frame, stop, frames_count, nodes: nodes.finish(&settings)?, nodes_clock: clock })
}

/// A block of one node: who ran when, and its times where it ran.
type NodeBlock = ([Side; 4], [Option<f64>; 4]);

/// Times of nodes by block, in the order that nodes run.
#[derive(Default)]
struct Nodes {
    order: Vec<String>,
    blocks: HashMap<String, Vec<NodeBlock>>,
}

impl Nodes {
    fn add(&mut self, order: [Side; 4], place: usize, trial: &Trial, frames: &[Frame]) {
        for (index, node) in trial.plan().nodes.iter().enumerate() {
            let times: Option<Vec<f64>> =
                frames.iter().map(|frame| frame.nodes[index].as_ref().and_then(|ran| ran.millis)).collect();
            let Some(times) = times.filter(|times| !times.is_empty()) else { continue };
            let mean = times.iter().sum::<f64>() / times.len() as f64;
            if !self.blocks.contains_key(&node.id) {
                self.order.push(node.id.clone());
            }
            let blocks = self.blocks.entry(node.id.clone()).or_default();
            // A block is new at its first side, or at the first side that has the node.
            let is_new = blocks.last().is_none_or(|(_, millis)| millis[place..].iter().any(Option::is_some));
            if is_new {
                blocks.push((order, [None; 4]));
            }
            if let Some((_, millis)) = blocks.last_mut() {
                millis[place] = Some(mean);
            }
        }
    }

    fn finish(self, settings: &Settings) -> Result<Vec<NodeTiming>, Problem> {
        let Self { order, blocks } = self;
        let of_node = |node: String| {
            let blocks = &blocks[&node];
            let whole: Vec<Block> = blocks
                .iter()
                .filter_map(|(order, millis)| {
                    let [Some(a), Some(b), Some(c), Some(d)] = *millis else { return None };
                    // A node without work is timed as nothing at all.
                    Some(Block { order: *order, millis: [a, b, c, d].map(|millis| millis.max(1e-6)) })
                })
                .collect();
            let median_of = |side: Side| {
                let times = blocks.iter().flat_map(|(order, millis)| {
                    order.iter().zip(millis).filter(|(of, _)| **of == side).filter_map(|(_, millis)| *millis)
                });
                let times: Vec<f64> = times.collect();
                shadowgraph_measure::statistics::median(&times).ok()
            };
            let summary = if whole.is_empty() { None } else { Some(summarise(&whole, settings)?) };
            let (a_millis, b_millis) = (median_of(Side::A), median_of(Side::B));
            Ok(NodeTiming { node, a_millis, b_millis, summary })
        };
        order.into_iter().map(of_node).collect()
    }
}
