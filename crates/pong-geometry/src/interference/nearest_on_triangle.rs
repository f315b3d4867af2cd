//! The point of a triangle nearest to a given point, and on which side of the surface that point lies there.

use super::triangle_features::{TriangleView, lexicographically_before, vertex_is_seen_from_front};
use crate::Vec3;
use crate::primitive::{NO_NEIGHBOR, TriangleSet};

/// Where in a triangle a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Within the outline.
    Face,
    /// On edge `k`, from corner `k` to the next.
    Edge(usize),
    /// At corner `k`.
    Corner(usize),
}

/// The square of the distance (m²) between a point and a triangle, and where in the triangle the nearest point lies.
///
/// A point that lies beyond an edge, and between its ends, has its nearest point on it. Where an edge ends is worked out in
/// one direction, whichever of its two triangles asks: so they never disagree on whether a point belongs to the edge or to
/// its corner.
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
    // A corner is measured by itself, so that all triangles around it come to the same number.
    let mut nearest = (f64::INFINITY, Place::Face);
    for (k, arm) in arms.iter().enumerate() {
        let square = arm.norm_squared();
        if square < nearest.0 {
            nearest = (square, Place::Corner(k));
        }
    }
    nearest
}

/// The point of a triangle nearest to a given point of its plane.
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

/// Whether a point is in front of a surface whose nearest point lies at `place` of a triangle; a point on the surface is.
///
/// On an edge the sum of the normals that meet there decides, at a vertex the sense in which the surface runs around it,
/// seen from the point; at a free edge the one face.
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
