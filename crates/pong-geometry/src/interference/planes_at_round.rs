//! Search for the plane behind a cylinder or a cone (B) on which a bar of two half springs (A) stores least
//! (docs/theory.md, 2.8).
//!
//! With h the support function of B, r the radius of A and p₀, p₁ its ends, the energy on the plane with the normal n
//! is ¼k·F with F = Σ eᵢ², eᵢ = max(0, h(n) + r − n·pᵢ). h is the greater one of the support functions of the two
//! rims. F has its least value
//!
//! * at the normal of an end,
//! * at a normal of the wall, along which both rims reach equally far: a search by the angle around the axis,
//! * at a normal that touches one rim: a descent on the unit sphere with the support function of this rim alone.

use super::Feature;
use super::circles::{Across, Reach};
use super::least_translation::{Limits, Local, lattice, least_of_many, newton};
use crate::primitive::Frustum;
use crate::{Mat3, Vec3, divisor};

/// A plane behind B.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// F, m².
    pub energy: f64,
    /// Unit normal, away from B.
    pub normal_b: Vec3,
    /// Depths of A's ends below it, m; negative above.
    pub depths: [f64; 2],
    /// Feature that it touches.
    pub feature: Feature,
}

impl Plane {
    /// Returns the one of two planes that stores less, the first of equal ones.
    fn or(self, other: Self) -> Self {
        if other.energy < self.energy * TIE { other } else { self }
    }
}

/// The bar and the solid.
pub(super) struct BarAtPlanes<'a> {
    /// Ends of A's axis, m.
    pub ends_b: &'a [Vec3; 2],
    /// Radius of A, m.
    pub radius: f64,
    /// The solid B.
    pub frustum: &'a Frustum,
}

/// Energies within this factor count as equal, so that rounding does not choose between equal planes.
const TIE: f64 = 1.0 - 1e-12;

/// Sine of the angle between a normal and B's axis below which the curvature of a rim is not counted as larger.
const UPRIGHT: f64 = 1e-6;

fn energy_of(depths: &[f64; 2]) -> f64 {
    depths.iter().map(|depth| depth.max(0.0) * depth.max(0.0)).sum()
}

