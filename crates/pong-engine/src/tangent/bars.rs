//! Motion of the contacts of a segment or a capsule with a convex solid (docs/theory.md, 2.8 and 7).
//!
//! The place x of the load follows from a slope that is zero, G(x, q) = n·u + 4xδ/W = 0, where q is the relative pose:
//! dx = −(∂G/∂q)/(∂G/∂x). A place at an end of the axis stays there.

use super::moves::Moves;
use super::two_capsules::MovesAtEnd;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use nalgebra::RowVector6;
use pong_geometry::interference::bar_polyhedron::{capsule_solid, segment_solid};
use pong_geometry::interference::sphere_polyhedron::sphere_outside_polyhedron;
use pong_geometry::interference::two_ended_round::EndContact;
use pong_geometry::interference::{Feature, FeatureKind};
use pong_geometry::pose::{displacement_slopes, turn_slopes};
use pong_geometry::primitive::{Capsule, LineSegment, Polyhedron, PolyhedronFace, Sphere};
use pong_geometry::{Mat3, Vec3};

/// A segment or a capsule on a convex solid, in the solid's frame.
pub(super) struct BarOnSolid<'a> {
    pub ends_b: [Vec3; 2],
    pub radius: f64,
    pub solid: &'a Polyhedron,
}

impl BarOnSolid<'_> {
    /// Returns the derivatives of a contact of the last frame. `None` where the axis passes through the feature that
    /// pushes, and where the remembered side of entry pushes instead of the nearest one.
    pub fn moves_of(&self, found: &ContactCandidate) -> Option<MovesAtEnd> {
        let contacts = match self.radius > 0.0 {
            true => capsule_solid(&Capsule { ends: self.ends_b, radius: self.radius }, self.solid, &[]),
            false => segment_solid(&LineSegment { ends: self.ends_b }, self.solid),
        };
        let end = found.key.end as usize;
        let contact =
            contacts[end].as_ref().filter(|contact| contact.interference.feature == found.feature)?;
        self.moves_at_end(contact, contacts[1 - end].as_ref())
    }

    /// Returns the derivatives of one of the two contacts; `other` is the other one, if there is one. `None` where the
    /// axis passes through the feature that pushes, which leaves the normal undetermined.
    fn moves_at_end(&self, contact: &EndContact, other: Option<&EndContact>) -> Option<MovesAtEnd> {
        /// Distance of the axis from a feature, relative to the depth, below which most digits of the normal are rounding.
        const CROSSING: f64 = 1e-9;
        let found = &contact.interference;
        let (normal, along) = (found.normal_b, self.ends_b[1] - self.ends_b[0]);
        let lean = normal.dot(&along);
        let place = self.place_of(&found.deepest_b, &normal);
        // Depths of the ends and of the load below the plane.
        let depths = [-0.5, 0.5].map(|at| (found.depth - lean * (at - place)).max(0.0));
        let at = 0.5 * (depths[1] - depths[0]) / (depths[0] + depths[1]);
        let is_held = depths.contains(&0.0);
        let depth = found.depth - lean * (at - place);
        let spread = 1.0 + 4.0 * at * at;
        let distance = self.radius - depth;
        let free = self.free(found.feature, &normal);
        let turns = free != Mat3::zeros();
        if turns && distance.abs() < CROSSING * depth {
            return None;
        }
        let free = if turns { free / distance } else { free };

        let carried = displacement_slopes(&self.at(at));
        let held_depth = -(normal.transpose() * carried);
        let slope = along.transpose() * (free * carried)
            + normal.transpose() * turn_slopes(&along)
            + held_depth * (4.0 * at / spread);
        let curvature = along.dot(&(free * along)) + 4.0 * depth / (spread * spread);
        let goes = if is_held { RowVector6::zeros() } else { -slope / curvature };
        let vector = carried + along * goes;
        let turned = free * vector;
        let deepens = -(normal.transpose() * vector);
        let (mean, spreads) = (depth / spread, goes * (8.0 * at));
        let means = (deepens - spreads * mean) / spread;
        let leans = along.transpose() * turned + normal.transpose() * turn_slopes(&along);

        let moves_of = |place: f64, normal_b: &Vec3| self.of_end_of_overlap(place, at, &goes, normal_b);
        let slides = moves_of(place, &normal);
        let own = deepens - leans * (place - at) - (slides - goes) * lean;
        // The lever of the load about the other contact; without one the contact carries all of it.
        let (share, of_share) = match other {
            Some(other) => {
                let far = self.place_of(&other.interference.deepest_b, &normal);
                let of_far = moves_of(far, &normal);
                let length = place - far;
                let share = (at - far) / length;
                (share, (goes - of_far - (slides - of_far) * share) / length)
            }
            None => (1.0, RowVector6::zeros()),
        };
        let at_contact = displacement_slopes(&self.at(place));
        let weight = 2.0 * share * mean / found.depth;
        Some(MovesAtEnd {
            pressing: -(normal.transpose() * at_contact),
            moves: Moves {
                depth: own,
                normal: turned,
                deepest: at_contact + along * slides - turned * self.radius,
            },
            weight: ((of_share * mean + means * share) * 2.0 - own * weight) / found.depth,
        })
    }

    fn at(&self, place: f64) -> Vec3 {
        0.5 * (self.ends_b[0] + self.ends_b[1]) + (self.ends_b[1] - self.ends_b[0]) * place
    }

    /// Returns the place on the axis, −½…½, of a deepest point.
    fn place_of(&self, deepest: &Vec3, normal: &Vec3) -> f64 {
        let along = self.ends_b[1] - self.ends_b[0];
        let at = along.dot(&(deepest + normal * self.radius - self.at(0.0))) / along.norm_squared();
        // At an end to rounding.
        if at.abs() > 0.5 - 1e-12 { 0.5_f64.copysign(at) } else { at }
    }

    /// Returns the projection on the directions in which the normal may turn.
    fn free(&self, feature: Feature, normal: &Vec3) -> Mat3 {
        let across = Mat3::identity() - normal * normal.transpose();
        match feature.kind() {
            FeatureKind::Face => Mat3::zeros(),
            FeatureKind::Edge => {
                let edge = self.solid.edges[feature.index()].direction;
                across - edge * edge.transpose()
            }
            FeatureKind::Vertex => across,
        }
    }

    /// Returns the derivatives of an end of the overlap: where the axis comes into the solid's reach, at an end of the
    /// axis, or at the load, whose place `load` moves by `goes`.
    fn of_end_of_overlap(
        &self,
        place: f64,
        load: f64,
        goes: &RowVector6<f64>,
        normal: &Vec3,
    ) -> RowVector6<f64> {
        if place.abs() >= 0.5 {
            return RowVector6::zeros();
        }
        if (place - load).abs() <= 1e-12 {
            return *goes;
        }
        let center = self.at(place);
        let along = self.ends_b[1] - self.ends_b[0];
        let away = match self.radius > 0.0 {
            true => {
                let sphere = Sphere { center, radius: 2.0 * self.radius };
                sphere_outside_polyhedron(&sphere, self.solid).map_or(*normal, |found| found.normal_b)
            }
            // A segment comes in through the face in which the place is.
            false => {
                let height = |face: &&PolyhedronFace| face.height(&center);
                let faces = self.solid.faces.iter();
                faces.max_by(|a, b| height(a).total_cmp(&height(b))).map_or(*normal, |face| face.normal)
            }
        };
        let rate = away.dot(&along);
        if rate == 0.0 {
            return RowVector6::zeros();
        }
        -(away.transpose() * displacement_slopes(&center)) / pong_geometry::divisor(rate)
    }
}
