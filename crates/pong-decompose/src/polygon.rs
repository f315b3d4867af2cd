//! Convex polygons in space: clipping, areas, differences.

use nalgebra::Vector3;
use pong_import::mesh::ring;

/// The half space `normal·x ≤ offset`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plane {
    pub(crate) normal: Vector3<f64>,
    pub(crate) offset: f64,
}

/// A convex outline, counter-clockwise seen from the side to which the normal points.
pub(crate) type Polygon = Vec<Vector3<f64>>;

impl Plane {
    /// The half space below (or above) a coordinate.
    pub(crate) fn across(axis: usize, at: f64, above: bool) -> Self {
        let sign = if above { -1.0 } else { 1.0 };
        Self { normal: Vector3::ith(axis, sign), offset: sign * at }
    }

    pub(crate) fn height(&self, place: &Vector3<f64>) -> f64 {
        self.normal.dot(place) - self.offset
    }

    pub(crate) fn flipped(&self) -> Self {
        Self { normal: -self.normal, offset: -self.offset }
    }

    pub(crate) fn shifted(&self, by: f64) -> Self {
        Self { offset: self.offset + by, ..*self }
    }

    /// Crossing of the line from `a` to `b` with the plane; independent of the order of the ends, bit for
    /// bit.
    pub(crate) fn crossing(&self, a: &Vector3<f64>, b: &Vector3<f64>) -> Vector3<f64> {
        let (a, b) = if lexicographic(a, b).is_le() { (a, b) } else { (b, a) };
        let (height_a, height_b) = (self.height(a), self.height(b));
        let mut place = a + (b - a) * (height_a / (height_a - height_b));
        // On an axis-aligned plane that coordinate is exact.
        if let Some(axis) = (0..3).find(|&axis| self.normal[axis].abs() == 1.0) {
            place[axis] = self.offset * self.normal[axis];
        }
        place
    }
}

pub(crate) fn lexicographic(a: &Vector3<f64>, b: &Vector3<f64>) -> std::cmp::Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// Area times normal.
pub(crate) fn area_vector(polygon: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(first) = polygon.first() else { return Vector3::zeros() };
    0.5 * ring(polygon).map(|(a, b)| (a - first).cross(&(b - first))).sum::<Vector3<f64>>()
}

pub(crate) fn area(polygon: &[Vector3<f64>]) -> f64 {
    area_vector(polygon).norm()
}

/// The plane of an outline, through the mean of its corners.
pub(crate) fn plane_of(polygon: &[Vector3<f64>]) -> Plane {
    let normal = area_vector(polygon).normalize();
    let first = polygon[0];
    let mean = polygon.iter().map(|place| place - first).sum::<Vector3<f64>>() / polygon.len() as f64;
    Plane { normal, offset: normal.dot(&(first + mean)) }
}

/// Width: the least, over all edges, of the extent across the edge.
pub(crate) fn width(polygon: &[Vector3<f64>]) -> f64 {
    let across = |(a, b): (Vector3<f64>, Vector3<f64>)| {
        let along = (b - a).normalize();
        polygon.iter().map(|place| (place - a).cross(&along).norm()).fold(0.0, f64::max)
    };
    ring(polygon).filter(|(a, b)| a != b).map(across).fold(f64::INFINITY, f64::min)
}

/// The part of a polygon in a half space.
pub(crate) fn clip(polygon: &[Vector3<f64>], plane: &Plane) -> Polygon {
    let mut inside = Polygon::with_capacity(polygon.len() + 1);
    for (a, b) in ring(polygon) {
        let (height_a, height_b) = (plane.height(&a), plane.height(&b));
        if height_a <= 0.0 {
            inside.push(a);
        }
        if (height_a < 0.0 && height_b > 0.0) || (height_a > 0.0 && height_b < 0.0) {
            inside.push(plane.crossing(&a, &b));
        }
    }
    inside
}

