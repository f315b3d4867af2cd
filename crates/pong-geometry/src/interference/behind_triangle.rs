//! Rule by which points behind a triangle surface are assigned to its triangles, where the prisms behind the
//! faces leave gaps between them (docs/theory.md, 2.2).

use super::nearest_on_triangle::{Place, nearest_on_triangle};
use super::triangle_features::{EdgeClass, TriangleEdges, TriangleView, walk_fan_while};
use crate::Vec3;

/// Returns `true` if a point `p` that is behind the triangle and beyond some of its edges still belongs to
/// the triangle. The part of the triangle nearest to `p` decides:
///
/// * a concave or flat edge, with `p` behind the face across the edge and beyond the edge as seen from that
///   face too: `p` belongs to both faces, so that the direction of the push does not depend on the order of
///   the triangles;
/// * a concave or flat edge, with `p` not behind the face across it: `p` belongs to the triangle if
///   [`TriangleEdges::has_on_seam`] is true, as for a point in front;
/// * a vertex: `p` belongs to the triangle if it is behind all faces around the vertex, and the vertex is the
///   nearest point of each of these faces;
/// * anything else: `p` does not belong to the triangle.
///
/// In the first and the third case, `p` must also be within `thickness` (m) of its nearest point. Up to
/// `slack` (m) from an edge or a face, `p` does not count as beyond the edge or behind the face. The result
/// does not depend on how a flat face is cut into triangles, because `p` belongs to the triangle that
/// contains the nearest point.
pub(super) fn has_behind(edges: &TriangleEdges<'_>, p: &Vec3, thickness: f64, slack: f64) -> bool {
    /// Largest cosine, between an edge and the direction from its vertex to `p`, at which the vertex counts
    /// as nearest. It exceeds zero, so that rounding alone does not exclude the vertex.
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
