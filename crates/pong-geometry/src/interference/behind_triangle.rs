//! Assignment of points behind a surface to its triangles, where the prisms behind the faces leave gaps
//! (docs/theory.md, 2.2).

use super::nearest_on_triangle::{Place, nearest_on_triangle};
use super::triangle_features::{EdgeClass, TriangleEdges, TriangleView, walk_fan_while};
use crate::Vec3;

/// Returns `true` if a point behind the triangle, and beyond some of its edges, still belongs to it. The
/// nearest point of the triangle decides:
///
/// * on a silent edge: the point belongs to the triangle in the wedge behind and beyond both faces. It
///   belongs to both of them, so that the direction of the push does not depend on which face is lower;
/// * at a vertex: the point belongs to the triangle if it is behind all faces around the vertex, and the
///   vertex is the nearest point of each.
///
/// In both cases it must be within `thickness` (m) of the nearest point. The triangulation of a face does not
/// matter: the triangle that holds the nearest point also has the point. Within `slack` (m) of an edge or a
/// face the point does not count as beyond or behind it.
pub(super) fn has_behind(edges: &TriangleEdges<'_>, p: &Vec3, thickness: f64, slack: f64) -> bool {
    /// Cosine below which only rounding decides between a vertex and an edge that ends in it: both then have
    /// the point.
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
