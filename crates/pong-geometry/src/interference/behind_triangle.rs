//! Which points behind a triangle belong to it, where the prisms below the faces of a surface leave space between them
//! (docs/theory.md, 2.2).

use super::nearest_on_triangle::{Place, nearest_on_triangle};
use super::triangle_features::{EdgeClass, TriangleEdges, TriangleView, walk_fan_while};
use crate::Vec3;

/// Whether a point behind the triangle, and beyond some of its edges, still belongs to it. The place of the triangle that
/// is nearest to the point decides:
///
/// * on a silent edge, it does in the wedge behind and beyond both faces, which belongs to both: which is the lower must
///   not decide which way the point is pushed;
/// * at a vertex, it does behind all faces that meet there, if the vertex is the nearest place of each.
///
/// In either case it does so as far as `thickness` (m) from that place. How the faces are cut does not matter: of the
/// triangles of a face the one that has the place nearest to the point also has the point. What is no more than `slack`
/// (m) beyond an edge or behind a face is not.
pub(super) fn has_behind(edges: &TriangleEdges<'_>, p: &Vec3, thickness: f64, slack: f64) -> bool {
    /// Cosine below which rounding alone tells whether a vertex or an edge that ends in it is nearer: both have the point.
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
