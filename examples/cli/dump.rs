//! Every value of a run as .npy files, with an index that says what each is.
//!
//! Rows of background pixels are left out: what is written has one row for every view-sample, in view order, and `pixel.npy`
//! says which pixel each came from. Lists name view-samples by those rows. Arrays with spare capacity are cut to what was
//! used.

use crate::outcome::Outcome;
use crate::{file_problem, npy};
use serde_json::{Value, json};
use shadowgraph_core::array::Array;
use shadowgraph_core::plan::{Plan, Producer, Slot};
use shadowgraph_core::problem::Problem;
use shadowgraph_core::shared::{NO_CELL, NO_TRIANGLE};
use std::path::Path;

/// What a dump holds.
pub struct Written {
    /// Arrays written.
    pub arrays_count: usize,
    /// Values of the plan without one array: tables by cell of a run in ranges of view-samples.
    pub left_out: Vec<String>,
}

/// Writes the graph's inputs and every live output port of `plan` to `directory`.
///
/// # Errors
/// A file cannot be written.
pub fn write(directory: &Path, plan: &Plan, inputs: &[(String, Array)], outcome: &Outcome) -> Result<Written, Problem> {
    std::fs::create_dir_all(directory).map_err(|error| file_problem(directory, &error))?;
    let rows = ViewRows::of(plan, outcome);
    let (mut index, mut left_out) = (Vec::new(), Vec::new());
    for (name, array) in inputs {
        let port = shadowgraph_core::input::ALL.iter().find(|port| port.name == name);
        let (unit, space) = port.map_or(("", Value::Null), |port| (port.unit, json!(port.space)));
        save(directory, &mut index, Entry { node: "", stage: "", port: name, unit, space }, array)?;
    }
    for (id, slot) in plan.slots.iter().enumerate() {
        let Producer::Node(node) = &slot.producer else { continue };
        let Some(array) = outcome.values.try_get(id) else {
            left_out.extend(slot.keep.then(|| slot.name.clone()));
            continue;
        };
        let node = &plan.nodes[*node];
        let port = &slot.port;
        let array = rows.trim(plan, outcome, slot, array);
        let entry = Entry {
            node: &node.id,
            stage: node.pass.stage.name,
            port: port.name,
            unit: port.unit,
            space: json!(port.space),
        };
        save(directory, &mut index, entry, &array)?;
    }
    let path = directory.join("index.json");
    let text = serde_json::to_string_pretty(&json!({ "graph": plan.name, "arrays": index, "left_out": left_out }))
        .unwrap_or_default();
    std::fs::write(&path, text).map_err(|error| file_problem(&path, &error))?;
    Ok(Written { arrays_count: index.len(), left_out })
}

struct Entry<'a> {
    node: &'a str,
    stage: &'a str,
    port: &'a str,
    unit: &'a str,
    space: Value,
}

fn save(directory: &Path, index: &mut Vec<Value>, entry: Entry, array: &Array) -> Result<(), Problem> {
    let file = if entry.node.is_empty() {
        format!("{}.npy", entry.port)
    } else {
        format!("{}.{}.npy", entry.node, entry.port)
    };
    npy::write(&directory.join(&file), array)?;
    index.push(json!({
        "file": file,
        "node": if entry.node.is_empty() { Value::Null } else { json!(entry.node) },
        "stage": if entry.stage.is_empty() { Value::Null } else { json!(entry.stage) },
        "port": entry.port,
        "shape": array.shape(),
        "element": array.element(),
        "unit": entry.unit,
        "space": entry.space,
    }));
    Ok(())
}

/// Which rows of the view-ordered arrays are view-samples.
struct ViewRows {
    /// Row in the run -> row in the dump; `NO_CELL` for background.
    new_row: Vec<u32>,
    kept_count: usize,
}

impl ViewRows {
    fn of(plan: &Plan, outcome: &Outcome) -> Self {
        let triangles = plan.slots.iter().position(|slot| slot.port.quantity == "triangle_of_sample" && is_made(slot));
        let triangles = triangles.and_then(|slot| outcome.values.try_get(slot)).map_or(&[] as &[u32], Array::as_u32);
        let mut kept_count = 0;
        let new_row = triangles
            .iter()
            .map(|triangle| {
                if *triangle == NO_TRIANGLE {
                    return NO_CELL;
                }
                kept_count += 1;
                kept_count as u32 - 1
            })
            .collect();
        Self { new_row, kept_count }
    }

    fn trim(&self, plan: &Plan, outcome: &Outcome, slot: &Slot, array: &Array) -> Array {
        let first = slot.port.shape.split(' ').next().unwrap_or_default();
        if slot.port.quantity == "view_sample" {
            return self.renamed_entries(used_rows(plan, outcome, "list_length"), array);
        }
        match first {
            "P" if array.dim(0) == self.new_row.len() => self.view_samples_only(array),
            "E" => cut(array, used_rows(plan, outcome, "caster_length")),
            _ => array.clone(),
        }
    }

    fn view_samples_only(&self, array: &Array) -> Array {
        let columns: usize = array.shape()[1..].iter().product();
        let mut words = Vec::with_capacity(self.kept_count * columns);
        for (row, new_row) in array.words().chunks_exact(columns.max(1)).zip(&self.new_row) {
            if *new_row != NO_CELL {
                words.extend_from_slice(row);
            }
        }
        let mut shape = array.shape().to_vec();
        shape[0] = self.kept_count;
        Array::from_words(array.element(), shape, words)
    }

    fn renamed_entries(&self, count: usize, array: &Array) -> Array {
        let entries = array.words().iter().take(count);
        let words: Vec<u32> = entries.map(|row| self.new_row.get(*row as usize).copied().unwrap_or(NO_CELL)).collect();
        Array::u32([words.len()], words)
    }
}

fn is_made(slot: &Slot) -> bool {
    matches!(slot.producer, Producer::Node(_))
}

/// Sum of the lengths port called `name`, which is how many rows of its table are used.
fn used_rows(plan: &Plan, outcome: &Outcome, name: &str) -> usize {
    let slot = plan.slots.iter().position(|slot| slot.port.name == name && is_made(slot));
    let lengths = slot.and_then(|slot| outcome.values.try_get(slot)).map_or(&[] as &[u32], Array::as_u32);
    lengths.iter().map(|length| *length as usize).sum()
}

fn cut(array: &Array, rows: usize) -> Array {
    let columns: usize = array.shape()[1..].iter().product();
    let rows = rows.min(array.dim(0));
    let mut shape = array.shape().to_vec();
    shape[0] = rows;
    Array::from_words(array.element(), shape, array.words()[..rows * columns].to_vec())
}