/// Half spaces whose intersection is the prism over a polygon; normals point outwards.
pub(crate) fn sides(polygon: &[Vector3<f64>], normal: &Vector3<f64>) -> Vec<Plane> {
    ring(polygon)
        .filter(|(a, b)| a != b)
        .map(|(a, b)| {
            let mut outward = (b - a).cross(normal).normalize();
            // Edges along an axis give axis-aligned planes; rounding must not tilt them.
            if let Some(axis) = (0..3).find(|&axis| (outward[axis].abs() - 1.0).abs() < 1e-14) {
                outward = Vector3::ith(axis, outward[axis].signum());
            }
            Plane { normal: outward, offset: outward.dot(&a) }
        })
        .collect()
}

/// Intersection of two coplanar polygons.
pub(crate) fn common(one: &[Vector3<f64>], other: &[Vector3<f64>], normal: &Vector3<f64>) -> Polygon {
    sides(other, normal).iter().fold(one.to_vec(), |rest, side| clip(&rest, side))
}

/// Difference of coplanar convex polygons and another: convex polygons, none narrower than `least_m`.
pub(crate) fn without(
    polygons: &[Polygon],
    taken: &[Vector3<f64>],
    normal: &Vector3<f64>,
    least_m: f64,
) -> Vec<Polygon> {
    let mut left = Vec::new();
    let sides = sides(taken, normal);
    for polygon in polygons {
        let mut rest = polygon.clone();
        let mut outer = Vec::new();
        for side in &sides {
            let beyond = clip(&rest, &side.flipped());
            if is_wide(&beyond, least_m) {
                outer.push(beyond);
            }
            rest = clip(&rest, side);
            if rest.len() < 3 {
                break;
            }
        }
        match is_wide(&rest, least_m) {
            true => left.extend(outer),
            // The overlap is negligible: nothing is cut.
            false => left.push(polygon.clone()),
        }
    }
    left
}

pub(crate) fn is_wide(polygon: &[Vector3<f64>], least_m: f64) -> bool {
    polygon.len() > 2 && area(polygon) > 0.0 && width(polygon) > least_m
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, size: f64) -> Polygon {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]
            .map(|(u, v)| Vector3::new(x + u * size, y + v * size, 2.0))
            .to_vec()
    }

    #[test]
    fn areas_of_what_is_common_and_what_is_left_add_up() {
        let up = Vector3::z();
        let whole = square(0.0, 0.0, 4.0);
        for other in
            [square(1.0, 1.0, 2.0), square(3.0, -1.0, 2.0), square(-1.0, -1.0, 9.0), square(5.0, 0.0, 1.0)]
        {
            let shared = area(&common(&whole, &other, &up));
            let left: f64 =
                without(std::slice::from_ref(&whole), &other, &up, 1e-9).iter().map(|p| area(p)).sum();
            assert!((shared + left - 16.0).abs() < 1e-12, "{shared} {left}");
        }
        assert_eq!(area(&common(&whole, &square(3.0, -1.0, 2.0), &up)), 1.0);
    }

    #[test]
    fn a_crossing_has_the_same_bits_from_both_ends() {
        let plane = Plane { normal: Vector3::new(0.6, 0.0, 0.8), offset: 0.37 };
        let (a, b) = (Vector3::new(0.1, 0.2, -0.3), Vector3::new(0.7, 1.1, 0.9));
        assert_eq!(plane.crossing(&a, &b), plane.crossing(&b, &a));
        let across = Plane::across(1, 0.7, true);
        assert_eq!(across.crossing(&a, &b).y, 0.7);
    }

    #[test]
    fn widths_are_least_extents() {
        let thin = [(0.0, 0.0), (3.0, 0.0), (3.0, 0.1), (0.0, 0.1)].map(|(x, y)| Vector3::new(x, y, 0.0));
        assert!((width(&thin) - 0.1).abs() < 1e-15);
    }
}
