//! `shadowgraph passes`: what there is to put into a graph. The Markdown form is docs/PASSES.md.

use crate::args::PassesArgs;
use crate::report::table;
use serde_json::json;
use shadowgraph_core::param::ParamSpec;
use shadowgraph_core::pass::{Catalogue, Contract, CounterKind, Pass};
use shadowgraph_core::port::{Direction, Port};
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_core::stage::Stage;
use std::fmt::Write;

/// The text asked for.
///
/// # Errors
/// No stage or pass has that name; the nearest one is named.
pub fn text(catalogue: &Catalogue, args: &PassesArgs) -> Result<String, Problem> {
    let chosen = chosen(catalogue, args.name.as_deref())?;
    if args.json {
        let rows: Vec<_> = chosen.iter().map(|pass| pass_json(pass)).collect();
        return Ok(serde_json::to_string_pretty(&rows).unwrap_or_default());
    }
    if args.markdown {
        return Ok(markdown(catalogue));
    }
    Ok(match args.name {
        None => overview(catalogue),
        Some(_) => chosen_text(catalogue, &chosen),
    })
}

fn chosen(catalogue: &Catalogue, name: Option<&str>) -> Result<Vec<&'static Pass>, Problem> {
    let Some(name) = name else { return Ok(catalogue.passes().collect()) };
    let full = |pass: &Pass| format!("{}/{}", pass.stage.name, pass.name);
    let fits = |pass: &&'static Pass| pass.name == name || pass.stage.name == name || full(pass) == name;
    let found: Vec<_> = catalogue.passes().filter(fits).collect();
    if !found.is_empty() {
        return Ok(found);
    }
    let names = catalogue.passes().flat_map(|pass| [pass.name, pass.stage.name]);
    let nearest = shadowgraph_graph::nearest(name, names);
    let problem = Problem::new(Kind::UnknownName, "no stage or pass has this name").found(name);
    Err(match nearest {
        Some(nearest) => problem.remedy(format!("did you mean {nearest}?")),
        None => problem.remedy("`shadowgraph passes` lists them all"),
    })
}

fn backends(pass: &Pass) -> &'static str {
    match (pass.cpu.is_some(), pass.gpu.is_some()) {
        (true, true) => "cpu, wgpu",
        (true, false) => "cpu",
        (false, true) => "wgpu",
        (false, false) => "none",
    }
}

fn overview(catalogue: &Catalogue) -> String {
    let mut table = table(&["stage", "pass", "on", "what it is"]);
    for stage in catalogue.stages() {
        let passes = catalogue.passes().filter(|pass| pass.stage.name == stage.name);
        for (row, pass) in passes.enumerate() {
            table.add_row([if row == 0 { stage.name } else { "" }, pass.name, backends(pass), pass.doc]);
        }
    }
    format!(
        "{table}\n`shadowgraph passes NAME` shows ports and parameters; the first pass of a stage is its default.\n"
    )
}

fn chosen_text(catalogue: &Catalogue, passes: &[&'static Pass]) -> String {
    let mut text = String::new();
    for stage in catalogue.stages() {
        let of_stage: Vec<_> = passes.iter().filter(|pass| pass.stage.name == stage.name).collect();
        if of_stage.is_empty() {
            continue;
        }
        let _ = writeln!(text, "{}: {}\n{}", stage.name, stage.doc, ports_table(stage));
        for pass in of_stage {
            let _ = writeln!(text, "\n{}/{} ({}): {}", stage.name, pass.name, backends(pass), pass.doc);
            let _ = writeln!(text, "  source    {}", pass.source);
            let _ = writeln!(text, "  contract  {}", contract_text(pass.contract));
            if !pass.features.is_empty() {
                let _ = writeln!(text, "  needs     {:?}", pass.features);
            }
            if !pass.ignores.is_empty() {
                let _ = writeln!(text, "  ignores   {}", pass.ignores.join(", "));
            }
            for counter in pass.counters {
                let _ = writeln!(text, "  counts    {}: {}", counter.name, counter.doc);
            }
            if !pass.params.is_empty() {
                let _ = writeln!(text, "{}", params_table(pass.params));
            }
        }
    }
    text
}

fn ports_table(stage: &Stage) -> comfy_table::Table {
    let mut table = table(&["port", "way", "type", "unit", "what it is"]);
    for port in stage.ports {
        table.add_row([
            port.name.to_string(),
            way(port).to_string(),
            port.type_text(),
            port.unit.to_string(),
            port.doc.to_string(),
        ]);
    }
    table
}

fn params_table(params: &[ParamSpec]) -> comfy_table::Table {
    let mut table = table(&["parameter", "allowed", "default", "unit", "what it does"]);
    for spec in params {
        table.add_row([
            spec.name.into(),
            spec.range.text(),
            spec.range.default_value().text(),
            spec.unit.into(),
            spec.doc.to_string(),
        ]);
    }
    table
}

fn way(port: &Port) -> &'static str {
    match port.direction {
        Direction::In => "in",
        Direction::OptionalIn => "in, optional",
        Direction::Out => "out",
    }
}