impl BarAtPlanes<'_> {
    /// Returns the plane of the least energy; `None` if one stores none. `likely` is a rim, and a normal there near which
    /// the plane is if A is hardly sunk in.
    pub fn least(&self, likely: Option<(usize, Vec3)>) -> Option<Plane> {
        /// Depth, relative to the radius of the rim and to the length of B, below which a minimum at the rim is the only
        /// one that touches none of the sides beside it.
        const SHALLOW: f64 = 0.1;
        let axis = self.frustum.axis;
        let mut best = self.plane(&-axis, Feature::face(1)).or(self.plane(&axis, Feature::face(2)));
        let along = self.ends_b[1] - self.ends_b[0];
        let arms = self.ends_b.map(|end| end - self.frustum.ends[0]);
        let around = Across::new(&axis, &[arms[0] + arms[1], along, arms[0]]);
        for side in around.greatest(|side| self.at_wall(side)).into_iter().flatten() {
            best = best.or(self.plane(&self.frustum.wall_toward(&side).normalize(), Feature::face(0)));
        }
        if let Some((end, normal)) = likely {
            let plane = best.or(self.at_bottom(end, &normal, &[]));
            let depth = SHALLOW * self.frustum.radii[end].min(self.frustum.length);
            if plane.energy < depth * depth {
                return (plane.energy > 0.0).then_some(plane);
            }
        }
        for end in (0..2).filter(|&end| self.frustum.radii[end] > 0.0) {
            if let Some(plane) = self.least_at_rim(end, &around.first_b) {
                best = best.or(plane);
            }
        }
        (best.energy > 0.0).then_some(best)
    }

    /// Returns the best of the planes to which normals across A and normals all around descend with one rim. `side` is a
    /// direction across B's axis that follows from the two.
    fn least_at_rim(&self, end: usize, side: &Vec3) -> Option<Plane> {
        /// Cosine above which two normals lead to one minimum.
        const SAME: f64 = 0.95;
        let axis = self.frustum.axis;
        let across = Across::new(&(self.ends_b[1] - self.ends_b[0]).normalize(), &[axis, *side]);
        let around = lattice([axis, *side, axis.cross(side)]);
        // At the axis the support function of a rim has a kink.
        let is_smooth = |n: &Vec3| n.dot(&axis).abs() < 1.0 - UPRIGHT;
        let starts = across.directions().into_iter().chain(around).filter(is_smooth);
        let energy = |n: &Vec3| self.plane(n, Feature::edge(end)).energy;
        let to_minimum = |n: &Vec3, known: &[Vec3]| self.at_bottom(end, n, known).normal_b;
        let normal = least_of_many(starts, SAME, energy, to_minimum)?;
        Some(self.plane(&normal, Feature::edge(end)))
    }

    /// Returns the plane of a local minimum with the support function of one rim, by descent from a normal, or one beside a
    /// minimum of `known`.
    fn at_bottom(&self, end: usize, normal: &Vec3, known: &[Vec3]) -> Plane {
        let limits = Limits { steps: 60, farthest: 0.3, enough: 0.0, known_b: known };
        self.plane(&newton(normal, limits, |n| self.near(end, n)), Feature::edge(end))
    }

    fn plane(&self, normal: &Vec3, feature: Feature) -> Plane {
        let depths = self.ends_b.map(|end| self.radius + self.frustum.support_from(normal, &end));
        Plane { energy: energy_of(&depths), normal_b: *normal, depths, feature }
    }

    /// Returns −F at the normal of the wall on the side to which the unit vector `side` points.
    fn at_wall(&self, side: &Vec3) -> Reach {
        let Frustum { axis, radii, wall, ends, .. } = self.frustum;
        let normal = self.frustum.wall_toward(side);
        let turning = axis.cross(side) * wall[1];
        let mut sum = Reach { depth: 0.0, slope: 0.0 };
        for end in *self.ends_b {
            let arm = end - ends[0];
            let depth = (self.radius + radii[0] * wall[1] - normal.dot(&arm)).max(0.0);
            sum.depth -= depth * depth;
            sum.slope += 2.0 * depth * turning.dot(&arm);
        }
        sum
    }

    /// Returns the depths of A's ends below the plane that touches a rim, the vectors from them to the place on the rim,
    /// and the direction of the rim there times the component of the normal across the axis.
    fn at_rim(&self, end: usize, normal: &Vec3) -> ([f64; 2], [Vec3; 2], Vec3) {
        let Frustum { axis, radii, ends, .. } = self.frustum;
        let level = axis.cross(normal);
        let up = level.cross(axis);
        let place = ends[end] + up * (radii[end] / divisor(up.norm()));
        let arms = self.ends_b.map(|end| place - end);
        (arms.map(|arm| self.radius + normal.dot(&arm)), arms, level)
    }

    /// Returns F with its derivatives on the unit sphere, for the support function of one rim.
    fn near(&self, end: usize, normal: &Vec3) -> Local {
        let (depths, arms, level) = self.at_rim(end, normal);
        let (mut slope, mut bend, mut load, mut reach) = (Vec3::zeros(), Mat3::zeros(), 0.0, 0.0_f64);
        for (depth, arm) in depths.into_iter().zip(&arms) {
            if depth > 0.0 {
                slope += arm * depth;
                bend += arm * arm.transpose();
                load += depth;
                reach = reach.max(arm.amax());
            }
        }
        let size = level.norm().max(UPRIGHT);
        let curved = load * self.frustum.radii[end] / (size * size * size);
        let along = normal.dot(&slope);
        Local {
            value: energy_of(&depths),
            slope_b: slope - normal * along,
            bend: bend + level * level.transpose() * curved,
            less: along,
            size: load * reach,
        }
    }
}
