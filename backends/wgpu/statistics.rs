//! Pipeline statistics: how often the shaders of each node ran, where a device counts that.

use crate::command::Act;
use crate::errors::scoped;
use crate::externals::Bound;
use crate::prepare::Prepared;
use crate::readback::{read_words, wait};
use crate::ready::Ready;
use crate::record::Queries;
use shadowgraph_core::problem::Problem;

/// What a device counts in a pass, in the order in which it writes it.
const TYPES: wgpu::PipelineStatisticsTypes = wgpu::PipelineStatisticsTypes::all();
/// Numbers of a query.
const NUMBERS: usize = 5;

/// How often shaders of one node ran in one frame, all its passes together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct NodeStatistics {
    /// Vertex shader.
    pub vertex_invocations: u64,
    /// Triangles that reached the clipper.
    pub clipper_invocations: u64,
    /// Triangles that it gave on.
    pub clipper_primitives: u64,
    /// Fragment shader; helpers may be counted.
    pub fragment_invocations: u64,
    /// Compute shader.
    pub compute_invocations: u64,
}

impl NodeStatistics {
    fn add(&mut self, numbers: [u64; NUMBERS]) {
        let [vertex, clipper, primitives, fragment, compute] = numbers;
        self.vertex_invocations += vertex;
        self.clipper_invocations += clipper;
        self.clipper_primitives += primitives;
        self.fragment_invocations += fragment;
        self.compute_invocations += compute;
    }
}

/// One query for every pass of every node.
pub(crate) struct Invocations {
    set: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    /// Node and place among its acts of each query.
    passes: Vec<(usize, usize)>,
    /// The first node with a pass that has no query.
    uncounted_from: Option<usize>,
}

impl Invocations {
    /// For a frame of `prepared` by at most `most` queries; none where there is nothing to count. A node with passes past them is not
    /// counted.
    fn new(prepared: &Prepared, most: usize) -> Option<Self> {
        let acts = |node: usize| prepared.nodes[node].iter().flatten().enumerate();
        let passes = (0..prepared.nodes.len())
            .flat_map(|node| acts(node).filter(|(_, act)| Act::is_pass(act)).map(move |(place, _)| (node, place)));
        let mut passes: Vec<_> = passes.collect();
        let uncounted_from = passes.get(most).map(|(node, _)| *node);
        passes.truncate(most);
        let label = Some("pipeline statistics");
        (!passes.is_empty()).then(|| Self {
            set: prepared.device.create_query_set(&wgpu::QuerySetDescriptor {
                label,
                ty: wgpu::QueryType::PipelineStatistics(TYPES),
                count: passes.len() as u32,
            }),
            resolved: prepared.device.create_buffer(&wgpu::BufferDescriptor {
                label,
                size: (passes.len() * NUMBERS * 8) as u64,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
            passes,
            uncounted_from,
        })
    }

    /// The query of a pass.
    pub fn query(&self, node: usize, place: usize) -> Option<(&wgpu::QuerySet, u32)> {
        let index = self.passes.binary_search(&(node, place)).ok()?;
        Some((&self.set, index as u32))
    }
}

impl Ready<'_> {
    /// Runs one more frame, untimed, and returns how often the shaders of each node ran; none where the device does not count, and
    /// none of a node whose passes do not all have a query: a query set holds [`wgpu::QUERY_SET_MAX_QUERIES`].
    ///
    /// # Errors
    /// What the device reports.
    pub fn statistics(&self) -> Result<Option<Vec<Option<NodeStatistics>>>, Problem> {
        self.statistics_of(wgpu::QUERY_SET_MAX_QUERIES as usize)
    }

    pub(crate) fn statistics_of(&self, most: usize) -> Result<Option<Vec<Option<NodeStatistics>>>, Problem> {
        let (session, prepared) = (self.session, &self.prepared);
        if !session.device.features().contains(wgpu::Features::PIPELINE_STATISTICS_QUERY) {
            return Ok(None);
        }
        scoped(&session.device, || {
            let mut nodes = vec![Some(NodeStatistics::default()); prepared.nodes.len()];
            let Some(counted) = Invocations::new(prepared, most) else { return Ok(Some(nodes)) };
            let mut encoder = session.device.create_command_encoder(&Default::default());
            let queries = Queries { invocations: Some(&counted), ..Queries::default() };
            prepared.record_nodes(&mut encoder, &Bound::none(prepared), 0..nodes.len(), queries);
            encoder.resolve_query_set(&counted.set, 0..counted.passes.len() as u32, &counted.resolved, 0);
            wait(&session.device, Some(session.queue.submit([encoder.finish()])))?;
            let words = counted.passes.len() * NUMBERS * 2;
            let words = read_words(&session.device, &session.queue, &counted.resolved, 0, words)?;
            for ((node, _), numbers) in counted.passes.iter().zip(words.chunks_exact(2 * NUMBERS)) {
                let number = |at: usize| u64::from(numbers[2 * at]) | u64::from(numbers[2 * at + 1]) << 32;
                if let Some(node) = &mut nodes[*node] {
                    node.add(std::array::from_fn(number));
                }
            }
            if let Some(from) = counted.uncounted_from {
                // Later nodes may have no pass at all: of those nothing is missing.
                let has_pass = |node: usize| prepared.nodes[node].iter().flatten().any(Act::is_pass);
                let uncounted = (from..nodes.len()).filter(|node| has_pass(*node)).collect::<Vec<_>>();
                uncounted.into_iter().for_each(|node| nodes[node] = None);
            }
            Ok(Some(nodes))
        })
    }
}
