//! Removal of triangles without area and of duplicates.

use super::triangle_mesh::Mesh;
use nalgebra::Vector3;

/// A triangle whose smallest height is below this share of its longest edge is a sliver; model files refuse it.
const SLIVER: f64 = 1e-9;

/// Counts of removed triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Cleaning {
    /// Triangles without area.
    pub(crate) slivers: usize,
    /// Triangles that repeated another with the same winding.
    pub(crate) duplicates: usize,
    /// Triangles that lie back to back with another.
    pub(crate) back_to_back: usize,
    /// True if every triangle had a mirror image, which was removed: the mesh has two sides.
    pub(crate) two_sided: bool,
}

/// Removes slivers and duplicates; vertices stay.
pub(crate) fn clean(mesh: &mut Mesh) -> Cleaning {
    let mut cleaning = Cleaning::default();
    let before = mesh.triangles.len();
    let good: Vec<bool> = (0..before).map(|triangle| !is_sliver(mesh, triangle)).collect();
    keep(mesh, &good);
    cleaning.slivers = before - mesh.triangles.len();
    let (repeated, mirrored, second_sides) = twins(&mesh.triangles);
    cleaning.duplicates = repeated.iter().filter(|repeated| **repeated).count();
    let all_mirrored = !mirrored.is_empty() && mirrored.iter().all(|mirrored| *mirrored);
    if all_mirrored {
        cleaning.two_sided = true;
        keep(
            mesh,
            &second_sides.iter().zip(&repeated).map(|(second, again)| !second && !again).collect::<Vec<_>>(),
        );
    } else {
        cleaning.back_to_back = mirrored.iter().filter(|mirrored| **mirrored).count();
        keep(mesh, &repeated.iter().map(|again| !again).collect::<Vec<_>>());
    }
    cleaning
}

fn keep(mesh: &mut Mesh, good: &[bool]) {
    let mut index = 0;
    mesh.triangles.retain(|_| (good[index], index += 1).0);
    index = 0;
    mesh.look_of.retain(|_| (good[index], index += 1).0);
}

fn is_sliver(mesh: &Mesh, triangle: usize) -> bool {
    let [a, b, c] = mesh.triangles[triangle];
    let corners = mesh.corners(triangle);
    let edges = [corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]];
    let longest = edges.iter().map(Vector3::norm).fold(0.0, f64::max);
    // Twice the loader's bound, because both round.
    let share = (edges[0] / longest).cross(&(edges[1] / longest)).norm();
    a == b || b == c || c == a || longest == 0.0 || share.is_nan() || share <= 2.0 * SLIVER
}

/// Flags of triangles that repeat an earlier one, that have a mirror image, and that are the later of such a
/// pair.
fn twins(triangles: &[[u32; 3]]) -> (Vec<bool>, Vec<bool>, Vec<bool>) {
    let count = triangles.len();
    let (mut repeated, mut mirrored, mut second) =
        (vec![false; count], vec![false; count], vec![false; count]);
    let mut keyed: Vec<([u32; 3], u32)> = Vec::with_capacity(count);
    for (index, triangle) in triangles.iter().enumerate() {
        let mut key = *triangle;
        key.sort_unstable();
        keyed.push((key, index as u32));
    }
    keyed.sort_unstable();
    for group in keyed.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1) {
        let even = |index: u32| is_even(&triangles[index as usize], &group[0].0);
        let first = even(group[0].1);
        let first_of = |side: bool| group.iter().map(|entry| entry.1).find(|index| even(*index) == side);
        let both = first_of(!first).is_some();
        for &(_, index) in group {
            let own = even(index);
            repeated[index as usize] = first_of(own) != Some(index);
            mirrored[index as usize] = both;
            second[index as usize] = own != first;
        }
    }
    (repeated, mirrored, second)
}

/// Tests whether a triangle visits its corners in rising order, up to rotation.
fn is_even(triangle: &[u32; 3], sorted: &[u32; 3]) -> bool {
    let start = triangle.iter().position(|vertex| *vertex == sorted[0]).unwrap_or(0);
    triangle[(start + 1) % 3] == sorted[1]
}
