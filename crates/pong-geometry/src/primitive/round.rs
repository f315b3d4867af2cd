//! Round parts: capsule, cylinder, cone and bore (docs/theory.md, 2.8).

use super::curved::Ellipsoid;
use super::facts::{
    Curved, Drawing, Primitive, Round, Stroke, box_around, distance_m, ends_and_middle, on_axis,
};
use crate::bounding::{Bounded, Dilated, PointCloud, ball_representatives, largest};
use crate::{Mat3, Transform, Vec3};
use std::borrow::Cow;

/// All points within a radius of a straight segment: a cylinder with a hemisphere at each end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    /// Centres of the two hemispheres, m; distinct. Their numbers, 0 and 1, are part of the keys of the
    /// capsule's contacts.
    pub ends: [Vec3; 2],
    /// Radius, m, positive.
    pub radius: f64,
}

/// Straight frustum of a cone. It is the solid of a cylinder (equal radii) or of a cone, or the hole of a
/// bore.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frustum {
    /// Centres of the two end circles, m.
    pub ends: [Vec3; 2],
    /// Radius at each end, m; not negative, and not both zero.
    pub radii: [f64; 2],
    /// Unit vector from end 0 to end 1.
    pub axis: Vec3,
    /// Distance between the ends, m. Zero for a disc.
    pub length: f64,
    /// Outward unit normal of the lateral surface, in a half plane bounded by the axis: axial component, then
    /// radial component (positive).
    pub wall: [f64; 2],
}

/// Inner wall of a round or tapered hole, open at both ends. It pushes towards its axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bore {
    /// The hole.
    pub hole: Frustum,
    /// Distance behind the wall within which a shape is still pushed back into the hole, m.
    pub thickness: f64,
    /// For each end, true if the hole ends there in a convex edge (mouth) that pushes shapes leaning on it;
    /// false if the hole continues as another bore.
    pub mouths: [bool; 2],
}

impl Bore {
    /// Returns `true` if a point is past an end of the bore. `inside` is its signed distance from the end
    /// (any unit), positive inside. A point exactly at an end is past it only at end 1, and only if the hole
    /// continues there as another bore. So a point on the seam of two bores in line belongs to one of them.
    #[inline]
    pub(crate) fn is_past(&self, end: usize, inside: f64) -> bool {
        inside < 0.0 || (inside == 0.0 && end == 1 && !self.mouths[end])
    }
}

impl Capsule {
    /// Returns the capsule transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), radius: self.radius }
    }

    /// Returns the lowest and the highest corner of the capsule's bounding box, along the axes of the frame,
    /// m.
    #[inline]
    pub fn region(&self, _meets_triangles: bool) -> (Vec3, Vec3) {
        let [a, b] = &self.ends;
        (a.inf(b).add_scalar(-self.radius), a.sup(b).add_scalar(self.radius))
    }
}

impl Frustum {
    /// Creates the frustum between two distinct points, m, with a radius at each, m. The radii must not be
    /// negative, and not both zero.
    pub fn new(ends: [Vec3; 2], radii: [f64; 2]) -> Self {
        let between = ends[1] - ends[0];
        let length = between.norm();
        let widening = radii[1] - radii[0];
        let slant = (length * length + widening * widening).sqrt();
        let wall = [-widening / slant, length / slant];
        Self { ends, radii, axis: between / length, length, wall }
    }

    /// Returns the outward unit normal of the lateral surface in the half plane through the axis and a point, which
    /// must not lie on the axis.
    pub fn wall_normal(&self, place: &Vec3) -> Vec3 {
        let arm = place - self.ends[0];
        let across = arm - self.axis * self.axis.dot(&arm);
        // Clamped, for a point on the axis: the normal then has no direction from it.
        self.axis * self.wall[0] + across * (self.wall[1] / across.norm().max(f64::MIN_POSITIVE))
    }

    /// Returns the outward unit normal of the lateral surface on the side to which `side` points, a unit vector
    /// perpendicular to the axis.
    pub fn wall_toward(&self, side: &Vec3) -> Vec3 {
        self.axis * self.wall[0] + side * self.wall[1]
    }

