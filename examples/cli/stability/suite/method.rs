//! Methods of a suite.

use super::value;
use crate::args::GraphChoice;
use shadowgraph_charts::model::StabilityFrame;
use shadowgraph_core::facts::Facts;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_graph::{Reader, Tree, nearest};

/// A graph, what it sets, and how it is judged.
#[derive(Clone, Debug)]
pub struct Method {
    /// Short name for tables.
    pub name: String,
    /// Graph, swaps, settings.
    pub choice: GraphChoice,
    /// Light samples asked; 1 for hard shadows.
    pub light_samples: u32,
    /// Light samples of the truth that visible fractions are compared with.
    pub truth_light_samples: u32,
    /// A fact without which the method is not for the scene.
    pub needs: Option<String>,
    /// When it holds.
    pub judge: Judge,
}

/// The figure that decides, and its threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judge {
    /// Which; the worst frame's counts.
    pub by: Figure,
    /// Above it the method fails.
    pub at_most: f64,
}

/// Figures that can decide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    /// Wrong bits outside the contact band over bits compared.
    WrongOutside,
    /// Wrong bits over bits compared.
    WrongBits,
    /// RMSE over true penumbra; over all view-samples in a sequence without any.
    RmsePenumbra,
}

impl Figure {
    const ALL: [Self; 3] = [Self::WrongOutside, Self::WrongBits, Self::RmsePenumbra];

    /// Its name in records.
    pub fn name(self) -> &'static str {
        match self {
            Self::WrongOutside => "wrong_outside_share",
            Self::WrongBits => "wrong_bit_share",
            Self::RmsePenumbra => "rmse_penumbra",
        }
    }

    /// Name of the figure that is looked at in these frames, and what it is in one.
    pub fn of(self, frames: &[StabilityFrame]) -> (&'static str, fn(&StabilityFrame) -> Option<f64>) {
        let has_penumbra = frames.iter().any(|frame| frame.rmse_penumbra.is_some());
        match self {
            Self::WrongOutside => (self.name(), |frame| frame.wrong_outside_share),
            Self::WrongBits => (self.name(), |frame| frame.wrong_bit_share),
            Self::RmsePenumbra if has_penumbra => (self.name(), |frame| frame.rmse_penumbra),
            Self::RmsePenumbra => ("rmse_all", |frame| frame.rmse_all),
        }
    }
}

const FIELDS: &[&str] = &["name", "graph", "set", "light_samples", "truth_light_samples", "needs", "judge"];
const MOST_LIGHT_SAMPLES: u32 = 4096;

/// One entry of `methods`.
pub fn read(tree: &Tree, reader: &mut Reader) -> Option<Method> {
    let fields = reader.fields(tree, FIELDS, "a method")?;
    let graph = reader.needed(tree, &fields, "graph", "a method").and_then(|value| reader.name(value, "graph"));
    let name = value(&fields, "name").and_then(|value| reader.name(value, "name")).or_else(|| graph.clone());
    let mut samples = |field: &str, default: u32| match value(&fields, field) {
        Some(value) => reader.whole(value, field, 1..=MOST_LIGHT_SAMPLES).unwrap_or(default),
        None => default,
    };
    let light_samples = samples("light_samples", 1);
    let truth_light_samples = samples("truth_light_samples", light_samples);
    let needs = value(&fields, "needs").and_then(|value| fact(value, reader));
    let judge = reader.needed(tree, &fields, "judge", "a method").and_then(|value| judge(value, reader));
    let mut choice = GraphChoice { graph: graph?.text, ..GraphChoice::default() };
    if let Some(value) = value(&fields, "set") {
        for name in reader.names(value, "set") {
            match name.text.split_once('=') {
                Some((place, _)) if place.contains('.') => choice.set.push(name.text),
                Some(_) => choice.swap.push(name.text),
                None => {
                    let problem = Problem::new(Kind::BadValue, "this sets nothing");
                    let problem = problem.expected("NODE=PASS or NODE.PARAM=VALUE").found(&name.text);
                    reader.problem(name.span, problem);
                }
            }
        }
    }
    let judge = judge?;
    if judge.by != Figure::RmsePenumbra && light_samples != truth_light_samples {
        let problem = Problem::new(Kind::BadValue, "bits can only be compared on the same light samples");
        let problem = problem.expected(format!("truth_light_samples: {light_samples}, or judge by rmse_penumbra"));
        reader.problem(tree.span, problem.found(truth_light_samples.to_string()));
    }
    Some(Method { name: name?.text, choice, light_samples, truth_light_samples, needs, judge })
}

fn fact(value: &Tree, reader: &mut Reader) -> Option<String> {
    let name = reader.name(value, "needs")?;
    if Facts::NAMES.iter().any(|(known, _)| *known == name.text) {
        return Some(name.text);
    }
    let problem = Problem::new(Kind::UnknownName, "there is no such fact").found(&name.text);
    let near = nearest(&name.text, Facts::NAMES.iter().map(|(known, _)| *known));
    reader.problem(
        name.span,
        problem.remedy(near.map_or("see `choose` of graph files".into(), |near| format!("did you mean {near}?"))),
    );
    None
}

fn judge(tree: &Tree, reader: &mut Reader) -> Option<Judge> {
    let fields = reader.fields(tree, &["by", "at_most"], "a judge")?;
    let by = reader.needed(tree, &fields, "by", "a judge").and_then(|value| reader.name(value, "by"));
    let at_most = reader.needed(tree, &fields, "at_most", "a judge");
    let at_most = at_most.and_then(|value| Some((value, reader.number(value, "at_most")?)));
    if let Some((value, number)) = at_most
        && !(0.0..=1.0).contains(&number)
    {
        let problem = Problem::new(Kind::BadValue, "`at_most` is no share").expected("a number in 0..=1");
        reader.problem(value.span, problem.found(value.data.text()));
    }
    let by = by?;
    let figure = Figure::ALL.into_iter().find(|figure| figure.name() == by.text);
    if figure.is_none() {
        let known: Vec<&str> = Figure::ALL.iter().map(|figure| figure.name()).collect();
        let problem = Problem::new(Kind::UnknownName, "nothing can be judged by this").found(&by.text);
        reader.problem(by.span, problem.expected(known.join(", ")));
    }
    Some(Judge { by: figure?, at_most: at_most?.1 })
}
