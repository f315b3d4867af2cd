//! Cylinder or cone (A) on a plane: what its four places store, and the planes through an edge or a vertex on which they
//! store least (docs/theory.md, 2.8).
//!
//! With the depths δ of the lowest and the highest place of each disc below a plane, A stores ¼k·F, F = Σ max(0, δ)². When
//! the unit normal n of a plane through the point p turns, the depth n·(p − q) of a place q changes by the product of
//! p − q with the change of n, because a place moves along its rim, square to n.

use super::Feature;
use super::end_disc::{UPRIGHT, down};
use super::least_translation::{Limits, Local, newton};
use crate::primitive::Frustum;
use crate::{Mat3, Vec3};

/// A cylinder or a cone on a plane.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Unit normal of the plane, towards the body.
    pub normal_b: Vec3,
    /// Place on the plane, m.
    pub point_b: Vec3,
    /// Depths of the lowest places of discs 0 and 1 below the plane, then of the highest, m; 0 above it.
    pub depths: [f64; 4],
    /// Feature that the plane touches.
    pub feature: Feature,
}

impl Stand {
    /// Returns the body on the plane through a point.
    pub fn new(frustum: &Frustum, normal_b: &Vec3, point_b: &Vec3, feature: Feature) -> Self {
        let sine = normal_b.cross(&frustum.axis).norm();
        let middles = frustum.ends.map(|end| normal_b.dot(&(point_b - end)));
        let low = |disc: usize| (middles[disc] + frustum.radii[disc] * sine).max(0.0);
        // An apex is one place.
        let high = |disc: usize| match frustum.radii[disc] > 0.0 {
            true => (middles[disc] - frustum.radii[disc] * sine).max(0.0),
            false => 0.0,
        };
        let depths = [low(0), low(1), high(0), high(1)];
        Self { normal_b: *normal_b, point_b: *point_b, depths, feature }
    }

    /// F, m².
    pub fn energy(&self) -> f64 {
        let [a, b, c, d] = self.depths.map(|depth| depth * depth);
        (a + b) + (c + d)
    }

    /// Returns true if only the lowest places are below the plane, those of both discs.
    pub fn lies(&self) -> bool {
        let [first, last, high, other] = self.depths;
        first > 0.0 && last > 0.0 && high == 0.0 && other == 0.0
    }

    /// Returns the four places, m.
    pub fn places(&self, frustum: &Frustum) -> [Vec3; 4] {
        let down = down(frustum, &self.normal_b);
        let [first, last] = [0, 1].map(|disc| down * frustum.radii[disc]);
        let [start, end] = frustum.ends;
        [start + first, end + last, start - first, end - last]
    }

    /// Returns the middle of the load, m: of the places with their depths as weights.
    pub fn middle_of_load(&self, frustum: &Frustum) -> Vec3 {
        let load: f64 = self.depths.iter().sum();
        let sum: Vec3 =
            self.places(frustum).iter().zip(self.depths).map(|(place, depth)| place * depth).sum();
        sum / load.max(f64::MIN_POSITIVE)
    }

    /// Returns half of F, and its derivatives when the plane turns about its point.
    fn turning(&self, frustum: &Frustum) -> Local {
        let down = down(frustum, &self.normal_b);
        let around = down.cross(&frustum.axis);
        let sine = self.normal_b.cross(&frustum.axis).norm();
        // The depth of a lowest place bends by R/s, with s the sine of the tilt, that of a highest by −R/s; while both push,
        // their depths differ by 2R·s.
        let of_disc = |disc: usize| {
            let radius = frustum.radii[disc];
            let both = 2.0 * radius * radius;
            if self.depths[disc + 2] > 0.0 {
                both
            } else {
                (self.depths[disc] * radius / sine.max(UPRIGHT)).min(both)
            }
        };
        let mut slope = Vec3::zeros();
        let mut bend: Mat3 = around * around.transpose() * (of_disc(0) + of_disc(1));
        let mut size = 0.0_f64;
        for (place, depth) in self.places(frustum).iter().zip(self.depths).filter(|(_, depth)| *depth > 0.0) {
            let arm = self.point_b - place;
            slope += arm * depth;
            bend += arm * arm.transpose();
            size = size.max(arm.norm());
        }
        let energy = self.energy();
        let slope_b = slope - self.normal_b * self.normal_b.dot(&slope);
        Local { value: energy, slope_b, bend, less: energy, size: size * energy.sqrt() }
    }

