//! Facts that guards ask for must exist.

use crate::names::{did_you_mean, nearest};
use crate::schema::{GuardWritten, Name};
use crate::source::Findings;
use crate::world::{Guard, fact_bit};
use shadowgraph_core::facts::Facts;
use shadowgraph_core::problem::{Kind, Problem};

/// The guard with its facts looked up.
pub(crate) fn guard(written: &GuardWritten, id: &Name, findings: &mut Findings) -> Guard {
    let mut bit = |name: &Option<Name>| name.as_ref().map_or(0, |name| fact(name, id, findings));
    Guard { when: bit(&written.when), unless: bit(&written.unless) }
}

fn fact(name: &Name, id: &Name, findings: &mut Findings) -> u32 {
    fact_bit(&name.text).unwrap_or_else(|| {
        let known = Facts::NAMES.iter().map(|(known, _)| *known);
        let problem = Problem::new(Kind::UnknownName, format!("there is no fact `{}`", name.text)).node(&id.text);
        findings.push(name.span, problem.remedy(did_you_mean(&name.text, known.clone())));
        nearest(&name.text, known).and_then(fact_bit).unwrap_or(0)
    })
}
