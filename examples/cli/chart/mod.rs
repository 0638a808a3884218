//! Milliseconds against error for every variant of a suite on every scene: measured in pieces that survive a kill, shown as one page.

mod inputs;
pub mod number;
pub mod pictures;
pub mod points;
pub mod run;
pub mod store;
pub mod suite;
pub mod variant;
