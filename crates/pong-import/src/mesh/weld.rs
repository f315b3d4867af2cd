//! Merging of vertices that coincide or lie within a tolerance.

use super::triangle_mesh::Mesh;
use nalgebra::Vector3;
use pong_model::weld::{PositionKey, WordMap, position_key};

/// Moves every vertex within `tolerance_m` of an earlier one onto it and returns how many moved.
pub(crate) fn weld(mesh: &mut Mesh, tolerance_m: f64) -> usize {
    let cell = |place: &Vector3<f64>| place.map(|x| (x / tolerance_m).floor() as i64);
    let mut cells: WordMap<[i64; 3], Vec<u32>> = WordMap::default();
    let mut moved = 0;
    let mut target: Vec<u32> = Vec::with_capacity(mesh.vertices.len());
    for (index, place) in mesh.vertices.iter().enumerate() {
        let home = cell(place);
        let near = (0..27)
            .filter_map(|k| cells.get(&[home.x + k % 3 - 1, home.y + k / 3 % 3 - 1, home.z + k / 9 - 1]));
        let close = |&&other: &&u32| (mesh.vertices[other as usize] - place).norm() <= tolerance_m;
        match near.flatten().filter(close).min() {
            Some(&earlier) => {
                moved += 1;
                target.push(earlier);
            }
            None => {
                cells.entry(home.into()).or_default().push(index as u32);
                target.push(index as u32);
            }
        }
    }
    mesh.triangles.iter_mut().flatten().for_each(|vertex| *vertex = target[*vertex as usize]);
    moved
}

/// Merges bit-equal vertices.
pub(crate) fn weld_equal(mesh: &mut Mesh) {
    let mut numbers: WordMap<PositionKey, u32> = WordMap::default();
    let first =
        |(index, place): (usize, &Vector3<f64>)| *numbers.entry(position_key(place)).or_insert(index as u32);
    let target: Vec<u32> = mesh.vertices.iter().enumerate().map(first).collect();
    mesh.triangles.iter_mut().flatten().for_each(|vertex| *vertex = target[*vertex as usize]);
}
