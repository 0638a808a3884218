//! The shadowgraph program: render, verify, check, graph, passes.
