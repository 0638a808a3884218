//! Every value that travels between stages, once. Written from the producing side; readers say `.read()` or `.optional()`.

use shadowgraph_core::array::Element::{F32, U32};
use shadowgraph_core::port::{Direction::Out, Port, Space, Storage};

/// View-sample positions.
pub const POSITION: Port = Port::new(Out, "position", F32, "position", "P 3")
    .space(Space::World)
    .unit("scene units")
    .doc("surface point seen through each pixel; undefined for background");
/// View-sample normals.
pub const NORMAL: Port = Port::new(Out, "normal", F32, "normal", "P 3")
    .space(Space::World)
    .doc("unit geometric normal, on the viewer's side of the surface");
/// View-sample triangles.
pub const TRIANGLE: Port = Port::new(Out, "triangle", U32, "triangle_of_sample", "P")
    .doc("triangle the view-sample lies on; all bits set: background");
/// View-sample pixels.
pub const PIXEL: Port =
    Port::new(Out, "pixel", U32, "pixel", "P").space(Space::Image).doc("row-major pixel index, from the top left");
/// View-sample positions that a host renders.
pub const GBUFFER_POSITION: Port = Port::new(Out, "gbuffer_position", F32, "position", "H W 4")
    .space(Space::World)
    .unit("scene units")
    .storage(Storage::Rgba32Float)
    .doc("a host's surface points, one for each pixel; the fourth word is not read");
/// View-sample normals that a host renders.
pub const GBUFFER_NORMAL: Port = Port::new(Out, "gbuffer_normal", F32, "normal", "H W 4")
    .space(Space::World)
    .storage(Storage::Rgba32Float)
    .doc("their unit geometric normals, on the viewer's side; the fourth word is not read");
/// View-sample triangles that a host renders.
pub const GBUFFER_TRIANGLE: Port = Port::new(Out, "gbuffer_triangle", U32, "triangle_of_sample", "H W")
    .storage(Storage::R32Uint)
    .doc("the triangle each lies on, by its place in `triangles`; all bits set: background");
/// View-sample states.
pub const SAMPLE_STATE: Port = Port::new(Out, "sample_state", U32, "sample_state", "P")
    .doc("0 background, 1 kept, 2 facing away from the light (its mask is full)");
/// Light frame.
pub const LIGHT_FRAME: Port = Port::new(Out, "light_frame", F32, "light_frame", "F 20")
    .space(Space::World)
    .doc("per face: origin, valid, three axes, window, near, far");
/// Cell of each view-sample.
pub const CELL: Port = Port::new(Out, "cell", U32, "cell", "P")
    .doc("cell each view-sample is listed in, (face S + row) S + column; all bits set: in none");
/// Place of each view-sample in its list.
pub const SLOT: Port =
    Port::new(Out, "slot", U32, "slot", "P").doc("place in the list of its cell; order within a list is unspecified");
/// List lengths.
pub const LIST_LENGTH: Port =
    Port::new(Out, "list_length", U32, "length", "F S S").unit("view-samples").doc("view-samples in each cell");
/// Largest depth in each cell.
pub const LIST_FAR: Port = Port::new(Out, "list_far", F32, "list_far", "F S S")
    .space(Space::Light)
    .unit("scene units")
    .doc("largest depth along the face's axis of the view-samples of each cell; 0 for an empty cell");
/// Scan input.
pub const LENGTH: Port = LIST_LENGTH.named("length").unit("entries").doc("entries in each cell");
/// Scan output.
pub const OFFSET: Port = Port::new(Out, "offset", U32, "offset", "C+1")
    .unit("entries")
    .doc("where each cell's entries start; the last is the total");
/// List entries.
pub const LIST_ENTRIES: Port =
    Port::new(Out, "list_entries", U32, "view_sample", "P").doc("view-samples by cell; defined below the total only");
/// Caster states.
pub const CASTER_STATE: Port =
    Port::new(Out, "caster_state", U32, "caster_state", "T").doc("1: the triangle casts; 0: left out");
