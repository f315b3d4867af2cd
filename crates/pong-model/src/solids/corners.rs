//! Points and segments, which must not be corners of a solid.

use super::refusal::Refusal;
use crate::draft::BodyDraft;
use crate::hull::PLANE_TOLERANCE;
use crate::solid::{Solid, SolidField};
use crate::solid_box::SolidBox;
use pong_geometry::Vec3;
use pong_geometry::distance::Solid as Shape;
use pong_geometry::primitive::{Point, PrimitiveKind, TriangleSet};

/// Reports points and segments in groups of solids, and those of the movable group that lie on or in a solid.
pub(super) fn check(draft: &BodyDraft, solids: &[Solid], refusals: &mut Vec<Refusal>) {
    let body = &draft.body;
    for (index, info) in body.primitives.iter().enumerate() {
        let element = info.elements.start as usize;
        let (what, places) = match info.kind {
            PrimitiveKind::Point => ("point", &[body.points[element].position][..]),
            PrimitiveKind::LineSegment => ("segment", &body.segments[element].ends[..]),
            _ => continue,
        };
        if draft.is_solid[index] {
            refusals.push(Refusal {
                primitive: index,
                rule: "solid-corner",
                cause: format!(
                    "a {what} in a group of solids: a solid touches with its whole surface, and its \
                                corners would count twice"
                ),
                cure: "leave it out, or put it in a group with `contact: Marked`",
            });
            continue;
        }
        let holds = |solid: &&Solid| places.iter().any(|place| holds(solid, &body.triangles, place));
        if let Some(solid) = solids.iter().find(holds) {
            let path = &body.primitives[solid.primitive as usize].path;
            refusals.push(Refusal {
                primitive: index,
                rule: "solid-corner",
                cause: format!(
                    "this {what} lies on or in the solid {path} of the same rigid body: the solid touches \
                                with its whole surface, and the {what} would count twice"
                ),
                cure: "leave it out, or give the solid's group `contact: Marked`",
            });
        }
    }
}

/// Tests whether a place lies on or in a solid.
fn holds(solid: &Solid, triangles: &TriangleSet, place: &Vec3) -> bool {
    let tolerance = 2.0 * PLANE_TOLERANCE * solid.bound.half.norm();
    if !reaches(&solid.bound, place, tolerance) {
        return false;
    }
    let in_field = |field: &SolidField| {
        reaches(&field.bound, place, tolerance)
            && field.faces.iter().chain(&field.walls).all(|plane| plane.depth(place) >= -tolerance)
    };
    if !solid.fields.is_empty() {
        return solid.fields.iter().any(in_field);
    }
    let own = (0..triangles.triangles.len() as u32)
        .filter(|&triangle| triangles.triangles[triangle as usize].shell == solid.shell);
    let mut turns = 0.0;
    for triangle in own {
        let corners = triangles.corners(triangle);
        let point = Shape::point(&Point { position: *place });
        if Shape::triangle(corners).to_within(&point, tolerance).is_some() {
            return true;
        }
        turns += solid_angle(&corners.map(|corner| corner - place));
    }
    turns > std::f64::consts::TAU
}

fn reaches(bound: &SolidBox, place: &Vec3, tolerance: f64) -> bool {
    let beyond = (place - bound.center).abs() - bound.half;
    beyond.max() <= tolerance
}

/// Solid angle of a triangle seen from the origin; positive if the origin is behind it.
fn solid_angle([a, b, c]: &[Vec3; 3]) -> f64 {
    let [la, lb, lc] = [a.norm(), b.norm(), c.norm()];
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * libm::atan2(a.dot(&b.cross(c)), below)
}
