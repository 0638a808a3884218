//! A variant as a graph file of its own.

use crate::args::GraphChoice;

/// A node that differs from the base: id, pass, parameters.
type Replaced<'a> = (&'a str, Option<&'a str>, Vec<(&'a str, &'a str)>);

/// The file: a base, its light samples, and what is replaced.
pub fn graph_text(choice: &GraphChoice, light_samples: usize) -> String {
    let mut nodes: Vec<Replaced> = Vec::new();
    for (id, pass) in choice.swap.iter().filter_map(|text| text.split_once('=')) {
        entry(&mut nodes, id).1 = Some(pass);
    }
    for (place, value) in choice.set.iter().filter_map(|text| text.split_once('=')) {
        if let Some((id, param)) = place.split_once('.') {
            entry(&mut nodes, id).2.push((param, value));
        }
    }
    let mut text = format!("(\n    version: 1,\n    base: {:?},\n    light_samples: {light_samples},\n", choice.graph);
    if !nodes.is_empty() {
        text += "    replace: [\n";
        for (id, pass, params) in nodes {
            text += &format!("        (id: {id:?}");
            text += &pass.map(|pass| format!(", pass: {pass:?}")).unwrap_or_default();
            if !params.is_empty() {
                let params: Vec<_> =
                    params.iter().map(|(name, value)| format!("{name:?}: {}", scalar(value))).collect();
                text += &format!(", params: {{{}}}", params.join(", "));
            }
            text += "),\n";
        }
        text += "    ],\n";
    }
    text + ")\n"
}

fn entry<'n, 'a>(nodes: &'n mut Vec<Replaced<'a>>, id: &'a str) -> &'n mut Replaced<'a> {
    let at = nodes.iter().position(|(known, ..)| *known == id).unwrap_or_else(|| {
        nodes.push((id, None, Vec::new()));
        nodes.len() - 1
    });
    &mut nodes[at]
}

/// A number or switch as it is, a word in quotes.
fn scalar(value: &str) -> String {
    let is_bare = value.parse::<f64>().is_ok() || ["true", "false"].contains(&value);
    if is_bare { value.to_string() } else { format!("{:?}", value.trim_matches('"')) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_variant_is_a_file_that_says_what_it_replaces() {
        let choice = GraphChoice {
            graph: "soft_lu".into(),
            swap: vec!["casters=light_back_facing".into()],
            set: vec!["lu_table.size=64".into(), "conservative_raster.bound=quad".into(), "lu_table.k=2".into()],
            ..GraphChoice::default()
        };
        let expected = r#"(
    version: 1,
    base: "soft_lu",
    light_samples: 64,
    replace: [
        (id: "casters", pass: "light_back_facing"),
        (id: "lu_table", params: {"size": 64, "k": 2}),
        (id: "conservative_raster", params: {"bound": "quad"}),
    ],
)
"#;
        assert_eq!(graph_text(&choice, 64), expected);
    }
}