fn contract_text(contract: Contract) -> String {
    match contract {
        Contract::Exact => "equal bits".into(),
        Contract::Within(bound) => format!("equal within {bound:e}"),
        Contract::Sets => "equal as sets in each cell".into(),
        Contract::Superset => "a superset: nothing missing".into(),
        Contract::WrongBits(share) => format!("at most {share:e} of the bits wrong"),
        Contract::Approximate => "an approximation, charted against the truth".into(),
    }
}

/// docs/PASSES.md.
pub fn markdown(catalogue: &Catalogue) -> String {
    let mut text = String::from(
        "# Passes\n\nGenerated by `shadowgraph passes --markdown`; a test holds it fresh. The first pass of a stage is its default.\n",
    );
    let cell = |text: &str| text.replace('|', "\\|");
    for stage in catalogue.stages() {
        let _ = write!(
            text,
            "\n## {}\n\n{}\n\n| port | way | type | unit | what it is |\n|---|---|---|---|---|\n",
            stage.name, stage.doc
        );
        for port in stage.ports {
            let _ = writeln!(
                text,
                "| `{}` | {} | {} | {} | {} |",
                port.name,
                way(port),
                port.type_text(),
                port.unit,
                cell(port.doc)
            );
        }
        for pass in catalogue.passes().filter(|pass| pass.stage.name == stage.name) {
            let _ = write!(text, "\n### {}/{}\n\n{}\n\n", stage.name, pass.name, pass.doc);
            let _ = writeln!(text, "- source: {}", pass.source);
            let _ = writeln!(text, "- runs on: {}", backends(pass));
            let _ = writeln!(text, "- contract: {}", contract_text(pass.contract));
            if !pass.features.is_empty() {
                let _ = writeln!(text, "- needs: {:?}", pass.features);
            }
            if !pass.ignores.is_empty() {
                let _ = writeln!(text, "- ignores: `{}`", pass.ignores.join("`, `"));
            }
            for counter in pass.counters {
                let _ = writeln!(text, "- counts `{}`: {}", counter.name, counter.doc);
            }
            if !pass.params.is_empty() {
                text.push_str("\n| parameter | allowed | default | unit | what it does |\n|---|---|---|---|---|\n");
            }
            for spec in pass.params {
                let default = spec.range.default_value().text();
                let _ = writeln!(
                    text,
                    "| `{}` | {} | {default} | {} | {} |",
                    spec.name,
                    spec.range.text(),
                    spec.unit,
                    cell(spec.doc)
                );
            }
        }
    }
    text
}

fn pass_json(pass: &Pass) -> serde_json::Value {
    let counters = pass.counters.iter().map(|counter| {
        let kind = match counter.kind {
            CounterKind::Info => "info".to_string(),
            CounterKind::OnCpu => "info, on the CPU only".to_string(),
            CounterKind::Most => "info, the largest".to_string(),
            CounterKind::Rows(port) => format!("rows of {port}"),
            CounterKind::MustBeZero(remedy) => format!("must be zero: {remedy}"),
        };
        json!({ "name": counter.name, "doc": counter.doc, "kind": kind })
    });
    json!({
        "stage": pass.stage.name,
        "pass": pass.name,
        "doc": pass.doc,
        "source": pass.source,
        "on": backends(pass).split(", ").collect::<Vec<_>>(),
        "ports": pass.stage.ports,
        "ignores": pass.ignores,
        "params": pass.params,
        "counters": counters.collect::<Vec<_>>(),
        "contract": pass.contract,
        "features": pass.features,
    })
}
