//! Axes must range over passes and values that exist.

use crate::names::did_you_mean;
use crate::resolve::Names;
use crate::schema::{Name, Scalar};
use crate::source::Findings;
use shadowgraph_core::param::Value;
use shadowgraph_core::problem::{Kind, Problem};

/// Every entry of `axes`.
pub(crate) fn axes(axes: &[(Name, Vec<Scalar>)], names: &Names, findings: &mut Findings) {
    for (key, values) in axes {
        let (id, param) = match key.text.split_once('.') {
            Some((id, param)) => (id, Some(param)),
            None => (key.text.as_str(), None),
        };
        let node = match names.node(id) {
            Ok(node) => node,
            Err((problem, _)) => {
                findings.push(key.span, problem);
                continue;
            }
        };
        let Some(stage) = names.stages[node] else { continue };
        let passes = names.passes_of(stage);
        match param {
            None => {
                for value in values {
                    let known = passes.iter().map(|pass| pass.name);
                    let is_known = |name: &str| passes.iter().any(|pass| pass.name == name);
                    match &value.value {
                        Some(Value::Word(name)) if is_known(name) => {}
                        Some(Value::Word(name)) => {
                            let message = format!("stage `{}` has no pass `{name}`", stage.name);
                            let problem = Problem::new(Kind::UnknownName, message).node(id);
                            findings.push(value.span, problem.remedy(did_you_mean(name, known)));
                        }
                        Some(_) => {
                            let problem = Problem::new(Kind::BadValue, "an axis over a node lists passes").node(id);
                            findings.push(value.span, problem.expected("text in quotes").found(&value.text));
                        }
                        None => {}
                    }
                }
            }
            Some(param) => {
                let specs: Vec<_> =
                    passes.iter().flat_map(|pass| pass.params).filter(|spec| spec.name == param).collect();
                if specs.is_empty() {
                    let message = format!("no pass of stage `{}` has a parameter `{param}`", stage.name);
                    let known = passes.iter().flat_map(|pass| pass.params).map(|spec| spec.name);
                    let problem = Problem::new(Kind::UnknownName, message).node(id);
                    findings.push(key.span, problem.remedy(did_you_mean(param, known)));
                    continue;
                }
                for scalar in values {
                    let Some(value) = &scalar.value else { continue };
                    let mut problems = specs.iter().map(|spec| spec.range.check(value).err());
                    if problems.clone().all(|problem| problem.is_some())
                        && let Some(Some(problem)) = problems.next()
                    {
                        findings.push(scalar.span, problem.node(id).port(param).found(&scalar.text));
                    }
                }
            }
        }
    }
}
