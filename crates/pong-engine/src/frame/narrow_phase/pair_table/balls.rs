//! Testers of points, spheres, ellipsoids and rays that need more than the pair's interference test.

use crate::frame::broad_phase::transformed::TransformedPrimitive;
use crate::frame::narrow_phase::candidate::CandidateStatus;
use crate::frame::narrow_phase::element_pair::{Ball, ChunkCandidates, ElementPair, status_of, wrong_kind};
use crate::frame::narrow_phase::on_triangle::{
    Centre, on_triangle, thickness_for_ellipsoid, thickness_for_sphere,
};
use crate::frame::narrow_phase::side_of_bore::role_in_bore;
use crate::state::{ContactKey, ContactRole, RecordRange};
use pong_geometry::Vec3;
use pong_geometry::interference::Interference;
use pong_geometry::interference::ball_bore::ball_bore;
use pong_geometry::interference::ellipsoid_polyhedron::ellipsoid_piece;
use pong_geometry::interference::ellipsoid_triangle::EllipsoidOnTriangles;
use pong_geometry::interference::point_polyhedron::point_below_face;
use pong_geometry::interference::ray_plane::{RayHit, ray_contact};
use pong_geometry::interference::ray_triangle::ray_triangle;
use pong_geometry::interference::sphere_polyhedron::{sphere_inside_polyhedron, sphere_outside_polyhedron};
use pong_geometry::interference::sphere_triangle::{sphere_over_face, sphere_triangle};
use pong_geometry::primitive::{Containment, Point, Ray, Sphere};

/// Adds the contact of a point with a polyhedron. The caller has removed points that are neither inside nor
/// on an internal face.
pub(super) fn point_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Point(point) = a else { wrong_kind(a) };
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let status = match polyhedron.planes().all_active {
        true => CandidateStatus::Front,
        false => status_of(polyhedron.containment(&point.position)),
    };
    let local = &pair.body_a().points[pair.item_a.element as usize].position;
    let key = pair.key();
    let remembered = pair.context.memory.under(&key);
    let Some(face) = pair.entry_face(polyhedron, &remembered, local, &point.position) else { return };
    let contact = point_below_face(&point.position, polyhedron, face.pushes());
    if let Some(contact) = contact {
        pair.emit(key, &contact, found, |out| {
            (out.entry_face, out.remembered) = (face.reached(), Some(remembered.range));
            out.status = status;
        });
    }
}

/// Adds the contacts of a sphere with a piece of a body.
pub(super) fn sphere_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    ball_on_piece(pair, &Ball::of(sphere), found);
}

/// Adds the contacts of a sphere, or of an end sphere of a capsule, with a piece of a body. The centre may be
/// inside or outside.
pub(super) fn ball_on_piece(pair: &ElementPair<'_>, ball: &Ball<'_>, found: &mut ChunkCandidates<'_>) {
    let polyhedron = &pair.body_b().polyhedra[pair.item_b.element as usize];
    let sphere = ball.sphere;
    let containment = polyhedron.containment(&sphere.center);
    if matches!(containment, Containment::Outside | Containment::BeyondWall)
        && let Some(contact) = sphere_outside_polyhedron(sphere, polyhedron)
    {
        pair.sharing(ball, &contact, found);
    }
    if containment == Containment::Outside {
        return;
    }
    let center_a = pair.center_a(ball);
    let key = pair.key_at(ball.end.unwrap_or(0));
    let remembered = pair.context.memory.under(&key);
    let Some(face) = pair.entry_face(polyhedron, &remembered, center_a, &sphere.center) else { return };
    let contact = sphere_inside_polyhedron(sphere, polyhedron, face.pushes());
    pair.emit(key, &contact, found, |out| {
        out.share(ball.end.is_some());
        out.status = status_of(containment);
        (out.entry_face, out.remembered) = (face.reached(), Some(remembered.range));
    });
}

/// Adds the contacts of a sphere with a triangle.
pub(super) fn sphere_on_triangle(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Sphere(sphere) = a else { wrong_kind(a) };
    ball_on_triangle(pair, &Ball::of(sphere), false, found);
}

/// Adds the contacts of a sphere, or of an end sphere of a capsule, with a triangle. `over_face` means that
/// only the face can push.
pub(crate) fn ball_on_triangle(
    pair: &ElementPair<'_>,
    ball: &Ball<'_>,
    over_face: bool,
    found: &mut ChunkCandidates<'_>,
) {
    let (set, triangle) = (&pair.body_b().triangles, pair.item_b.element);
    let center = Centre { center_a: *pair.center_a(ball), center_b: ball.sphere.center, end: ball.end };
    let mut emit = |contact| on_triangle(pair, &center, contact, found);
    if over_face {
        sphere_over_face(ball.sphere, set, triangle).into_iter().for_each(emit);
    } else {
        let thickness = thickness_for_sphere(pair.context, pair.item_b, ball.sphere);
        sphere_triangle(ball.sphere, set, triangle, thickness, &mut emit);
    }
}

