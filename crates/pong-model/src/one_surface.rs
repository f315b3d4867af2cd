//! Primitives that a group declares one surface (`one_surface: true`): polyhedra get internal faces where they
//! touch, and all polyhedra, triangles and planes get one shell (docs/theory.md, 2.2).

use crate::draft::BodyDraft;
use crate::hull::{Hull, PLANE_TOLERANCE, area, overlap_area};
use crate::model::MovableGroup;
use crate::pieces::{Sets, Wall, faces_by_x, lie_against, share_planes};
use crate::weld::WordMap;
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use std::collections::BTreeMap;

/// Overlap of two faces with the same third face up to which they count as beside each other, as a fraction of
/// the smaller area.
const BESIDE_SHARE: f64 = 1e-6;

/// Pieces that may get internal faces between each other: those of one declared surface that are not solids, or
/// those that are solids of one surface entry of the file.
pub(crate) type WallGroup = (u32, Option<u32>);

/// For each polyhedron of a movable group, the pieces with which it may get internal faces.
pub(crate) fn wall_groups(draft: &BodyDraft, pieces: usize) -> Vec<Option<WallGroup>> {
    let mut groups = vec![None; pieces];
    for (index, info) in draft.body.primitives.iter().enumerate() {
        if info.kind == PrimitiveKind::Polyhedron {
            let solid = draft.is_solid[index].then_some(info.surface);
            groups[info.elements.start as usize] = draft.one_surface[index].map(|group| (group, solid));
        }
    }
    groups
}

/// Faces (piece, face) of pieces of declared surfaces that lie against each other.
pub(crate) struct ClosedWalls {
    /// Faces that are internal although no internal face lies against them: their counterparts reach beyond them.
    pub(crate) lonely: Vec<(u32, usize)>,
    /// Faces that are covered in part and still push.
    pub(crate) in_part: Vec<(u32, usize)>,
}

/// Makes a face internal if faces of other pieces of its group cover it. A face that is covered in part gets the
/// plane of the face against it, reversed, and stays active.
pub(crate) fn close_walls(hulls: &mut [Hull], groups: &[Option<WallGroup>]) -> ClosedWalls {
    let faces = faces_by_x(hulls, |piece, _| groups[piece].is_some());
    let touching = touching(hulls, &faces, groups);
    let is_internal = |face: &Wall| !hulls[face.piece as usize].faces[face.face].active;
    let covered: Vec<bool> = (0..faces.len())
        .map(|face| is_internal(&faces[face]) || is_covered(hulls, &faces, face, &touching[face]))
        .collect();
    let mut walls = ClosedWalls { lonely: Vec::new(), in_part: Vec::new() };
    let mut planes = Sets::new(faces.len());
    for (index, face) in faces.iter().enumerate() {
        let twins = touching[index].iter().filter(|(other, _)| covered[index] || covered[*other]);
        twins.for_each(|(other, _)| planes.join(index as u32, *other as u32));
        let own = &mut hulls[face.piece as usize].faces[face.face];
        if covered[index] {
            own.active = false;
            if !touching[index].is_empty() && touching[index].iter().all(|(other, _)| !covered[*other]) {
                // The faces against it push and do not contain their own plane.
                own.closed = true;
                walls.lonely.push((face.piece, face.face));
            }
        } else if !touching[index].is_empty() {
            walls.in_part.push((face.piece, face.face));
        }
    }
    share_planes(hulls, &faces, &mut planes);
    walls.in_part.sort_unstable();
    walls
}

/// For each face, the faces of its group that lie against it, with the area common to both, m².
fn touching(hulls: &[Hull], faces: &[Wall], groups: &[Option<WallGroup>]) -> Vec<Vec<(usize, f64)>> {
    let mut touching = vec![Vec::new(); faces.len()];
    for (index, face) in faces.iter().enumerate() {
        let reachable = faces[index + 1..].iter().take_while(|other| other.low.x <= face.high.x);
        for (ahead, other) in reachable.enumerate() {
            let same_group = groups[face.piece as usize] == groups[other.piece as usize];
            if same_group && let Some(common) = lie_against(hulls, face, other) {
                touching[index].push((index + 1 + ahead, common));
                touching[index + 1 + ahead].push((index, common));
            }
        }
    }
    touching
}

