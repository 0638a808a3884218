//! One value of two runs compared as its contract allows: exact, within a bound, as sets where order is unspecified, as supersets,
//! bit by bit where bits have a meaning.

use serde::Serialize;
use shadowgraph_core::array::{Array, Element};
use shadowgraph_core::metric::mask_difference;
use shadowgraph_core::pass::Contract;
use shadowgraph_core::plan::Node;
use std::ops::Range;

/// How one value of two runs compares.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Comparison {
    /// The same bits, or the same sets.
    Equal,
    /// Other bits where any would do: an order that is unspecified, another superset.
    Allowed {
        /// What differs, and what allows it.
        why: String,
        /// Whether it is another superset, of which tables are laid out otherwise too; an order alone makes the same tables.
        is_other_set: bool,
    },
    /// Other numbers, within the bound or the share of wrong bits that the contract states.
    Within {
        /// What differs, and what allows it.
        why: String,
    },
    /// Other bits from a pass that only approximates: charted, never judged here.
    Approximation {
        /// What differs.
        why: String,
    },
    /// Other values from one node with other parameters: what they are for.
    Parameters {
        /// What differs.
        why: String,
    },
    /// Other than the contract allows.
    Differs {
        /// Words, bits or cells that differ.
        count: u64,
        /// Of how many.
        of: u64,
        /// The first of them: its row.
        first_row: u64,
        /// What the numbers count, and how large the largest difference is.
        what: String,
    },
    /// Nothing can be said.
    NotCompared {
        /// Why.
        why: String,
    },
}

impl Comparison {
    /// Whether it is a difference that the contract does not allow.
    pub fn differs(&self) -> bool {
        matches!(self, Self::Differs { .. })
    }

    /// Whether what reads the value must answer alike for both.
    pub fn is_equivalent(&self) -> bool {
        matches!(self, Self::Equal | Self::Allowed { .. })
    }

    /// The same of a node that has other parameters in the two runs: no contract says that its values are alike then.
    pub fn of_other_parameters(self) -> Self {
        match self {
            Self::Differs { .. } => Self::Parameters { why: self.text() },
            same => same,
        }
    }

    /// In a few words.
    pub fn text(&self) -> String {
        match self {
            Self::Equal => "equal".into(),
            Self::Allowed { why, .. } | Self::Within { why } | Self::Approximation { why } => why.clone(),
            Self::Parameters { why } => format!("by its parameters: {why}"),
            Self::Differs { count, of, first_row, what } => {
                format!("{count} of {of} {what}; first at row {first_row}")
            }
            Self::NotCompared { why } => format!("not compared: {why}"),
        }
    }
}

/// Values of one run around a node, by port.
pub type Around<'a> = &'a dyn Fn(&str) -> Option<&'a Array>;

/// Compares output `port` of `node` in two runs, as `contract` allows; `around` gives what the node reads and makes in each.
///
/// The contract of a node whose two runs have one pass is [`Contract::Exact`] on equal inputs, unless the pass says otherwise.
pub fn port_difference(node: &Node, port: &str, contract: Contract, around: [Around; 2], lights: usize) -> Comparison {
    let (Some(one), Some(other)) = (around[0](port), around[1](port)) else {
        return Comparison::NotCompared { why: "one of the runs has no such value".into() };
    };
    match (node.pass.stage.name, port) {
        ("list_build", "slot") => places(["cell", "list_length"], one, other, around),
        ("list_fill", _) => sets("list_offset", one, other, around),
        ("caster_fill", _) => sets("caster_offset", one, other, around),
        ("conservative_raster", "pair_cell" | "pair_slot" | "pair_caster") => pairs(port, contract, around),
        ("conservative_raster", _) if contract == Contract::Superset && one != other => {
            Comparison::Allowed { why: "another superset of the casters of each cell".into(), is_other_set: true }
        }
        _ if one.shape() != other.shape() => {
            Comparison::NotCompared { why: format!("shapes {:?} and {:?}", one.shape(), other.shape()) }
        }
        (_, "mask") => masks(one, other, contract, lights),
        _ => values(one, other, contract),
    }
}

