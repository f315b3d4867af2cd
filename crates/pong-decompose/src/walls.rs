//! Internal faces: faces against or inside other pieces, unreachable from outside.
//!
//! A face is inactive if other pieces cover all of it. A partly covered face is divided into its covered and
//! open parts, unless the loader would merge them again (coplanar neighbours become one face, and every face
//! must be convex). In that case the piece is cut in two along the boundary of the covered part while the
//! number of pieces allows it. A face that is still partly covered stays active as a whole.

use crate::piece::Piece;
use crate::polygon::{Plane, Polygon, area, clip, common, is_wide, sides, without};
use crate::regions::{faces_of, sum};
use crate::seams::{Pool, stitch};
use nalgebra::Vector3;

/// Opposite faces within this share of the larger piece's box are coplanar; the loader's tolerance is four
/// times larger.
const PLANE_SHARE: f64 = 0.25e-6;
/// Narrower strips (in sizes of the whole) are ignored.
const STRIP_SHARE: f64 = 1e-7;
/// Distance in front of a face within which covering pieces are searched, in sizes of the whole.
const PROBE_SHARE: f64 = 1e-8;

/// Counts of cuts and of partly covered faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Walls {
    /// Pieces cut in two along boundaries of internal faces.
    pub(crate) cuts: usize,
    /// Partly covered faces that stay active.
    pub(crate) part_covered: usize,
}

/// Two opposite coplanar faces and their intersection, counter-clockwise seen along the first's normal.
struct Touch {
    faces: [(usize, usize); 2],
    polygon: Polygon,
}

/// Division of a partly covered face.
enum Split {
    /// No division.
    Whole,
    /// Covered and open parts.
    Parts { covered: Vec<Polygon>, open: Vec<Polygon> },
    /// Cut of the piece along this plane, because the loader would refuse the parts.
    Cut(Plane),
}

/// Marks internal faces, dividing faces and cutting pieces where needed; `accepted` tests whether the loader
/// takes a piece.
pub(crate) fn mark(
    pieces: &mut Vec<Piece>,
    pieces_max: usize,
    size_m: f64,
    accepted: &dyn Fn(&Piece) -> bool,
) -> Walls {
    let mut walls = Walls::default();
    let strip_m = STRIP_SHARE * size_m;
    let mut pool = Pool::of(pieces, size_m);
    let cuts_max = pieces_max.saturating_sub(pieces.len()).min(2 * pieces.len());
    let mut refused = Vec::new();
    let mut touches = touching(pieces, strip_m);
    while walls.cuts < cuts_max {
        let Some((index, plane)) = next_cut(pieces, &touches, &refused, strip_m) else { break };
        let parts = pieces[index].cut(&plane).map(|parts| parts.map(|part| pool.canonical(part)));
        match parts.filter(|parts| parts.iter().all(accepted)) {
            Some([below, above]) => {
                pieces[index] = below;
                pieces.push(above);
                walls.cuts += 1;
                touches = touching(pieces, strip_m);
            }
            None => refused.push(index),
        }
    }
    let covered = fully_covered(pieces, size_m);
    let mut polygons: Vec<Vec<(Polygon, bool)>> = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        let mut faces = Vec::new();
        for face in 0..piece.faces.len() {
            let whole = piece.polygon(face);
            if covered[index][face] {
                faces.push((whole, true));
                continue;
            }
            match split(piece, face, &touches_of(&touches, index, face), strip_m) {
                Split::Whole => faces.push((whole, false)),
                Split::Cut(_) => {
                    walls.part_covered += 1;
                    faces.push((whole, false));
                }
                Split::Parts { covered, open } => {
                    faces.extend(covered.into_iter().map(|polygon| (pool.polygon(polygon), true)));
                    faces.extend(open.into_iter().map(|polygon| (pool.polygon(polygon), false)));
                }
            }
        }
        polygons.push(faces);
    }
    for index in stitch(pieces, &polygons, size_m, accepted) {
        // The parts covered by the divided faces are partly covered again.
        let split = polygons[index].iter().filter(|(_, inactive)| *inactive).count();
        walls.part_covered += split.saturating_sub(covered[index].iter().filter(|covered| **covered).count());
        pieces[index].inactive.clone_from(&covered[index]);
        if !accepted(&pieces[index]) {
            // Without an internal face between them, nearly coplanar faces are merged.
            pieces[index].inactive.fill(false);
            walls.part_covered += covered[index].iter().filter(|covered| **covered).count();
        }
    }
    walls
}

