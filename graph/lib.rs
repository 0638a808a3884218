//! RON text to a checked plan.
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
pub use source::{MAX_TEXT_BYTES, Source};
pub use write::{plan_id, resolved_text};
