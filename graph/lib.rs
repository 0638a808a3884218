//! RON text to a checked [`Plan`](shadowgraph_core::plan::Plan). Reads no files, knows passes only through a
//! [`Catalogue`](shadowgraph_core::pass::Catalogue).
//!
//! The way of a file: text -> tree with places (`span`) -> the file as written (`read`, `schema`) -> bases applied
//! ([`load`]) -> names looked up (`resolve`, `check`) -> what the facts leave (`world`) -> who reads what, and so who is
//! live (`wire`) -> order, lifetimes, shared memory, transfers (`schedule`, `alias`). Every mistake on that way is a
//! [`Problem`](shadowgraph_core::problem::Problem) with file, line and column, and all of them come at once: a name that
//! is not found is told, then read as the nearest one there is. Only text that is no RON ends the reading early.
//!
//! # The graph file
//!
//! A RON struct. Names the user makes up or looks up (ids, ports, parameters) are text in quotes; fields are bare.
//!
//! ```ron
//! (
//!     version: 1,                                  // of this format; required
//!     doc: "Hard shadows, tested cell by cell.",
//!     inputs: ["triangles", "light_samples"],      // graph inputs that nodes may read; default: all that are supplied
//!     nodes: [
//!         (id: "light_frame", pass: "fitted",
//!          choose: [(when: "light_inside_scene", pass: "six_faces")]),
//!         (id: "list_build", params: {"size": 256}),
//!         (id: "list_scan", stage: "scan", in: {"length": "list_build.list_length"}, on: Cpu),
//!     ],
//!     outputs: {"offsets": "list_scan.offset"},    // name: NODE.PORT, or a graph input; these are what is run for
//! )
//! ```
//!
//! A node has an `id` of letters, digits, `_` and `-`, and may have
//!
//! - `stage`: its signature; default: the stage called as its id. `pass`: the way to do it; default: the stage's first.
//! - `params`: `{"NAME": value}`, checked against the pass; those not given have their defaults.
//! - `in`: `{"PORT": "NODE.PORT"}`, or a graph input's name. A port that is not named here is fed by the only node output
//!   or graph input of its own name and type; several such values, or none, are a mistake. Optional ports stay
//!   unconnected where nothing fits. Ports that the pass ignores are not fed and keep no node alive.
//! - `on`: `Cpu` or `Wgpu`; default: as the run says. Nothing runs elsewhere unasked: a pass without a function for its
//!   backend is a mistake. Values that cross are transferred before their first use.
//! - `when`, `unless`: a fact ([`Facts::NAMES`](shadowgraph_core::facts::Facts::NAMES)) that must, or must not, hold for
//!   the node to be there; with both, both must be so.
//! - `choose`: alternatives `(when: .., unless: .., pass: .., params: {..})`, at least one guard each. The first whose
//!   guards hold is used, else the node's own `pass`. The node's `params` are used where the alternative's pass has them,
//!   its own win.
//!
//! A file with `base`, a built-in graph's name or a path that ends in `.ron`, seen from the file's folder, states
//! differences instead of `nodes`:
//!
//! ```ron
//! (
//!     version: 1,
//!     base: "hard",
//!     remove: ["bent_light"],
//!     replace: [(id: "visibility", pass: "fused")],     // only the fields that differ
//!     add: [(id: "coarse", stage: "scan", in: {"length": "list_build.list_length"})],
//!     outputs: {"image": "coarse.offset"},
//! )
//! ```
//!
//! `remove` comes first, then `replace`, then `add`; the base's outputs of a removed node go with it unless it is added
//! anew. In a replaced node `params` and `in` are laid over entry by entry, `choose: []` drops the alternatives, and a
//! stated `stage` makes the node wholly new. Parameters that the base wrote for another pass are used where the new pass
//! has them, else listed as left out. `outputs` and `axes` are laid over entry by entry; `inputs` and `doc` are the file's
//! own if given.
//!
//! `light_samples: 256` says how many light samples the graph is made for; a base's number holds until a file states its own. It
//! is a wish to whoever supplies the samples ([`Graph::light_samples`]), not a part of the plan: every graph runs on any number.
//!
//! `axes` lists what sweeps range over, `NODE: [passes]` and `NODE.PARAM: [values]`; [`variants()`] makes every combination:
//!
//! ```ron
//! axes: {"visibility": ["planes", "fused"], "list_build.size": [256, 512]},
//! ```
//!
//! # Example
//!
//! ```
//! use shadowgraph_graph::{Source, load};
//! let text = "(version: 1, base: \"hard\", replace: [(id: \"visibility\", pass: \"fused\")])";
//! let graph = load(Source { name: "mine.ron".into(), text: text.into() }, &|path| unreachable!("{path} is not read"))?;
//! assert!(graph.node_ids().any(|id| id == "list_scan"));
//! # Ok::<(), shadowgraph_core::problem::Problems>(())
//! ```
#![forbid(unsafe_code)]

mod alias;
mod axes;
mod builtin;
mod check;
mod describe;
pub mod drawing;
mod load;
mod names;
mod overrides;
mod plan;
mod read;
mod resolve;
mod schedule;
mod schema;
mod source;
mod span;
mod wire;
mod world;
mod write;

#[cfg(test)]
mod tests;

pub use axes::{Variant, variants};
pub use builtin::{builtin, builtin_names};
pub use describe::describe;
pub use load::{Graph, Loader, load};
pub use names::nearest;
pub use overrides::{Keep, Overrides};
pub use plan::plan;
pub use schema::VERSION;
pub use source::{MAX_TEXT_BYTES, Source, Span};
pub use span::{Data, Field, Name, Number, Reader, Tree, read_ron};
pub use write::{plan_id, resolved_text};
