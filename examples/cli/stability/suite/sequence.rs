//! What changes along a sequence.

use super::{positions, value};
use shadowgraph_charts::model::Sequence;
use shadowgraph_core::problem::{Kind, Problem};
use shadowgraph_graph::{Reader, Tree};

/// One kind of change on some scenes.
#[derive(Clone, Debug)]
pub struct SequenceEntry {
    /// What changes.
    pub change: Sequence,
    /// Its values, a frame each, in [`unit`]s.
    pub values: Vec<f64>,
    /// Positions of the scenes.
    pub scenes: Vec<usize>,
}

/// Every change, by its word in suites.
pub const CHANGES: [(&str, Sequence); 10] = [
    ("Still", Sequence::Still),
    ("LightOrbit", Sequence::LightOrbit),
    ("CameraPan", Sequence::CameraPan),
    ("Zoom", Sequence::Zoom),
    ("WorldScale", Sequence::WorldScale),
    ("FarFromOrigin", Sequence::FarFromOrigin),
    ("GrowingLight", Sequence::GrowingLight),
    ("Tessellation", Sequence::Tessellation),
    ("ClosingContact", Sequence::ClosingContact),
    ("OpeningMeshes", Sequence::OpeningMeshes),
];

/// What the value of a change is, its unit, and the values it may have.
pub fn parameter(change: Sequence) -> (&'static str, &'static str, [f64; 2]) {
    match change {
        Sequence::Still => ("still", "", [0.0, 0.0]),
        Sequence::LightOrbit => ("light angle", "degrees", [-360.0, 360.0]),
        Sequence::CameraPan => ("camera turn", "pixels", [-1000.0, 1000.0]),
        Sequence::Zoom => ("distance left to a shadow edge", "", [1e-6, 1.0]),
        Sequence::WorldScale => ("world scale", "", [1e-9, 1e9]),
        Sequence::FarFromOrigin => ("distance from the origin", "scene diagonals", [0.0, 1e7]),
        Sequence::GrowingLight => ("light radius", "of the scene's own", [1e-6, 1e3]),
        Sequence::Tessellation => ("divisions of every triangle", "", [0.0, 6.0]),
        Sequence::ClosingContact => ("gap", "scene units", [0.0, 1e6]),
        Sequence::OpeningMeshes => ("triangles left out", "", [0.0, 1.0]),
    }
}

/// A bare word of [`CHANGES`].
pub fn change(value: &Tree, reader: &mut Reader) -> Option<Sequence> {
    let word = reader.word(value, "change", &CHANGES.map(|(word, _)| word))?;
    CHANGES.iter().find(|(known, _)| *known == word).map(|(_, change)| *change)
}

/// One entry of `sequences`.
pub fn read(tree: &Tree, reader: &mut Reader, scenes: &[&str]) -> Option<SequenceEntry> {
    let fields = reader.fields(tree, &["change", "values", "scenes"], "a sequence")?;
    let change = reader.needed(tree, &fields, "change", "a sequence").and_then(|value| change(value, reader));
    let scenes = match value(&fields, "scenes") {
        Some(value) => positions(&reader.names(value, "scenes"), scenes, "scene", reader),
        None => (0..scenes.len()).collect(),
    };
    let change = change?;
    let values = match (change, value(&fields, "values")) {
        (Sequence::Still, None) => vec![0.0],
        (Sequence::Still, Some(value)) => {
            let problem = Problem::new(Kind::BadValue, "nothing changes in `Still`, so it has no values");
            reader.problem(value.span, problem.remedy("leave out `values`"));
            return None;
        }
        (_, Some(value)) => values(value, change, reader),
        (_, None) => {
            reader.needed(tree, &fields, "values", "a sequence");
            return None;
        }
    };
    Some(SequenceEntry { change, values, scenes })
}

fn values(tree: &Tree, change: Sequence, reader: &mut Reader) -> Vec<f64> {
    let (name, _, [low, high]) = parameter(change);
    let mut values = Vec::new();
    for item in reader.items(tree, "values") {
        let Some(number) = reader.number(item, "values") else { continue };
        let is_whole = change != Sequence::Tessellation || number.fract() == 0.0;
        if !(low..=high).contains(&number) || !is_whole {
            let problem = Problem::new(Kind::BadValue, format!("not a value of {name}"));
            let kind = if change == Sequence::Tessellation { "a whole number" } else { "a number" };
            let expected = format!("{kind} in {low:?}..={high:?}");
            reader.problem(item.span, problem.expected(expected).found(item.data.text()));
        }
        values.push(number);
    }
    if values.is_empty() {
        reader.problem(tree.span, Problem::new(Kind::Missing, "a sequence without values has no frames"));
    }
    values
}

/// No scene has the same change twice: records could not be told apart.
pub fn once(entry: &SequenceEntry, earlier: &[SequenceEntry], scenes: &[&str], at: &Tree, reader: &mut Reader) {
    let twice = |scene: &&usize| {
        let again = |other: &SequenceEntry| other.change == entry.change && other.scenes.contains(scene);
        earlier.iter().any(again)
    };
    if let Some(scene) = entry.scenes.iter().find(twice) {
        let word = CHANGES.iter().find(|(_, change)| *change == entry.change).map_or("", |(word, _)| word);
        let problem = Problem::new(Kind::Duplicate, format!("scene {:?} has two sequences {word}", scenes[*scene]));
        reader.problem(at.span, problem.remedy("name the scenes of each with `scenes`"));
    }
}
