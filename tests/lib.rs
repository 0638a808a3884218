//! The suite is the test target `main.rs`; this library is empty so that the package has one.
