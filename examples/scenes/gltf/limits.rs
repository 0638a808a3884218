//! How much a file may ask for. Checked before anything is allocated or looped over.

use glam::DVec3;

/// Largest absolute world coordinate, in scene units: products of three differences of such numbers stay finite in f32.
pub const COORDINATE: f64 = 1e12;
/// Most triangles of a scene, over all instances: a few hundred bytes each while loading.
pub const TRIANGLES: u64 = 1 << 24;
/// Most JSON objects of a file: parsing costs a few hundred bytes for each.
pub const OBJECTS: usize = 1 << 21;
/// Most bytes of a scene file, and of all its buffers: what the lengths in a GLB can count.
pub const BYTES: u64 = u32::MAX as u64;
/// Most vertex elements read (corners, morph deltas, joint influences, sparse entries): minutes of work, not hours.
pub const READS: u64 = 1 << 30;
/// Most pairs of JOINTS_n and WEIGHTS_n of a primitive: 16 joints a vertex.
pub const INFLUENCE_SETS: u32 = 4;

/// Whether a world position is finite and within [`COORDINATE`].
pub fn allow(position: DVec3) -> bool {
    position.abs().cmple(DVec3::splat(COORDINATE)).all()
}
