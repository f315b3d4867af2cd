//! Convex solids that several pieces of a body form together (docs/theory.md, 2.8).

use crate::hull::{self, PLANE_TOLERANCE, Places, convex_outline};
use crate::model::{MovableGroup, Whole};
use crate::polyhedra;
use crate::weld::Welder;
use pong_geometry::Vec3;
use pong_geometry::primitive::{Polyhedron, PolyhedronFace, PrimitiveKind};
use std::collections::BTreeMap;

/// Returns the convex solids of a movable group that consist of several pieces, by shell. A declared surface is none, nor
/// are pieces with different surface entries.
pub(crate) fn wholes(body: &MovableGroup) -> Vec<Whole> {
    let mut shells: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (index, info) in body.primitives.iter().enumerate() {
        if info.kind == PrimitiveKind::Polyhedron && !body.is_joint(info.shell) {
            shells.entry(info.shell).or_default().push(index);
        }
    }
    let whole = |(shell, pieces): (u32, Vec<usize>)| {
        let [first, others @ ..] = &pieces[..] else { return None };
        let surface = |index: &usize| body.primitives[*index].surface;
        if others.is_empty() || others.iter().any(|other| surface(other) != surface(first)) {
            return None;
        }
        let solids =
            pieces.iter().map(|&index| &body.polyhedra[body.primitives[index].elements.start as usize]);
        let solid = union(&solids.collect::<Vec<_>>())?;
        Some(Whole { shell, primitive: *first as u32, solid })
    };
    shells.into_iter().filter_map(whole).collect()
}

/// Faces of a body in one plane, with their corners.
struct Side<'a> {
    face: &'a PolyhedronFace,
    corners: Vec<u32>,
}

/// Returns the union of pieces whose active faces are its boundary; `None` if it is not convex.
fn union(pieces: &[&Polyhedron]) -> Option<Polyhedron> {
    let (mut welder, mut vertices) = (Welder::default(), Vec::new());
    let mut faces: Vec<(&PolyhedronFace, Vec<u32>)> = Vec::new();
    for piece in pieces {
        for face in piece.faces.iter().filter(|face| face.active) {
            let corners = corners(piece, face).map(|corner| welder.weld(corner, &mut vertices));
            faces.push((face, corners.collect()));
        }
    }
    if vertices.is_empty() {
        return None;
    }
    let places = Places::new(&vertices);
    let diameter = hull::diameter(&vertices, &places);
    let tolerance = PLANE_TOLERANCE * diameter;
    if faces.iter().any(|(face, _)| places.any_above((&face.normal, face.offset), tolerance)) {
        return None;
    }
    let mut sides: Vec<Side<'_>> = Vec::new();
    for (face, corners) in faces {
        let holds = |side: &&mut Side<'_>| {
            let is_on = |&corner: &u32| side.face.height(&vertices[corner as usize]).abs() <= tolerance;
            side.face.normal.dot(&face.normal) > 0.5 && corners.iter().all(is_on)
        };
        match sides.iter_mut().find(holds) {
            Some(side) => side.corners.extend(corners),
            None => sides.push(Side { face, corners }),
        }
    }
    // A vertex of pieces at which fewer than three planes meet is within an edge or a face of the whole.
    let mut meet = vec![0; vertices.len()];
    for side in &mut sides {
        side.corners.sort_unstable();
        side.corners.dedup();
        side.corners.iter().for_each(|&corner| meet[corner as usize] += 1);
    }
    let outlines = sides.iter().map(|side| {
        let corners: Vec<u32> =
            side.corners.iter().copied().filter(|&corner| meet[corner as usize] > 2).collect();
        let at: Vec<Vec3> = corners.iter().map(|&corner| vertices[corner as usize]).collect();
        let outline = convex_outline(&at, &side.face.normal);
        outline.into_iter().map(|place| corners[place]).collect::<Vec<u32>>()
    });
    let outlines: Vec<Vec<u32>> = outlines.collect();
    let outlines: Vec<&[u32]> = outlines.iter().map(|outline| &outline[..]).collect();
    let checked = hull::check(&vertices, &outlines, &vec![true; outlines.len()]).ok()?;
    let whole = polyhedra::build(&[checked], &[0]).0.pop()?;
    // Walls that cover each other only in part, or pieces that overlap, are no solid.
    let origin = vertices[0];
    let [space, of_pieces] = [&[&whole][..], pieces].map(|solids| volume_and_area(solids, &origin));
    ((space.0 - of_pieces.0).abs() <= tolerance * of_pieces.1).then_some(whole)
}

fn corners<'a>(solid: &'a Polyhedron, face: &'a PolyhedronFace) -> impl Iterator<Item = Vec3> + 'a {
    solid.rims_of(face).iter().map(|rim| solid.vertices[rim.start as usize].position)
}

/// Returns the sum of the volumes, m³, and of the surfaces, m².
fn volume_and_area(solids: &[&Polyhedron], origin: &Vec3) -> (f64, f64) {
    let faces = solids.iter().flat_map(|solid| {
        solid.faces.iter().map(|face| {
            let corners: Vec<Vec3> = corners(solid, face).collect();
            let area = hull::area(&corners);
            (face.height(origin) * area / -3.0, area)
        })
    });
    faces.fold((0.0, 0.0), |sum, (volume, area)| (sum.0 + volume, sum.1 + area))
}
