//! Records a plan's GPU recipes into a host's wgpu encoder.
