//! Extent of a primitive, and a lower bound of the distance between two.

use pong_geometry::bounding::Bounded;
use pong_geometry::primitive::{Plane, PrimitiveKind};
use pong_geometry::{Transform, Vec3};
use pong_model::{Element, Item, MovableGroup};

/// A primitive in the frame of its movable group.
pub(crate) enum Reach<'m> {
    /// One element, with its own extent.
    Element(Element<'m>),
    /// A mesh: the box around it.
    Box(Vec3, Vec3),
    /// A half space below a plane.
    Plane(&'m Plane),
}

/// A primitive and a ball around it, m; a plane's is infinite.
pub(crate) struct Shape<'m> {
    reach: Reach<'m>,
    pub center: Vec3,
    pub radius: f64,
}

impl<'m> Shape<'m> {
    pub fn new(body: &'m MovableGroup, primitive: usize) -> Self {
        let info = &body.primitives[primitive];
        if info.kind == PrimitiveKind::Plane {
            let reach = Reach::Plane(&body.planes[info.elements.start as usize]);
            return Self { reach, center: Vec3::zeros(), radius: f64::INFINITY };
        }
        let element = |element| Element::new(body, Item { primitive: primitive as u32, element });
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for (least, most) in info.elements.clone().map(|index| element(index).extent()) {
            (low, high) = (low.inf(&least), high.sup(&most));
        }
        let reach = match info.elements.len() {
            1 => Reach::Element(element(info.elements.start)),
            _ => Reach::Box(low, high),
        };
        Self { reach, center: 0.5 * (low + high), radius: 0.5 * (high - low).norm() }
    }

    /// The largest `direction · x` over the primitive for a unit direction, m.
    fn support(&self, direction: &Vec3) -> f64 {
        match &self.reach {
            Reach::Element(element) => element.support(direction),
            Reach::Box(low, high) => direction.zip_zip_map(low, high, |d, l, h| (d * l).max(d * h)).sum(),
            Reach::Plane(_) => f64::INFINITY,
        }
    }

    /// A lower bound of the distance between two primitives, m, negative where they may overlap; `x_ba` maps
    /// from A's frame to B's. The largest gap along the axes of both frames, between the centres, and along
    /// the normal of a plane.
    pub fn apart(&self, other: &Self, x_ba: &Transform) -> f64 {
        let x_ab = x_ba.inverse();
        match (&self.reach, &other.reach) {
            (_, Reach::Plane(plane)) => below(self, plane, &x_ab),
            (Reach::Plane(plane), _) => below(other, plane, x_ba),
            _ => self.apart_along_axes(other, x_ba, &x_ab),
        }
    }

    fn apart_along_axes(&self, other: &Self, x_ba: &Transform, x_ab: &Transform) -> f64 {
        let between = other.center - x_ba.point(&self.center);
        let own = (0..3).map(|axis| x_ba.vector(&unit(axis)));
        let axes = (0..3).map(unit).chain(own);
        let both_ways = axes.flat_map(|axis| [axis, -axis]);
        let all = both_ways.chain(between.try_normalize(f64::MIN_POSITIVE));
        all.map(|direction_b| {
            let most_of_a =
                self.support(&x_ab.vector(&direction_b)) + direction_b.dot(&x_ba.point(&Vec3::zeros()));
            -other.support(&-direction_b) - most_of_a
        })
        .fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Height of a shape above a plane; `x` maps from the plane's frame to the shape's.
fn below(shape: &Shape<'_>, plane: &Plane, x: &Transform) -> f64 {
    let lowest =
        -shape.support(&-x.vector(&plane.normal)) - x.vector(&plane.normal).dot(&x.point(&Vec3::zeros()));
    lowest - plane.offset
}

fn unit(axis: usize) -> Vec3 {
    Vec3::ith(axis, 1.0)
}