/// Floats within the contract's bound, relative to the larger of 1 and the value; whole numbers equal.
fn values(one: &Array, other: &Array, contract: Contract) -> Comparison {
    let bits = one.words().iter().zip(other.words()).enumerate().filter(|(_, (one, other))| one != other);
    let (mut count, mut first, mut largest) = (0, None, 0.0f32);
    for (index, (one_word, other_word)) in bits {
        let off = match one.element() {
            Element::U32 => f32::INFINITY,
            Element::F32 => {
                let (a, b) = (f32::from_bits(*one_word), f32::from_bits(*other_word));
                if a == b { 0.0 } else { (a - b).abs() / a.abs().max(1.0) }
            }
        };
        count += 1;
        first = first.or(Some(index));
        // A NaN on one side is as far off as can be.
        largest = largest.max(if off.is_nan() { f32::INFINITY } else { off });
    }
    let Some(first) = first else { return Comparison::Equal };
    let columns = one.shape().iter().skip(1).product::<usize>().max(1);
    match contract {
        Contract::Within(bound) if largest <= bound => {
            Comparison::Within { why: format!("{count} words differ by at most {largest:.1e}, within {bound:.1e}") }
        }
        Contract::Approximate => Comparison::Approximation { why: format!("an approximation: {count} words differ") },
        _ => Comparison::Differs {
            count,
            of: one.words().len() as u64,
            first_row: (first / columns) as u64,
            what: match one.element() {
                Element::U32 => "words".into(),
                Element::F32 => format!("numbers, by {largest:.1e} at most"),
            },
        },
    }
}

fn masks(one: &Array, other: &Array, contract: Contract, lights: usize) -> Comparison {
    let difference = mask_difference(one.as_u32(), other.as_u32(), one.dim(1), lights.min(one.dim(1) * 32), |_| true);
    let count = difference.wrong_count();
    match contract {
        _ if count == 0 => Comparison::Equal,
        Contract::WrongBits(share) if difference.wrong_share() <= f64::from(share) => {
            let of = difference.bits_count;
            Comparison::Within { why: format!("{count} of {of} bits differ, a share within {share:.1e}") }
        }
        Contract::Approximate => Comparison::Approximation { why: format!("an approximation: {count} bits differ") },
        _ => Comparison::Differs {
            count,
            of: difference.bits_count,
            first_row: u64::from(difference.wrong_rows.first().copied().unwrap_or(0)),
            what: "bits".into(),
        },
    }
}

/// Places in lists, whose cells and lengths the ports `of` say: any order will do, if each list has each of its places once.
fn places(of: [&str; 2], one: &Array, other: &Array, around: [Around; 2]) -> Comparison {
    if one == other {
        return Comparison::Equal;
    }
    let lists = |around: Around, slots: &Array| {
        let [cell, length] = of.map(|port| around(port).map(Array::as_u32));
        let (cell, length) = (cell?, length?);
        let mut seen: Vec<Vec<u32>> = vec![Vec::new(); length.len()];
        // Pairs past the last are room that was not needed; rows in no list have a cell past the last.
        let count = if of[0] == PAIR_CELL { total(length) } else { cell.len() };
        for (cell, slot) in cell.iter().zip(slots.as_u32()).take(count) {
            if let Some(list) = seen.get_mut(*cell as usize) {
                list.push(*slot);
            }
        }
        let is_whole = |(list, length): (&mut Vec<u32>, &u32)| {
            list.sort_unstable();
            list.iter().copied().eq(0..*length)
        };
        Some(seen.iter_mut().zip(length).map(is_whole).collect::<Vec<_>>())
    };
    let (Some(one), Some(other)) = (lists(around[0], one), lists(around[1], other)) else {
        return Comparison::NotCompared { why: "one of the runs has no lists".into() };
    };
    let broken = |lists: &[bool]| lists.iter().position(|is_whole| !is_whole);
    match broken(&one).or(broken(&other)) {
        Some(first) => Comparison::Differs {
            count: one.iter().chain(&other).filter(|is_whole| !**is_whole).count() as u64,
            of: one.len() as u64,
            first_row: first as u64,
            what: "cells whose list misses a place or has one twice".into(),
        },
        None => {
            Comparison::Allowed { why: "another order within lists, which is unspecified".into(), is_other_set: false }
        }
    }
}

/// Entries as sets within each cell.
fn sets(offset: &str, one: &Array, other: &Array, around: [Around; 2]) -> Comparison {
    let offsets = around.map(|around| around(offset).map(Array::as_u32));
    let [Some(mine), Some(theirs)] = offsets else {
        return Comparison::NotCompared { why: format!("one of the runs has no {offset}") };
    };
    if mine != theirs {
        return Comparison::NotCompared { why: format!("{offset} differs, so cells hold other numbers of entries") };
    }
    let sorted = |array: &Array, range: Range<usize>| {
        let mut set = array.as_u32().get(range).unwrap_or_default().to_vec();
        set.sort_unstable();
        set
    };
    let differs = |pair: &[u32]| {
        let range = pair[0] as usize..pair[1] as usize;
        sorted(one, range.clone()) != sorted(other, range)
    };
    cells(mine.windows(2).map(differs).enumerate().filter(|(_, differs)| *differs).map(|(cell, _)| cell), mine.len())
}

fn cells(mut differing: impl Iterator<Item = usize>, of: usize) -> Comparison {
    let Some(first) = differing.next() else { return Comparison::Equal };
    Comparison::Differs {
        count: 1 + differing.count() as u64,
        of: of as u64,
        first_row: first as u64,
        what: "cells that hold other entries".into(),
    }
}

