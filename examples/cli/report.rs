//! Tables and progress for people.

use crate::record::{RunRecord, SceneRecord};
use comfy_table::{CellAlignment, ContentArrangement, Table, presets::UTF8_BORDERS_ONLY};
use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

/// A table with a header.
pub fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table
        .load_preset(UTF8_BORDERS_ONLY)
        .set_content_arrangement(ContentArrangement::Disabled)
        .set_header(header.to_vec());
    table
}

/// Right-aligns these columns.
pub fn align_right(table: &mut Table, columns: &[usize]) {
    for index in columns {
        if let Some(column) = table.column_mut(*index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
}

/// Bytes in the largest unit that keeps three digits.
pub fn bytes_text(bytes: usize) -> String {
    let units = ["B", "KiB", "MiB", "GiB"];
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < units.len() {
        value /= 1024.0;
        unit += 1;
    }
    if unit == 0 { format!("{bytes} B") } else { format!("{value:.1} {}", units[unit]) }
}

/// What ran and what each node cost.
pub fn run_text(record: &RunRecord) -> String {
    let mut text = heading_text(record);
    text.push_str(&nodes_table(record).to_string());
    text.push('\n');
    let frame = record.frame_millis;
    if record.runs_count > 1 {
        text.push_str(&format!(
            "{} runs after a warm-up: median {:.2} ms, {:.2} to {:.2}\n",
            record.runs_count, frame.median, frame.min, frame.max
        ));
    } else {
        text.push_str(&format!("one run, cold: {:.2} ms (--repeat N for medians)\n", frame.median));
    }
    text + &left_out_text(record)
}

/// Graph, scene and machine.
pub fn heading_text(record: &RunRecord) -> String {
    let scene = &record.scene;
    let mut text = format!(
        "{} on {}{}: {} triangles, {} of {} parts closed, {}x{} pixels, {}\n",
        record.graph,
        scene.name,
        if scene.view.is_empty() { String::new() } else { format!(" ({})", scene.view) },
        scene.triangles_count,
        scene.closed_parts_count,
        scene.parts_count,
        record.size[0],
        record.size[1],
        light_text(scene),
    );
    let device = &record.device;
    text.push_str(&match device.backend {
        "cpu" => format!("CPU backend, {} threads ({})\n", device.threads, device.reason),
        _ => format!(
            "wgpu backend, {} [{}], {} ({})\n",
            device.adapter, device.adapter_type, device.driver, device.reason
        ),
    });
    text
}

/// What did not run, and remarks.
pub fn left_out_text(record: &RunRecord) -> String {
    let mut text = String::new();
    for (node, reason) in &record.left_out {
        text.push_str(&format!("left out: {node}: {reason}\n"));
    }
    for note in &record.notes {
        text.push_str(&format!("note: {note}\n"));
    }
    text
}

fn light_text(scene: &SceneRecord) -> String {
    match scene.light_samples_count {
        1 => "1 light sample".into(),
        count => format!("{count} light samples ({}, {})", scene.light_shape, scene.light_generator),
    }
}

fn nodes_table(record: &RunRecord) -> Table {
    let mut table = table(&["node", "pass", "on", "ms", "share", "made", "counts"]);
    let total: f64 = record.nodes.iter().map(|node| node.millis_spread.median).sum();
    for node in &record.nodes {
        let share = if total > 0.0 { 100.0 * node.millis_spread.median / total } else { 0.0 };
        let counts: Vec<String> = node.node.counts.iter().map(|(name, count)| format!("{name} {count}")).collect();
        let pass = if node.node.stage == node.node.node {
            node.node.pass.into()
        } else {
            format!("{}/{}", node.node.stage, node.node.pass)
        };
        table.add_row([
            node.node.node.clone(),
            pass,
            format!("{:?}", node.node.on).to_lowercase(),
            format!("{:.3}", node.millis_spread.median),
            format!("{share:.0} %"),
            bytes_text(node.node.bytes),
            counts.join(", "),
        ]);
    }
    align_right(&mut table, &[3, 4, 5]);
    table
}

/// A progress bar on stderr that shows itself only when the work is long and stderr is a terminal.
pub struct Bar(ProgressBar);

impl Bar {
    /// A bar; hidden when `quiet`.
    pub fn new(quiet: bool) -> Self {
        if quiet {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new(1);
        let style = ProgressStyle::with_template("{msg:<28} {bar:32} {percent:>3} % {elapsed} (left {eta})");
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        bar.enable_steady_tick(Duration::from_millis(250));
        Self(bar)
    }
    /// Node `name` has done `done` of `total`.
    pub fn set(&self, name: &str, done: u64, total: u64) {
        self.0.set_length(total);
        self.0.set_message(name.to_string());
        self.0.set_position(done);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_keep_their_unit() {
        assert_eq!(bytes_text(1023), "1023 B");
        assert_eq!(bytes_text(1536), "1.5 KiB");
        assert_eq!(bytes_text(3 << 30), "3.0 GiB");
    }
}
