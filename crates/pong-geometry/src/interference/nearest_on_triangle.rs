//! Point of a triangle nearest to a given point, and the side of the surface on which the given point lies.

use super::triangle_features::{TriangleView, lexicographically_before, vertex_is_seen_from_front};
use crate::Vec3;
use crate::primitive::{NO_NEIGHBOR, TriangleSet};

/// Part of a triangle that contains a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Inside the outline.
    Face,
    /// On edge `k`, from corner `k` to the next corner.
    Edge(usize),
    /// At corner `k`.
    Corner(usize),
}

/// Returns the squared distance (m²) between a point and a triangle, and the part of the triangle that
/// contains the nearest point.
///
/// If a point lies outside an edge and projects onto it between the edge's ends, that edge is nearest. Both
/// triangles at an edge measure from the same end, so they agree on whether the edge or a corner is nearest
/// to a point.
pub fn nearest_on_triangle(p: &Vec3, corners: &[Vec3; 3]) -> (f64, Place) {
    let edges = [0, 1, 2].map(|k| corners[(k + 1) % 3] - corners[k]);
    let arms = corners.map(|corner| p - corner);
    let normal = edges[0].cross(&edges[1]);
    let beyond = [0, 1, 2].map(|k| edges[k].cross(&normal).dot(&arms[k]) > 0.0);
    if beyond == [false; 3] {
        let height = normal.dot(&arms[0]);
        return (height * height / normal.norm_squared(), Place::Face);
    }
    for k in (0..3).filter(|&k| beyond[k]) {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let (first, second) = if lexicographically_before(&to, &from) { (to, from) } else { (from, to) };
        let along = second - first;
        let arm = p - first;
        let share = along.dot(&arm) / along.norm_squared();
        if share > 0.0 && share < 1.0 {
            return ((arm - along * share).norm_squared(), Place::Edge(k));
        }
    }
    // The distance to a corner depends on the corner only, so all triangles around it get the same number.
    let mut nearest = (f64::INFINITY, Place::Face);
    for (k, arm) in arms.iter().enumerate() {
        let square = arm.norm_squared();
        if square < nearest.0 {
            nearest = (square, Place::Corner(k));
        }
    }
    nearest
}

/// Returns the point of a triangle nearest to a given point of the triangle's plane.
pub fn nearest_in_plane(p: &Vec3, corners: &[Vec3; 3]) -> Vec3 {
    match nearest_on_triangle(p, corners).1 {
        Place::Face => *p,
        Place::Corner(k) => corners[k],
        Place::Edge(k) => {
            let along = corners[(k + 1) % 3] - corners[k];
            corners[k] + along * ((p - corners[k]).dot(&along) / along.norm_squared())
        }
    }
}

/// Returns `true` if a point is in front of a surface, or on it. `place` is the part of `triangle` that
/// contains the surface point nearest to the given point.
///
/// On an edge, the side follows from the sum of the two face normals, or from the only face normal if the
/// edge is free. At a vertex, it follows from the orientation of the surface around the vertex as seen from
/// the point.
pub fn is_in_front_at(p: &Vec3, set: &TriangleSet, triangle: u32, place: Place) -> bool {
    let view = TriangleView::new(set, triangle);
    match place {
        Place::Face => view.height(p) >= 0.0,
        Place::Edge(k) => {
            let neighbor = set.triangles[triangle as usize].neighbors[k];
            let other = if neighbor == NO_NEIGHBOR { Vec3::zeros() } else { set.normal(neighbor) };
            (view.normal + other).dot(&(p - view.corners[k])) >= 0.0
        }
        Place::Corner(k) => vertex_is_seen_from_front(set, triangle, k, &(p - view.corners[k])),
    }
}
