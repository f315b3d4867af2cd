//! Shape queries of a movable group's elements, for fitting bounding volumes.

use crate::model::{Item, MovableGroup};
use pong_geometry::Vec3;
use pong_geometry::bounding::{Bounded, CustomBounds, PointCloud};
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::primitive::{Ellipsoid, PrimitiveKind};

/// Element of a movable group, as a shape around which volumes can be fitted.
#[derive(Clone, Copy)]
pub struct Element<'b> {
    body: &'b MovableGroup,
    item: Item,
}

/// Triangle with the region behind it in which it still pushes.
struct ThickTriangle {
    corners: [Vec3; 3],
    normal: Vec3,
    /// Explicit thickness, m. The default thickness needs no extra region, because a shape whose centre lies
    /// within it still overlaps the triangle itself (an ellipsoid together with its foot points:
    /// [`WithFeet`]).
    thickness: f64,
}

/// Ellipsoid together with all foot points at which a triangle may push it.
struct WithFeet<'a>(&'a Ellipsoid);

impl<'b> Element<'b> {
    /// Element to which an item of the movable group's tree refers.
    pub fn new(body: &'b MovableGroup, item: Item) -> Self {
        Self { body, item }
    }

    /// Minimum and maximum coordinates in the group frame, m; infinite in directions in which the element is
    /// unbounded.
    pub fn extent(&self) -> (Vec3, Vec3) {
        let body = self.body;
        let points = match self.kind() {
            PrimitiveKind::Triangle if self.thickness().is_none() => {
                body.triangles.corners(self.item.element)
            }
            PrimitiveKind::Point => [body.points[self.item.element as usize].position; 3],
            _ => return self.as_bounded(extent_by_support),
        };
        let [a, b, c] = points;
        (a.inf(&b).inf(&c), a.sup(&b).sup(&c))
    }

    fn kind(&self) -> PrimitiveKind {
        self.body.primitives[self.item.primitive as usize].kind
    }

    fn thickness(&self) -> Option<f64> {
        self.body.primitives[self.item.primitive as usize].thickness
    }

    fn as_bounded<R>(&self, ask: impl FnOnce(&dyn Bounded) -> R) -> R {
        match self.body.element(self.kind(), self.item.element) {
            PrimitiveRef::Ellipsoid(ellipsoid) => ask(&WithFeet(ellipsoid)),
            PrimitiveRef::Custom(custom) => ask(&CustomBounds(custom)),
            PrimitiveRef::Triangle(set, triangle) => {
                let corners = set.corners(triangle);
                let Some(thickness) = self.thickness() else { return ask(&PointCloud(&corners)) };
                ask(&ThickTriangle { corners, normal: set.normal(triangle), thickness })
            }
            other => ask(other.facts().expect("only triangles and custom primitives have no facts")),
        }
    }
}

macro_rules! elements {
    ($($(#[$doc:meta])+ $kind:ident = $number:literal: $shape:ty, $array:ident;)*) => {
        impl MovableGroup {
            /// Element of a kind.
            ///
            /// # Panics
            ///
            /// If the group has no element of that index.
            #[inline(always)]
            pub fn element(&self, kind: PrimitiveKind, element: u32) -> PrimitiveRef<'_> {
                match kind {
                    $(PrimitiveKind::$kind => PrimitiveRef::$kind(&self.$array[element as usize]),)*
                    PrimitiveKind::Triangle => PrimitiveRef::Triangle(&self.triangles, element),
                    PrimitiveKind::Custom => PrimitiveRef::Custom(&*self.customs[element as usize]),
                }
            }
        }
    };
}

pong_geometry::for_each_kind!(elements);

fn extent_by_support(thing: &dyn Bounded) -> (Vec3, Vec3) {
    let axes = [Vec3::x(), Vec3::y(), Vec3::z()];
    (Vec3::from(axes.map(|axis| -thing.support(&-axis))), Vec3::from(axes.map(|axis| thing.support(&axis))))
}

impl Bounded for Element<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        self.as_bounded(|thing| thing.support(direction))
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        self.as_bounded(|thing| thing.farthest(from))
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.as_bounded(|thing| thing.representatives(out));
    }
}

impl Bounded for ThickTriangle {
    /// Support of the triangle and the region behind it. The region is that of a half ball whose centre moves
    /// over the triangle. The prism behind the triangle would be too small, because a ray that hits may start
    /// beside the prism.
    fn support(&self, direction: &Vec3) -> f64 {
        let forward = direction.dot(&self.normal);
        let widest = if forward <= 0.0 { 1.0 } else { (1.0 - forward * forward).max(0.0).sqrt() };
        PointCloud(&self.corners).support(direction) + widest * self.thickness
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        PointCloud(&self.corners).farthest(from) + self.thickness
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        out.extend(self.corners);
    }
}

impl Bounded for WithFeet<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        let Self(ellipsoid) = self;
        let feet = direction.dot(&ellipsoid.center) + ellipsoid.reach_of_feet() * direction.norm();
        Bounded::support(*ellipsoid, direction).max(feet)
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        let Self(ellipsoid) = self;
        ellipsoid.farthest(from).max((ellipsoid.center - from).norm() + ellipsoid.reach_of_feet())
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        self.0.representatives(out);
    }
}