/// All pairs of opposite coplanar faces that overlap.
fn touching(pieces: &[Piece], strip_m: f64) -> Vec<Touch> {
    let mut touches = Vec::new();
    for (a, one) in pieces.iter().enumerate() {
        for (b, other) in pieces.iter().enumerate().skip(a + 1) {
            if one.is_near(other, strip_m) {
                touch(&mut touches, (a, one), (b, other), strip_m);
            }
        }
    }
    touches
}

fn touch(touches: &mut Vec<Touch>, (a, one): (usize, &Piece), (b, other): (usize, &Piece), strip_m: f64) {
    let tolerance = PLANE_SHARE * (one.high - one.low).norm().max((other.high - other.low).norm());
    let lies_in = |plane: &Plane, polygon: &[Vector3<f64>]| {
        polygon.iter().all(|place| plane.height(place).abs() <= tolerance)
    };
    for (face_a, plane_a) in one.planes.iter().enumerate() {
        for (face_b, plane_b) in other.planes.iter().enumerate() {
            if plane_a.normal.dot(&plane_b.normal) > -0.999 {
                continue;
            }
            let (outline_a, outline_b) = (one.polygon(face_a), other.polygon(face_b));
            if !lies_in(plane_a, &outline_b) || !lies_in(plane_b, &outline_a) {
                continue;
            }
            let facing: Polygon = outline_b.into_iter().rev().collect();
            let polygon = common(&outline_a, &facing, &plane_a.normal);
            if is_wide(&polygon, strip_m) {
                touches.push(Touch { faces: [(a, face_a), (b, face_b)], polygon });
            }
        }
    }
}

/// Polygons that cover parts of a face, counter-clockwise seen from outside of it.
fn touches_of(touches: &[Touch], piece: usize, face: usize) -> Vec<Polygon> {
    let seen = touches.iter().filter_map(|touch| match touch.faces {
        [first, _] if first == (piece, face) => Some(touch.polygon.clone()),
        [_, second] if second == (piece, face) => Some(touch.polygon.iter().rev().copied().collect()),
        _ => None,
    });
    seen.collect()
}

/// True for each face of each piece that the other pieces cover completely.
fn fully_covered(pieces: &[Piece], size_m: f64) -> Vec<Vec<bool>> {
    let strip_m = STRIP_SHARE * size_m;
    let covered = |index: usize, face: usize| {
        let piece = &pieces[index];
        let normal = piece.planes[face].normal;
        let outline = piece.polygon(face);
        let probe: Polygon = outline.iter().map(|place| place + normal * (PROBE_SHARE * size_m)).collect();
        let mut open = vec![probe.clone()];
        for (_, other) in pieces.iter().enumerate().filter(|(other, _)| *other != index) {
            if !piece.is_near(other, strip_m) {
                continue;
            }
            let inside = other.planes.iter().fold(probe.clone(), |rest, plane| clip(&rest, plane));
            if is_wide(&inside, strip_m) {
                open = without(&open, &inside, &normal, strip_m);
            }
        }
        open.is_empty()
    };
    (0..pieces.len())
        .map(|index| (0..pieces[index].faces.len()).map(|face| covered(index, face)).collect())
        .collect()
}

/// Next piece to cut: the one with the largest covered part that no division of faces separates.
fn next_cut(pieces: &[Piece], touches: &[Touch], refused: &[usize], strip_m: f64) -> Option<(usize, Plane)> {
    let mut best: Option<(f64, usize, Plane)> = None;
    let mut seen: Vec<(usize, usize)> = touches.iter().flat_map(|touch| touch.faces).collect();
    seen.sort_unstable();
    seen.dedup();
    for (index, face) in seen.into_iter().filter(|(index, _)| !refused.contains(index)) {
        let parts = touches_of(touches, index, face);
        if let Split::Cut(plane) = split(&pieces[index], face, &parts, strip_m) {
            let covered = sum(&parts);
            if best.as_ref().is_none_or(|(most, _, _)| covered > *most) {
                best = Some((covered, index, plane));
            }
        }
    }
    best.map(|(_, index, plane)| (index, plane))
}

fn split(piece: &Piece, face: usize, touches: &[Polygon], strip_m: f64) -> Split {
    if touches.is_empty() {
        return Split::Whole;
    }
    let outline = piece.polygon(face);
    let normal = piece.planes[face].normal;
    let open =
        touches.iter().fold(vec![outline.clone()], |open, touch| without(&open, touch, &normal, strip_m));
    if open.is_empty() {
        return Split::Whole;
    }
    let slack_m2 = strip_m * outline.iter().map(|place| (place - outline[0]).norm()).sum::<f64>();
    let whole = area(&outline);
    // Overlapping pieces cover points twice: then nothing is cut.
    if (sum(&open) + sum(touches) - whole).abs() > 4.0 * slack_m2 {
        return Split::Whole;
    }
    if let (Some(covered), Some(open)) =
        (faces_of(touches, &normal, strip_m, slack_m2), faces_of(&open, &normal, strip_m, slack_m2))
    {
        return Split::Parts { covered, open };
    }
    match longest_line(&outline, touches, &normal, strip_m) {
        Some(plane) => Split::Cut(plane),
        None => Split::Whole,
    }
}

