//! Faces that rounding to 32 bits has left without width, or turned over: narrow triangles whose corners have
//! moved onto one line, or past it.
//!
//! The longest edge of such a face runs along all its others. So the face joins the neighbour across that
//! edge, which takes over the other edges: the surface stays closed and no vertex moves.

use super::polygon::{area_vector, edges, longest_edge, width};
use crate::weld::WordMap;
use pong_geometry::Vec3;
use std::collections::VecDeque;

/// Width relative to its longest edge below which a face has no width and no normal.
const SLIVER: f64 = 1e-9;

/// Faces without width, each with its width relative to its longest edge.
pub(super) fn without_width(vertices: &[Vec3], faces: &[Vec<u32>]) -> Vec<(usize, f64)> {
    let present = faces.iter().enumerate().filter(|(_, face)| !face.is_empty());
    let shares = present.map(|(index, face)| (index, narrowness(vertices, face)));
    shares.filter(|(_, share)| is_sliver(*share)).collect()
}

/// Width of a face relative to its longest edge.
fn narrowness(vertices: &[Vec3], face: &[u32]) -> f64 {
    let corners = corners(vertices, face);
    if area_vector(&corners).amax() > 0.0 { width(&corners) / longest_edge(&corners) } else { 0.0 }
}

fn is_sliver(share: f64) -> bool {
    share.is_nan() || share < SLIVER
}

/// Returns `true` if a face lies in a strip of this width.
pub(super) fn is_narrow(vertices: &[Vec3], face: &[u32], strip: f64) -> bool {
    width(&corners(vertices, face)) <= strip
}

/// Joins faces of a closed surface to their neighbours, and repeats for faces that become narrow. Joined
/// faces keep their indices, with an empty outline. Returns the faces that could not be joined, in increasing
/// order.
pub(super) fn join(vertices: &[Vec3], faces: &mut [Vec<u32>], narrow: &[usize]) -> Vec<usize> {
    let mut along: WordMap<(u32, u32), usize> = WordMap::default();
    for (index, face) in faces.iter().enumerate() {
        along.extend(edges(face).map(|edge| (edge, index)));
    }
    let mut open: VecDeque<usize> = narrow.iter().copied().collect();
    let mut left = Vec::new();
    while let Some(face) = open.pop_front() {
        if faces[face].is_empty() {
            continue;
        }
        match joined(vertices, faces, face, &mut along) {
            Some(neighbor) if is_sliver(narrowness(vertices, &faces[neighbor])) => open.push_back(neighbor),
            Some(_) => {}
            None => left.push(face),
        }
    }
    left.sort_unstable();
    left.dedup();
    left
}

/// Vertices that no face uses any more after faces were joined.
pub(super) fn lost(before: &[Vec<u32>], after: &[Vec<u32>]) -> Vec<u32> {
    if before.iter().zip(after).all(|(before, after)| before == after) {
        return Vec::new();
    }
    let mut kept: Vec<u32> = after.iter().flatten().copied().collect();
    kept.sort_unstable();
    let mut lost: Vec<u32> = before.iter().flatten().copied().collect();
    lost.retain(|vertex| kept.binary_search(vertex).is_err());
    lost.sort_unstable();
    lost.dedup();
    lost
}

/// Faces without degenerate parts left where vertices have merged: edges between a vertex and itself, faces
/// of fewer than three vertices, and pairs of faces back to back. Removed faces keep their indices, with an
/// empty outline. `None` if there is nothing to remove.
pub(super) fn collapsed(faces: &[Vec<u32>]) -> Option<Vec<Vec<u32>>> {
    let mut left: Vec<Vec<u32>> = faces.iter().map(|face| without_repeats(face)).collect();
    let mut by_outline: WordMap<Vec<u32>, usize> = WordMap::default();
    for index in 0..left.len() {
        let backwards = from_lowest(left[index].iter().rev().copied().collect());
        match by_outline.remove(&backwards) {
            Some(back) => [index, back].into_iter().for_each(|face| left[face].clear()),
            None if left[index].is_empty() => {}
            None => _ = by_outline.insert(from_lowest(left[index].clone()), index),
        }
    }
    (left != faces).then_some(left)
}

/// Outline without edges between a vertex and itself; empty if fewer than three vertices remain.
fn without_repeats(face: &[u32]) -> Vec<u32> {
    let mut left = face.to_vec();
    left.dedup();
    while left.len() > 1 && left.first() == left.last() {
        left.pop();
    }
    if left.len() < 3 { Vec::new() } else { left }
}

/// Same loop, starting at its lowest vertex.
fn from_lowest(mut outline: Vec<u32>) -> Vec<u32> {
    let lowest = (0..outline.len()).min_by_key(|&k| outline[k]).unwrap_or(0);
    outline.rotate_left(lowest);
    outline
}

fn corners(vertices: &[Vec3], face: &[u32]) -> Vec<Vec3> {
    face.iter().map(|&v| vertices[v as usize]).collect()
}

/// Merges a face into the neighbour across its longest edge, and returns that neighbour; `None` if no face
/// would remain.
fn joined(
    vertices: &[Vec3],
    faces: &mut [Vec<u32>],
    face: usize,
    along: &mut WordMap<(u32, u32), usize>,
) -> Option<usize> {
    let length = |(a, b): &(u32, u32)| (vertices[*b as usize] - vertices[*a as usize]).norm();
    let longest = edges(&faces[face]).max_by(|first, second| length(first).total_cmp(&length(second)));
    let (a, b) = longest?;
    let neighbor = along[&(b, a)];
    let outline = united(&faces[face], &faces[neighbor], (a, b))?;
    along.extend(edges(&outline).map(|edge| (edge, neighbor)));
    faces[neighbor] = outline;
    faces[face].clear();
    Some(neighbor)
}

/// Outline of two faces with a common edge, which runs from `a` to `b` along the first one; `None` if it is
/// not a single loop.
fn united(first: &[u32], second: &[u32], (a, b): (u32, u32)) -> Option<Vec<u32>> {
    let mut outline = Vec::with_capacity(first.len() + second.len());
    for (face, start) in [(first, b), (second, a)] {
        let at = face.iter().position(|&v| v == start)?;
        outline.extend(face.iter().cycle().skip(at).take(face.len() - 1));
    }
    // Along further common edges the outline runs forth and back; these are removed.
    while let Some(tip) = (0..outline.len()).find(|&k| {
        let count = outline.len();
        count > 2 && outline[(k + count - 1) % count] == outline[(k + 1) % count]
    }) {
        outline.rotate_left(tip);
        outline.drain(..2);
    }
    let mut sorted = outline.clone();
    sorted.sort_unstable();
    let once = sorted.windows(2).all(|pair| pair[0] != pair[1]);
    (once && outline.len() >= 3).then_some(outline)
}
