//! The triangle across each edge, where there is exactly one and it is wound the same way.
//!
//! Corners are the same when their coordinates are. Edges that one triangle has, or three, or two that are wound against each
//! other, have no triangle across: to a patch they are borders.

use crate::shared::predicate::Corners;

/// No triangle.
pub const NONE: u32 = u32::MAX;
/// Marks a place of a table that is not in use.
const EMPTY: u32 = u32::MAX;

/// By triangle and edge; edge k leads from corner k to the next.
pub struct Neighbours {
    of: Vec<[u32; 3]>,
}

fn mix(key: u64) -> u64 {
    let key = (key ^ key >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    key ^ key >> 29
}

/// Open addressing over keys that the caller compares.
struct Table {
    places: Vec<u32>,
    mask: usize,
}

impl Table {
    fn new(count: usize) -> Self {
        let length = (2 * count).next_power_of_two().max(2);
        Self { places: vec![EMPTY; length], mask: length - 1 }
    }
    /// The place of what `is` the one looked for, or the empty one where it belongs.
    #[inline]
    fn find(&mut self, hash: u64, mut is: impl FnMut(u32) -> bool) -> &mut u32 {
        let mut at = hash as usize & self.mask;
        while self.places[at] != EMPTY && !is(self.places[at]) {
            at = (at + 1) & self.mask;
        }
        &mut self.places[at]
    }
}

impl Neighbours {
    /// Those among the triangles that `casts` keeps.
    pub fn new(triangles: &[Corners], casts: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<u32> = (0..triangles.len()).filter(|&id| casts(id)).map(|id| id as u32).collect();
        // Corners by number. Adding zero makes one of both zeros.
        let mut points: Vec<[u32; 3]> = Vec::new();
        let mut table = Table::new(3 * kept.len());
        let mut corners: Vec<[u32; 3]> = vec![[0; 3]; kept.len()];
        for (numbers, &id) in corners.iter_mut().zip(&kept) {
            for (number, corner) in numbers.iter_mut().zip(&triangles[id as usize]) {
                let bits = corner.map(|x| (x + 0.0).to_bits());
                let hash = mix(u64::from(bits[0])
                    ^ u64::from(bits[1]) << 21
                    ^ u64::from(bits[2]) << 42
                    ^ u64::from(bits[2]) >> 22);
                let place = table.find(hash, |other| points[other as usize] == bits);
                if *place == EMPTY {
                    *place = points.len() as u32;
                    points.push(bits);
                }
                *number = *place;
            }
        }
        // Edges by direction: the half edge 3 i + k of the i-th triangle kept.
        let ends = |half: u32| {
            let (numbers, k) = (corners[half as usize / 3], half as usize % 3);
            [numbers[k], numbers[(k + 1) % 3]]
        };
        let hash = |[a, b]: [u32; 2]| mix(u64::from(a) << 32 | u64::from(b));
        let mut table = Table::new(3 * kept.len());
        let mut twice = vec![false; 3 * kept.len()];
        for half in 0..3 * kept.len() as u32 {
            let edge = ends(half);
            let place = table.find(hash(edge), |other| ends(other) == edge);
            if *place == EMPTY {
                *place = half;
            } else {
                twice[*place as usize] = true;
            }
        }
        let mut of = vec![[NONE; 3]; triangles.len()];
        for half in 0..3 * kept.len() as u32 {
            let [a, b] = ends(half);
            let mine = *table.find(hash([a, b]), |other| ends(other) == [a, b]);
            let across = *table.find(hash([b, a]), |other| ends(other) == [b, a]);
            if a != b && across != EMPTY && !twice[across as usize] && !twice[mine as usize] {
                of[kept[half as usize / 3] as usize][half as usize % 3] = kept[across as usize / 3];
            }
        }
        Self { of }
    }

    /// The triangle across edge `edge` of `triangle`.
    pub fn across(&self, triangle: u32, edge: usize) -> u32 {
        self.of[triangle as usize][edge]
    }
}
