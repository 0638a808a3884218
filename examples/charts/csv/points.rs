//! Points and their nodes.

use super::{PROVENANCE, Table, number, optional, provenance};
use crate::model::{Interval, Point};

/// A row for each point; axes of choices are columns `set.AXIS`.
pub fn points(points: &[Point]) -> String {
    let mut axes: Vec<&str> = Vec::new();
    for (axis, _) in points.iter().flat_map(|point| &point.choices) {
        if !axes.contains(&axis.as_str()) {
            axes.push(axis);
        }
    }
    let sets: Vec<String> = axes.iter().map(|axis| format!("set.{axis}")).collect();
    let mut table = Table::default();
    let mut header: Vec<&str> = POINT.to_vec();
    header.extend(sets.iter().map(String::as_str));
    header.extend(ERRORS);
    header.extend(["failure"]);
    header.extend(PROVENANCE);
    table.row(header);
    for point in points {
        let [width, height] = point.size.map(|side| side.to_string());
        let millis = |of: fn(&Interval) -> f64| point.millis.as_ref().map(of).map_or(String::new(), number);
        let mut fields = vec![
            point.id.clone(),
            point.suite.clone(),
            point.scene.clone(),
            point.view.clone(),
            point.graph.clone(),
            point.label.clone(),
            point.backend.clone(),
            width,
            height,
            point.light_samples.to_string(),
            millis(|time| time.median),
            millis(|time| time.low),
            millis(|time| time.high),
            point.runs_count.to_string(),
        ];
        let set = |axis: &&str| point.choices.iter().find(|(name, _)| name == axis).map(|(_, value)| value.clone());
        fields.extend(axes.iter().map(|axis| set(axis).unwrap_or_default()));
        let errors = &point.errors;
        let shares = [
            errors.wrong_bit_share,
            errors.light_leak_share,
            errors.shadow_leak_share,
            errors.rmse_penumbra,
            errors.rmse_all,
            errors.p99,
            errors.max,
            errors.mean_signed,
            errors.flip_tonemapped,
            errors.flip_linear,
            errors.penumbra_width_ratio,
        ];
        fields.extend(shares.map(optional));
        let counts = [errors.penumbra_rows_count, errors.rows_count];
        fields.extend(counts.map(|count| count.map_or(String::new(), |count| count.to_string())));
        fields.push(point.failure.clone().unwrap_or_default());
        fields.extend(provenance(&point.provenance));
        table.row(fields.iter().map(String::as_str));
    }
    table.text
}

const POINT: [&str; 14] = [
    "id",
    "suite",
    "scene",
    "view",
    "graph",
    "label",
    "backend",
    "width_px",
    "height_px",
    "light_samples_count",
    "median_millis",
    "low_millis",
    "high_millis",
    "runs_count",
];

const ERRORS: [&str; 13] = [
    "wrong_bit_share",
    "light_leak_share",
    "shadow_leak_share",
    "rmse_penumbra",
    "rmse_all",
    "p99",
    "max",
    "mean_signed",
    "flip_tonemapped",
    "flip_linear",
    "penumbra_width_ratio",
    "penumbra_rows_count",
    "rows_count",
];

/// A row for each node of each point.
pub fn nodes(points: &[Point]) -> String {
    let mut table = Table::default();
    table.row([
        "id", "scene", "view", "label", "backend", "order", "node", "stage", "pass", "millis", "bytes", "counts",
    ]);
    for point in points {
        for (order, node) in point.nodes.iter().enumerate() {
            let counts: Vec<String> = node.counts.iter().map(|(name, count)| format!("{name}={count}")).collect();
            let [order, bytes] = [order.to_string(), node.bytes.to_string()];
            let (millis, counts) = (number(node.millis), counts.join(" "));
            let [id, scene, view] = [&point.id, &point.scene, &point.view];
            let names = [id, scene, view, &point.label, &point.backend, &order, &node.node, &node.stage, &node.pass];
            table.row(names.into_iter().chain([&millis, &bytes, &counts]).map(String::as_str));
        }
    }
    table.text
}
