//! Code and WGSL pieces that several passes are made of.
