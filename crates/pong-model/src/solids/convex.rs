//! Planes of a solid, merged where faces lie in one plane, and the test whether the solid is convex.

use super::facets::Facet;
use crate::hull::{PLANE_TOLERANCE, Places, area};
use crate::solid::{FieldEdge, SolidField};
use crate::solid_box::SolidBox;
use crate::weld::WordMap;
use pong_geometry::Vec3;
use pong_geometry::overlap::HalfSpace;
use std::collections::BTreeMap;

/// Distance of two unit normals above which faces of different pieces are never merged. Two normals within this
/// distance lie in the same cell or in neighbouring cells of a grid.
const NORMAL_CELL: f64 = 0.02;

/// Difference of the areas of internal faces on the two sides of a plane up to which they count as equal,
/// relative to the square of the diameter: moving the outline of a face by [`PLANE_TOLERANCE`] changes its area
/// by about this much.
const AREA_TOLERANCE: f64 = 4.0 * PLANE_TOLERANCE;

/// Cosine of two normals up to which the edge of their faces is listed: no direction of entry makes one of two faces push
/// and takes the other away if their normals are closer than 35°.
const FAR_APART: f64 = 0.82;

/// Largest number of vertices times faces for which edges are searched, about 0.2 s.
const MOST_EDGE_TESTS: usize = 1 << 27;

/// Facets in one plane.
struct Merged {
    plane: HalfSpace,
    /// Sum of the areas of the facets, m².
    area: f64,
    /// Lowest index of the facets.
    lowest: usize,
}

/// Merges facets that lie in one plane within the tolerance. Each plane is that of the largest of its facets, and
/// the planes are in the order of their lowest facets.
fn merged(facets: &[Facet], tolerance: f64) -> Vec<Merged> {
    let areas: Vec<f64> = facets.iter().map(|facet| area(&facet.corners)).collect();
    let mut largest_first: Vec<usize> = (0..facets.len()).collect();
    largest_first.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]).then(a.cmp(&b)));
    let mut found: Vec<Merged> = Vec::new();
    let mut cells: WordMap<[i32; 3], Vec<usize>> = WordMap::default();
    for index in largest_first {
        let facet = &facets[index];
        let same = around(&cell_of(&facet.plane.normal_b)).find_map(|cell| {
            let there = cells.get(&cell)?;
            there.iter().copied().find(|&at| lies_in(facet, &found[at].plane, tolerance))
        });
        match same {
            Some(at) => {
                found[at].area += areas[index];
                found[at].lowest = found[at].lowest.min(index);
            }
            None => {
                cells.entry(cell_of(&facet.plane.normal_b)).or_default().push(found.len());
                found.push(Merged { plane: facet.plane, area: areas[index], lowest: index });
            }
        }
    }
    found.sort_by_key(|merged| merged.lowest);
    found
}

/// Tests whether a facet lies in a plane and faces the same way.
fn lies_in(facet: &Facet, plane: &HalfSpace, tolerance: f64) -> bool {
    (facet.plane.normal_b - plane.normal_b).norm() <= NORMAL_CELL
        && facet.corners.iter().all(|corner| plane.depth(corner).abs() <= tolerance)
}

fn cell_of(normal: &Vec3) -> [i32; 3] {
    [0, 1, 2].map(|axis| (normal[axis] / NORMAL_CELL).floor() as i32)
}

