//! T-junctions: vertices within a free edge of another triangle. The triangle is split there, which closes the crack.

use super::{Adjacency, Mesh, ring};
use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use std::collections::BTreeMap;

/// A vertex nearer to an edge than this share of its length lies on it, as model files judge it.
const ON_EDGE: f64 = 1e-9;
/// Every round splits one edge of a triangle; three edges may need it, and the pieces again.
const ROUNDS: usize = 8;

/// Splits triangles at the vertices that lie within their free edges; tells how many splits.
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

/// For each triangle at most one free edge and the vertices within it, in order.
fn find(mesh: &Mesh) -> Junctions {
    let free = Adjacency::new(&mesh.triangles).free;
    let mut ends: Vec<u32> =
        free.iter().map(|&(triangle, corner)| mesh.triangles[triangle as usize][corner as usize]).collect();
    ends.extend(
        free.iter().map(|&(triangle, corner)| mesh.triangles[triangle as usize][(corner as usize + 1) % 3]),
    );
    ends.sort_unstable();
    ends.dedup();
    let mut found = Junctions::new();
    if ends.len() < 3 {
        return found;
    }
    let place = |vertex: u32| mesh.vertices[vertex as usize];
    let boxes: Vec<Aabb> = ends.iter().map(|&vertex| box_of([place(vertex); 2], 0.0)).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    for &(triangle, corner) in &free {
        let [a, b] = [0, 1].map(|k| mesh.triangles[triangle as usize][(corner as usize + k) % 3]);
        let length = (place(b) - place(a)).norm();
        let along = (place(b) - place(a)) / length;
        let mut within: Vec<(f64, u32)> = Vec::new();
        for leaf in tree.intersect_aabb(&box_of([place(a), place(b)], ON_EDGE * length)) {
            let vertex = ends[leaf as usize];
            let arm = place(vertex) - place(a);
            let t = arm.dot(&along);
            let inside = t > ON_EDGE * length && t < length * (1.0 - ON_EDGE);
            if inside && vertex != a && vertex != b && (arm - along * t).norm() <= ON_EDGE * length {
                within.push((t, vertex));
            }
        }
        within.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        within.retain(|(_, vertex)| !mesh.triangles[triangle as usize].contains(vertex));
        if !within.is_empty() {
            let within = within.into_iter().map(|(_, vertex)| vertex).collect();
            found.entry(triangle).or_insert((corner, within));
        }
    }
    found
}

fn box_of([a, b]: [Vector3<f64>; 2], margin: f64) -> Aabb {
    let vector = |v: Vector3<f64>| parry3d_f64::math::Vector::new(v.x, v.y, v.z);
    let margin = Vector3::repeat(margin);
    Aabb::new(vector(a.inf(&b) - margin), vector(a.sup(&b) + margin))
}

/// A fan from the opposite corner over the edge's new parts; the winding stays.
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