/// Tests whether faces that do not overlap each other cover a whole face.
fn is_covered(hulls: &[Hull], faces: &[Wall], face: usize, touching: &[(usize, f64)]) -> bool {
    let mut largest_first = touching.to_vec();
    largest_first.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut counted: Vec<usize> = Vec::new();
    let mut common_area = 0.0;
    let mut diameter = hulls[faces[face].piece as usize].diameter;
    for (other, common) in largest_first {
        if counted.iter().all(|before| are_beside(hulls, &faces[*before], &faces[other])) {
            counted.push(other);
            common_area += common;
            diameter = diameter.max(hulls[faces[other].piece as usize].diameter);
        }
    }
    let corners = &faces[face].corners;
    let ends = corners.iter().zip(corners.iter().cycle().skip(1));
    let rim: f64 = ends.map(|(start, end)| (end - start).norm()).sum();
    area(corners) - common_area <= PLANE_TOLERANCE * diameter * rim
}

/// Tests whether two faces of the same orientation do not overlap.
fn are_beside(hulls: &[Hull], one: &Wall, other: &Wall) -> bool {
    let normal = hulls[one.piece as usize].faces[one.face].normal;
    let reversed: Vec<Vec3> = other.corners.iter().rev().copied().collect();
    let smaller = area(&one.corners).min(area(&other.corners));
    overlap_area(&one.corners, &reversed, &normal) <= BESIDE_SHARE * smaller
}

/// Gives the primitives of each declared surface one shell, and numbers the shells again in the order of their
/// first element. The backs of two-sided meshes get a shell of their own. Solids keep theirs.
pub(crate) fn join_shells(draft: &mut BodyDraft) {
    let BodyDraft { body, one_surface, is_solid, .. } = draft;
    if one_surface.iter().all(Option::is_none) {
        return;
    }
    let mut sets = Sets::new(body.shell_count as usize);
    let mut firsts: BTreeMap<(u32, bool), u32> = BTreeMap::new();
    for (index, info) in body.primitives.iter().enumerate() {
        let Some(group) = one_surface[index].filter(|_| !is_solid[index]) else { continue };
        let mut join = |shell: u32, is_back: bool| {
            let first = *firsts.entry((group, is_back)).or_insert(shell);
            sets.join(first, shell);
        };
        match info.kind {
            PrimitiveKind::Polyhedron | PrimitiveKind::Plane => join(info.shell, false),
            PrimitiveKind::Triangle => {
                for triangle in info.elements.clone() {
                    let shell = body.triangles.triangles[triangle as usize].shell;
                    join(shell, triangle >= info.first_mirror);
                }
            }
            _ => {}
        }
    }
    renumber(body, &mut sets, firsts.into_values());
}

/// Numbers joined shells in the order of their first element, and lists those of declared surfaces.
fn renumber(body: &mut MovableGroup, sets: &mut Sets, declared: impl Iterator<Item = u32>) {
    let mut numbers: WordMap<u32, u32> = WordMap::default();
    let mut number = |shell: u32| {
        let next = numbers.len() as u32;
        *numbers.entry(sets.find(shell)).or_insert(next)
    };
    for info in &mut body.primitives {
        if info.kind == PrimitiveKind::Triangle {
            for triangle in info.elements.clone() {
                let record = &mut body.triangles.triangles[triangle as usize];
                record.shell = number(record.shell);
            }
            info.shell = body.triangles.triangles[info.elements.start as usize].shell;
        } else {
            info.shell = number(info.shell);
        }
    }
    body.joint_shells = declared.map(&mut number).collect();
    body.joint_shells.sort_unstable();
    body.joint_shells.dedup();
    body.shell_count = numbers.len() as u32;
}
