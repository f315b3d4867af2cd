//! Lines through triangles. What comes from behind passes by right (docs/theory.md, 2.2).

use super::line::{Line, Met};
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::primitive::{Ray, TriangleSet};

/// Whether a line goes from the front through a triangle.
pub(super) fn meet(set: &TriangleSet, triangle: u32, line: &Line) -> Option<Met> {
    let ray = Ray::between(&line.from_b, &line.to_b)?;
    ray_triangle(&ray, set, triangle, 0.0).map(|_| Met::Through(set.normal(triangle)))
}
