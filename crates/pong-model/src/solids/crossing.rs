//! Triangles of a mesh that cross each other: the mesh then has no inside.

use super::facets::Facet;
use crate::solid_tree::SolidTree;
use pong_geometry::Vec3;

/// Distance, relative to the diameter, up to which triangles touch rather than cross. Regions are touched from the same
/// distance, relative to their greatest height.
pub(super) const TOUCH: f64 = 1e-9;

/// Two triangles that cross, and a place where they do.
pub(super) struct Crossing {
    /// Indices of the triangles, the lower first.
    pub(super) triangles: [usize; 2],
    pub(super) place: Vec3,
}

/// First two triangles of a mesh of which an edge of one pierces the inside of the other; `None` if there are none.
/// `tree` has the boxes around the triangles.
pub(super) fn crossing(facets: &[Facet], tree: &SolidTree, diameter: f64) -> Option<Crossing> {
    let tolerance = TOUCH * diameter;
    let mut first: Option<Crossing> = None;
    tree.meeting_pairs(&mut |one, other| {
        let triangles = [one.min(other) as usize, one.max(other) as usize];
        if first.as_ref().is_some_and(|known| known.triangles < triangles) {
            return;
        }
        let [a, b] = triangles.map(|number| &facets[number]);
        if let Some(place) = pierced(a, b, tolerance).or_else(|| pierced(b, a, tolerance)) {
            first = Some(Crossing { triangles, place });
        }
    });
    first
}

/// Place where an edge of one triangle passes through the inside of another. An edge that ends within `tolerance` (m)
/// of the plane does not, so triangles with a common vertex or edge need no exception.
fn pierced(triangle: &Facet, by: &Facet, tolerance: f64) -> Option<Vec3> {
    let depths = [0, 1, 2].map(|k| triangle.plane.depth(&by.corners[k]));
    let corners = &triangle.corners;
    (0..3).find_map(|from| {
        let to = (from + 1) % 3;
        let [one, two] = [depths[from], depths[to]];
        if one.abs().min(two.abs()) <= tolerance || (one > 0.0) == (two > 0.0) {
            return None;
        }
        let place = by.corners[from] + (by.corners[to] - by.corners[from]) * (one / (one - two));
        let is_inside = (0..3).all(|k| {
            let edge = corners[(k + 1) % 3] - corners[k];
            let height = edge.cross(&(place - corners[k])).dot(&triangle.plane.normal_b);
            height > tolerance * edge.norm()
        });
        is_inside.then_some(place)
    })
}
