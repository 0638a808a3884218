//! `NAME?param=value&..` to a scene and checked parameters.

use super::{Builtin, PREFIX, list};
use crate::nearest::nearest;
use shadowgraph_core::param::{ParamSpec, Params, Range, Value};
use shadowgraph_core::problem::{Kind, Place, Problem};

/// Finds the scene and checks every parameter.
pub fn parse(text: &str) -> Result<(&'static Builtin, Params), Problem> {
    let place = || Place { file: format!("{PREFIX}{text}"), line: 0, column: 0, path: String::new() };
    let (name, query) = text.split_once('?').unwrap_or((text, ""));
    let names = || list().iter().map(|scene| scene.name);
    let scene = list().iter().find(|scene| scene.name == name).ok_or_else(|| {
        Problem::new(Kind::UnknownName, "no such built-in scene")
            .at(place())
            .expected(names().collect::<Vec<_>>().join(", "))
            .found(name)
            .remedy(nearest(name, names()))
    })?;
    let mut params = Params::defaults(scene.params);
    let mut given: Vec<&str> = Vec::new();
    for pair in query.split('&').filter(|pair| !pair.is_empty()) {
        let (key, value) = pair.split_once('=').ok_or_else(|| {
            Problem::new(Kind::Syntax, "not a parameter").at(place()).expected("name=value").found(pair)
        })?;
        let spec = scene.params.iter().find(|spec| spec.name == key).ok_or_else(|| unknown(scene, key).at(place()))?;
        if given.contains(&key) {
            return Err(Problem::new(Kind::Duplicate, "the parameter is given twice").at(place()).port(key));
        }
        given.push(key);
        let value = read(spec, value).map_err(|problem| problem.at(place()).port(key))?;
        params.0.iter_mut().filter(|(name, _)| *name == key).for_each(|slot| slot.1 = value.clone());
    }
    Ok((scene, params))
}

fn unknown(scene: &Builtin, key: &str) -> Problem {
    let problem = Problem::new(Kind::UnknownName, format!("{} has no such parameter", scene.name)).found(key);
    if scene.params.is_empty() {
        return problem.expected("no parameters");
    }
    let listed: Vec<String> =
        scene.params.iter().map(|spec| format!("{} ({})", spec.name, spec.range.text())).collect();
    problem.expected(listed.join(", ")).remedy(nearest(key, scene.params.iter().map(|spec| spec.name)))
}

fn read(spec: &ParamSpec, text: &str) -> Result<Value, Problem> {
    let parsed = match spec.range {
        Range::U32 { .. } => text.parse().ok().map(Value::U32),
        Range::F32 { .. } => text.parse().ok().map(Value::F32),
        Range::Bool { .. } => text.parse().ok().map(Value::Bool),
        Range::Word { .. } => Some(Value::Word(text.into())),
    };
    parsed.and_then(|value| spec.range.check(&value).ok()).ok_or_else(|| {
        Problem::new(Kind::BadValue, "parameter value not allowed").expected(spec.range.text()).found(text)
    })
}
