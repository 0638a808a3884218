//! `axes` of a graph file: every combination of their values.

use crate::load::Graph;
use crate::overrides::Overrides;
use shadowgraph_core::param::Value;
use shadowgraph_core::problem::{Kind, Problem, Problems};

/// Most variants of one graph.
const MAX_VARIANTS: usize = 10_000;

/// One combination.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Axis and value, as written, in the order of the file: `("visibility", "fused")`, `("list_build.size", "256")`.
    pub choices: Vec<(String, String)>,
    /// The given overrides, then these choices. [`crate::plan()`] turns them into a plan, [`crate::plan_id()`] names it.
    pub overrides: Overrides,
}

impl Variant {
    /// `visibility=fused, list_build.size=256`; empty for a graph without axes.
    pub fn label(&self) -> String {
        self.choices.iter().map(|(axis, value)| format!("{axis}={value}")).collect::<Vec<_>>().join(", ")
    }
}

/// Every combination of the graph's axes, the last axis fastest; a graph without axes has one.
///
/// # Errors
/// More combinations than can be meant.
pub fn variants(graph: &Graph, overrides: &Overrides) -> Result<Vec<Variant>, Problems> {
    let sizes = graph.axes.iter().map(|(_, values)| values.len());
    let count = sizes.fold(1usize, |count, size| count.saturating_mul(size));
    if count > MAX_VARIANTS {
        let place = graph.files.place(graph.axes[0].0.span, &[]);
        let problem = Problem::new(Kind::BadValue, "axes make too many variants").at(place);
        return Err(problem.expected(format!("at most {MAX_VARIANTS}")).found(count.to_string()).into());
    }
    let mut variants = vec![Variant { choices: Vec::new(), overrides: overrides.clone() }];
    for (axis, values) in &graph.axes {
        let longer = variants.iter().flat_map(|variant| {
            values.iter().map(|scalar| {
                let mut variant = variant.clone();
                let text = match &scalar.value {
                    Some(Value::Word(word)) => word.clone(),
                    _ => scalar.text.clone(),
                };
                match axis.text.split_once('.') {
                    Some((node, param)) => {
                        variant.overrides.sets.push((node.into(), param.into(), scalar.text.clone()));
                    }
                    None => variant.overrides.swaps.push((axis.text.clone(), text.clone())),
                }
                variant.choices.push((axis.text.clone(), text));
                variant
            })
        });
        variants = longer.collect();
    }
    Ok(variants)
}
