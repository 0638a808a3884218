//! Colour and shape of a method, and colour of a stage: the same in every chart of a page, told apart without seeing colour.

use crate::model::{Point, Stability};
use std::collections::BTreeSet;

/// `[light, dark]` backgrounds. Okabe and Ito 2008 without yellow, which a white page swallows.
pub const METHOD_COLOURS: [[&str; 2]; 7] = [
    ["#0072b2", "#4aa8e0"],
    ["#d55e00", "#ff8a3d"],
    ["#009e73", "#2fc99b"],
    ["#b8578c", "#e29cc4"],
    ["#b87a00", "#f0b429"],
    ["#3fa0d8", "#8fd0f5"],
    ["#222222", "#e6e6e6"],
];

/// `[light, dark]`. Tol's muted scheme; the last is what all further stages share.
pub const STAGE_COLOURS: [[&str; 2]; 10] = [
    ["#cc6677", "#cc6677"],
    ["#332288", "#7d70d8"],
    ["#ddcc77", "#ddcc77"],
    ["#117733", "#3aa564"],
    ["#88ccee", "#88ccee"],
    ["#882255", "#bb5588"],
    ["#44aa99", "#44aa99"],
    ["#999933", "#999933"],
    ["#aa4499", "#c46cb5"],
    ["#b0b0b0", "#8a8a8a"],
];

/// A filled outline around its centre, relative to it, about 10 units wide. As many as have no factor in common with the
/// number of colours: index modulo both gives 56 different pairs.
pub const SHAPES: [&str; 8] = [
    "m-4.5 0a4.5 4.5 0 1 0 9 0a4.5 4.5 0 1 0-9 0z",
    "m-4-4h8v8h-8z",
    "m0-5.5l5 9h-10z",
    "m0-5.8l5.8 5.8l-5.8 5.8l-5.8-5.8z",
    "m0 5.5l5-9h-10z",
    "m-5-3l2-2l3 3l3-3l2 2l-3 3l3 3l-2 2l-3-3l-3 3l-2-2l3-3z",
    "m-1.6-5.2h3.2v3.6h3.6v3.2h-3.6v3.6h-3.2v-3.6h-3.6v-3.2h3.6z",
    "m-4.5-5h9l-9 10h9z",
];

/// Legend order of methods that ship; any other follows by name. A method keeps its looks from page to page because of this.
const ORDER: &[&str] = &[
    "truth_hard",
    "truth_soft",
    "hard",
    "hard_fused",
    "hard_draw",
    "soft",
    "soft_certain",
    "soft_penumbra",
    "soft_lu",
    "soft_lu_planar",
    "soft_shafts",
    "rays",
    "rays_soft",
    "shadow_map",
    "pcf",
    "pcss",
    "multi_shadow_map",
];

/// Looks of all methods and stages of a data set.
#[derive(Clone, Debug, Default)]
pub struct Styles {
    methods: Vec<String>,
    stages: Vec<String>,
    backends: Vec<String>,
}

