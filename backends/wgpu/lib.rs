//! Records a plan's GPU recipes into a host's wgpu encoder.
//!
//! Two ways in. A **host** that owns instance, device, queue and encoder asks [`features::required_features`] and
//! [`limits::required_limits`] before it makes its device, builds a [`Prepared`] and calls [`Prepared::record`] between passes
//! of its own; on that way nothing here makes a device, polls or submits. A **program** without a device uses a
//! [`Session`], which does all of that and hands back arrays, times and counts.
//!
//! What is wrong with a recipe or a kernel (a binding that does not match, a port that is written though it is an input), and what
//! the world lacks (adapter, feature, memory), is a [`Problem`](shadowgraph_core::problem::Problem) that names node and binding.
#![forbid(unsafe_code)]

pub mod adapter;
mod command;
pub mod counters;
mod errors;
pub mod externals;
pub mod features;
mod group;
pub mod limits;
mod pipeline;
mod pool;
mod prepare;
pub mod readback;
pub mod ready;
mod recipe;
mod record;
mod run;
pub mod segment;
pub mod session;
mod settle;
mod shader;
pub mod statistics;
pub mod timing;
pub mod upload;

#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_draw;
#[cfg(test)]
mod tests_host;

pub use externals::Externals;
pub use prepare::{Prepared, Request};
pub use ready::Ready;
pub use session::{Options, Outcome, Session};
pub use wgpu;
