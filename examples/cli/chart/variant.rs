//! Variants: what they are called, which facts rule them out, and how axes make them.

use crate::args::GraphChoice;
use shadowgraph_core::facts::Facts;
use std::path::Path;

/// One graph with one value of each axis.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Graph, swaps, settings.
    pub choice: GraphChoice,
    /// What the file sets for all variants of the method.
    pub fixed: Vec<String>,
    /// Axis and value, in the order of the file; `light_samples` is one.
    pub choices: Vec<(String, String)>,
    /// Which axis is the method's quality.
    pub quality: Option<String>,
    /// Light samples asked.
    pub light_samples: u32,
    /// Names of the scenes it is for; none: all.
    pub only: Vec<String>,
    /// Where it runs; none: as the suite says.
    pub backends: Vec<&'static str>,
    /// A fact of the scene that must hold for it to be tried.
    pub when: Option<String>,
    /// A fact that must not hold.
    pub unless: Option<String>,
    /// Whether its label names nodes and folders in full, as another variant's would be the same without.
    pub is_long: bool,
}

impl Variant {
    /// Unlike that of any other variant: the graph's name and values of the axes.
    pub fn label(&self) -> String {
        let short = |place: &str| match place.rsplit_once('.') {
            Some((_, param)) if !self.is_long => param.to_string(),
            _ => place.to_string(),
        };
        let of_axis = |(axis, value): &(String, String)| match axis.as_str() {
            "light_samples" => format!("{value} samples"),
            _ => format!("{}={value}", short(axis)),
        };
        let mut parts = vec![if self.is_long { self.choice.graph.clone() } else { self.graph_name() }];
        parts.extend(self.fixed.iter().map(|text| match text.split_once('=') {
            Some((place, value)) => format!("{}={value}", short(place)),
            None => text.clone(),
        }));
        parts.extend(self.choices.iter().map(of_axis));
        parts.join(", ")
    }

    /// Why the facts of a scene rule it out, if they do.
    pub fn ruled_out(&self, facts: &Facts) -> Option<String> {
        let holds = |name: &String| facts.get(name).unwrap_or(false);
        let when = self.when.as_ref().filter(|name| !holds(name)).map(|name| format!("{name} does not hold"));
        when.or_else(|| self.unless.as_ref().filter(|name| holds(name)).map(|name| format!("{name} holds")))
    }

    /// The graph's name without folder and ending.
    pub fn graph_name(&self) -> String {
        let path = Path::new(&self.choice.graph);
        path.file_stem().map_or_else(|| self.choice.graph.clone(), |stem| stem.to_string_lossy().into_owned())
    }
}

/// Lengthens the labels of variants that differ and would be called the same.
pub fn tell_apart(variants: &mut [Variant]) {
    let is_other = |a: &Variant, b: &Variant| {
        let of = |variant: &Variant| {
            let GraphChoice { graph, swap, set, .. } = variant.choice.clone();
            (graph, swap, set, variant.light_samples)
        };
        a.label() == b.label() && of(a) != of(b)
    };
    let is_long: Vec<bool> =
        variants.iter().map(|variant| variants.iter().any(|other| is_other(variant, other))).collect();
    for (variant, is_long) in variants.iter_mut().zip(is_long) {
        variant.is_long = is_long;
    }
}

/// Every combination, the last axis fastest. An axis with one value is no choice, but for the light samples of soft methods.
pub fn combinations(first: Variant, axes: &[(String, Vec<String>)]) -> Vec<Variant> {
    let mut variants = vec![first];
    for (axis, values) in axes {
        let longer = variants.iter().flat_map(|variant| {
            values.iter().map(|value| {
                let mut variant = variant.clone();
                match axis.as_str() {
                    "light_samples" => variant.light_samples = value.parse().unwrap_or(1),
                    place if place.contains('.') => variant.choice.set.push(format!("{place}={value}")),
                    node => variant.choice.swap.push(format!("{node}={value}")),
                }
                if values.len() > 1 || axis == "light_samples" && variant.light_samples > 1 {
                    variant.choices.push((axis.clone(), value.clone()));
                }
                variant
            })
        });
        variants = longer.collect();
    }
    variants
}