    /// Returns the disc at one end: a frustum of length zero.
    pub fn disc(&self, end: usize) -> Self {
        Self {
            ends: [self.ends[end]; 2],
            radii: [self.radii[end]; 2],
            axis: self.axis,
            length: 0.0,
            wall: [0.0, 1.0],
        }
    }

    /// Returns the disc at one end as an ellipsoid whose semi-axis along the axis is [`Self::FLAT`] of the radius; for
    /// an apex a ball that small. Its last principal axis is that of the frustum.
    pub fn flat_ellipsoid(&self, end: usize) -> Ellipsoid {
        let largest = self.radii[0].max(self.radii[1]);
        let across = crate::any_perpendicular(&self.axis);
        let axes = Mat3::from_columns(&[across, self.axis.cross(&across), self.axis]);
        let radius = self.radii[end].max(Self::FLAT * largest);
        Ellipsoid { center: self.ends[end], axes, semi_axes: Vec3::new(radius, radius, Self::FLAT * largest) }
    }

    /// Thickness of the ellipsoids that stand for the end discs, relative to the larger radius.
    pub const FLAT: f64 = 1e-5;

    /// Returns the frustum transformed to another frame.
    #[inline]
    pub fn carried(&self, x: &Transform) -> Self {
        Self { ends: self.ends.map(|end| x.point(&end)), axis: x.vector(&self.axis), ..*self }
    }

    /// Returns the lowest and the highest corner of the box, along the axes of the frame, around everything that the
    /// frustum can touch, m. If `meets_triangles`, it is the box of balls around the end discs: as an ellipsoid's, the
    /// foot of a disc that leans may lie outside it, as far from its centre as the diagonal of a square on its radius.
    /// The function is not inlined, so that the cheaper kinds do not pay for its stack frame.
    #[inline(never)]
    pub fn region(&self, meets_triangles: bool) -> (Vec3, Vec3) {
        if meets_triangles {
            let reach = self.radii.map(|radius| radius * std::f64::consts::SQRT_2);
            let [one, other] = [0, 1].map(|end| box_around(&self.ends[end], Vec3::repeat(reach[end])));
            return (one.0.inf(&other.0), one.1.sup(&other.1));
        }
        let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
        let along = |sign: f64| Vec3::from(axes.map(|axis| sign * self.support(&(axis * sign))));
        (along(-1.0), along(1.0))
    }

    /// Returns the maximum of `direction · x` over the solid, m, for a unit direction.
    #[inline]
    pub fn support(&self, direction: &Vec3) -> f64 {
        self.support_from(direction, &Vec3::zeros())
    }

    /// Returns the maximum of `direction · (x − from)` over the solid, m, for a unit direction.
    #[inline]
    pub fn support_from(&self, direction: &Vec3, from: &Vec3) -> f64 {
        let aside = direction.cross(&self.axis).norm();
        let at = |end: usize| direction.dot(&(self.ends[end] - from)) + self.radii[end] * aside;
        at(0).max(at(1))
    }
}

impl Bounded for Capsule {
    fn support(&self, direction: &Vec3) -> f64 {
        PointCloud(&self.ends).support(direction) + self.radius
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        PointCloud(&self.ends).farthest(from) + self.radius
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.ends.iter().for_each(|end| ball_representatives(end, self.radius, out));
    }
}

impl Bounded for Frustum {
    fn support(&self, direction: &Vec3) -> f64 {
        Frustum::support(self, direction)
    }

    /// Returns the distance of the farthest point, m. That point lies on one of the end circles, on the far
    /// side of the axis.
    fn farthest(&self, from: &Vec3) -> f64 {
        let of_circle = |end: usize| {
            let arm = from - self.ends[end];
            let along = self.axis.dot(&arm);
            let aside = (arm - self.axis * along).norm() + self.radii[end];
            (along * along + aside * aside).sqrt()
        };
        largest([0, 1].map(of_circle).into_iter())
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        let across = crate::any_perpendicular(&self.axis);
        let other = self.axis.cross(&across);
        for (end, radius) in self.ends.iter().zip(self.radii) {
            out.extend([across, -across, other, -other].map(|arm| end + arm * radius));
        }
    }
}