/// Port with the cell of each pair.
const PAIR_CELL: &str = "pair_cell";

fn total(lengths: &[u32]) -> usize {
    lengths.iter().map(|length| *length as usize).sum()
}

/// (cell, caster) pairs as sets: what each run has beside the other. Their places may have any order in which each is taken once.
fn pairs(port: &str, contract: Contract, around: [Around; 2]) -> Comparison {
    let set = |around: Around| {
        let count = total(around("caster_length")?.as_u32());
        let (cell, caster) = (around(PAIR_CELL)?.as_u32(), around("pair_caster")?.as_u32());
        let mut pairs: Vec<_> = cell.iter().zip(caster).take(count).map(|(cell, caster)| (*cell, *caster)).collect();
        pairs.sort_unstable();
        Some(pairs)
    };
    let [Some(one), Some(other)] = around.map(set) else {
        return Comparison::NotCompared { why: "one of the runs has no pairs".into() };
    };
    let beside = |one: &[(u32, u32)], other: &[(u32, u32)]| {
        one.iter().copied().filter(|pair| other.binary_search(pair).is_err()).collect::<Vec<_>>()
    };
    let (mine, theirs) = (beside(&one, &other), beside(&other, &one));
    let slots = || match port {
        "pair_slot" => {
            let (one, other) = (around[0](port)?, around[1](port)?);
            Some(places([PAIR_CELL, "caster_length"], one, other, around))
        }
        _ => None,
    };
    let slots = slots();
    match mine.iter().chain(&theirs).map(|(cell, _)| *cell).min() {
        _ if slots.as_ref().is_some_and(Comparison::differs) => slots.unwrap_or(Comparison::Equal),
        None => slots.unwrap_or(Comparison::Equal),
        Some(_) if contract == Contract::Superset => Comparison::Allowed {
            why: format!("another superset: {} pairs less, {} more, of {}", mine.len(), theirs.len(), one.len()),
            is_other_set: true,
        },
        Some(cell) => Comparison::Differs {
            count: (mine.len() + theirs.len()) as u64,
            of: one.len() as u64,
            first_row: u64::from(cell),
            what: format!("(cell, caster) pairs: {} less, {} more; the row is a cell", mine.len(), theirs.len()),
        },
    }
}

