//! What a suite came to: methods against cases, what is not as expected, motion, times and lists.

use crate::report::table;
use shadowgraph_charts::model::{Expected, Stability, Verdict};

/// The record's sequence in a word, as suites write it.
fn change(record: &Stability) -> &'static str {
    let known = super::suite::CHANGES.iter().find(|(_, change)| *change == record.sequence);
    known.map_or("", |(word, _)| word)
}

/// Cases and methods in the order of the records, each once, and a record for each pair that has one.
struct Grid<'r> {
    cases: Vec<(&'r str, &'static str)>,
    methods: Vec<&'r str>,
    records: &'r [&'r Stability],
}

impl<'r> Grid<'r> {
    fn new(records: &'r [&'r Stability]) -> Self {
        let (mut cases, mut methods) = (Vec::new(), Vec::new());
        for record in records {
            let case = (record.scene.as_str(), change(record));
            if !cases.contains(&case) {
                cases.push(case);
            }
            if !methods.contains(&record.label.as_str()) {
                methods.push(record.label.as_str());
            }
        }
        Self { cases, methods, records }
    }

    fn find(&self, case: (&str, &str), method: &str) -> Option<&'r Stability> {
        let is_here = |record: &&&Stability| (record.scene.as_str(), change(record)) == case && record.label == method;
        self.records.iter().find(is_here).copied()
    }
}

/// Four decimals, powers of ten only where they say more.
pub fn number(value: f64) -> String {
    match value {
        0.0 => "0".into(),
        value if value >= 0.0005 => {
            let text = format!("{value:.4}");
            text.trim_start_matches('0').trim_end_matches('0').trim_end_matches('.').into()
        }
        value => format!("{value:.0e}"),
    }
}

fn cell(record: Option<&Stability>) -> String {
    let Some(record) = record else { return String::new() };
    let figure = record.figure.map(number).unwrap_or_default();
    let mark = if record.verdict.surprises(record.expected) { " !" } else { "" };
    match record.verdict {
        Verdict::Holds => format!("{figure}{mark}"),
        Verdict::Fails => format!("X {figure}{mark}"),
        Verdict::NotRun { .. } => "-".into(),
    }
}

/// The table for a terminal, and what must be told beside it.
pub fn report(records: &[&Stability]) -> String {
    let grid = Grid::new(records);
    let mut rows = table(&[&["scene", "change"], grid.methods.as_slice()].concat());
    for case in &grid.cases {
        let cells = grid.methods.iter().map(|method| cell(grid.find(*case, method)));
        rows.add_row([case.0.to_string(), case.1.to_string()].into_iter().chain(cells));
    }
    format!(
        "{rows}\nX fails; ! not as theory says; - not run; the figure is that of the worst frame\n{}",
        notes(records)
    )
}

/// The same tables in Markdown.
pub fn markdown(records: &[&Stability]) -> String {
    let grid = Grid::new(records);
    let mut text = format!("| scene | change | {} |\n|---|---|", grid.methods.join(" | "));
    text.push_str(&"---|".repeat(grid.methods.len()));
    text.push('\n');
    for case in &grid.cases {
        let cells: Vec<String> = grid.methods.iter().map(|method| cell(grid.find(*case, method))).collect();
        text.push_str(&format!("| {} | {} | {} |\n", case.0, case.1, cells.join(" | ")));
    }
    text.push_str("\n| method | judged by | threshold | holds | fails | not run | largest T-RMSE | most toggled bits | slowest frame, ms | longest list |\n");
    text.push_str("|---|---|---|---|---|---|---|---|---|---|\n");
    for method in &grid.methods {
        text.push_str(&format!("| {} |\n", summary(records, method).join(" | ")));
    }
    text
}

/// One method over all cases.
fn summary(records: &[&Stability], method: &str) -> Vec<String> {
    let of: Vec<&Stability> = records.iter().copied().filter(|record| record.label == method).collect();
    let count = |wanted: &dyn Fn(&Verdict) -> bool| of.iter().filter(|record| wanted(&record.verdict)).count();
    let largest = |values: &mut dyn Iterator<Item = f64>| values.reduce(f64::max);
    let text = |value: Option<f64>| value.map_or("-".into(), number);
    let frames = || of.iter().flat_map(|record| &record.frames);
    let motion = || of.iter().filter_map(|record| record.temporal);
    let millis = largest(&mut frames().filter_map(|frame| frame.millis));
    let list = frames().filter_map(|frame| frame.longest_list_count).max();
    let judged: Vec<&str> = of.iter().map(|record| record.judged_by.as_str()).filter(|by| *by != "rmse_all").collect();
    vec![
        method.into(),
        judged.first().or(of.first().map(|record| record.judged_by.as_str()).as_ref()).copied().unwrap_or("").into(),
        text(of.first().and_then(|record| record.threshold)),
        count(&|verdict| *verdict == Verdict::Holds).to_string(),
        count(&|verdict| *verdict == Verdict::Fails).to_string(),
        count(&|verdict| matches!(verdict, Verdict::NotRun { .. })).to_string(),
        text(largest(&mut motion().filter_map(|motion| motion.t_rmse))),
        text(largest(&mut motion().filter_map(|motion| motion.toggled_share))),
        millis.map_or("-".into(), |millis| format!("{millis:.0}")),
        list.map_or("-".into(), |list| list.to_string()),
    ]
}

fn notes(records: &[&Stability]) -> String {
    let mut rows = table(&[
        "method",
        "judged by",
        "at most",
        "holds",
        "fails",
        "not run",
        "T-RMSE",
        "toggled",
        "slowest ms",
        "longest list",
    ]);
    for method in &Grid::new(records).methods {
        rows.add_row(summary(records, method));
    }
    let mut text = format!("{rows}\n");
    let place = |record: &Stability| format!("{} on {}, {}", record.label, record.scene, change(record));
    for record in records {
        let figure = || {
            let (figure, threshold) = (record.figure.unwrap_or_default(), record.threshold.unwrap_or_default());
            format!("{} {}, at most {}", record.judged_by, number(figure), number(threshold))
        };
        match (&record.verdict, record.expected) {
            (Verdict::Fails, Expected::MustHold) => {
                text.push_str(&format!(
                    "MUST HOLD and fails: {}: {} ({})\n",
                    place(record),
                    figure(),
                    record.expected_source
                ));
            }
            (Verdict::Holds, Expected::ExpectedToFail) => text.push_str(&format!(
                "not seen to fail: explain: {}: {} ({})\n",
                place(record),
                figure(),
                record.expected_source
            )),
            (Verdict::NotRun { why }, Expected::MustHold | Expected::ExpectedToFail) => {
                text.push_str(&format!("did not run: {}: {why}\n", place(record)));
            }
            _ => {}
        }
    }
    if !records.is_empty() && records.iter().all(|record| record.verdict != Verdict::Fails) {
        text.push_str("nothing fails: such a suite has not shown that it can see a failure\n");
    }
    text
}

/// Whether every record that must hold does.
pub fn is_accepted(records: &[&Stability]) -> bool {
    let holds = |record: &&&Stability| record.expected != Expected::MustHold || record.verdict == Verdict::Holds;
    records.iter().all(|record| holds(&record))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_none_reads_as_nothing() {
        let shown = [0.0, 1.0, 0.0157, 0.25, 3e-4, 3.6e-6, 12.5].map(number);
        assert_eq!(shown, ["0", "1", ".0157", ".25", "3e-4", "4e-6", "12.5"]);
    }
}
