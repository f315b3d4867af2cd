//! Polygons in space: area, plane, width, overlap.

use pong_geometry::Vec3;

/// Twice the area along the polygon's normal (Newell's rule), relative to its first corner.
pub(super) fn area_vector(corners: &[Vec3]) -> Vec3 {
    let first = corners[0];
    corners.windows(2).skip(1).map(|pair| (pair[0] - first).cross(&(pair[1] - first))).sum()
}

/// Unit normal and offset: Newell's normal through the mean of the corners. The polygon has an area.
pub(crate) fn plane_of(corners: &[Vec3]) -> (Vec3, f64) {
    let normal = unit(&area_vector(corners));
    (normal, normal.dot(&mean(corners)))
}

/// A unit vector without overflow at any size.
pub(super) fn unit(v: &Vec3) -> Vec3 {
    (v / v.amax()).normalize()
}

pub(super) fn mean(corners: &[Vec3]) -> Vec3 {
    // Relative to one corner, so that a far origin costs no digits.
    let first = corners[0];
    first + corners.iter().map(|corner| corner - first).sum::<Vec3>() / corners.len() as f64
}

/// Each corner with the next one.
pub(super) fn edges<T: Copy>(outline: &[T]) -> impl Iterator<Item = (T, T)> + '_ {
    outline.iter().copied().zip(outline.iter().copied().cycle().skip(1))
}

/// The smallest distance between two parallel lines that hold the polygon: one of them lies along an edge.
pub(super) fn width(corners: &[Vec3]) -> f64 {
    let across = |a: Vec3, b: Vec3| {
        let along = unit(&(b - a));
        corners.iter().map(|c| (c - a).cross(&along).norm()).fold(0.0, f64::max)
    };
    edges(corners).map(|(a, b)| across(a, b)).fold(f64::INFINITY, f64::min)
}

pub(super) fn longest_edge(corners: &[Vec3]) -> f64 {
    edges(corners).map(|(a, b)| (b - a).norm()).fold(0.0, f64::max)
}

/// Area that two convex polygons of opposite normals share, seen along `normal` (the first one's).
pub(crate) fn overlap_area(first: &[Vec3], second: &[Vec3], normal: &Vec3) -> f64 {
    let mut rest = first.to_vec();
    // The second runs clockwise seen along the first's normal.
    for (b, a) in edges(second) {
        let inward = normal.cross(&(b - a));
        rest = clipped(&rest, &a, &inward);
        if rest.len() < 3 {
            return 0.0;
        }
    }
    0.5 * area_vector(&rest).dot(normal)
}

/// The area of a polygon.
pub(crate) fn area(corners: &[Vec3]) -> f64 {
    0.5 * area_vector(corners).norm()
}

/// The part of a polygon on the inner side of a line.
fn clipped(polygon: &[Vec3], on_line: &Vec3, inward: &Vec3) -> Vec<Vec3> {
    let mut inside = Vec::with_capacity(polygon.len() + 1);
    for (a, b) in edges(polygon) {
        let (height_a, height_b) = (inward.dot(&(a - on_line)), inward.dot(&(b - on_line)));
        if height_a >= 0.0 {
            inside.push(a);
        }
        if (height_a > 0.0 && height_b < 0.0) || (height_a < 0.0 && height_b > 0.0) {
            inside.push(a + (b - a) * (height_a / (height_a - height_b)));
        }
    }
    inside
}
