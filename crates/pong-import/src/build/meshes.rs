//! Triangles of a node on their way into a primitive: placed, welded, cleaned, mended; what was done is told.

use super::building::Building;
use crate::affine::Affine;
use crate::findings::Findings;
use crate::mesh::{self, Adjacency, Mesh};
use crate::number::Grid;
use crate::source::Shape;

/// A mesh in the frame of its body.
pub struct Placed {
    pub mesh: Mesh,
    pub two_sided: bool,
}

/// Places a shape's vertices in the frame of its body, on the grid.
pub fn place(shape: &mut Shape, to_body: &Affine, grid: Grid) {
    let moved = !to_body.is_identity();
    for place in &mut shape.vertices {
        *place = grid.round_place(&if moved { to_body.point(place) } else { *place });
    }
    if to_body.mirrors() {
        shape.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
}

/// The triangles of a placed shape, without what no model takes.
pub fn triangles(shape: Shape, building: &Building<'_>, path: &str, findings: &mut Findings) -> Placed {
    let Shape { vertices, triangles, mut look_of, .. } = shape;
    look_of.resize(triangles.len(), 0);
    let mut mesh = Mesh { vertices, triangles, look_of };
    // Places on the grid may be the same now though they were not before.
    mesh::weld_equal(&mut mesh);
    let tolerance = building.weld_m.unwrap_or(0.0);
    let moved = match tolerance > 0.0 {
        true => mesh::weld(&mut mesh, tolerance),
        false => 0,
    };
    if moved > 0 {
        let cause = format!("{moved} vertices within {tolerance} m of another were welded to it");
        findings.note(path, "welded", cause, "");
    }
    let cleaning = mesh::clean(&mut mesh);
    let mut tell = |count: usize, rule: &'static str, what: &str, cure: &str| {
        if count > 0 {
            findings.note(path, rule, format!("{count} {what}"), cure);
        }
    };
    tell(cleaning.slivers, "sliver-triangle", "triangles without area were left out", "");
    tell(cleaning.duplicates, "duplicate-triangle", "triangles that were there twice were left out", "");
    tell(
        cleaning.back_to_back,
        "back-to-back",
        "triangles lie back to back with another",
        "give the mesh one side, or every triangle its back for a two-sided one",
    );
    if cleaning.two_sided {
        let cause = "every triangle has its back: the mesh is two-sided";
        findings.note(path, "two-sided", cause, "");
    }
    let splits = mesh::mend(&mut mesh);
    if splits > 0 {
        let cause = format!("triangles were split at {splits} vertices that lay within their edges");
        findings.note(path, "t-junction", cause, "");
        mesh::clean(&mut mesh);
    }
    Placed { mesh: mesh.compact(), two_sided: cleaning.two_sided }
}

/// Tells of edges at which a surface of triangles does not run on.
pub fn tell_oddities(mesh: &Mesh, path: &str, findings: &mut Findings) {
    let adjacency = Adjacency::new(&mesh.triangles);
    let at = |triangle: u32| {
        let place = mesh.corners(triangle as usize)[0];
        format!("the first near ({}, {}, {})", place.x, place.y, place.z)
    };
    if let Some(&first) = adjacency.crowded.first() {
        let cause =
            format!("{} edges are shared by three or more triangles, {}", adjacency.crowded.len(), at(first));
        findings.note(path, "crowded-edge", cause, "there the surface has free edges; take inner walls away");
    }
    if let Some(&first) = adjacency.wound_against.first() {
        let cause = format!(
            "{} edges join neighbours wound against each other, {}",
            adjacency.wound_against.len(),
            at(first)
        );
        findings.note(
            path,
            "winding",
            cause,
            "there the surface has free edges; make the normals consistent",
        );
    }
}
