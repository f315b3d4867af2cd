//! What bounding volumes must know of the elements of a body.

use crate::model::{Body, Item};
use pong_geometry::Vec3;
use pong_geometry::bounding::Bounded;
use pong_geometry::primitive::{CustomPrimitive, Ellipsoid, PrimitiveKind, Ray};

/// One element of a body, as a thing to fit volumes around.
#[derive(Clone, Copy)]
pub struct Element<'b> {
    body: &'b Body,
    item: Item,
}

impl<'b> Element<'b> {
    /// The element that an item of the body's tree names.
    pub fn new(body: &'b Body, item: Item) -> Self {
        Self { body, item }
    }

    /// Smallest and largest coordinates, m; infinite if unbounded.
    pub fn extent(&self) -> (Vec3, Vec3) {
        match self.kind() {
            PrimitiveKind::Point | PrimitiveKind::LineSegment | PrimitiveKind::Ray => {
                let (points, count) = self.few_points();
                extent_of(points[..count].iter().copied())
            }
            PrimitiveKind::Polyhedron => {
                let polyhedron = &self.body.polyhedra[self.index()];
                extent_of(polyhedron.vertices.iter().map(|v| v.position))
            }
            PrimitiveKind::Triangle if self.thickness() == 0.0 => {
                extent_of(self.body.triangles.corners(self.item.element).into_iter())
            }
            _ => {
                let mut low = Vec3::zeros();
                let mut high = Vec3::zeros();
                for axis in 0..3 {
                    let unit = Vec3::ith(axis, 1.0);
                    low[axis] = -self.support(&-unit);
                    high[axis] = self.support(&unit);
                }
                (low, high)
            }
        }
    }

    fn kind(&self) -> PrimitiveKind {
        self.body.primitives[self.item.primitive as usize].kind
    }

    fn index(&self) -> usize {
        self.item.element as usize
    }

    /// Explicit thickness of a triangle, m; the default one needs no room, since the body that touches is larger.
    fn thickness(&self) -> f64 {
        self.body.primitives[self.item.primitive as usize].thickness.unwrap_or(0.0)
    }

    fn custom(&self) -> &'b dyn CustomPrimitive {
        self.body.customs[self.index()].as_ref()
    }

    /// The corners of what is the hull of at most three points.
    fn few_points(&self) -> ([Vec3; 3], usize) {
        let body = self.body;
        match self.kind() {
            PrimitiveKind::Point => ([body.points[self.index()].position; 3], 1),
            PrimitiveKind::LineSegment => {
                let [a, b] = body.segments[self.index()].ends;
                ([a, b, b], 2)
            }
            PrimitiveKind::Ray => {
                let ray = &body.rays[self.index()];
                ([rear(ray), ray.tip(), ray.tip()], 2)
            }
            _ => (body.triangles.corners(self.item.element), 3),
        }
    }
}

/// The rearmost place that the ray still hits.
fn rear(ray: &Ray) -> Vec3 {
    ray.origin - ray.direction * ray.reach.unwrap_or(0.0)
}

fn extent_of(mut points: impl Iterator<Item = Vec3>) -> (Vec3, Vec3) {
    let first = points.next().unwrap_or_else(Vec3::zeros);
    points.fold((first, first), |(low, high), p| (low.inf(&p), high.sup(&p)))
}

fn farthest_in_box(from: &Vec3, low: &Vec3, high: &Vec3) -> f64 {
    (from - low).abs().sup(&(high - from).abs()).norm()
}

impl Bounded for Element<'_> {
    fn support(&self, direction: &Vec3) -> f64 {
        let body = self.body;
        match self.kind() {
            PrimitiveKind::Plane => f64::INFINITY,
            PrimitiveKind::Sphere => {
                let sphere = &body.spheres[self.index()];
                direction.dot(&sphere.center) + sphere.radius
            }
            PrimitiveKind::Ellipsoid => {
                let ellipsoid: &Ellipsoid = &body.ellipsoids[self.index()];
                direction.dot(&ellipsoid.center) + ellipsoid.half_width(direction)
            }
            PrimitiveKind::Polyhedron => {
                let vertices = body.polyhedra[self.index()].vertices.iter();
                vertices.map(|v| direction.dot(&v.position)).fold(f64::NEG_INFINITY, f64::max)
            }
            PrimitiveKind::Custom => self.custom().support(direction),
            _ => {
                let (points, count) = self.few_points();
                let hull = points[..count].iter().map(|p| direction.dot(p)).fold(f64::NEG_INFINITY, f64::max);
                hull + self.behind(direction)
            }
        }
    }

    fn farthest(&self, from: &Vec3) -> f64 {
        let body = self.body;
        match self.kind() {
            PrimitiveKind::Sphere => {
                let sphere = &body.spheres[self.index()];
                (sphere.center - from).norm() + sphere.radius
            }
            PrimitiveKind::Polyhedron => {
                let vertices = body.polyhedra[self.index()].vertices.iter();
                vertices.map(|v| (v.position - from).norm()).fold(0.0, f64::max)
            }
            PrimitiveKind::Plane | PrimitiveKind::Ellipsoid | PrimitiveKind::Custom => {
                let (low, high) = self.extent();
                farthest_in_box(from, &low, &high)
            }
            _ => {
                let (points, count) = self.few_points();
                let hull = points[..count].iter().map(|p| (p - from).norm()).fold(0.0, f64::max);
                hull + if self.kind() == PrimitiveKind::Triangle { self.thickness() } else { 0.0 }
            }
        }
    }

    fn representatives(&self, out: &mut Vec<Vec3>) {
        match self.kind() {
            PrimitiveKind::Plane => {}
            PrimitiveKind::Polyhedron => {
                out.extend(self.body.polyhedra[self.index()].vertices.iter().map(|v| v.position));
            }
            PrimitiveKind::Ellipsoid => {
                let e = &self.body.ellipsoids[self.index()];
                for (axis, semi) in e.axes.column_iter().zip(e.semi_axes.iter()) {
                    out.extend([e.center + axis * *semi, e.center - axis * *semi]);
                }
            }
            PrimitiveKind::Sphere | PrimitiveKind::Custom => {
                let (low, high) = self.extent();
                for corner in 0..8 {
                    let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
                    out.push(Vec3::new(pick(0), pick(1), pick(2)));
                }
            }
            _ => {
                let (points, count) = self.few_points();
                out.extend_from_slice(&points[..count]);
            }
        }
    }
}

impl Element<'_> {
    /// Room behind a triangle for what is pushed from up to its thickness behind: half a ball, since a ray that
    /// still hits may start beside the triangle's prism.
    fn behind(&self, direction: &Vec3) -> f64 {
        if self.kind() != PrimitiveKind::Triangle || self.thickness() == 0.0 {
            return 0.0;
        }
        let forward = direction.dot(&self.body.triangles.normal(self.item.element));
        let widest = if forward <= 0.0 { 1.0 } else { (1.0 - forward * forward).max(0.0).sqrt() };
        widest * self.thickness()
    }
}
