//! Hand-counted cases: `suite/<stage>/<case>.ron` holds input, parameters and expected output; every backend that a named pass
//! runs on runs the case.

use crate::gpu;
use crate::root;
use libtest_mimic::{Failed, Trial};
use serde::Deserialize;
use shadowgraph_core::array::Array;
use shadowgraph_core::param::{Params, Value};
use shadowgraph_core::pass::Pass;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    /// What the case shows.
    #[allow(dead_code)]
    doc: String,
    stage: String,
    passes: Vec<String>,
    #[serde(default)]
    params: BTreeMap<String, Number>,
    #[serde(default = "one_pixel")]
    image: (usize, usize),
    inputs: BTreeMap<String, Values>,
    /// Outputs by port; ports not named are not looked at.
    #[serde(default)]
    expect: BTreeMap<String, Expected>,
    /// Part of the text of the problem that must come instead.
    #[serde(default)]
    problem: Option<String>,
}

#[derive(Clone, Deserialize)]
enum Number {
    U32(u32),
    F32(f32),
    Bool(bool),
    Word(String),
}

#[derive(Clone, Deserialize)]
enum Values {
    U32(Vec<usize>, Vec<u32>),
    F32(Vec<usize>, Vec<f32>),
}

#[derive(Clone, Deserialize)]
enum Expected {
    /// Equal bits.
    Exact(Values),
    /// Equal within an absolute bound.
    Within(f32, Values),
    /// Equal as a multiset over the first so many words.
    Set(usize, Vec<u32>),
}

fn one_pixel() -> (usize, usize) {
    (1, 1)
}

/// One trial a case, pass and backend; and one that every file was understood.
pub fn trials() -> Vec<Trial> {
    let mut trials = Vec::new();
    let catalogue = shadowgraph_passes::catalogue();
    for path in case_files(&root().join("tests/suite")) {
        let name =
            path.strip_prefix(root().join("tests/suite")).unwrap_or(&path).with_extension("").display().to_string();
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let case: Case = match ron::from_str(&text) {
            Ok(case) => case,
            Err(error) => {
                trials.push(failing(format!("suite/{name}"), format!("{}: {error}", path.display())));
                continue;
            }
        };
        for pass_name in &case.passes {
            match catalogue.pass(&case.stage, pass_name) {
                Some(pass) => trials.extend(pass_trials(&name, &case, pass)),
                None => trials.push(failing(format!("suite/{name}"), format!("no pass {}/{pass_name}", case.stage))),
            }
        }
    }
    assert!(!trials.is_empty(), "no cases found");
    trials
}

fn pass_trials(name: &str, case: &Case, pass: &'static Pass) -> Vec<Trial> {
    let mut trials = Vec::new();
    if pass.cpu.is_some() {
        let case = case.clone();
        let run = move || {
            judge(&case, pass, |params, image, inputs| {
                shadowgraph_cpu::run_node(pass, params, image, inputs).map(|out| out.0)
            })
        };
        trials.push(Trial::test(format!("suite/{name}/{}/cpu", pass.name), run));
    }
    if pass.gpu.is_some() {
        let case = case.clone();
        trials.push(gpu::trial(format!("suite/{name}/{}/wgpu", pass.name), move |session| {
            judge(&case, pass, |params, image, inputs| session.run_node(pass, params, image, inputs).map(|out| out.0))
        }));
    }
    trials
}

type Outputs = Vec<(&'static str, Array)>;
type Run<'a> =
    &'a dyn Fn(&Params, [usize; 2], &[(&'static str, Array)]) -> Result<Outputs, shadowgraph_core::problem::Problem>;

fn judge(
    case: &Case,
    pass: &'static Pass,
    run: impl Fn(&Params, [usize; 2], &[(&'static str, Array)]) -> Result<Outputs, shadowgraph_core::problem::Problem>,
) -> Result<(), Failed> {
    let params = params(case, pass)?;
    let mut inputs = Vec::new();
    for (name, values) in &case.inputs {
        let port = pass.stage.port(name).ok_or(format!("stage {} has no port {name}", case.stage))?;
        inputs.push((port.name, array(values)));
    }
    let run: Run = &run;
    match (run(&params, [case.image.0, case.image.1], &inputs), &case.problem) {
        (Ok(outputs), None) => {
            for (port, expected) in &case.expect {
                let found = outputs.iter().find(|(name, _)| name == port).ok_or(format!("no output {port}"))?;
                compare(port, expected, &found.1)?;
            }
            Ok(())
        }
        (Err(problem), Some(part)) if problem.to_string().contains(part.as_str()) => Ok(()),
        (Err(problem), _) => Err(problem.to_string().into()),
        (Ok(_), Some(part)) => Err(format!("expected a problem with {part:?}").into()),
    }
}

fn params(case: &Case, pass: &'static Pass) -> Result<Params, Failed> {
    let mut params = Params::defaults(pass.params);
    for (name, number) in &case.params {
        let value = match number.clone() {
            Number::U32(v) => Value::U32(v),
            Number::F32(v) => Value::F32(v),
            Number::Bool(v) => Value::Bool(v),
            Number::Word(v) => Value::Word(v),
        };
        let spec =
            pass.params.iter().find(|spec| spec.name == name).ok_or(format!("{pass:?} has no parameter {name}"))?;
        let value = spec.range.check(&value).map_err(|problem| problem.to_string())?;
        if let Some(entry) = params.0.iter_mut().find(|(key, _)| key == name) {
            entry.1 = value;
        }
    }
    Ok(params)
}

fn array(values: &Values) -> Array {
    match values {
        Values::U32(shape, words) => Array::u32(shape.clone(), words.clone()),
        Values::F32(shape, values) => Array::f32(shape.clone(), values.clone()),
    }
}

fn compare(port: &str, expected: &Expected, found: &Array) -> Result<(), Failed> {
    let same = match expected {
        Expected::Exact(values) => array(values) == *found,
        Expected::Within(bound, values) => {
            let wanted = array(values);
            wanted.shape() == found.shape()
                && wanted.as_f32().iter().zip(found.as_f32()).all(|(want, got)| (want - got).abs() <= *bound)
        }
        Expected::Set(count, words) => {
            let sorted = |words: &[u32]| {
                let mut words = words.to_vec();
                words.sort_unstable();
                words
            };
            found.words().len() >= *count && sorted(&found.words()[..*count]) == sorted(words)
        }
    };
    if same { Ok(()) } else { Err(format!("port {port}: found {found:?}").into()) }
}

fn case_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            files.extend(case_files(&path));
        } else {
            files.push(path);
        }
    }
    files
}

fn failing(name: String, message: String) -> Trial {
    Trial::test(name, move || Err(message.into()))
}
