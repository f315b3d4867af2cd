//! Cylinder or cone (A) on a plane through an edge or a vertex of triangles: where it stores least (docs/theory.md, 2.8).

use super::Feature;
use super::frustum_plane::{OnPlane, size_of};
use super::least_translation::{Limits, Local, newton};
use crate::Vec3;
use crate::primitive::Frustum;

/// A cylinder or a cone on a plane.
#[derive(Clone, Copy, Debug)]
pub struct Stand {
    /// Unit normal of the plane, towards the body.
    pub normal_b: Vec3,
    /// Place on the plane, m.
    pub point_b: Vec3,
    /// Feature that the plane touches.
    pub feature: Feature,
    /// The body on it.
    pub at: OnPlane,
}

impl Stand {
    /// Returns the body on the plane through a point.
    pub fn new(frustum: &Frustum, normal_b: &Vec3, point_b: &Vec3, feature: Feature) -> Self {
        let at = OnPlane::new(frustum, normal_b, frustum.ends.map(|end| normal_b.dot(&(point_b - end))));
        Self { normal_b: *normal_b, point_b: *point_b, feature, at }
    }

    /// Returns true if only the lowest places are below the plane, those of both discs.
    pub fn lies(&self) -> bool {
        let [first, last, high, other] = self.at.depths;
        first > 0.0 && last > 0.0 && high == 0.0 && other == 0.0
    }

    /// Returns true if the highest place of a disc is below the plane, too.
    pub fn is_sunk(&self) -> bool {
        self.at.depths[2] > 0.0 || self.at.depths[3] > 0.0
    }

    /// Returns F, and the derivatives of half of it when the plane turns about its point.
    fn turning(&self, frustum: &Frustum) -> Local {
        self.at.about((frustum, size_of(frustum)), &self.point_b, &self.normal_b)
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
