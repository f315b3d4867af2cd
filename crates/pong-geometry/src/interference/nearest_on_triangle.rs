//! The point of a triangle nearest to a given point, and on which side of the surface that point lies there.

use super::triangle_features::{TriangleView, vertex_is_seen_from_front};
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
pub fn nearest_on_triangle(p: &Vec3, corners: &[Vec3; 3]) -> (f64, Place) {
    let edges = [0, 1, 2].map(|k| corners[(k + 1) % 3] - corners[k]);
    let arms = corners.map(|corner| p - corner);
    let normal = edges[0].cross(&edges[1]);
    if (0..3).all(|k| edges[k].cross(&normal).dot(&arms[k]) <= 0.0) {
        let height = normal.dot(&arms[0]);
        return (height * height / normal.norm_squared(), Place::Face);
    }
    let mut nearest = (f64::INFINITY, Place::Face);
    for k in 0..3 {
        let share = edges[k].dot(&arms[k]) / edges[k].norm_squared();
        // A corner is measured by itself, so that all triangles around it come to the same number.
        let (arm, place) = if share <= 0.0 {
            (arms[k], Place::Corner(k))
        } else if share >= 1.0 {
            (arms[(k + 1) % 3], Place::Corner((k + 1) % 3))
        } else {
            (arms[k] - edges[k] * share, Place::Edge(k))
        };
        let square = arm.norm_squared();
        if square < nearest.0 {
            nearest = (square, place);
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
