//! What a triangle soup is made of: connected parts, closed two-manifolds, smooth vertices.

mod intern;
mod parts;
mod smooth;

pub use parts::{Parts, find_parts};
pub use smooth::{Smooth, smooth_vertices};

#[cfg(test)]
mod tests;