/// The cell and its 26 neighbours.
fn around(cell: &[i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    let [x, y, z] = *cell;
    (0..27).map(move |number| [x + number % 3 - 1, y + number / 3 % 3 - 1, z + number / 9 - 1])
}

/// Planes of the facets, each once.
pub(super) fn planes(facets: &[Facet], diameter: f64) -> Vec<HalfSpace> {
    merged(facets, PLANE_TOLERANCE * diameter).into_iter().map(|merged| merged.plane).collect()
}

/// Tests some of the triangles of a mesh. `true` means that a vertex is so far above one of them that [`field`] finds
/// the mesh not convex, whichever planes of [`planes_of_mesh`](super::facets::planes_of_mesh) it gets: the corners of a
/// triangle of the height h lie within the tolerance of one of these planes, which is turned by 60° at most. So at the
/// distance of the diameter D from the triangle the plane is less than (2 + 8·D/h) tolerances above the triangle's own.
pub(super) fn is_clearly_concave(facets: &[Facet], vertices: &[Vec3], diameter: f64) -> bool {
    /// Number of triangles that are tested.
    const TESTED: usize = 16;
    let tolerance = PLANE_TOLERANCE * diameter;
    facets.iter().step_by(facets.len().div_ceil(TESTED).max(1)).any(|facet| {
        let longest =
            (0..3).map(|k| (facet.corners[(k + 1) % 3] - facet.corners[k]).norm()).fold(0.0, f64::max);
        let height = 2.0 * area(&facet.corners) / longest.max(f64::MIN_POSITIVE);
        if height <= tolerance {
            return false;
        }
        let margin = tolerance * (4.0 + 8.0 * diameter / height);
        vertices.iter().any(|vertex| facet.plane.depth(vertex) < -margin)
    })
}

/// Field of a solid given by the planes of its outer faces, by the internal faces of its pieces and by its
/// vertices; `None` if the solid is not convex.
///
/// A convex solid lies below the planes of all its faces. An internal face with nothing behind it bounds the solid
/// as well, so the plane of such a face is a wall of the field. The other internal faces lie between two pieces:
/// on both sides of their plane they have the same area.
pub(super) fn field(
    faces: Vec<HalfSpace>,
    internal: &[Facet],
    vertices: &[Vec3],
    diameter: f64,
) -> Option<SolidField> {
    let tolerance = PLANE_TOLERANCE * diameter;
    let places = Places::new(vertices);
    let holds_all = |plane: &HalfSpace| !places.any_above((&plane.normal_b, plane.offset), tolerance);
    if !faces.iter().all(holds_all) {
        return None;
    }
    let all = merged(internal, tolerance);
    let (walls, between): (Vec<_>, Vec<_>) = all.iter().partition(|merged| holds_all(&merged.plane));
    let is_matched = |one: &&Merged| {
        let reversed = HalfSpace { normal_b: -one.plane.normal_b, offset: -one.plane.offset };
        let opposite = |other: &&&Merged| lies_in(&internal[other.lowest], &reversed, 2.0 * tolerance);
        let behind: f64 = between.iter().filter(opposite).map(|other| other.area).sum();
        (one.area - behind).abs() <= AREA_TOLERANCE * diameter * diameter
    };
    if !between.iter().all(is_matched) {
        return None;
    }
    let walls = walls.iter().map(|merged| merged.plane).collect();
    let edges = edges(&faces, vertices, tolerance);
    Some(SolidField { bound: SolidBox::around(vertices), faces, walls, edges })
}

/// Edges between faces whose normals have at most the cosine [`FAR_APART`], in the order of the faces.
fn edges(faces: &[HalfSpace], vertices: &[Vec3], tolerance: f64) -> Vec<FieldEdge> {
    if faces.len() * vertices.len() > MOST_EDGE_TESTS {
        return Vec::new();
    }
    let mut found: BTreeMap<[u32; 2], Vec<Vec3>> = BTreeMap::new();
    for vertex in vertices {
        let on: Vec<usize> =
            (0..faces.len()).filter(|&face| faces[face].depth(vertex).abs() <= tolerance).collect();
        for (at, &one) in on.iter().enumerate() {
            for &other in &on[at + 1..] {
                if faces[one].normal_b.dot(&faces[other].normal_b) <= FAR_APART {
                    found.entry([one as u32, other as u32]).or_default().push(*vertex);
                }
            }
        }
    }
    found.into_iter().filter_map(|(faces_of, ends)| edge(faces, faces_of, &ends, tolerance)).collect()
}

/// Edge of two faces with these vertices on both; `None` if they share a single point.
fn edge(faces: &[HalfSpace], faces_of: [u32; 2], ends: &[Vec3], tolerance: f64) -> Option<FieldEdge> {
    let [one, other] = faces_of.map(|face| faces[face as usize].normal_b);
    let direction = one.cross(&other).try_normalize(1e-6)?;
    let along = |vertex: &Vec3| direction.dot(vertex);
    let low = ends.iter().map(along).fold(f64::INFINITY, f64::min);
    let high = ends.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
    (high - low > 2.0 * tolerance).then(|| FieldEdge { faces: faces_of, point: ends[0] })
}