impl Styles {
    /// For these methods, and these stages with their total cost: the dearest get colours of their own.
    pub fn new<'a>(
        methods: impl IntoIterator<Item = &'a str>,
        stages: impl IntoIterator<Item = (&'a str, f64)>,
    ) -> Self {
        let methods: BTreeSet<&str> = methods.into_iter().collect();
        let shipped = ORDER.iter().copied();
        let others = methods.into_iter().filter(|method| !ORDER.contains(method));
        let mut totals: Vec<(&str, f64)> = Vec::new();
        for (stage, millis) in stages {
            match totals.iter_mut().find(|(name, _)| *name == stage) {
                Some((_, total)) => *total += millis,
                None => totals.push((stage, millis)),
            }
        }
        totals.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(b.0)));
        Self {
            methods: shipped.chain(others).map(String::from).collect(),
            stages: totals.into_iter().map(|(stage, _)| stage.into()).collect(),
            backends: Vec::new(),
        }
    }

    /// For all of these points.
    pub fn of_points(points: &[Point]) -> Self {
        let nodes = points.iter().flat_map(|point| &point.nodes);
        let styles = Self::new(
            points.iter().map(|point| point.graph.as_str()),
            nodes.map(|node| (node.stage.as_str(), node.millis)),
        );
        styles.backends(points.iter().map(|point| point.backend.as_str()))
    }

    /// For all of these records.
    pub fn of_stabilities(records: &[Stability]) -> Self {
        let styles = Self::new(records.iter().map(|record| record.graph.as_str()), []);
        styles.backends(records.iter().map(|record| record.backend.as_str()))
    }

    /// With these backends: marks of the first by name are filled, all others hollow.
    pub fn backends<'a>(mut self, names: impl IntoIterator<Item = &'a str>) -> Self {
        let names: BTreeSet<&str> = names.into_iter().collect();
        self.backends = names.into_iter().map(String::from).collect();
        self
    }

    /// Whether marks of a backend are hollow.
    pub fn is_hollow(&self, backend: &str) -> bool {
        self.backends.first().is_some_and(|first| first != backend)
    }

    /// What filled and hollow marks mean, where there are both.
    pub fn backend_key(&self) -> Option<String> {
        let (filled, hollow) = self.backends.split_first()?;
        (!hollow.is_empty()).then(|| format!("filled marks: {filled}, hollow: {}", hollow.join(", ")))
    }

    /// Position of a method in legends.
    pub fn method(&self, name: &str) -> usize {
        self.methods.iter().position(|method| method == name).unwrap_or(self.methods.len())
    }

    /// Index into [`METHOD_COLOURS`].
    pub fn colour(&self, method: &str) -> usize {
        self.method(method) % METHOD_COLOURS.len()
    }

    /// Outline of a method's marks.
    pub fn shape(&self, method: &str) -> &'static str {
        SHAPES[self.method(method) % SHAPES.len()]
    }

    /// Index into [`STAGE_COLOURS`].
    pub fn stage(&self, name: &str) -> usize {
        let own = STAGE_COLOURS.len() - 1;
        self.stages.iter().take(own).position(|stage| stage == name).unwrap_or(own)
    }

    /// Stages, the dearest first.
    pub fn stages(&self) -> &[String] {
        &self.stages
    }
}

/// Rules that give method and stage colours on a dark page: they outrank the attributes that a chart carries.
pub fn dark_rules() -> String {
    let method = METHOD_COLOURS
        .iter()
        .enumerate()
        .map(|(index, [_, dark])| format!(".m{index}.f{{fill:{dark}}}.m{index}.s{{stroke:{dark}}}"));
    let stage = STAGE_COLOURS.iter().enumerate().map(|(index, [_, dark])| format!(".g{index}{{fill:{dark}}}"));
    method.chain(stage).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn methods_differ_in_colour_and_shape_together() {
        let names: Vec<String> = (0..40).map(|index| format!("method_{index}")).collect();
        let styles = Styles::new(names.iter().map(String::as_str), []);
        let looks: BTreeSet<_> = names.iter().map(|name| (styles.colour(name), styles.shape(name))).collect();
        assert_eq!(looks.len(), names.len());
        for shipped in ["soft", "pcss"] {
            let alone = Styles::new([shipped], []);
            assert_eq!(styles.shape(shipped), alone.shape(shipped), "{shipped} looks the same in any company");
        }
    }

    #[test]
    fn the_dearest_stages_have_colours_of_their_own_and_the_rest_share_one() {
        let names: Vec<String> = (0..12).map(|index| format!("stage_{index:02}")).collect();
        let styles = Styles::new([], names.iter().enumerate().map(|(index, name)| (name.as_str(), index as f64)));
        assert_eq!((styles.stage("stage_11"), styles.stage("stage_03")), (0, 8));
        assert_eq!((styles.stage("stage_02"), styles.stage("stage_00"), styles.stage("unknown")), (9, 9, 9));
    }
}
