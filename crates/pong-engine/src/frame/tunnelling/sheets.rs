//! Lines through triangles. What comes from behind passes by right (docs/theory.md, 2.2).

use super::line::{Line, Met};
use pong_geometry::Vec3;
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::primitive::{Ray, RayResponse, TriangleSet};

/// Whether a line goes from the front through a triangle.
pub(super) fn meet(set: &TriangleSet, triangle: u32, line: &Line) -> Option<Met> {
    let ray = along(&line.from_b, &line.to_b)?;
    ray_triangle(&ray, set, triangle, 0.0).map(|_| Met::Through(set.normal(triangle)))
}

/// A ray from one place to another; `None` if they are one.
pub(super) fn along(from: &Vec3, to: &Vec3) -> Option<Ray> {
    let path = to - from;
    let length = path.norm();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let direction = path / length;
    Some(Ray { origin: *from, direction, length, reach: None, response: RayResponse::Normal })
}
