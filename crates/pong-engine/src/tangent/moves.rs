//! Motion of a contact with the relative pose of its two bodies: depth, normal and deepest point.
//!
//! A moves relative to B by a small translation u of the material point of A at B's origin, and by a small rotation
//! φ; all in B's frame, in which B is at rest. A's deepest point a and B's point b = a + δ·n follow the
//! normal as the shapes of the two surfaces tell ([`Shape`]):
//!
//! ```text
//! da = u(a) + A's slide − H_A·(dn − φ × n)      db = B's slide + H_B·dn      db = da + dδ·n + δ·dn
//! ```
//!
//! Since n·da, n·db and n·dn hold no slide, dδ = −n·u(a). The tangential part gives dn and the slides.

use super::shape::Shape;
use nalgebra::{Matrix2, Matrix3x6, RowVector6, Vector2};
use pong_geometry::pose::{displacement_slopes, turn_slopes};
use pong_geometry::{Mat3, Vec3};

/// Derivatives of a contact with respect to (u, φ): 3 translations, m, and 3 rotations, rad.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moves {
    /// Depth.
    pub depth: RowVector6<f64>,
    /// Normal.
    pub normal: Matrix3x6<f64>,
    /// Deepest point of A.
    pub deepest: Matrix3x6<f64>,
}

/// Contact as its tester gives it, in B's frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Touch {
    pub normal_b: Vec3,
    pub depth: f64,
    /// Deepest point of A, m.
    pub deepest_b: Vec3,
}

impl Touch {
    /// Moves of the contact; `None` where the shapes determine none: A is flat, or both are straight and parallel.
    pub fn moves(&self, a: &Shape, b: &Shape) -> Option<Moves> {
        let moved = displacement_slopes(&self.deepest_b);
        let depth = -(self.normal_b.transpose() * moved);
        let turned = turn_slopes(&self.normal_b);
        let (normal, deepest) = match (a, b) {
            (Shape::Flat, _) => return None,
            (Shape::Round(h), Shape::Flat) => (Matrix3x6::zeros(), moved + h * turned),
            (Shape::Straight { .. }, Shape::Flat) => return None,
            (Shape::Round(ha), Shape::Round(hb)) => {
                let normal =
                    self.in_plane(&(ha + hb - Mat3::identity() * self.depth))? * (moved + ha * turned);
                (normal, moved - ha * (normal - turned))
            }
            (Shape::Round(h), Shape::Straight { along, radius }) => {
                let across = self.normal_b.cross(along);
                let gap = across.dot(&(h * across)) + radius - self.depth;
                let terms = h.amax() + radius.abs() + self.depth;
                let normal = across * (across.transpose() * (moved + h * turned)) * inverse(gap, terms)?;
                (normal, moved - h * (normal - turned))
            }
            (Shape::Straight { along, radius }, Shape::Round(h)) => {
                let across = self.normal_b.cross(along);
                let rest = h - Mat3::identity() * self.depth;
                let gap = across.dot(&(rest * across)) + radius;
                let terms = h.amax() + radius.abs() + self.depth;
                let free = across * (across.transpose() * (moved - rest * turned)) * inverse(gap, terms)?;
                let normal = turned + free;
                (normal, self.moved_with_b(&(h * normal), &depth, &normal))
            }
            (Shape::Straight { along, radius }, Shape::Straight { along: other, radius: of_b }) => {
                let normal = self.across_both(along, other, &turned)?;
                let across = [self.normal_b.cross(along), self.normal_b.cross(other)];
                let of_a = across[0] * (across[0].transpose() * (normal - turned)) * *radius;
                let side_b = across[1] * (across[1].transpose() * normal) * *of_b;
                // What the two slides, along and other, have to bridge.
                let rest = side_b - (moved - of_a) - normal * self.depth;
                let slide = self.slide(along, other, &rest)?;
                (normal, moved - of_a + along * slide)
            }
        };
        Some(Moves { depth, normal, deepest })
    }

    /// Motion of A's point from that of B's.
    fn moved_with_b(
        &self,
        of_b: &Matrix3x6<f64>,
        depth: &RowVector6<f64>,
        normal: &Matrix3x6<f64>,
    ) -> Matrix3x6<f64> {
        of_b - self.normal_b * depth - normal * self.depth
    }

    /// Inverse of a matrix in the contact plane, zero along the normal.
    fn in_plane(&self, matrix: &Mat3) -> Option<Mat3> {
        let [e, f] = plane_axes(&self.normal_b);
        let at = |x: &Vec3, y: &Vec3| x.dot(&(matrix * y));
        let inverse = Matrix2::new(at(&e, &e), at(&e, &f), at(&f, &e), at(&f, &f)).try_inverse()?;
        let of = |x: &Vec3, y: &Vec3, factor: f64| x * y.transpose() * factor;
        Some(
            of(&e, &e, inverse[(0, 0)])
                + of(&e, &f, inverse[(0, 1)])
                + of(&f, &e, inverse[(1, 0)])
                + of(&f, &f, inverse[(1, 1)]),
        )
    }

    /// Turn of the normal that stays perpendicular to an edge of A, which turns with A, and to an edge of B.
    fn across_both(&self, along: &Vec3, other: &Vec3, turned: &Matrix3x6<f64>) -> Option<Matrix3x6<f64>> {
        let [e, f] = plane_axes(&self.normal_b);
        let rows = Matrix2::new(along.dot(&e), along.dot(&f), other.dot(&e), other.dot(&f));
        let inverse = well_inverted(&rows)?;
        let needed = along.transpose() * turned;
        Some((e * inverse[(0, 0)] + f * inverse[(1, 0)]) * needed)
    }

    /// Slide along A's edge, so that the rest is a slide along B's edge.
    fn slide(&self, along: &Vec3, other: &Vec3, rest: &Matrix3x6<f64>) -> Option<RowVector6<f64>> {
        let across = self.normal_b.cross(other);
        Some(across.transpose() * rest * inverse(across.dot(along), 1.0)?)
    }
}

/// Two unit vectors perpendicular to a normal and to each other: the three are right-handed.
pub(super) fn plane_axes(normal: &Vec3) -> [Vec3; 2] {
    let e = pong_geometry::any_perpendicular(normal);
    [e, normal.cross(&e)]
}

/// Inverse of a number; `None` for zero to rounding, relative to the size of its terms.
fn inverse(number: f64, terms: f64) -> Option<f64> {
    /// Rounding of a sum of a few terms.
    const ROUNDING: f64 = 1e-12;
    (number.abs() > ROUNDING * terms).then(|| 1.0 / number.abs().max(f64::MIN_POSITIVE).copysign(number))
}

/// Inverse of a matrix; `None` if its rows are parallel.
fn well_inverted(matrix: &Matrix2<f64>) -> Option<Matrix2<f64>> {
    /// Sine between the rows below which a turn of the normal is known to less than half of the digits.
    const PARALLEL: f64 = 1e-9;
    let [first, second] = [0, 1].map(|row| Vector2::new(matrix[(row, 0)], matrix[(row, 1)]).norm());
    (matrix.determinant().abs() > PARALLEL * first * second).then(|| matrix.try_inverse()).flatten()
}
