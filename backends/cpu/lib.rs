//! Runs a plan with the passes' CPU functions: reference and fallback.