impl Bore {
    /// Returns the region in which the bore may push: the hole dilated by the thickness. The layer of that
    /// thickness behind the wall would be too small: the origin of a ray that grazes the wall may lie beside
    /// the layer, and so may a shape that passes through the wall near a mouth.
    fn pushed(&self) -> Dilated<'_> {
        Dilated { thing: &self.hole, reach: self.thickness }
    }
}

impl Bounded for Bore {
    fn support(&self, direction: &Vec3) -> f64 {
        self.pushed().support(direction)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        self.pushed().farthest(from)
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.hole.representatives(out);
    }
}

impl Primitive for Capsule {
    #[inline]
    fn reference_point(&self, end: u32) -> Cow<'_, Vec3> {
        on_axis(&self.ends, end)
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        ends_and_middle(&self.ends)
    }

    fn core(&self) -> Option<([Vec3; 2], f64)> {
        Some((self.ends, self.radius))
    }

    fn smallest_radius_m(&self) -> Option<f64> {
        Some(self.radius)
    }

    fn least_width_m(&self) -> f64 {
        self.width_m()
    }

    fn round(&self) -> Option<&dyn Round> {
        Some(self)
    }

    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        vec![("the length", distance_m(&self.ends)), ("the radius", self.radius)]
    }

    fn drawing(&self) -> Option<Drawing> {
        let (between, radius) = (self.ends[1] - self.ends[0], self.radius);
        let length = between.norm();
        let arc = |along, quarters| Stroke::Arc { along, aside: 0.0, radius, quarters };
        let outline = vec![arc(0.0, [-1, 0]), arc(length, [0, 1])];
        Some(Drawing::Revolved { origin: self.ends[0], axis: between / length, outline })
    }
}

impl Primitive for Frustum {
    /// Returns the centre of the disc to which the contact belongs. In the keys of the contacts, ends 0 and 2
    /// are contacts of the disc at end 0, ends 1 and 3 those of the disc at end 1. A contact of the side between the
    /// two has end 4, and the middle of the axis.
    #[inline]
    fn reference_point(&self, end: u32) -> Cow<'_, Vec3> {
        match end {
            0..=3 => Cow::Borrowed(&self.ends[usize::from(!end.is_multiple_of(2))]),
            _ => on_axis(&self.ends, end),
        }
    }

    fn followed(&self) -> [Option<Vec3>; 3] {
        ends_and_middle(&self.ends)
    }

    fn smallest_radius_m(&self) -> Option<f64> {
        self.radii.into_iter().filter(|radius| *radius > 0.0).reduce(f64::min)
    }

    fn least_width_m(&self) -> f64 {
        self.width_m()
    }

    fn round(&self) -> Option<&dyn Round> {
        Some(self)
    }

    /// Returns the sizes with their names, without the zero radius of an apex.
    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        let radii = self.radii.into_iter().filter(|radius| *radius > 0.0);
        radii.map(|radius| ("a radius", radius)).chain([("the length", distance_m(&self.ends))]).collect()
    }

    fn drawing(&self) -> Option<Drawing> {
        let corner = |along, aside| Stroke::Corner { along, aside };
        let wall = self.radii;
        let outline = vec![
            corner(0.0, 0.0),
            corner(0.0, wall[0]),
            corner(self.length, wall[1]),
            corner(self.length, 0.0),
        ];
        Some(Drawing::Revolved { origin: self.ends[0], axis: self.axis, outline })
    }
}

impl Primitive for Bore {
    fn least_width_m(&self) -> f64 {
        self.thickness
    }

    fn curved(&self) -> Option<&dyn Curved> {
        Some(self)
    }

    fn sizes_m(&self) -> Vec<(&'static str, f64)> {
        let mut sizes = self.hole.sizes_m();
        sizes.push(("the thickness", self.thickness));
        sizes
    }

    /// Returns the drawing of the wall alone, seen from inside.
    fn drawing(&self) -> Option<Drawing> {
        let Frustum { ends, radii, axis, length, .. } = self.hole;
        let corner = |along, aside| Stroke::Corner { along, aside };
        let outline = vec![corner(length, radii[1]), corner(0.0, radii[0])];
        Some(Drawing::Revolved { origin: ends[0], axis, outline })
    }
}
