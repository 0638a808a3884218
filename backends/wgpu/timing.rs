//! Times of nodes, and whose clock they come from.

use crate::command::Act;
use crate::prepare::Prepared;
use crate::readback::read_words;
use shadowgraph_core::problem::Problem;
use shadowgraph_core::reading::Reading;

/// Where a node's time comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// No node was timed.
    Off,
    /// The host's clock around a submission of its own for each node, waited for. The way for software rasterisers, whose
    /// timestamps cannot be trusted; costs a submission a node.
    HostPerNode,
    /// The device's timestamps at the borders of the node's passes, all nodes in one submission.
    Device,
}

impl Clock {
    /// As records show it.
    pub fn text(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::HostPerNode => "host clock, one submission a node",
            Self::Device => "device timestamps at pass boundaries",
        }
    }

    /// The clock for a device of this type with these features.
    pub(crate) fn fitting(kind: wgpu::DeviceType, features: wgpu::Features) -> Self {
        let stamps = features.contains(wgpu::Features::TIMESTAMP_QUERY);
        if kind == wgpu::DeviceType::Cpu || !stamps { Self::HostPerNode } else { Self::Device }
    }
}

/// Timestamps at the first and last pass boundary of every node.
pub(crate) struct Stamps {
    set: wgpu::QuerySet,
    count: u32,
    resolved: wgpu::Buffer,
}

impl Stamps {
    /// For a plan of `nodes` nodes; those past what one query set holds stay untimed.
    pub fn new(device: &wgpu::Device, nodes: usize) -> Self {
        let count = (2 * nodes as u32).clamp(2, wgpu::QUERY_SET_MAX_QUERIES);
        let label = Some("node times");
        Self {
            set: device.create_query_set(&wgpu::QuerySetDescriptor { label, ty: wgpu::QueryType::Timestamp, count }),
            count,
            resolved: device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size: u64::from(count) * 8,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
        }
    }

    /// Query indices of a node for a pass that is its first, its last, both; none for a pass between.
    fn indices(&self, node: usize, first: bool, last: bool) -> Option<[Option<u32>; 2]> {
        let begin = 2 * node as u32;
        ((first || last) && begin + 1 < self.count).then_some([first.then_some(begin), last.then_some(begin + 1)])
    }

    pub fn compute(&self, node: usize, first: bool, last: bool) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        self.indices(node, first, last).map(|[begin, end]| wgpu::ComputePassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: begin,
            end_of_pass_write_index: end,
        })
    }

    pub fn render(&self, node: usize, first: bool, last: bool) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        self.indices(node, first, last).map(|[begin, end]| wgpu::RenderPassTimestampWrites {
            query_set: &self.set,
            beginning_of_pass_write_index: begin,
            end_of_pass_write_index: end,
        })
    }

    /// Records the end of the frame.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.set, 0..self.count, &self.resolved, 0);
    }

    /// When each node ran, after the frame has; milliseconds since the first stamp.
    pub fn readings(&self, prepared: &Prepared, queue: &wgpu::Queue) -> Result<Vec<Reading>, Problem> {
        let words = read_words(&prepared.device, queue, &self.resolved, 0, self.count as usize * 2)?;
        let tick = |query: usize| u64::from(words[2 * query]) | u64::from(words[2 * query + 1]) << 32;
        let ticks = |index: usize| {
            let is_timed = prepared.nodes[index].as_ref().is_some_and(|acts| acts.iter().any(Act::is_pass));
            (is_timed && 2 * index + 1 < self.count as usize).then(|| [tick(2 * index), tick(2 * index + 1)])
        };
        let ticks: Vec<_> = (0..prepared.nodes.len()).map(ticks).collect();
        let first = ticks.iter().flatten().flatten().copied().filter(|tick| *tick != 0).min().unwrap_or(0);
        let millis_per_tick = f64::from(queue.get_timestamp_period()) * 1e-6;
        let millis = |tick: u64| (tick - first) as f64 * millis_per_tick;
        let reading = |ticks: Option<[u64; 2]>| match ticks {
            None => Reading::Untimed,
            Some([begin, end]) if begin == 0 || end == 0 => Reading::Dropped,
            Some([begin, end]) => Reading::of(millis(begin), millis(end)),
        };
        Ok(ticks.into_iter().map(reading).collect())
    }
}
