//! Convex piece: from authored vertices and faces to a checked shape with merged planar faces.
//!
//! Each degenerate case has its own rule: non-finite vertices; too few faces; faces of too few, unknown or
//! repeated vertices; edges without length; slivers; non-planar or non-convex faces; open or inside-out
//! surfaces; solids without thickness; non-convex solids. All tolerances are relative to the diameter, so a
//! good shape rounded to `f32` passes at every size. Parts that rounding has made degenerate or turned over
//! are dropped or joined to their neighbours ([`slivers`]); faces too narrow to have a normal get a plane
//! that supports the solid ([`support`]).

mod checks;
mod merge;
mod places;
mod polygon;
mod problem;
mod slivers;
mod solid;
mod support;
#[cfg(test)]
mod tests;

pub(crate) use places::{Places, diameter};
pub(crate) use polygon::{area, convex_outline, overlap_area};
pub(crate) use problem::Problem;
pub(crate) use solid::{Hull, HullFace, PLANE_TOLERANCE};

use crate::weld::Welder;
use merge::Merged;
use pong_geometry::Vec3;
use std::borrow::Cow;

/// Checks a polyhedron and merges its coplanar neighbouring faces, or returns all problems of the first stage
/// that finds any.
pub(crate) fn check(vertices: &[Vec3], faces: &[&[u32]], active: &[bool]) -> Result<Hull, Vec<Problem>> {
    checks::authored(vertices, faces)?;
    let (vertices, faces, remarks) = welded(vertices, faces);
    let as_written = checks::edges(&vertices, &faces).and_then(|()| of_surface(&vertices, &faces, active));
    let hull = as_written.or_else(|problems| match slivers::collapsed(&faces) {
        // If rounding has merged vertices, the solid may be valid without the edges and faces between them.
        Some(faces) => of_surface(&vertices, &faces, active).map_err(|_| problems),
        None => Err(problems),
    })?;
    Ok(Hull { remarks: [remarks, hull.remarks].concat(), ..hull })
}

/// Builds the solid from faces whose edges all have a length; faces without an outline are ignored.
fn of_surface(vertices: &[Vec3], authored: &[Vec<u32>], active: &[bool]) -> Result<Hull, Vec<Problem>> {
    let tree = Places::new(vertices);
    let diameter = diameter(vertices, &tree);
    checks::closed_surface(vertices, authored)?;
    let mut faces = Cow::Borrowed(authored);
    join_slivers(vertices, &mut faces)?;
    checks::volume(vertices, &faces, diameter)?;
    checks::planar(vertices, &faces, diameter)?;
    let solid = Solid { vertices, tree: &tree, diameter, active };
    let convex = solid.convex_faces(&faces).or_else(|problems| {
        if solid.join_turned_over(&mut faces) {
            solid.convex_faces(&faces).map_err(|_| problems)
        } else {
            Err(problems)
        }
    })?;
    checks::none_deep(vertices, &slivers::lost(authored, &faces), &convex, diameter)?;
    let joined = faces.iter().filter(|face| face.is_empty()).count();
    let remark = || format!("faces without width, which have joined their neighbours: {joined}");
    let remarks = (joined > 0).then(remark).into_iter().collect();
    Ok(without_unused(Hull { vertices: vertices.to_vec(), faces: convex, diameter, remarks }))
}

/// Joins faces without width to their neighbours, if enough faces remain for a solid.
fn join_slivers(vertices: &[Vec3], faces: &mut Cow<'_, [Vec<u32>]>) -> Result<(), Vec<Problem>> {
    let slivers = slivers::without_width(vertices, faces);
    if slivers.is_empty() {
        return Ok(());
    }
    let numbers: Vec<usize> = slivers.iter().map(|(face, _)| *face).collect();
    let present = faces.iter().filter(|face| !face.is_empty()).count();
    let left =
        if present < numbers.len() + 4 { numbers } else { slivers::join(vertices, faces.to_mut(), &numbers) };
    let refused = slivers.iter().filter(|(face, _)| left.binary_search(face).is_ok());
    let problems: Vec<Problem> = refused.map(|(face, share)| checks::sliver(*face, *share)).collect();
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

/// Position of the planes that bound a face sideways.
#[derive(Clone, Copy, PartialEq)]
enum Walls {
    /// Along its edges.
    Edges,
    /// Along the sides of its outline's convex hull, if edges are too short to define directions.
    Sides,
}

/// Closed surface to be made convex.
struct Solid<'a> {
    vertices: &'a [Vec3],
    tree: &'a Places,
    diameter: f64,
    active: &'a [bool],
}

