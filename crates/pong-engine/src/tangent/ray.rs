//! Moves of the contact of a ray (docs/theory.md, 2.5).
//!
//! A ray of length L hits the surface at the distance t along its direction d; N is the surface normal there. The
//! hit stays on the surface: dt = −N·u(hit)/(d·N). Depth and normal are L − t and −d, or (L − t)·(−d·N) and N.

use super::moves::Moves;
use super::shape::Shape;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::Feature;
use pong_geometry::pose::{displacement_slopes, turn_slopes};
use pong_geometry::primitive::{Ray, RayResponse};
use pong_geometry::{Mat3, Vec3};

/// A ray that hits a surface, in B's frame.
pub(super) struct RayHit {
    pub ray: Ray,
    /// Distance of the hit from the origin, m.
    pub distance: f64,
    /// Normal of the surface at the hit.
    pub normal_b: Vec3,
}

impl RayHit {
    pub fn place(&self) -> Vec3 {
        self.ray.origin + self.ray.direction * self.distance
    }

    /// Moves of the contact, given the local shape of the surface.
    pub fn moves(&self, shape: &Shape) -> Option<Moves> {
        let Self { ray, distance, normal_b: normal } = self;
        let (direction, place) = (ray.direction, self.place());
        let moved = displacement_slopes(&place);
        let closing = direction.dot(normal);
        let travelled = -(normal.transpose() * moved) / closing;
        let deepest = displacement_slopes(&ray.tip());
        if ray.response == RayResponse::Axial {
            return Some(Moves { depth: -travelled, normal: turn_slopes(&-direction), deepest });
        }
        let turned = normal_turns(shape, normal)? * (moved + direction * travelled);
        let shortening = ray.length - distance;
        let depth = travelled * closing
            - (normal.transpose() * turn_slopes(&direction) + direction.transpose() * turned) * shortening;
        Some(Moves { depth, normal: turned, deepest })
    }
}

/// Matrix that gives the turn of the normal of a surface with a displacement along it.
fn normal_turns(shape: &Shape, normal: &Vec3) -> Option<Mat3> {
    match shape {
        Shape::Flat => Some(Mat3::zeros()),
        Shape::Straight { along, radius } => {
            let across = normal.cross(along);
            (*radius != 0.0).then(|| across * across.transpose() / *radius)
        }
        // The inverse in the contact plane; the term along the normal only makes the matrix regular.
        Shape::Round(radii) => {
            let size = radii.amax();
            let along = normal * normal.transpose();
            (radii + along * size).try_inverse().map(|inverse| inverse - along / size)
        }
    }
}

/// Outward normal of a primitive at a point of its surface; `None` for kinds that a ray does not hit.
pub(super) fn normal_at(element: &PrimitiveRef<'_>, feature: Feature, place: &Vec3) -> Option<Vec3> {
    match element {
        PrimitiveRef::Plane(plane) => Some(plane.normal),
        PrimitiveRef::Sphere(sphere) => Some((place - sphere.center).normalize()),
        PrimitiveRef::Ellipsoid(ellipsoid) => {
            let local = ellipsoid.axes.tr_mul(&(place - ellipsoid.center));
            let squares = ellipsoid.semi_axes.component_mul(&ellipsoid.semi_axes);
            Some((ellipsoid.axes * local.component_div(&squares)).normalize())
        }
        PrimitiveRef::Triangle(set, triangle) => Some(set.normal(*triangle)),
        PrimitiveRef::Polyhedron(polyhedron) => Some(polyhedron.faces[feature.index()].normal),
        PrimitiveRef::Capsule(capsule) => {
            let axis = capsule.ends[1] - capsule.ends[0];
            let share = ((place - capsule.ends[0]).dot(&axis) / axis.norm_squared()).clamp(0.0, 1.0);
            Some((place - capsule.ends[0] - axis * share).normalize())
        }
        PrimitiveRef::Cylinder(frustum) | PrimitiveRef::Cone(frustum) => match feature.index() {
            0 => Some(frustum.wall_normal(place)),
            end => Some(frustum.axis * if end == 1 { -1.0 } else { 1.0 }),
        },
        PrimitiveRef::Bore(bore) => Some(-bore.hole.wall_normal(place)),
        _ => None,
    }
}
