//! One convex piece: from authored vertices and faces to a checked shape with merged planar faces.
//!
//! Degenerate cases, each with its own rule: vertices that are not finite; too few faces; faces of too few,
//! unknown or repeated vertices; edges without length; slivers; faces that are not planar or not convex; open
//! or inside-out surfaces; solids without thickness; solids that are not convex. All tolerances are relative to
//! the diameter, so that what `f32` rounding makes of a good shape passes at every size.

mod checks;
mod merge;
mod places;
mod polygon;
mod problem;
mod solid;
#[cfg(test)]
mod tests;

pub(crate) use polygon::{area, overlap_area};
pub(crate) use problem::Problem;
pub(crate) use solid::{Hull, HullFace, PLANE_TOLERANCE};

use crate::weld::Welder;
use places::Places;
use pong_geometry::Vec3;

/// Checks a polyhedron and merges its coplanar neighbouring faces, or lists all that is wrong at the first
/// stage that finds anything.
pub(crate) fn check(vertices: &[Vec3], faces: &[&[u32]], active: &[bool]) -> Result<Hull, Vec<Problem>> {
    checks::authored(vertices, faces)?;
    let (vertices, faces, remarks) = welded(vertices, faces);
    let tree = Places::new(&vertices);
    let diameter = places::diameter(&vertices, &tree);
    checks::edges_and_widths(&vertices, &faces)?;
    checks::closed_surface(&vertices, &faces)?;
    checks::volume(&vertices, &faces, diameter)?;
    checks::planar(&vertices, &faces, diameter)?;
    let faces = convex_faces((&vertices, &tree), &faces, active, diameter)?;
    Ok(without_unused(Hull { vertices, faces, diameter, remarks }))
}

/// The faces of a closed surface, merged as far as the solid stays convex; or what keeps it from being so.
fn convex_faces(
    (vertices, tree): (&[Vec3], &Places),
    faces: &[Vec<u32>],
    active: &[bool],
    diameter: f64,
) -> Result<Vec<HullFace>, Vec<Problem>> {
    let tolerance = PLANE_TOLERANCE * diameter;
    let authored = merge::Faces::new(vertices, faces, active, diameter);
    let last = merge::LEVELS + 1;
    let mut suspect = 0;
    for attempt in 0..last {
        let mut merged = faces_of_attempt(attempt, vertices, &authored, tolerance);
        let is_bad = |face: &mut HullFace| match attempt {
            0 => checks::face(vertices, face, tree, diameter).is_some(),
            // What supports the solid has nothing in front.
            _ => {
                !merge::support(vertices, face, tree, tolerance)
                    || checks::dented(vertices, face, diameter).is_some()
            }
        };
        match first_from(&mut merged, suspect, is_bad) {
            // Likely this is where the next attempt fails too: it begins there, and need not look at all faces.
            Some(authored) => suspect = authored,
            None if checks::thickness(&merged, tree, diameter).is_ok() => return Ok(merged),
            None => {}
        }
    }
    // What is wrong in the last attempt is told: its faces are those that were authored.
    let mut merged = faces_of_attempt(last, vertices, &authored, tolerance);
    for face in &mut merged {
        merge::support(vertices, face, tree, tolerance);
    }
    checks::convex(vertices, &merged, tree, diameter)?;
    Ok(merged)
}

/// The first attempt merges all that lies within the tolerance and leaves the rest as it is, which suits nearly every solid.
/// Those after it straighten edges that rounding has bent, and merge less and less; their planes are tilted face by face
/// ([`merge::support`]).
fn faces_of_attempt(
    attempt: usize,
    vertices: &[Vec3],
    faces: &merge::Faces<'_>,
    tolerance: f64,
) -> Vec<HullFace> {
    let mut merged = faces.merged(attempt.saturating_sub(1));
    if attempt > 0 {
        merge::straighten(vertices, &mut merged, tolerance);
    }
    merged
}

/// Looks at the faces once round, from an authored one on: which authored face the first bad one is.
fn first_from(
    faces: &mut [HullFace],
    authored: u32,
    mut is_bad: impl FnMut(&mut HullFace) -> bool,
) -> Option<u32> {
    let first = faces.partition_point(|face| face.authored < authored);
    let (before, after) = faces.split_at_mut(first);
    after.iter_mut().chain(before).find_map(|face| is_bad(face).then_some(face.authored))
}

/// Bit-equal positions become one vertex.
fn welded(vertices: &[Vec3], faces: &[&[u32]]) -> (Vec<Vec3>, Vec<Vec<u32>>, Vec<String>) {
    let mut welder = Welder::default();
    let mut distinct = Vec::new();
    let mut used = vec![false; vertices.len()];
    let faces = faces
        .iter()
        .map(|face| {
            face.iter()
                .map(|&v| {
                    used[v as usize] = true;
                    welder.weld(vertices[v as usize], &mut distinct)
                })
                .collect()
        })
        .collect();
    let idle = used.iter().filter(|&&used| !used).count();
    let remarks = if idle > 0 { vec![format!("{idle} vertices belong to no face")] } else { Vec::new() };
    (distinct, faces, remarks)
}

/// Drops the vertices that lie within merged faces.
fn without_unused(hull: Hull) -> Hull {
    let mut number = vec![u32::MAX; hull.vertices.len()];
    let mut vertices = Vec::new();
    let mut faces = hull.faces;
    for vertex in faces.iter_mut().flat_map(|face| &mut face.outline) {
        let slot = &mut number[*vertex as usize];
        if *slot == u32::MAX {
            *slot = vertices.len() as u32;
            vertices.push(hull.vertices[*vertex as usize]);
        }
        *vertex = *slot;
    }
    Hull { vertices, faces, ..hull }
}
