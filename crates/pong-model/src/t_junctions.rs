//! T-junctions: vertices inside a free edge of another triangle, where the surface has a crack.
//!
//! Only end points of free edges can be such vertices. A k-d tree holds them, and every free edge searches
//! only the boxes through which it passes.

use pong_geometry::Vec3;

/// Distance, relative to the edge's length, within which a vertex lies on an edge.
pub const ON_EDGE: f64 = 1e-9;
const LEAF: usize = 8;

struct Node {
    low: Vec3,
    high: Vec3,
    start: usize,
    end: usize,
    /// Index of the second child; the first follows its parent. 0 for a leaf.
    second: usize,
}

struct KdTree<'v> {
    vertices: &'v [Vec3],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// Pairs of a vertex and the index of the free edge that contains it, by edge; the search ends when it has
/// more than `enough` pairs.
pub fn find(vertices: &[Vec3], free_edges: &[[u32; 2]], enough: usize) -> Vec<(u32, usize)> {
    let mut ends: Vec<u32> = free_edges.iter().flatten().copied().collect();
    ends.sort_unstable();
    ends.dedup();
    if ends.is_empty() {
        return Vec::new();
    }
    let tree = KdTree::new(vertices, ends);
    let mut found = Vec::new();
    for (index, edge) in free_edges.iter().enumerate() {
        tree.vertices_within(edge, |vertex| found.push((vertex, index)));
        if found.len() > enough {
            break;
        }
    }
    found
}

impl<'v> KdTree<'v> {
    fn new(vertices: &'v [Vec3], order: Vec<u32>) -> Self {
        let mut tree = Self { vertices, nodes: Vec::new(), order };
        tree.split(0, tree.order.len());
        tree
    }

    fn split(&mut self, start: usize, end: usize) {
        let place = |&v: &u32| self.vertices[v as usize];
        let members = &self.order[start..end];
        let first = place(&members[0]);
        let low = members.iter().fold(first, |low, v| low.inf(&place(v)));
        let high = members.iter().fold(first, |high, v| high.sup(&place(v)));
        let node = self.nodes.len();
        self.nodes.push(Node { low, high, start, end, second: 0 });
        if end - start <= LEAF {
            return;
        }
        let axis = (high - low).imax();
        let middle = (start + end) / 2;
        let vertices = self.vertices;
        let by_axis = |a: &u32, b: &u32| {
            vertices[*a as usize][axis].total_cmp(&vertices[*b as usize][axis]).then(a.cmp(b))
        };
        self.order[start..end].select_nth_unstable_by(middle - start, by_axis);
        self.split(start, middle);
        self.nodes[node].second = self.nodes.len();
        self.split(middle, end);
    }

    fn vertices_within(&self, edge: &[u32; 2], mut found: impl FnMut(u32)) {
        let [a, b] = edge.map(|v| self.vertices[v as usize]);
        let length = (b - a).norm();
        let along = (b - a) / length;
        let near = ON_EDGE * length;
        let mut open = vec![0];
        while let Some(index) = open.pop() {
            let node = &self.nodes[index];
            if !passes(&a, &along, length, node, near) {
                continue;
            }
            if node.second != 0 {
                open.extend([index + 1, node.second]);
                continue;
            }
            for &vertex in &self.order[node.start..node.end] {
                let arm = self.vertices[vertex as usize] - a;
                let t = arm.dot(&along);
                let within = t > 0.0 && t < length && (arm - along * t).norm() <= near;
                if within && !edge.contains(&vertex) {
                    found(vertex);
                }
            }
        }
    }
}

/// Returns `true` if a segment passes through a box enlarged by `near` on all sides.
fn passes(a: &Vec3, along: &Vec3, length: f64, node: &Node, near: f64) -> bool {
    let (mut enter, mut leave) = (-near, length + near);
    for axis in 0..3 {
        let (low, high) = (node.low[axis] - near - a[axis], node.high[axis] + near - a[axis]);
        if along[axis] == 0.0 {
            if low > 0.0 || high < 0.0 {
                return false;
            }
            continue;
        }
        let (t0, t1) = (low / along[axis], high / along[axis]);
        enter = enter.max(t0.min(t1));
        leave = leave.min(t0.max(t1));
    }
    enter <= leave
}
