//! T-junctions: vertices within a boundary edge of another triangle. Splitting the triangle there closes the
//! crack.

use super::adjacency::Adjacency;
use super::measures::ring;
use super::triangle_mesh::Mesh;
use pong_model::t_junctions::{self, ON_EDGE};
use std::collections::BTreeMap;

/// Each round splits one edge of a triangle; all three edges and the parts may need it.
const ROUNDS: usize = 8;

/// Splits triangles at the vertices within their boundary edges and returns the number of splits.
pub(crate) fn mend(mesh: &mut Mesh) -> usize {
    let mut splits = 0;
    for _ in 0..ROUNDS {
        let found = find(mesh);
        if found.is_empty() {
            break;
        }
        let mut done = 0;
        for (triangle, (corner, within)) in found {
            done += within.len();
            split(mesh, triangle as usize, corner as usize, &within);
        }
        splits += done;
    }
    splits
}

type Junctions = BTreeMap<u32, (u8, Vec<u32>)>;

/// At most one boundary edge of each triangle, with the vertices within it, in order.
fn find(mesh: &Mesh) -> Junctions {
    let free = Adjacency::new(&mesh.triangles).free;
    let edges: Vec<[u32; 2]> = free
        .iter()
        .map(|&(triangle, corner)| {
            [0, 1].map(|k| mesh.triangles[triangle as usize][(corner as usize + k) % 3])
        })
        .collect();
    let mut found = Junctions::new();
    let all = t_junctions::find(&mesh.vertices, &edges, usize::MAX);
    for of_edge in all.chunk_by(|one, other| one.1 == other.1) {
        let edge = of_edge[0].1;
        let (triangle, corner) = free[edge];
        let others = of_edge.iter().map(|(vertex, _)| *vertex);
        let others = others.filter(|vertex| !mesh.triangles[triangle as usize].contains(vertex));
        let within = in_order(mesh, &edges[edge], others);
        if !within.is_empty() {
            found.entry(triangle).or_insert((corner, within));
        }
    }
    found
}

/// Vertices strictly between the ends of an edge, sorted from its start.
fn in_order(mesh: &Mesh, edge: &[u32; 2], vertices: impl Iterator<Item = u32>) -> Vec<u32> {
    let [a, b] = edge.map(|vertex| mesh.vertices[vertex as usize]);
    let share = |vertex: &u32| (mesh.vertices[*vertex as usize] - a).dot(&(b - a)) / (b - a).norm_squared();
    let inside = |share: f64| share > ON_EDGE && share < 1.0 - ON_EDGE;
    let mut within: Vec<(f64, u32)> = vertices.map(|vertex| (share(&vertex), vertex)).collect();
    within.retain(|(share, _)| inside(*share));
    within.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    within.into_iter().map(|(_, vertex)| vertex).collect()
}

/// Triangle fan from the opposite corner over the edge's parts; the winding stays.
fn split(mesh: &mut Mesh, triangle: usize, corner: usize, within: &[u32]) {
    let [a, b, tip] = [0, 1, 2].map(|k| mesh.triangles[triangle][(corner + k) % 3]);
    let mut chain = vec![a];
    chain.extend(within);
    chain.push(b);
    let fan: Vec<[u32; 3]> = ring(&chain).take(chain.len() - 1).map(|(from, to)| [from, to, tip]).collect();
    mesh.triangles[triangle] = fan[0];
    mesh.triangles.extend(&fan[1..]);
    mesh.look_of.extend(std::iter::repeat_n(mesh.look_of[triangle], fan.len() - 1));
}
