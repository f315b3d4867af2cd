//! Adjacency of triangles across edges.

use super::measures::ring;

/// Index of no triangle.
pub const NONE: u32 = u32::MAX;

/// For each triangle its neighbours across the edges from corner 0, 1 and 2.
pub struct Adjacency {
    pub across: Vec<[u32; 3]>,
    /// Boundary edges: (triangle, corner where the edge starts).
    pub free: Vec<(u32, u8)>,
    /// Triangles at non-manifold edges (of more than two triangles), one per edge.
    pub crowded: Vec<u32>,
    /// Triangles at edges that both neighbours traverse in the same direction, one per edge.
    pub wound_against: Vec<u32>,
}

impl Adjacency {
    pub fn new(triangles: &[[u32; 3]]) -> Self {
        let mut edges: Vec<(u64, u32)> = Vec::with_capacity(3 * triangles.len());
        for (index, triangle) in triangles.iter().enumerate() {
            for (corner, (a, b)) in ring(triangle).enumerate() {
                let key = u64::from(a.min(b)) << 32 | u64::from(a.max(b));
                edges.push((key, 4 * index as u32 + corner as u32));
            }
        }
        edges.sort_unstable();
        let mut found = Self {
            across: vec![[NONE; 3]; triangles.len()],
            free: Vec::new(),
            crowded: Vec::new(),
            wound_against: Vec::new(),
        };
        let place = |half: u32| ((half / 4) as usize, (half % 4) as usize);
        let start = |half: u32| triangles[place(half).0][place(half).1];
        for group in edges.chunk_by(|a, b| a.0 == b.0) {
            match *group {
                [(_, one)] => found.free.push((one / 4, (one % 4) as u8)),
                [(_, one), (_, other)] if start(one) != start(other) => {
                    found.across[place(one).0][place(one).1] = other / 4;
                    found.across[place(other).0][place(other).1] = one / 4;
                }
                [(_, one), _] => found.wound_against.push(one / 4),
                _ => found.crowded.push(group[0].1 / 4),
            }
        }
        found
    }

    /// Tests whether every edge joins two triangles that traverse it in opposite directions.
    pub fn is_closed(&self) -> bool {
        self.free.is_empty() && self.crowded.is_empty() && self.wound_against.is_empty()
    }
}
