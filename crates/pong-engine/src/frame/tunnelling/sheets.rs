//! Paths through triangles. A path from behind is no tunnelling (docs/theory.md, 2.2).

use super::line::{Line, Met};
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::primitive::{Ray, TriangleSet};

/// Outcome of a path through a triangle from the front; `None` if the path does not cross it from there.
pub(super) fn meet(set: &TriangleSet, triangle: u32, line: &Line) -> Option<Met> {
    let ray = Ray::between(&line.from_b, &line.to_b)?;
    ray_triangle(&ray, set, triangle, 0.0).map(|_| Met::Through(set.normal(triangle)))
}