/// Triangles across edges.
pub const ACROSS: Port = Port::new(Out, "across", U32, "triangle_across", "T 3").doc(
    "the casting triangle across each edge, from a corner to the next, of a casting triangle; all bits set: none, or not just one wound alike",
);
/// Penumbra states.
pub const PENUMBRA_STATE: Port = Port::new(Out, "penumbra_state", U32, "penumbra_state", "P")
    .doc("0: every light sample has one answer; 1: light samples may differ, and are asked one by one");
/// Pair cells.
pub const PAIR_CELL: Port = Port::new(Out, "pair_cell", U32, "cell", "E").doc("cell of each (cell, caster) pair");
/// Pair places.
pub const PAIR_SLOT: Port = Port::new(Out, "pair_slot", U32, "slot", "E")
    .doc("place of each pair in the list of its cell; order within a list is unspecified");
/// Pair casters.
pub const PAIR_CASTER: Port = Port::new(Out, "pair_caster", U32, "caster", "E").doc("triangle of each pair");
/// Caster list lengths.
pub const CASTER_LENGTH: Port = LIST_LENGTH
    .named("caster_length")
    .unit("casters")
    .doc("casters listed in each cell: a superset of those that can matter");
/// Caster list entries.
pub const CASTER_ENTRIES: Port =
    Port::new(Out, "caster_entries", U32, "caster", "E").doc("triangles by cell; defined below the total only");
/// Visibility masks.
pub const MASK: Port = Port::new(Out, "mask", U32, "mask", "P M").doc(
    "bit l%32 of word l/32 set: light sample l is blocked; all set for a view-sample facing away, none for background",
);
/// Visible fraction.
pub const VISIBLE: Port = Port::new(Out, "visible", F32, "fraction", "P")
    .doc("visible fraction of the light, 0 umbra to 1 lit; 1 for background");
/// Visible light of each channel.
pub const VISIBLE_COLOR: Port = Port::new(Out, "visible_color", F32, "light_share", "P 3")
    .unit("share of the light's colour")
    .doc("light of each channel that arrives, 0 umbra; no rows where every channel is `visible` times the light's colour");
/// Depth seen from the light.
pub const DEPTH: Port = Port::new(Out, "depth", F32, "light_depth", "F D D")
    .space(Space::Light)
    .storage(Storage::DepthTexture)
    .doc("hyperbolic depth 0 near to 1 far, 1 where nothing is seen");
/// Tree of boxes.
pub const BVH_NODES: Port = Port::new(Out, "bvh_nodes", U32, "bvh_node", "N 8").space(Space::World).doc(
    "boxes over the casters, depth first: low xyz, node after the subtree (all bits set: none), high xyz, 8 place + count of a leaf's triangles (0: inner)",
);
/// Triangles by leaf.
pub const BVH_ORDER: Port = Port::new(Out, "bvh_order", U32, "bvh_triangle", "T")
    .doc("triangles in the order of the leaves; all bits set past the casters");
/// Bent light at corners.
pub const CORNER_LIGHT: Port = Port::new(Out, "corner_light", F32, "bent_light", "T 3")
    .doc("l_bend: smallest cosine between the light direction and the adjacent faces' normals");
/// Picture.
pub const IMAGE: Port =
    Port::new(Out, "image", F32, "radiance", "H W 4").space(Space::Image).doc("linear RGB and coverage");
/// Look-up table.
pub const LU: Port = Port::new(Out, "lu", U32, "lu", "K A B U Q").doc(
    "by blocks of 128 light samples and bins of a plane's coordinates: bit set: the light sample is behind the plane; Q = 8: surely, \
     then possibly, over the whole bin",
);
/// Which plane falls in which bin.
pub const LU_LAYOUT: Port = Port::new(Out, "lu_layout", F32, "lu_layout", "16")
    .space(Space::World)
    .unit("scene units")
    .doc("middle of the light, largest distance from it, and for a planar light its axes, each padded to four, normal and offset along it");
