//! Connected parts of a mesh: triangles joined by edges of exactly two triangles.

use super::adjacency::{Adjacency, NONE};
use super::triangle_mesh::Mesh;

/// Parts as separate meshes, in the order of their first triangles.
pub fn parts(mesh: &Mesh) -> Vec<Mesh> {
    let adjacency = Adjacency::new(&mesh.triangles);
    let mut part_of = vec![NONE; mesh.triangles.len()];
    let mut lists: Vec<Vec<u32>> = Vec::new();
    for first in 0..mesh.triangles.len() {
        if part_of[first] != NONE {
            continue;
        }
        let part = lists.len() as u32;
        part_of[first] = part;
        let mut list = vec![first as u32];
        let mut next = 0;
        while next < list.len() {
            for &other in &adjacency.across[list[next] as usize] {
                if other != NONE && part_of[other as usize] == NONE {
                    part_of[other as usize] = part;
                    list.push(other);
                }
            }
            next += 1;
        }
        list.sort_unstable();
        lists.push(list);
    }
    if lists.len() == 1 {
        return vec![mesh.clone().compact()];
    }
    lists.iter().map(|list| mesh.part(list)).collect()
}
