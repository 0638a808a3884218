//! The triangle across each edge, where there is exactly one and it is wound the same way.
//!
//! Corners are the same when their coordinates are. Edges that one triangle has, or three, or two that are wound against each
//! other, have no triangle across: they are borders.

use crate::shared::predicate::Corners;

/// No triangle.
pub const NONE: u32 = u32::MAX;
/// Marks a place of a table that is not in use.
const EMPTY: u32 = u32::MAX;

/// By triangle and edge; edge k leads from corner k to the next.
pub struct Neighbours {
    of: Vec<[u32; 3]>,
}

fn mix(bits: [u32; 3]) -> usize {
    let key = u64::from(bits[0]) ^ u64::from(bits[1]) << 21 ^ u64::from(bits[2]) << 42 ^ u64::from(bits[2]) >> 22;
    let key = (key ^ key >> 32).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (key ^ key >> 29) as usize
}

/// Points by number, in the order of their first use; open addressing that grows, so that it stays as small as the points are few.
struct Points {
    at: Vec<[u32; 3]>,
    places: Vec<u32>,
}

impl Points {
    fn new() -> Self {
        Self { at: Vec::new(), places: vec![EMPTY; 1024] }
    }

    /// The number of `point`. Adding zero makes one of both zeros.
    fn number(&mut self, point: [f32; 3]) -> u32 {
        let bits = point.map(|x| (x + 0.0).to_bits());
        let mask = self.places.len() - 1;
        let mut place = mix(bits) & mask;
        while self.places[place] != EMPTY {
            if self.at[self.places[place] as usize] == bits {
                return self.places[place];
            }
            place = (place + 1) & mask;
        }
        let number = self.at.len() as u32;
        self.places[place] = number;
        self.at.push(bits);
        if 2 * self.at.len() > self.places.len() {
            self.grow();
        }
        number
    }

    fn grow(&mut self) {
        let mask = 2 * self.places.len() - 1;
        self.places = vec![EMPTY; mask + 1];
        for (number, bits) in (0u32..).zip(&self.at) {
            let mut place = mix(*bits) & mask;
            while self.places[place] != EMPTY {
                place = (place + 1) & mask;
            }
            self.places[place] = number;
        }
    }
}

impl Neighbours {
    /// Those among the triangles that `casts` keeps.
    pub fn new(triangles: &[Corners], casts: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<u32> = (0..triangles.len()).filter(|&id| casts(id)).map(|id| id as u32).collect();
        let mut points = Points::new();
        let corners: Vec<[u32; 3]> =
            kept.iter().map(|&id| triangles[id as usize].map(|corner| points.number(corner))).collect();
        // Half edges by their smaller end: half edge 3 i + k is edge k of the i-th triangle kept.
        let ends = |half: usize| {
            let (numbers, k) = (corners[half / 3], half % 3);
            [numbers[k], numbers[(k + 1) % 3]]
        };
        let mut ending = vec![0u32; points.at.len() + 1];
        for numbers in &corners {
            for k in 0..3 {
                ending[numbers[k].min(numbers[(k + 1) % 3]) as usize + 1] += 1;
            }
        }
        for at in 1..ending.len() {
            ending[at] += ending[at - 1];
        }
        // The larger end above the half edge: sorted, those of one edge lie together.
        let mut halves = vec![0u64; 3 * kept.len()];
        let mut next = ending.clone();
        for half in 0..3 * kept.len() {
            let [a, b] = ends(half);
            let place = &mut next[a.min(b) as usize];
            halves[*place as usize] = u64::from(a.max(b)) << 32 | half as u64;
            *place += 1;
        }
        let mut of = vec![[NONE; 3]; triangles.len()];
        for around in ending.windows(2) {
            let around = &mut halves[around[0] as usize..around[1] as usize];
            around.sort_unstable();
            for edge in around.chunk_by(|a, b| a >> 32 == b >> 32) {
                let &[a, b] = edge else { continue };
                let [a, b] = [a, b].map(|half| half as u32 as usize);
                // Walked both ways, and no point.
                if ends(a)[0] == ends(b)[1] && ends(a)[0] != ends(a)[1] {
                    of[kept[a / 3] as usize][a % 3] = kept[b / 3];
                    of[kept[b / 3] as usize][b % 3] = kept[a / 3];
                }
            }
        }
        Self { of }
    }

    /// All of them, by triangle and edge.
    pub fn into_rows(self) -> Vec<[u32; 3]> {
        self.of
    }

    /// The triangle across edge `edge` of `triangle`.
    pub fn across(&self, triangle: u32, edge: usize) -> u32 {
        self.of[triangle as usize][edge]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::hard_scenes::grid;

    #[test]
    fn two_triangles_wound_alike_are_neighbours_and_others_are_not() {
        let p = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [-0.0, 0.0, 1.0], [2.0, 2.0, 0.0]];
        let of = |corners: [usize; 3]| corners.map(|at| p[at]);
        // A quad; its first triangle's edge from 0 to 1 has two more, from 2 to 0 one wound the wrong way; one folded up,
        // which blocks nothing and may be its own neighbour.
        let triangles = [of([0, 1, 2]), of([3, 2, 1]), of([1, 0, 4]), of([1, 0, 5]), of([2, 0, 5]), of([3, 3, 5])];
        let found = Neighbours::new(&triangles, |_| true);
        assert_eq!(found.of, [[NONE, 1, NONE], [NONE, 0, NONE], [NONE; 3], [NONE; 3], [NONE; 3], [NONE, 5, 5]]);
        // Without the third and the fifth, the edges have one triangle on either side.
        let found = Neighbours::new(&triangles, |id| id != 2 && id != 4);
        assert_eq!(found.of, [[3, 1, NONE], [NONE, 0, NONE], [NONE; 3], [0, NONE, NONE], [NONE; 3], [NONE, 5, 5]]);
    }

    #[test]
    fn a_grid_larger_than_the_first_table_is_joined_throughout() {
        let side = 60;
        let triangles = grid(side);
        let found = Neighbours::new(&triangles, |_| true);
        assert_eq!(found.of.iter().flatten().filter(|across| **across == NONE).count(), 4 * side);
        for (id, across) in (0u32..).zip(&found.of) {
            for &other in across.iter().filter(|across| **across != NONE) {
                assert!((0..3).any(|edge| found.across(other, edge) == id));
            }
        }
    }
}