/// Adds the contact of an ellipsoid with a piece of a body.
pub(super) fn ellipsoid_polyhedron(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ellipsoid(ellipsoid) = a else { wrong_kind(a) };
    let Some(contact) = ellipsoid_piece(ellipsoid, &pair.body_b().polyhedra[pair.item_b.element as usize])
    else {
        return;
    };
    pair.emit(pair.key(), &contact.interference, found, |out| {
        out.shares = true;
        out.status = if contact.stands_in { CandidateStatus::StandIn } else { CandidateStatus::Front };
    });
}

/// Adds the contacts of an ellipsoid with a triangle.
pub(super) fn ellipsoid_triangle(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ellipsoid(ellipsoid) = a else { wrong_kind(a) };
    ellipsoid_on_triangle(pair, &EllipsoidOnTriangles::new(ellipsoid), found);
}

/// Adds the contacts of an ellipsoid with a triangle; `ready` has the precomputed values of the ellipsoid.
pub(crate) fn ellipsoid_on_triangle(
    pair: &ElementPair<'_>,
    ready: &EllipsoidOnTriangles,
    found: &mut ChunkCandidates<'_>,
) {
    let ellipsoid = ready.ellipsoid();
    let local = pair.body_a().ellipsoids[pair.item_a.element as usize].center;
    let thickness = thickness_for_ellipsoid(pair.context, pair.item_b, ellipsoid);
    let center = Centre { center_a: local, center_b: ellipsoid.center, end: None };
    let mut emit = |contact| on_triangle(pair, &center, contact, found);
    ready.test(&pair.body_b().triangles, pair.item_b.element, thickness, &mut emit);
}

/// Adds the contacts of a point or a sphere with a bore: one at the nearest point of the wall and, for a
/// sphere that is too large for the hole, one on the opposite side. Both contacts share one spring.
pub(super) fn ball_in_bore(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let (body_a, element) = (pair.body_a(), pair.item_a.element as usize);
    let (ball, local) = match a {
        TransformedPrimitive::Sphere(sphere) => (*sphere, body_a.spheres[element].center),
        TransformedPrimitive::Point(point) => (ball_of(point), body_a.points[element].position),
        _ => wrong_kind(a),
    };
    let bore = &pair.body_b().bores[pair.item_b.element as usize];
    for contact in ball_bore(&ball, bore).iter().flatten() {
        let at = InBore::new(pair, pair.key_at(0), &local, contact);
        pair.emit(at.key, contact, found, |out| {
            out.share(false);
            (out.role, out.remembered) = (at.role, Some(at.remembered));
        });
    }
}

/// Sphere of zero radius at a point.
pub(super) fn ball_of(point: &Point) -> Sphere {
    Sphere { center: point.position, radius: 0.0 }
}

/// Key, role and committed records of a contact with a bore.
pub(super) struct InBore {
    pub key: ContactKey,
    pub role: ContactRole,
    pub remembered: RecordRange,
}

impl InBore {
    /// Looks up what a contact of the point `local`, in A's frame, was before.
    pub fn new(pair: &ElementPair<'_>, key: ContactKey, local: &Vec3, contact: &Interference) -> Self {
        let remembered = pair.context.memory.under(&key);
        let role = role_in_bore(pair, &remembered, local, contact);
        Self { key, role, remembered: remembered.range }
    }
}

/// Adds the contact of a ray with a triangle.
pub(super) fn ray_on_triangle(
    pair: &ElementPair<'_>,
    a: &TransformedPrimitive,
    found: &mut ChunkCandidates<'_>,
) {
    let TransformedPrimitive::Ray(ray) = a else { wrong_kind(a) };
    let reach = ray.reach.or(pair.info_b().thickness).unwrap_or(0.0);
    let hit = ray_triangle(ray, &pair.body_b().triangles, pair.item_b.element, reach);
    emit_hit(pair, ray, hit, found);
}

/// Adds the contact of a ray at its hit, if any.
pub(super) fn emit_hit(
    pair: &ElementPair<'_>,
    ray: &Ray,
    hit: Option<RayHit>,
    found: &mut ChunkCandidates<'_>,
) {
    if let Some(hit) = hit {
        pair.emit(pair.key(), &ray_contact(ray, &hit), found, |out| out.ray_distance = hit.distance);
    }
}
