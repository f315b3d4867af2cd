//! Assignment of points behind a surface to its triangles, where the prisms that extend behind the faces
//! leave gaps (docs/theory.md, 2.2).

use super::nearest_on_triangle::{Place, nearest_on_triangle};
use super::triangle_features::{EdgeClass, TriangleEdges, TriangleView, walk_fan_while};
use crate::Vec3;

/// Returns `true` if a point `p` that is behind the triangle and beyond some of its edges still belongs to
/// it. The part of the triangle that is nearest to `p` decides:
///
/// * a concave or flat edge, with `p` behind and beyond both of its faces: `p` belongs to both, so that the
///   direction of the push does not depend on the order of the triangles;
/// * such an edge, with `p` not behind the face across it: `has_on_seam` decides, as for a point in front;
/// * a vertex: `p` belongs to the triangle if it is behind all faces around the vertex, and the vertex is the
///   nearest point of each of these faces.
///
/// In the first and the last case, `p` must also be within `thickness` (m) of the nearest point. How a flat
/// face is cut into triangles does not matter, because `p` belongs to the triangle that contains the nearest
/// point. Within `slack` (m) of an edge or a face, `p` does not count as beyond the edge or behind the face.
pub(super) fn has_behind(edges: &TriangleEdges<'_>, p: &Vec3, thickness: f64, slack: f64) -> bool {
    /// Largest cosine, between an edge and the direction from its vertex to `p`, at which the vertex counts
    /// as nearest. Not zero: where only rounding decides between vertex and edge, `p` belongs to both.
    const ALONG_COSINE: f64 = 1e-12;
    let (set, view) = (edges.set, edges.view);
    let (square, place) = nearest_on_triangle(p, &view.corners);
    let is_behind = |t: u32| TriangleView::new(set, t).height(p) <= -slack;
    let within = thickness - slack;
    match place {
        Place::Face => false,
        Place::Edge(k) => {
            let EdgeClass::Silent { neighbor, outward } = edges.class(k) else { return false };
            let is_beyond = outward.dot(&(p - view.edge_ends(k)[0])) > slack;
            match is_behind(neighbor) {
                true => is_beyond && square < within * within,
                false => edges.has_on_seam(k, p),
            }
        }
        Place::Corner(corner) => {
            let arm = p - view.corners[corner];
            let is_of_vertex = |t: u32, at: usize| {
                let corners = set.corners(t);
                let edge = |k: usize| corners[(at + k) % 3] - corners[at];
                let is_along = |edge: Vec3| edge.dot(&arm) > ALONG_COSINE * edge.norm() * arm.norm();
                is_behind(t) && !is_along(edge(1)) && !is_along(edge(2))
            };
            let all = walk_fan_while(set, view.index, corner, is_of_vertex);
            all.is_some_and(|fan| !fan.open) && square < within * within
        }
    }
}