/// Line along the boundary of a covered part that runs farthest across the face.
fn longest_line(
    outline: &[Vector3<f64>],
    touches: &[Polygon],
    normal: &Vector3<f64>,
    strip_m: f64,
) -> Option<Plane> {
    let mut best: Option<(f64, Plane)> = None;
    for side in touches.iter().flat_map(|touch| sides(touch, normal)) {
        let heights = outline.iter().map(|place| side.height(place));
        let (low, high) = heights.fold((0.0_f64, 0.0_f64), |(low, high), h| (low.min(h), high.max(h)));
        if high <= strip_m || low >= -strip_m {
            continue;
        }
        let along = side.normal.cross(normal);
        let on_line = clip(&clip(outline, &side.shifted(strip_m)), &side.flipped().shifted(strip_m));
        let ends = on_line.iter().map(|place| along.dot(place));
        let (from, to) = ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        if best.as_ref().is_none_or(|(longest, _)| to - from > *longest * (1.0 + 1e-9)) {
            best = Some((to - from, side));
        }
    }
    best.map(|(_, plane)| plane)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::box_between;

    fn inactive_normals(piece: &Piece) -> Vec<Vector3<f64>> {
        let faces = (0..piece.faces.len()).filter(|&face| piece.inactive[face]);
        faces.map(|face| piece.planes[face].normal).collect()
    }

    #[test]
    fn a_bar_cut_in_two_has_one_wall_on_either_side() {
        let bar = box_between([0.0; 3], [3.0, 1.0, 1.0]);
        for plane in
            [Plane::across(0, 1.0, false), Plane { normal: Vector3::new(0.8, 0.6, 0.0), offset: 1.3 }]
        {
            let mut pieces = bar.cut(&plane).unwrap().to_vec();
            let walls = mark(&mut pieces, 2, 3.3, &|_| true);
            assert_eq!(walls, Walls::default());
            let [one, other] = [&pieces[0], &pieces[1]].map(inactive_normals);
            assert_eq!((one.len(), other.len()), (1, 1));
            assert!((one[0] - plane.normal).norm() < 1e-12 && (other[0] + plane.normal).norm() < 1e-12);
            assert!((pieces[0].volume_m3 + pieces[1].volume_m3 - 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn pieces_apart_and_faces_side_by_side_have_no_walls() {
        let mut pieces = vec![
            box_between([0.0; 3], [1.0; 3]),
            box_between([1.001, 0.0, 0.0], [2.0, 1.0, 1.0]),
            // Its edge touches, and it lies in the same planes.
            box_between([-1.0, 1.0, 0.0], [0.0, 2.0, 1.0]),
        ];
        mark(&mut pieces, 9, 3.0, &|_| true);
        assert!(pieces.iter().all(|piece| inactive_normals(piece).is_empty()));
    }

    #[test]
    fn a_face_inside_another_piece_is_a_wall_and_one_in_a_common_outside_is_not() {
        let mut pieces =
            vec![box_between([0.0; 3], [2.0, 1.0, 1.0]), box_between([1.0, 0.0, 0.0], [3.0, 1.0, 1.0])];
        mark(&mut pieces, 9, 3.0, &|_| true);
        assert_eq!(inactive_normals(&pieces[0]), [Vector3::x()]);
        assert_eq!(inactive_normals(&pieces[1]), [-Vector3::x()]);
    }

    #[test]
    fn a_wall_covered_by_two_neighbours_together_is_covered() {
        let mut pieces = vec![
            box_between([0.0; 3], [1.0, 2.0, 1.0]),
            box_between([1.0, 0.0, 0.0], [2.0, 1.2, 1.0]),
            box_between([1.0, 1.2, 0.0], [2.0, 2.0, 1.0]),
        ];
        let walls = mark(&mut pieces, 3, 3.0, &|_| true);
        assert_eq!(walls, Walls::default());
        assert_eq!(pieces.iter().map(|piece| inactive_normals(piece).len()).collect::<Vec<_>>(), [1, 2, 2]);
        // The neighbours' common corner is a vertex of the first, within its edges.
        assert_eq!(pieces[0].vertices.len(), 10);
    }
}