    /// Returns the same body on the plane through the same point with another normal.
    fn turned_to(&self, frustum: &Frustum, normal_b: &Vec3) -> Self {
        Self::new(frustum, normal_b, &self.point_b, self.feature)
    }

    /// Returns the plane on which the body stores least beside this one, turned about its point.
    pub fn least_about_point(&self, frustum: &Frustum) -> Self {
        const LIMITS: Limits<'_> = Limits { steps: 40, farthest: 0.3, enough: 0.0, known_b: &[] };
        let normal =
            newton(&self.normal_b, LIMITS, |normal| self.turned_to(frustum, normal).turning(frustum));
        self.turned_to(frustum, &normal)
    }

    /// Returns the plane on which the body stores least between two normals, turned about an edge.
    pub fn least_about_edge(&self, frustum: &Frustum, sector: &Sector) -> Self {
        /// Newton's steps, and halvings where F bends downward.
        const STEPS: usize = 60;
        /// A step that is rounding, rad.
        const ENOUGH: f64 = 1e-15;
        let [mut low, mut high] = sector.normals;
        let mut stand = *self;
        for _ in 0..STEPS {
            let local = stand.turning(frustum);
            let across = sector.toward(&stand.normal_b);
            let slope = across.dot(&local.slope_b);
            let bend = across.dot(&(local.bend * across)) - local.less;
            if local.value <= 0.0 || slope.abs() <= f64::EPSILON * local.size {
                break;
            }
            if slope < 0.0 {
                low = stand.normal_b
            } else {
                high = stand.normal_b
            }
            let step = -slope / bend.max(f64::MIN_POSITIVE);
            if bend > 0.0 && step.abs() <= ENOUGH {
                break;
            }
            let next = (stand.normal_b + across * step.clamp(-1.0, 1.0)).normalize();
            let is_between = sector.toward(&low).dot(&next) > 0.0 && sector.toward(&high).dot(&next) < 0.0;
            let next = if bend > 0.0 && is_between { next } else { (low + high).normalize() };
            if next == stand.normal_b {
                break;
            }
            stand = stand.turned_to(frustum, &next);
        }
        stand
    }
}

/// Normals from that of a face to that of the face across an edge.
#[derive(Clone, Copy, Debug)]
pub struct Sector {
    normals: [Vec3; 2],
    /// Unit vector along the edge, about which the normals turn from the first to the second.
    edge: Vec3,
}

impl Sector {
    /// Creates the sector between two unit normals; `across` is in the plane of the first face, square to the edge, out of
    /// the face.
    pub fn new(first: &Vec3, across: &Vec3, second: &Vec3) -> Self {
        Self { normals: [*first, *second], edge: first.cross(across) }
    }

    /// Returns the direction in which a normal turns.
    fn toward(&self, normal: &Vec3) -> Vec3 {
        self.edge.cross(normal)
    }

    /// Returns the unit normal of the sector that is nearest to a direction.
    pub fn nearest(&self, direction: &Vec3) -> Vec3 {
        let flat = direction - self.edge * self.edge.dot(direction);
        let [first, second] = &self.normals;
        let is_between = self.toward(first).dot(&flat) > 0.0 && self.toward(second).dot(&flat) < 0.0;
        match () {
            () if is_between => flat / flat.norm().max(f64::MIN_POSITIVE),
            () if flat.dot(first) >= flat.dot(second) => *first,
            () => *second,
        }
    }
}
