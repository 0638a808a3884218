//! The suite lives in `main.rs`; this library target is empty.
