//! Preparation of a node's triangles: placed, welded, cleaned, mended, with notes of every change.

use super::building::Building;
use crate::affine::Affine;
use crate::findings::Findings;
use crate::mesh::{self, Adjacency, Closed, Mesh, Turned};
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

/// Triangles of a placed shape, without those that model files refuse.
pub fn triangles(shape: Shape, building: &Building<'_>, path: &str, findings: &mut Findings) -> Placed {
    let Shape { vertices, triangles, mut look_of, .. } = shape;
    look_of.resize(triangles.len(), 0);
    let mut mesh = Mesh { vertices, triangles, look_of };
    // Different points may coincide once rounded to the grid.
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
    if !cleaning.two_sided {
        mend(&mut mesh, building, path, findings);
    }
    Placed { mesh: mesh.compact(), two_sided: cleaning.two_sided }
}

/// Corrects winding and fills holes, as requested.
fn mend(mesh: &mut Mesh, building: &Building<'_>, path: &str, findings: &mut Findings) {
    let mut turned = Turned::default();
    if building.outward {
        turned.triangles = mesh::make_alike(mesh);
    }
    if building.close {
        match mesh::close(mesh) {
            Ok(Some(closed)) => {
                let Closed { triangles, area_m2, largest_m2, at, bent_m, .. } = closed;
                let cause = format!(
                    "{} closed with {triangles} triangles: {area_m2:.3e} m² added, the largest {largest_m2:.3e} m² near ({}, {}, {}); corners up to {bent_m:.1e} m off their plane",
                    mesh::count(closed.holes),
                    at.x,
                    at.y,
                    at.z
                );
                findings.note(path, "closed", cause, "");
            }
            Ok(None) => {}
            Err(cause) => {
                let cure =
                    "close it where it was made, or leave --close out; --outward makes triangles run alike";
                findings.fault(path, "not-closed", format!("it cannot be closed: {cause}"), cure);
            }
        }
    }
    if building.outward {
        turned.shells = mesh::turn_outward(mesh).shells;
    }
    if turned.triangles > 0 {
        let cause = format!("{} triangles that ran against their neighbours were turned", turned.triangles);
        findings.note(path, "turned", cause, "");
    }
    if turned.shells > 0 {
        let cause = format!("{} closed surfaces that faced inwards were turned outwards", turned.shells);
        findings.note(path, "turned", cause, "");
    }
}

/// Notes edges at which a surface of triangles is interrupted.
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
        let edges = adjacency.wound_against.len();
        let cause = match mesh::shells(mesh).iter().find_map(|shell| Some((shell.against.first()?, shell))) {
            Some((&triangle, shell)) => {
                let [a, b, c] = mesh.corners(triangle as usize).map(|place| named(&place));
                format!(
                    "{} of {} triangles run against the others, so that {edges} edges are free; the first has the corners {a}, {b}, {c}",
                    shell.against.len(),
                    shell.triangles.len(),
                )
            }
            None => format!("{edges} edges join neighbours wound against each other, {}", at(first)),
        };
        findings.note(path, "winding", cause, "--outward turns them; else make the normals consistent");
    }
    for (triangles, volume_m3) in mesh::facing_inwards(mesh) {
        let cause = format!(
            "a closed surface of {} triangles faces inwards, {}: it holds bodies within its {:.3e} m³, and lets them in from outside",
            triangles.len(),
            at(triangles[0]),
            -volume_m3
        );
        findings.note(path, "inside-out", cause, "--outward turns it; leave it if it is a room");
    }
}

fn named(place: &nalgebra::Vector3<f64>) -> String {
    format!("({}, {}, {})", place.x, place.y, place.z)
}
