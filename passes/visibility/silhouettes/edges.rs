//! The edges of all casters, each once: two triangles that share both ends by position share the edge.

use crate::shared::predicate::Corners;

/// Marks a place of the table that is not in use.
const EMPTY: u32 = u32::MAX;

/// Edges by number, and those of each triangle.
pub struct Edges {
    /// Ends of each edge, the lesser first.
    pub ends: Vec<[[f32; 3]; 2]>,
    /// By triangle: of the edge from corner k to the next, twice its number, plus one where the triangle walks it from its
    /// second end to its first. Undefined for a triangle that is not kept.
    pub of: Vec<[u32; 3]>,
}

fn mix(ends: &[[f32; 3]; 2]) -> usize {
    let words = ends
        .as_flattened()
        .iter()
        .fold(0u64, |key, x| (key.rotate_left(23) ^ u64::from(x.to_bits())).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    (words ^ words >> 29) as usize
}

impl Edges {
    /// Those of the triangles that `casts` keeps; their coordinates are finite.
    pub fn new(triangles: &[Corners], casts: impl Fn(usize) -> bool) -> Self {
        let kept: Vec<usize> = (0..triangles.len()).filter(|id| casts(*id)).collect();
        let mut of = vec![[0; 3]; triangles.len()];
        let mut ends: Vec<[[f32; 3]; 2]> = Vec::with_capacity(2 * kept.len());
        let mut places = vec![EMPTY; (6 * kept.len()).next_power_of_two().max(16)];
        let last = places.len() - 1;
        for id in kept {
            // Adding zero makes one of both zeros.
            let corners = triangles[id].map(|corner| corner.map(|x| x + 0.0));
            for k in 0..3 {
                let (from, to) = (corners[k], corners[(k + 1) % 3]);
                let turned = to < from;
                let edge = if turned { [to, from] } else { [from, to] };
                let mut place = mix(&edge) & last;
                let number = loop {
                    match places[place] {
                        EMPTY => {
                            places[place] = ends.len() as u32;
                            ends.push(edge);
                            break places[place];
                        }
                        number if ends[number as usize] == edge => break number,
                        _ => place = (place + 1) & last,
                    }
                };
                of[id][k] = 2 * number + u32::from(turned);
            }
        }
        Self { ends, of }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shared::hard_scenes::grid;

    #[test]
    fn a_shared_edge_has_one_number_and_a_direction_for_each_side() {
        let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let edges = Edges::new(&[[a, b, c], [d, c, b], [[-0.0; 3], b, d], [a, b, c]], |id| id < 3);
        assert_eq!(edges.ends.len(), 6);
        assert_eq!(edges.of[0][1] ^ 1, edges.of[1][1], "b to c, and c to b");
        assert_eq!(edges.of[0][0], edges.of[2][0], "zeros are alike");
        assert_eq!(edges.of[1][2], edges.of[2][1], "b to d, walked alike");
        assert_eq!(edges.of[3], [0; 3]);
    }

    #[test]
    fn a_grid_has_as_many_edges_as_it_should() {
        let side = 60;
        let triangles = grid(side);
        let edges = Edges::new(&triangles, |_| true);
        assert_eq!(edges.ends.len(), 3 * side * side + 2 * side);
        let mut walks = vec![0; edges.ends.len()];
        edges.of.iter().flatten().for_each(|edge| walks[*edge as usize / 2] += if edge % 2 == 0 { 1 } else { -1 });
        assert_eq!(walks.iter().filter(|walks| **walks == 0).count(), 3 * side * side - 2 * side);
    }
}