impl Solid<'_> {
    /// Faces merged as far as the solid stays convex, or the problems that prevent it. [`Walls::Sides`] is
    /// the last resort, because its planes differ from the edges that push.
    fn convex_faces(&self, faces: &[Vec<u32>]) -> Result<Vec<HullFace>, Vec<Problem>> {
        let Self { vertices, tree, diameter, active } = *self;
        let tolerance = PLANE_TOLERANCE * diameter;
        let authored = merge::Faces::new(vertices, faces, active, diameter);
        let last = merge::LEVELS + 1;
        let mut suspect = 0;
        let attempts = (0..=last).map(|attempt| (attempt, Walls::Edges));
        for (attempt, walls) in attempts.chain((1..=last).map(|attempt| (attempt, Walls::Sides))) {
            let mut merged = faces_of_attempt(attempt, vertices, &authored, tolerance);
            let is_bad = |merged: &mut Merged| match attempt {
                0 => checks::face(vertices, &merged.face, tree, diameter).is_some(),
                // A supporting plane has nothing in front.
                _ => {
                    !merge::support(vertices, merged, tree, tolerance)
                        || !self.has_walls(&mut merged.face, walls)
                }
            };
            match first_from(&mut merged, suspect, is_bad) {
                // The next attempt will probably fail at the same face: it starts there, and need not test
                // all faces.
                Some(authored) => suspect = authored,
                None => {
                    let faces = faces_alone(merged);
                    if checks::thickness(&faces, tree, diameter).is_ok() {
                        return Ok(faces);
                    }
                }
            }
        }
        // Reports the problems of the last attempt, whose faces are the authored ones.
        let mut merged = faces_of_attempt(last, vertices, &authored, tolerance);
        for merged in &mut merged {
            merge::support(vertices, merged, tree, tolerance);
            self.has_walls(&mut merged.face, Walls::Sides);
        }
        checks::convex(vertices, &faces_alone(merged), tree, diameter)?;
        // A face that another face has joined may have a vertex off its plane.
        Err(checks::planar(vertices, faces, diameter).err().unwrap_or_else(|| vec![checks::too_few_faces()]))
    }

    /// Returns `true` if no corner of a face is beyond one of its lateral planes.
    fn has_walls(&self, face: &mut HullFace, walls: Walls) -> bool {
        if checks::dented(self.vertices, face, self.diameter).is_none() {
            return true;
        }
        if walls == Walls::Edges {
            return false;
        }
        let corners: Vec<Vec3> = face.outline.iter().map(|&v| self.vertices[v as usize]).collect();
        let sides = polygon::hull_sides(&corners, &face.normal, PLANE_TOLERANCE * self.diameter);
        let Some(sides) = sides else { return false };
        face.walls = sides.into_iter().map(|side| side.map(|corner| face.outline[corner])).collect();
        true
    }

    /// Joins faces turned over by rounding to their neighbours, repeatedly. Returns `true` if there were any.
    fn join_turned_over(&self, faces: &mut Cow<'_, [Vec<u32>]>) -> bool {
        let mut any = false;
        loop {
            let over = self.turned_over(faces);
            slivers::join(self.vertices, faces.to_mut(), &over);
            if over.iter().all(|&face| !faces[face].is_empty()) {
                return any;
            }
            any = true;
        }
    }

    /// Narrow faces that no supporting plane shows from outside: rounding has turned them over.
    fn turned_over(&self, faces: &[Vec<u32>]) -> Vec<usize> {
        let authored = merge::Faces::new(self.vertices, faces, self.active, self.diameter);
        let is_over = |merged: &mut Merged| {
            slivers::is_narrow(self.vertices, &merged.face.outline, merge::SURE_WIDTH * self.diameter)
                && !(merge::support(self.vertices, merged, self.tree, PLANE_TOLERANCE * self.diameter)
                    && self.has_walls(&mut merged.face, Walls::Sides))
        };
        let mut alone = authored.merged(merge::LEVELS);
        alone
            .iter_mut()
            .filter_map(|merged| is_over(merged).then_some(merged.face.authored as usize))
            .collect()
    }
}

fn faces_alone(merged: Vec<Merged>) -> Vec<HullFace> {
    merged.into_iter().map(|merged| merged.face).collect()
}

/// Faces for one attempt. The first attempt merges everything within the tolerance and leaves the rest
/// unchanged, which suits nearly every solid. Later ones straighten edges bent by rounding and merge less and
/// less; their planes are tilted face by face ([`merge::support`]).
fn faces_of_attempt(
    attempt: usize,
    vertices: &[Vec3],
    faces: &merge::Faces<'_>,
    tolerance: f64,
) -> Vec<Merged> {
    let mut merged = faces.merged(attempt.saturating_sub(1));
    if attempt > 0 {
        merge::straighten(vertices, &mut merged, tolerance);
    }
    merged
}

/// Tests all faces cyclically, starting at an authored face, and returns the authored index of the first bad
/// one.
fn first_from(
    faces: &mut [Merged],
    authored: u32,
    mut is_bad: impl FnMut(&mut Merged) -> bool,
) -> Option<u32> {
    let first = faces.partition_point(|merged| merged.face.authored < authored);
    let (before, after) = faces.split_at_mut(first);
    after.iter_mut().chain(before).find_map(|merged| is_bad(merged).then_some(merged.face.authored))
}

/// Merges bit-equal positions into one vertex.
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

/// Drops the vertices that lie inside merged faces.
fn without_unused(hull: Hull) -> Hull {
    let mut number = vec![u32::MAX; hull.vertices.len()];
    let mut vertices = Vec::new();
    let mut faces = hull.faces;
    for face in &mut faces {
        for vertex in &mut face.outline {
            let slot = &mut number[*vertex as usize];
            if *slot == u32::MAX {
                *slot = vertices.len() as u32;
                vertices.push(hull.vertices[*vertex as usize]);
            }
            *vertex = *slot;
        }
        // Lateral planes run between vertices of the outline.
        face.walls.iter_mut().flatten().for_each(|vertex| *vertex = number[*vertex as usize]);
    }
    Hull { vertices, faces, ..hull }
}