/// The cells of a caster table that do not hold the casters of their own pairs, whatever another run made of other pairs.
pub fn misfilled(around: Around) -> Option<Comparison> {
    let [offset, entries, cell, caster] =
        ["caster_offset", "caster_entries", PAIR_CELL, "pair_caster"].map(|port| around(port).map(Array::as_u32));
    let (offset, entries, cell, caster) = (offset?, entries?, cell?, caster?);
    let count = *offset.last()? as usize;
    let mut wanted: Vec<_> = cell.iter().copied().zip(caster.iter().copied()).take(count).collect();
    let places = |cell: usize| offset[cell] as usize..offset[cell + 1] as usize;
    let cells_count = offset.len() - 1;
    let found = |cell: usize| {
        let entries = entries.get(places(cell)).unwrap_or_default();
        entries.iter().map(move |caster| (cell as u32, *caster))
    };
    let mut found: Vec<_> = (0..cells_count).flat_map(found).collect();
    wanted.sort_unstable();
    found.sort_unstable();
    let wrong = found.iter().zip(&wanted).find(|(found, wanted)| found != wanted);
    let first = wrong.map(|(found, wanted)| found.0.min(wanted.0));
    let first = first.or((found.len() != wanted.len()).then_some(0))?;
    let is_missing = |pair: &&(u32, u32)| found.binary_search(pair).is_err();
    Some(Comparison::Differs {
        count: wanted.iter().filter(is_missing).count().max(1) as u64,
        of: wanted.len() as u64,
        first_row: u64::from(first),
        what: "(cell, caster) pairs are not in the table made of them; the row is a cell".into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_differences_of_each_kind_are_found() {
        let floats = |last: f32| Array::f32([2, 2], vec![1.0, 2.0, 3.0, last]);
        assert_eq!(values(&floats(4.0), &floats(4.0), Contract::Exact), Comparison::Equal);
        let off = values(&floats(4.0), &floats(5.0), Contract::Exact);
        assert_eq!(
            off,
            Comparison::Differs { count: 1, of: 4, first_row: 1, what: "numbers, by 2.5e-1 at most".into() }
        );
        assert!(matches!(values(&floats(4.0), &floats(4.1), Contract::Within(0.1)), Comparison::Within { .. }));
        assert!(values(&floats(4.0), &floats(f32::NAN), Contract::Within(0.1)).differs());
        let words = |last: u32| Array::u32([2, 1], vec![1, last]);
        assert!(values(&words(1), &words(2), Contract::Within(10.0)).differs());
        assert!(masks(&words(1), &words(3), Contract::Exact, 2).differs());
        assert_eq!(masks(&words(1), &words(5), Contract::Exact, 2), Comparison::Equal);
        assert!(matches!(masks(&words(1), &words(3), Contract::WrongBits(0.5), 2), Comparison::Within { .. }));
        assert!(masks(&words(1), &words(3), Contract::WrongBits(0.1), 2).differs());
    }

    #[test]
    fn lists_are_sets_and_supersets_are_told_from_others() {
        let offset = Array::u32([3], vec![0, 2, 3]);
        let one = Array::u32([4], vec![7, 5, 1, 99]);
        let ordered = Array::u32([4], vec![5, 7, 1, 0]);
        let other = Array::u32([4], vec![5, 6, 1, 99]);
        let around: Around = &|port| (port == "list_offset").then_some(&offset);
        assert_eq!(sets("list_offset", &one, &ordered, [around; 2]), Comparison::Equal);
        assert!(sets("list_offset", &one, &other, [around; 2]).differs());
        let (length, cell) = (Array::u32([2], vec![2, 1]), Array::u32([3], vec![0, 0, 1]));
        let casters = [Array::u32([3], vec![4, 5, 6]), Array::u32([3], vec![4, 5, 7])];
        let run = |caster: &'static Array| {
            let (length, cell): (&'static Array, &'static Array) =
                (Box::leak(Box::new(length.clone())), Box::leak(Box::new(cell.clone())));
            move |port: &str| match port {
                "caster_length" => Some(length),
                "pair_cell" => Some(cell),
                "pair_caster" => Some(caster),
                _ => None,
            }
        };
        let [first, second] = casters.map(|array| &*Box::leak(Box::new(array)));
        let (first, second) = (run(first), run(second));
        let both: [Around; 2] = [&first, &second];
        assert!(pairs("pair_caster", Contract::Exact, both).differs());
        assert!(matches!(pairs("pair_caster", Contract::Superset, both), Comparison::Allowed { .. }));
        assert_eq!(pairs("pair_caster", Contract::Exact, [&first, &first]), Comparison::Equal);
    }

    #[test]
    fn a_place_taken_twice_is_a_difference_and_another_order_is_none() {
        let (cell, length) = (Array::u32([3], vec![0, 0, 1]), Array::u32([2], vec![2, 1]));
        let around: Around = &|port| match port {
            "cell" => Some(&cell),
            "list_length" => Some(&length),
            _ => None,
        };
        let slots = |first: u32, second: u32| Array::u32([3], vec![first, second, 0]);
        let of = ["cell", "list_length"];
        assert!(matches!(places(of, &slots(0, 1), &slots(1, 0), [around; 2]), Comparison::Allowed { .. }));
        assert!(places(of, &slots(0, 1), &slots(1, 1), [around; 2]).differs());
    }

    #[test]
    fn places_of_pairs_and_tables_made_of_them_are_looked_at() {
        let [length, cell] = [Array::u32([2], vec![2, 1]), Array::u32([4], vec![0, 1, 0, 77])];
        let [caster, offset] = [Array::u32([4], vec![4, 5, 6, 77]), Array::u32([3], vec![0, 2, 3])];
        let slots = [[0, 0, 1, 9], [1, 0, 0, 9], [1, 0, 1, 9]].map(|slots| Array::u32([4], slots.to_vec()));
        let entries = [[4, 6, 5, 0], [6, 4, 5, 1], [4, 4, 5, 0], [4, 5, 6, 0]].map(|of| Array::u32([4], of.to_vec()));
        let run = |slot: usize, entry: usize| {
            let arrays = [&length, &cell, &caster, &offset, &slots[slot], &entries[entry]];
            let ports = ["caster_length", "pair_cell", "pair_caster", "caster_offset", "pair_slot", "caster_entries"];
            move |port: &str| ports.iter().position(|other| *other == port).map(|place| arrays[place])
        };
        let (first, other_order, twice) = (run(0, 0), run(1, 1), run(2, 2));
        for port in ["pair_cell", "pair_caster"] {
            assert_eq!(pairs(port, Contract::Superset, [&first, &twice]), Comparison::Equal, "{port}");
        }
        let order = pairs("pair_slot", Contract::Superset, [&first, &other_order]);
        assert!(matches!(order, Comparison::Allowed { is_other_set: false, .. }), "{order:?}");
        assert!(pairs("pair_slot", Contract::Superset, [&first, &twice]).differs());
        assert_eq!([misfilled(&first), misfilled(&other_order)], [None, None]);
        assert!(misfilled(&twice).is_some_and(|wrong| wrong.differs()));
        assert!(misfilled(&run(0, 3)).is_some(), "a caster in another's cell");
    }
}
