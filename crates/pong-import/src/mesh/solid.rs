//! Recognition of convex solids, and their polygons.

use super::adjacency::{Adjacency, NONE};
use super::facets::{Facets, facets};
use super::measures::{area_vector, bounds, ring};
use super::triangle_mesh::Mesh;
use nalgebra::Vector3;

/// Heights above a face that count as zero, in sizes of the mesh. Model files compare with the diameter,
/// which is at least 0.57 of the diagonal of the box.
const CONVEX_SHARE: f64 = 0.5e-6;
/// Parts thinner than this share of their size are no solids.
const THIN: f64 = 2e-6;

/// A convex solid with planar faces.
#[derive(Debug)]
pub struct Polyhedron {
    pub vertices: Vec<Vector3<f64>>,
    pub faces: Vec<Vec<u32>>,
    /// The look of each face.
    pub look_of: Vec<u16>,
}

/// Finds the convex hull of a mesh and how far its deepest vertex lies within it, m; `None` if it has no thickness.
pub type HullFinder = fn(&Mesh) -> Option<(Polyhedron, f64)>;

/// Reasons why a part is no convex solid.
#[derive(Debug, PartialEq)]
pub enum Flaw {
    /// Edges that do not join two triangles, and one of their ends.
    Open {
        edges: usize,
        at: Vector3<f64>,
    },
    InsideOut,
    Thin,
    /// A vertex in front of a face, and its height, m.
    Dented {
        at: Vector3<f64>,
        height_m: f64,
    },
    /// A closed surface with a hole through it, or with self-intersections.
    Tangled,
    /// More faces than allowed.
    TooManyFaces(usize),
}

/// Signed volume, m³: positive if the triangles face outwards.
pub fn volume_m3(mesh: &Mesh) -> f64 {
    let (low, high) = bounds(&mesh.vertices);
    volume_of(mesh, 0..mesh.triangles.len(), &(0.5 * (low + high)))
}

/// Signed volume between a point and some triangles, m³.
pub(super) fn volume_of(mesh: &Mesh, triangles: impl Iterator<Item = usize>, place: &Vector3<f64>) -> f64 {
    let six = |triangle: usize| {
        let [a, b, c] = mesh.corners(triangle).map(|corner| corner - place);
        a.dot(&b.cross(&c))
    };
    triangles.map(six).sum::<f64>() / 6.0
}

/// The part as a convex polyhedron of at most `faces_max` faces, or the reason why it is none.
pub fn polyhedron(mesh: &Mesh, faces_max: usize) -> Result<Polyhedron, Flaw> {
    let adjacency = Adjacency::new(&mesh.triangles);
    closed(mesh, &adjacency)?;
    let size_m = mesh.size_m();
    thick(mesh, size_m)?;
    convex_at_edges(mesh, &adjacency, CONVEX_SHARE * size_m)?;
    let edges = 3 * mesh.triangles.len() / 2;
    let mut used = vec![false; mesh.vertices.len()];
    mesh.triangles.iter().flatten().for_each(|&vertex| used[vertex as usize] = true);
    let vertices = used.iter().filter(|used| **used).count();
    if vertices + mesh.triangles.len() != edges + 2 {
        return Err(Flaw::Tangled);
    }
    let Facets { faces, simple } = facets(mesh, &adjacency, size_m);
    if !simple || faces.len() < 4 || faces.iter().any(|(outline, _)| outline.len() < 3) {
        return Err(Flaw::Tangled);
    }
    if faces.len() > faces_max {
        return Err(Flaw::TooManyFaces(faces.len()));
    }
    let polyhedron = compact(mesh, faces);
    convex_everywhere(&polyhedron, 2.0 * CONVEX_SHARE * size_m)?;
    Ok(polyhedron)
}

fn closed(mesh: &Mesh, adjacency: &Adjacency) -> Result<(), Flaw> {
    if adjacency.is_closed() {
        return Ok(());
    }
    let Adjacency { free, crowded, wound_against, .. } = adjacency;
    let odd = free.first().map(|free| free.0).or(crowded.first().copied()).or(wound_against.first().copied());
    let corner = free.first().map_or(0, |free| free.1) as usize;
    let at = mesh.corners(odd.unwrap_or(0) as usize)[corner];
    Err(Flaw::Open { edges: free.len() + crowded.len() + wound_against.len(), at })
}

fn thick(mesh: &Mesh, size_m: f64) -> Result<(), Flaw> {
    let volume = volume_m3(mesh);
    let area: f64 = (0..mesh.triangles.len()).map(|t| 0.5 * area_vector(&mesh.corners(t)).norm()).sum();
    match volume {
        volume if volume.abs() <= THIN * size_m * 0.5 * area => Err(Flaw::Thin),
        volume if volume < 0.0 => Err(Flaw::InsideOut),
        _ => Ok(()),
    }
}

/// Checks that every neighbour of each triangle (of the larger of two) bends away from it.
fn convex_at_edges(mesh: &Mesh, adjacency: &Adjacency, tolerance_m: f64) -> Result<(), Flaw> {
    for (index, across) in adjacency.across.iter().enumerate() {
        let corners = mesh.corners(index);
        let area = area_vector(&corners);
        let normal = area.normalize();
        for &other in across.iter().filter(|other| **other != NONE) {
            let beyond = mesh.corners(other as usize);
            if area_vector(&beyond).norm_squared() > area.norm_squared() {
                continue;
            }
            for place in beyond {
                let height_m = normal.dot(&(place - corners[0]));
                if height_m > tolerance_m {
                    return Err(Flaw::Dented { at: place, height_m });
                }
            }
        }
    }
    Ok(())
}

fn compact(mesh: &Mesh, faces: Vec<(Vec<u32>, u16)>) -> Polyhedron {
    let mut number = vec![NONE; mesh.vertices.len()];
    for &vertex in faces.iter().flat_map(|(outline, _)| outline) {
        number[vertex as usize] = 0;
    }
    let mut vertices = Vec::new();
    for (vertex, slot) in number.iter_mut().enumerate().filter(|(_, slot)| **slot == 0) {
        *slot = vertices.len() as u32;
        vertices.push(mesh.vertices[vertex]);
    }
    let (outlines, look_of): (Vec<Vec<u32>>, Vec<u16>) = faces.into_iter().unzip();
    let renumbered = |outline: Vec<u32>| outline.into_iter().map(|vertex| number[vertex as usize]).collect();
    Polyhedron { vertices, faces: outlines.into_iter().map(renumbered).collect(), look_of }
}

fn convex_everywhere(solid: &Polyhedron, tolerance_m: f64) -> Result<(), Flaw> {
    for face in &solid.faces {
        let corners: Vec<Vector3<f64>> = face.iter().map(|&vertex| solid.vertices[vertex as usize]).collect();
        let origin = corners[0];
        let area: Vector3<f64> = ring(&corners).map(|(a, b)| (a - origin).cross(&(b - origin))).sum();
        let normal = area.normalize();
        let mean =
            corners.iter().map(|corner| normal.dot(&(corner - origin))).sum::<f64>() / corners.len() as f64;
        for place in &solid.vertices {
            let height_m = normal.dot(&(place - origin)) - mean;
            if height_m > tolerance_m {
                return Err(Flaw::Dented { at: *place, height_m });
            }
        }
    }
    Ok(())
}
