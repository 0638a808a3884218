//! Graphs that come with the crate.

/// Name and text of each.
const BUILTIN: &[(&str, &str)] = &[
    ("hard", include_str!("variants/hard.ron")),
    ("hard_fused", include_str!("variants/hard_fused.ron")),
    ("hard_draw", include_str!("variants/hard_draw.ron")),
    ("shadow_map", include_str!("variants/shadow_map.ron")),
    ("pcf", include_str!("variants/pcf.ron")),
    ("pcss", include_str!("variants/pcss.ron")),
    ("multi_shadow_map", include_str!("variants/multi_shadow_map.ron")),
    ("rays", include_str!("variants/rays.ron")),
    ("soft", include_str!("variants/soft.ron")),
    ("soft_penumbra", include_str!("variants/soft_penumbra.ron")),
    ("soft_lu", include_str!("variants/soft_lu.ron")),
    ("soft_lu_planar", include_str!("variants/soft_lu_planar.ron")),
    ("soft_certain", include_str!("variants/soft_certain.ron")),
    ("rays_soft", include_str!("variants/rays_soft.ron")),
    ("truth_hard", include_str!("variants/truth_hard.ron")),
    ("truth_soft", include_str!("variants/truth_soft.ron")),
    ("soft_shafts", include_str!("variants/soft_shafts.ron")),
    ("soft_silhouettes", include_str!("variants/soft_silhouettes.ron")),
];

/// Text of the built-in graph `name`.
pub fn builtin(name: &str) -> Option<&'static str> {
    BUILTIN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

/// Names of all built-in graphs.
pub fn builtin_names() -> Vec<&'static str> {
    BUILTIN.iter().map(|(name, _)| *name).collect()
}
