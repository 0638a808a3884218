//! Parameters must exist and lie in range.

use crate::names::{did_you_mean, nearest};
use crate::overrides::flag_value;
use crate::resolve::{Choice, Resolved};
use crate::schema::{Name, Scalar};
use crate::source::{Findings, Span};
use crate::world::{Guard, Selection};
use shadowgraph_core::param::{Params, Range, Value};
use shadowgraph_core::pass::Pass;
use shadowgraph_core::problem::{Kind, Problem};

/// `--set NODE.PARAM=VALUE`.
pub(crate) struct Set<'o> {
    pub param: &'o str,
    pub text: &'o str,
    pub span: Span,
}

/// Collects the values of one pass of one node; later values win.
pub(crate) struct ParamReader<'a> {
    id: &'a Name,
    pass: &'static Pass,
    passes: &'a [&'static Pass],
    is_sound: bool,
    params: Params,
    dropped: Vec<String>,
    unset: Vec<(String, Span)>,
    findings: &'a mut Findings,
}

impl<'a> ParamReader<'a> {
    pub fn new(
        id: &'a Name,
        pass: &'static Pass,
        passes: &'a [&'static Pass],
        is_sound: bool,
        findings: &'a mut Findings,
    ) -> Self {
        let params = Params::defaults(pass.params);
        Self { id, pass, passes, is_sound, params, dropped: Vec::new(), unset: Vec::new(), findings }
    }

    /// Values that were written for this pass.
    pub fn take(&mut self, given: &[(Name, Scalar)]) {
        for (name, scalar) in given {
            self.strict(name, scalar);
        }
    }

    /// Values that were written for the node's own pass: those that this pass has too are used.
    pub fn inherit(&mut self, given: &[(Name, Scalar)]) {
        for (name, scalar) in given {
            self.lenient(name, scalar);
        }
    }

    /// Values of the node, some of them perhaps written before its pass was replaced by the one named at `pass_span`.
    pub fn take_from_layers(&mut self, given: &[(Name, Scalar)], pass_span: Span) {
        for (name, scalar) in given {
            let was_for_another = name.span.is_older_than(pass_span);
            if was_for_another && self.passes.iter().any(|pass| has(pass, &name.text)) {
                self.lenient(name, scalar);
            } else {
                self.strict(name, scalar);
            }
        }
    }

    /// Values from flags; those this pass lacks are left to [`unused_sets`].
    pub fn set(&mut self, sets: &[Set]) {
        for set in sets {
            if has(self.pass, set.param) {
                let value = flag_value(set.text);
                let text = match &value {
                    Value::Word(word) => format!("{word:?}"),
                    _ => set.text.to_string(),
                };
                let name = Name { text: set.param.into(), span: set.span };
                self.strict(&name, &Scalar { value: Some(value), text, span: set.span });
            } else if self.is_sound {
                self.unset.push((set.param.into(), set.span));
            }
        }
    }

    pub fn finish(self, guard: Guard, span: Span) -> Choice {
        let Self { pass, params, dropped, unset, is_sound, .. } = self;
        Choice { guard, pass, span, params, dropped, unset, is_sound }
    }

    fn strict(&mut self, name: &Name, scalar: &Scalar) {
        let Some(index) = index_of(self.pass, &name.text) else {
            // Told of the pass already: its parameters are anyone's guess.
            if self.is_sound {
                self.findings.push(name.span, unknown_param(self.id, self.pass, &name.text));
            }
            return;
        };
        let Some(value) = &scalar.value else { return };
        match self.pass.params[index].range.check(value) {
            Ok(value) => self.params.0[index].1 = value,
            Err(problem) => {
                let mut problem = problem.node(&self.id.text).port(&name.text).found(&scalar.text);
                if let (Range::Word { words, .. }, Value::Word(word)) = (self.pass.params[index].range, value)
                    && let Some(near) = nearest(word, words.iter().copied())
                {
                    problem = problem.remedy(format!("did you mean {near:?}?"));
                }
                self.findings.push(scalar.span, problem);
            }
        }
    }

    fn lenient(&mut self, name: &Name, scalar: &Scalar) {
        let Some(value) = &scalar.value else { return };
        let index = index_of(self.pass, &name.text);
        match index.and_then(|index| Some((index, self.pass.params[index].range.check(value).ok()?))) {
            Some((index, value)) => self.params.0[index].1 = value,
            None => self.dropped.push(name.text.clone()),
        }
    }
}

/// A flag that the pass of its node cannot use is a mistake; where facts are not known, that no alternative can use.
pub(crate) fn unused_sets(resolved: &Resolved, selection: Option<&Selection>, findings: &mut Findings) {
    for (index, node) in resolved.nodes.iter().enumerate() {
        let asked = match selection.map(|selection| selection.chosen[index]) {
            Some(chosen) => chosen.map(|chosen| &node.choices[chosen]),
            None => node.choices.last(),
        };
        for (param, span) in asked.map_or(&[][..], |choice| &choice.unset) {
            let used = |choice: &Choice| has(choice.pass, param) || !choice.is_sound;
            if selection.is_some() || !node.choices.iter().any(used) {
                let pass = asked.map_or(node.choices[0].pass, |choice| choice.pass);
                findings.push(*span, unknown_param(node.id, pass, param));
            }
        }
    }
}

fn unknown_param(id: &Name, pass: &'static Pass, param: &str) -> Problem {
    let problem = Problem::new(Kind::UnknownName, format!("pass `{}` has no parameter `{param}`", pass.name));
    problem.node(&id.text).remedy(did_you_mean(param, pass.params.iter().map(|spec| spec.name)))
}

fn index_of(pass: &Pass, param: &str) -> Option<usize> {
    pass.params.iter().position(|spec| spec.name == param)
}

fn has(pass: &Pass, param: &str) -> bool {
    index_of(pass, param).is_some()
}
