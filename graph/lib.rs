//! RON text to a checked plan.
