//! Checks of a polyhedron.

use super::places::Places;
use super::polygon::{self, area_vector, dent, plane_of};
use super::problem::Problem;
use super::solid::{HullFace, PLANE_TOLERANCE};
use crate::limits::out_of_range;
use crate::weld::WordMap;
use pong_geometry::Vec3;

type Checked = Result<(), Vec<Problem>>;

fn verdict(problems: Vec<Problem>) -> Checked {
    if problems.is_empty() { Ok(()) } else { Err(problems) }
}

/// Checks numbers and indices as authored.
pub(super) fn authored(vertices: &[Vec3], faces: &[&[u32]]) -> Checked {
    let mut problems = Vec::new();
    for (index, vertex) in vertices.iter().enumerate() {
        if let Some((rule, cause, cure)) = vertex.iter().find_map(|&x| out_of_range(x)) {
            problems.push(Problem::new(None, rule, format!("vertex {index}: {cause}"), cure));
        }
    }
    if faces.len() < 4 {
        let cause = format!("a solid of {} faces", faces.len());
        problems.push(Problem::new(None, "too-few-faces", cause, "a solid has at least four"));
    }
    for (index, face) in faces.iter().enumerate() {
        problems.extend(face_indices(index, face, vertices.len()));
    }
    verdict(problems)
}

fn face_indices(index: usize, face: &[u32], vertex_count: usize) -> Option<Problem> {
    let problem = |rule, cause, cure| Some(Problem::new(Some(index), rule, cause, cure));
    if face.len() < 3 {
        let cause = format!("a face of {} vertices", face.len());
        return problem("too-few-vertices", cause, "a face has at least three");
    }
    if let Some(v) = face.iter().find(|&&v| v as usize >= vertex_count) {
        let cause = format!("there is no vertex {v} among {vertex_count}");
        return problem("index-out-of-range", cause, "indices count from 0");
    }
    let mut sorted = face.to_vec();
    sorted.sort_unstable();
    let twice = sorted.windows(2).find(|pair| pair[0] == pair[1])?[0];
    problem("repeated-index", format!("vertex {twice} comes twice"), "a face names each of its vertices once")
}

fn corners(vertices: &[Vec3], face: &[u32]) -> Vec<Vec3> {
    face.iter().map(|&v| vertices[v as usize]).collect()
}

/// Checks that every edge has a length.
pub(super) fn edges(vertices: &[Vec3], faces: &[Vec<u32>]) -> Checked {
    let without = |(index, face): (usize, &Vec<u32>)| {
        let (a, _) = polygon::edges(face).find(|(a, b)| a == b)?;
        let vertex = vertices[a as usize];
        let cause = format!("two neighbouring vertices are the same place, {}", place(&vertex));
        Some(Problem::new(Some(index), "zero-length-edge", cause, "merge the two").at(&[vertex]))
    };
    verdict(faces.iter().enumerate().filter_map(without).collect())
}

/// Problem: a face without width that cannot be joined to a neighbour.
pub(super) fn sliver(face: usize, share: f64) -> Problem {
    let cause = format!("a sliver: its width is {share:.1e} of its longest edge");
    Problem::new(Some(face), "sliver-face", cause, "remove it or move a vertex")
}

/// Checks that every edge is shared by exactly two faces that run along it in opposite directions.
pub(super) fn closed_surface(vertices: &[Vec3], faces: &[Vec<u32>]) -> Checked {
    let mut users: WordMap<(u32, u32), u32> = WordMap::default();
    for (a, b) in faces.iter().flat_map(|face| polygon::edges(face)) {
        *users.entry((a, b)).or_default() += 1;
    }
    let mut problems = Vec::new();
    for (index, face) in faces.iter().enumerate() {
        let open = polygon::edges(face).find(|&(a, b)| users[&(a, b)] != 1 || users.get(&(b, a)) != Some(&1));
        if let Some((a, b)) = open {
            let (a, b) = (vertices[a as usize], vertices[b as usize]);
            let cause = format!(
                "the edge from ({}, {}, {}) to ({}, {}, {}) is not shared by exactly two faces in opposite directions",
                a.x, a.y, a.z, b.x, b.y, b.z
            );
            let cure = "close the surface and run every face counter-clockwise seen from outside";
            problems.push(Problem::new(Some(index), "open-polyhedron", cause, cure).at(&[a, b]));
        }
    }
    verdict(problems)
}

/// Checks that the solid lies behind its faces.
pub(super) fn volume(vertices: &[Vec3], faces: &[Vec<u32>], diameter: f64) -> Checked {
    let first = vertices[0];
    let local = |v: u32| (vertices[v as usize] - first) / diameter;
    let mut six_volumes = 0.0;
    let mut largest_area: f64 = 0.0;
    for face in faces.iter().filter(|face| !face.is_empty()) {
        let origin = local(face[0]);
        let corners: Vec<Vec3> = face.iter().map(|&v| local(v)).collect();
        let area = area_vector(&corners);
        six_volumes += area.dot(&origin);
        largest_area = largest_area.max(area.norm());
    }
    // The thickness in diameters is about the volume over the largest area.
    if six_volumes.abs() <= PLANE_TOLERANCE * largest_area {
        let thickness = six_volumes.abs() / (3.0 * largest_area);
        return Err(vec![no_thickness(None, &format!("about {thickness:.1e} of its diameter thick"))]);
    }
    if six_volumes < 0.0 {
        let cause = "its faces run clockwise seen from outside".to_owned();
        let cure = "reverse the order of the vertices of every face";
        return Err(vec![Problem::new(None, "inside-out", cause, cure)]);
    }
    Ok(())
}

