//! What a triangle soup is made of: connected parts, closed two-manifolds, smooth vertices.

mod inside;
mod intern;
mod parts;
mod smooth;

pub use inside::{open_all_parts, open_parts_around};
pub use parts::{Parts, find_parts};
pub use smooth::{Smooth, smooth_vertices};

#[cfg(test)]
mod tests;
