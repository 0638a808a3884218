//! A tree of boxes as words: what travels from the pass that builds it to those that walk it, on either backend.
//!
//! Nodes stand depth first, so an inner node's left child is the next node, and the right child is where the left one's subtree
//! ends. Eight words: low corner xyz (bits of f32), the node after the subtree ([`END`]: none), high corner xyz, and for a leaf
//! the place of its first triangle in the order of the leaves times 8 plus their count; 0 for an inner node. Whoever goes to
//! the next node from a box that is met, and to the node after the subtree otherwise, needs no stack ([`WGSL`] does).
//!
//! Boxes are the exact bounds of their triangles, one f32 step wider. A slab distance `(bound - from) / along` in f32 errs by at
//! most a difference's and a product's rounding and a reciprocal's, to which WGSL allows 2.5 units in the last place: 4.2e-7 of
//! itself. Both backends give way by [`SLAB_ERROR`], so no box that is met is passed over. The tree of nothing is one box at the
//! far corner of space, which no segment reaches: low is not above high, so no comparison of the two can turn it into all of
//! space.

/// Words of a node.
pub const NODE_WORDS: usize = 8;
/// The word that holds the node after the subtree.
pub const SKIP: usize = 3;
/// The word that says what a leaf holds.
pub const LEAF: usize = 7;
/// There is no node after the subtree.
pub const END: u32 = u32::MAX;
/// Bits of a leaf's count of triangles.
pub const LEAF_BITS: u32 = 3;
/// Relative error of a slab distance in f32, with room.
pub const SLAB_ERROR: f32 = 6e-7;

/// The walk in WGSL; the kernel declares `bvh_nodes: array<vec4<u32>>`.
pub const WGSL: &str = include_str!("threaded.wgsl");

/// A node.
#[derive(Clone, Copy, Debug)]
pub struct Node<'a>(&'a [u32; NODE_WORDS]);

impl<'a> Node<'a> {
    /// Node `index` of the words of a tree.
    #[inline(always)]
    pub fn of(words: &'a [[u32; NODE_WORDS]], index: u32) -> Self {
        Self(&words[index as usize])
    }
    /// The low corner.
    #[inline(always)]
    pub fn low(&self) -> [f32; 3] {
        [0, 1, 2].map(|k| f32::from_bits(self.0[k]))
    }
    /// The high corner.
    #[inline(always)]
    pub fn high(&self) -> [f32; 3] {
        [4, 5, 6].map(|k| f32::from_bits(self.0[k]))
    }
    /// The node after the subtree, or [`END`].
    #[inline(always)]
    pub fn skip(&self) -> u32 {
        self.0[SKIP]
    }
    /// Places of a leaf's triangles in the order; none for an inner node.
    #[inline(always)]
    pub fn triangles(&self) -> Option<std::ops::Range<usize>> {
        let leaf = self.0[LEAF];
        let first = (leaf >> LEAF_BITS) as usize;
        (leaf != 0).then(|| first..first + (leaf & ((1 << LEAF_BITS) - 1)) as usize)
    }
}

#[cfg(test)]
#[path = "threaded_tests.rs"]
mod tests;