/// Problem: a solid without thickness, with the face and the thickness behind it.
fn no_thickness(face: Option<usize>, how_thick: &str) -> Problem {
    let cause = format!("the solid is {how_thick}; it has to be thicker than {PLANE_TOLERANCE:.0e}");
    Problem::new(face, "zero-volume", cause, "give it a thickness, or use triangles")
}

/// Problem: too few faces remain for a solid.
pub(super) fn too_few_faces() -> Problem {
    no_thickness(None, "as good as flat: its faces lie in fewer than four planes")
}

/// Checks that faces of more than three vertices are planar.
pub(super) fn planar(vertices: &[Vec3], faces: &[Vec<u32>], diameter: f64) -> Checked {
    let mut problems = Vec::new();
    for (index, face) in faces.iter().enumerate().filter(|(_, face)| face.len() > 3) {
        let corners = corners(vertices, face);
        let (normal, offset) = plane_of(&corners);
        let offs = corners.iter().map(|c| ((normal.dot(c) - offset).abs(), c));
        let Some((off, corner)) = offs.max_by(|a, b| a.0.total_cmp(&b.0)) else { continue };
        if off > PLANE_TOLERANCE * diameter {
            let cause = format!(
                "the vertex {} is {:.1e} of the diameter off the plane of this face",
                place(corner),
                off / diameter
            );
            let cure = "move it, or triangulate the face";
            problems.push(Problem::new(Some(index), "face-not-planar", cause, cure).at(&[*corner]).off(off));
        }
    }
    verdict(problems)
}

/// Checks that no vertex lies in front of a face, no face has a dent, and the solid has a thickness behind
/// every face.
///
/// Vertices dropped by merging count too: no point of the solid may move by more than the tolerance.
pub(super) fn convex(vertices: &[Vec3], faces: &[HullFace], tree: &Places, diameter: f64) -> Checked {
    verdict(faces.iter().filter_map(|one| face(vertices, one, tree, diameter)).collect())?;
    thickness(faces, tree, diameter)
}

/// Problem of one face, if any: a vertex in front of it, or a dent.
pub(super) fn face(vertices: &[Vec3], face: &HullFace, tree: &Places, diameter: f64) -> Option<Problem> {
    vertex_in_front(vertices, face, tree, diameter).or_else(|| dented(vertices, face, diameter))
}

/// Problem of the outline, if any, for a face whose boundary planes run along its edges.
pub(super) fn dented(vertices: &[Vec3], face: &HullFace, diameter: f64) -> Option<Problem> {
    if !face.walls.is_empty() {
        return None;
    }
    let corners = corners(vertices, &face.outline);
    let (depth, corner) = dent(&corners, &face.normal, PLANE_TOLERANCE * diameter)?;
    let cause = format!(
        "the outline of this face has a dent: the vertex {} is {:.1e} of the diameter beyond the line of an edge",
        place(&corners[corner]),
        depth / diameter
    );
    Some(not_convex(face, "face-not-convex", cause).at(&[corners[corner]]).off(depth))
}

/// Checks the thickness behind every face. With fewer than four faces after merging, the solid would be
/// practically flat.
pub(super) fn thickness(faces: &[HullFace], tree: &Places, diameter: f64) -> Checked {
    let floor = PLANE_TOLERANCE * diameter;
    if faces.len() < 4 {
        return Err(vec![too_few_faces()]);
    }
    let is_thin = |face: &&HullFace| !tree.any_above((&-face.normal, -face.offset), floor);
    let Some(thin) = faces.iter().find(is_thin) else { return Ok(()) };
    let how_thick = "as good as flat: no vertex is farther behind this face";
    Err(vec![no_thickness(Some(thin.authored as usize), how_thick)])
}

/// Checks that no vertex without a face lies deeper below the surface than the tolerance.
pub(super) fn none_deep(vertices: &[Vec3], lost: &[u32], faces: &[HullFace], diameter: f64) -> Checked {
    let problem = |vertex: &u32| {
        let vertex = &vertices[*vertex as usize];
        let depths = faces.iter().map(|face| face.offset - face.normal.dot(vertex));
        let depth = depths.fold(f64::INFINITY, f64::min);
        let cause = format!(
            "not convex: the vertex {} is {:.1e} of the diameter below the faces beside those without width",
            place(vertex),
            depth / diameter
        );
        let problem = Problem::new(None, "not-convex", cause, "remove it, or move it").at(&[*vertex]);
        (depth > PLANE_TOLERANCE * diameter).then(|| problem.off(depth))
    };
    verdict(lost.iter().filter_map(problem).collect())
}

fn not_convex(face: &HullFace, rule: &'static str, cause: String) -> Problem {
    Problem::new(Some(face.authored as usize), rule, cause, "split the solid into convex pieces")
}

fn place(v: &Vec3) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

fn vertex_in_front(vertices: &[Vec3], face: &HullFace, tree: &Places, diameter: f64) -> Option<Problem> {
    let others = |v: u32| !face.outline.contains(&v);
    let (height, vertex) = tree.highest((&face.normal, face.offset), PLANE_TOLERANCE * diameter, others)?;
    let cause = format!(
        "not convex: the vertex {} is {:.1e} of the diameter in front of this face",
        place(&vertices[vertex as usize]),
        height / diameter
    );
    Some(not_convex(face, "not-convex", cause).at(&[vertices[vertex as usize]]).off(height))
}
