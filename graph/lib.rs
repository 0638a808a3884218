//! RON text to a checked plan.
#![forbid(unsafe_code)]

mod alias;
mod builtin;
mod check;
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

#[cfg(test)]
mod tests;

pub use builtin::{builtin, builtin_names};
pub use load::{Graph, Loader, load};
pub use names::nearest;
pub use overrides::{Keep, Overrides};
pub use plan::plan;
pub use schema::VERSION;
pub use source::{MAX_TEXT_BYTES, Source};
