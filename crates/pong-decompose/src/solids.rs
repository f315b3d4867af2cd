//! Closed solids of a mesh file, or the faults that prevent them.

use nalgebra::Vector3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};
use pong_import::Findings;
use pong_import::affine::Affine;
use pong_import::build::{Building, meshes};
use pong_import::mesh::{self, Adjacency, Mesh, area_vector, bounds, ring};
use pong_import::number::Grid;
use pong_import::source::{Shape, Source};

/// A solid thinner than this share of its size is refused.
const THIN: f64 = 2e-6;

/// Closed surfaces of one solid: its outside and its cavities.
pub(crate) struct SolidMesh {
    pub(crate) mesh: Mesh,
    pub(crate) hollow: bool,
}

/// All triangles of a file in the frame of the model.
pub(crate) fn flatten(source: Source, building: &Building<'_>, findings: &mut Findings) -> Shape {
    let marked = source.settings.is_some() || source.nodes.iter().any(|node| node.mark.is_some());
    if marked {
        let cause = "its marks (extras.pong) are not looked at: all triangles are one body";
        findings.note(&building.file, "marks-not-used", cause, "");
    }
    let mut to_model: Vec<Affine> = Vec::with_capacity(source.nodes.len());
    let mut whole = Shape::default();
    let mut loose = 0;
    for node in source.nodes {
        let above = node.parent.map_or(Affine::identity(), |parent| to_model[parent]);
        let here = above.after(&node.local);
        to_model.push(here);
        let Some(shape) = node.mesh else { continue };
        loose += shape.lines.len() + shape.points.len();
        let first = whole.vertices.len() as u32;
        whole.vertices.extend(shape.vertices.iter().map(|place| here.point(place)));
        let mirrored = here.mirrors();
        whole.triangles.extend(shape.triangles.iter().map(|triangle| {
            let [a, b, c] = triangle.map(|vertex| first + vertex);
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
    }
    if loose > 0 {
        let cause = format!("{loose} points and lines belong to no triangle and were left out");
        findings.note(&building.file, "loose", cause, "");
    }
    whole
}

/// Solids of a shape, in the order of their first triangles.
pub(crate) fn solids(
    mut shape: Shape,
    building: &Building<'_>,
    findings: &mut Findings,
) -> Option<Vec<SolidMesh>> {
    let file = &building.file;
    if shape.triangles.is_empty() {
        return findings.refuse(file, "empty-mesh", "it has no triangles", "export a mesh that has some");
    }
    let largest = shape.vertices.iter().map(|place| place.amax()).fold(0.0, f64::max);
    meshes::place(&mut shape, &Affine::identity(), Grid::of_size(largest));
    let placed = meshes::triangles(shape, building, file, findings);
    if !findings.faults.is_empty() {
        return None;
    }
    if placed.two_sided || placed.mesh.triangles.is_empty() {
        let cause = "its triangles have no inside: they lie back to back or have no area";
        return findings.refuse(
            file,
            "open-mesh",
            cause,
            "give it a thickness, or use a TriangleMesh (`pong import`)",
        );
    }
    closed(&placed.mesh, file, findings)?;
    let parts = mesh::parts(&placed.mesh);
    let solids = sorted(parts, file, findings)?;
    crossings(&placed.mesh, file, findings);
    Some(solids)
}

/// Faults of a mesh that is not closed.
fn closed(mesh: &Mesh, file: &str, findings: &mut Findings) -> Option<()> {
    let adjacency = Adjacency::new(&mesh.triangles);
    let start = |triangle: u32, corner: usize| named(&mesh.corners(triangle as usize)[corner]);
    if let Some(&(triangle, corner)) = adjacency.free.first() {
        let [a, b] = [corner as usize, (corner as usize + 1) % 3].map(|corner| start(triangle, corner));
        let cause =
            format!("{} edges have a triangle on one side only, one from {a} to {b}", adjacency.free.len());
        let cure = "--close fills holes, --weld joins vertices that nearly meet; keep a sheet as a TriangleMesh (`pong import`)";
        findings.fault(file, "open-mesh", cause, cure);
    }
    if let Some(&triangle) = adjacency.crowded.first() {
        let cause = format!(
            "{} edges are shared by three or more triangles, one at {}",
            adjacency.crowded.len(),
            start(triangle, 0)
        );
        let cure = "take inner walls away, or part solids that touch along an edge";
        findings.fault(file, "non-manifold", cause, cure);
    }
    if let Some(&triangle) = adjacency.wound_against.first() {
        let odd = mesh::shells(mesh).iter().find_map(|shell| shell.against.first().copied());
        let [a, b, c] = mesh.corners(odd.unwrap_or(triangle) as usize).map(|corner| named(&corner));
        let cause = format!(
            "{} edges join triangles wound against each other, the first of the triangle {a}, {b}, {c}",
            adjacency.wound_against.len(),
        );
        let cure = "--outward turns those that run against the rest; else make the normals consistent";
        findings.fault(file, "winding", cause, cure);
    }
    findings.faults.is_empty().then_some(())
}

/// Assigns cavities to the smallest solid around them.
fn sorted(parts: Vec<Mesh>, file: &str, findings: &mut Findings) -> Option<Vec<SolidMesh>> {
    let mut outsides: Vec<(f64, SolidMesh)> = Vec::new();
    let mut cavities = Vec::new();
    for part in parts {
        let volume = mesh::volume_m3(&part);
        let surface: f64 =
            (0..part.triangles.len()).map(|t| 0.5 * area_vector(&part.corners(t)).norm()).sum();
        if volume.abs() <= THIN * part.size_m() * 0.5 * surface {
            let cause = format!("the part at {} has no thickness", named(&part.vertices[0]));
            findings.fault(
                file,
                "zero-volume",
                cause,
                "give it a thickness, or use a TriangleMesh (`pong import`)",
            );
        } else if volume > 0.0 {
            outsides.push((volume, SolidMesh { mesh: part, hollow: false }));
        } else {
            cavities.push(part);
        }
    }
    for cavity in cavities {
        let (low, high) = bounds(&cavity.vertices);
        let around = outsides.iter_mut().filter(|(_, solid)| {
            let (outer_low, outer_high) = bounds(&solid.mesh.vertices);
            outer_low.inf(&low) == outer_low && outer_high.sup(&high) == outer_high
        });
        match around.min_by(|a, b| a.0.total_cmp(&b.0)) {
            Some((_, solid)) => {
                solid.hollow = true;
                solid.mesh.append(&cavity);
            }
            None => {
                let cause = format!(
                    "the part at {} faces inwards, and no solid is around it",
                    named(&cavity.vertices[0])
                );
                findings.fault(file, "inside-out", cause, "--outward turns it");
            }
        }
    }
    findings.faults.is_empty().then(|| outsides.into_iter().map(|(_, solid)| solid).collect())
}

/// Reports triangles that pass through each other.
fn crossings(mesh: &Mesh, file: &str, findings: &mut Findings) {
    let boxes: Vec<Aabb> = (0..mesh.triangles.len()).map(|triangle| aabb(&mesh.corners(triangle))).collect();
    let tree = Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes);
    let (mut count, mut first) = (0, None);
    for (one, bounds) in boxes.iter().enumerate() {
        let mut near: Vec<usize> = tree.intersect_aabb(bounds).map(|leaf| leaf as usize).collect();
        near.sort_unstable();
        for other in near.into_iter().filter(|&other| other > one) {
            let apart = mesh.triangles[one].iter().all(|vertex| !mesh.triangles[other].contains(vertex));
            if let Some(place) = crossing(mesh, one, other).filter(|_| apart) {
                count += 1;
                first.get_or_insert(place);
            }
        }
    }
    if let Some(place) = first {
        let cause =
            format!("{count} pairs of triangles pass through each other, the first at {}", named(&place));
        let cure = "the figures are unsure there; unite the solids (a Boolean union) before the export";
        findings.note(file, "self-intersecting", cause, cure);
    }
}

fn aabb(corners: &[Vector3<f64>; 3]) -> Aabb {
    let (low, high) = bounds(corners);
    let vector = |v: Vector3<f64>| parry3d_f64::math::Vector::new(v.x, v.y, v.z);
    Aabb::new(vector(low), vector(high))
}

/// Point where an edge of one triangle passes through the inside of the other.
fn crossing(mesh: &Mesh, one: usize, other: usize) -> Option<Vector3<f64>> {
    let (one, other) = (mesh.corners(one), mesh.corners(other));
    ring(&one)
        .find_map(|edge| pierced(&other, edge))
        .or_else(|| ring(&other).find_map(|edge| pierced(&one, edge)))
}

fn pierced(triangle: &[Vector3<f64>; 3], (from, to): (Vector3<f64>, Vector3<f64>)) -> Option<Vector3<f64>> {
    let normal = area_vector(triangle).normalize();
    let (above, below) = (normal.dot(&(from - triangle[0])), normal.dot(&(to - triangle[0])));
    let slack = 1e-9 * (to - from).norm();
    if above.abs().min(below.abs()) <= slack || (above > 0.0) == (below > 0.0) {
        return None;
    }
    let place = from + (to - from) * (above / (above - below));
    let inside =
        ring(triangle).all(|(a, b)| normal.dot(&(b - a).cross(&(place - a))) > slack * (b - a).norm());
    inside.then_some(place)
}

pub(crate) fn named(place: &Vector3<f64>) -> String {
    format!("({}, {}, {})", place.x, place.y, place.z)
}
