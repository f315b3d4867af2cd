//! Tangent of the last frame: derivatives of the wrenches of every two movable groups that touch with respect to
//! their poses and twists (docs/theory.md, 7). Computed on request; a frame pays nothing for it.
//!
//! | file | step |
//! |---|---|
//! | `shape.rs` | radii of curvature of both surfaces at a contact |
//! | `moves.rs`, `ray.rs` | derivatives of depth, normal and contact point with the relative pose |
//! | `two_capsules.rs`, `bar_on_round.rs`, `bars.rs` | the same, and of the weights, where bodies with two ends yield |
//! | `sharing.rs` | derivatives of the weights of contacts that share a spring |
//! | `friction.rs`, `contact.rs` | derivatives of the force of one contact |
//! | `resistance.rs` | derivatives of the couple that resists rolling and spinning |
//! | `potential.rs` | incremental potential of a step |
//! | `blocks.rs` | sum over the contacts of two groups; common axes |

mod bar_on_round;
mod bars;
mod blocks;
mod contact;
#[cfg(test)]
mod differences;
mod friction;
mod moves;
mod potential;
mod ray;
mod resistance;
mod shape;
mod sharing;
mod two_capsules;

pub use blocks::{PairTangent, TangentMatrix};
pub use potential::PairPotential;

use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, PairContext, WorkerInput};
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::{FrameContact, FrameResults};
use crate::law::{FrictionProps, NormalProps};
use crate::seal::Direction;
use crate::state::ContactRole;
use bar_on_round::moves_on_round;
use bars::BarOnSolid;
use blocks::DirectionSlopes;
use contact::Moving;
use moves::{Moves, Touch};
use nalgebra::RowVector6;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::two_capsules::TwoAxes;
use pong_geometry::interference::two_ended_round::BarOnFrustum;
use pong_geometry::primitive::{PrimitiveKind, Ray};
use pong_model::Item;
use potential::Increment;
use ray::RayHit;
use shape::{AtContact, Shape};
use two_capsules::{MovesAtEnd, moves_at_end};

/// Reason why a contact has no tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// A law of the host's.
    HostLaw,
    /// Two solids.
    Solids,
    /// Rolling or spinning resistance: of a surface that moves along itself, and in a potential.
    Resistance,
    /// Shapes whose contact has no unique derivative.
    Shapes,
}

/// A contact without a tangent: the pair of groups, the primitives' kinds, and why.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unknown {
    pub direction: Direction,
    pub kinds: [PrimitiveKind; 2],
    pub why: Missing,
}

/// A frame and its input.
#[derive(Clone, Copy)]
pub(crate) struct Given<'a> {
    pub given: &'a EvaluationInput<'a>,
    pub motions: &'a Motions<'a>,
    pub input: &'a WorkerInput,
    pub results: &'a FrameResults<'a>,
}

/// Tangents of all pairs of groups that touch in a frame, each with the index of the pair.
pub(crate) fn of_frame(frame: &Given<'_>) -> Vec<(u32, Result<PairTangent, Unknown>)> {
    let mut tangents = Vec::new();
    for refs in frame.pairs() {
        let mut tangent = PairTangent::of_groups(frame.given.scene.stamp, frame.bodies(refs));
        let known = frame.each_direction(refs, |side, refs| {
            tangent.add(&side.slopes(refs)?, side.context, frame.motions, frame.bodies_of(side));
            Ok(())
        });
        if known.is_err() || tangent.touches {
            tangents.push((refs[0].direction().group_pair, known.map(|()| tangent)));
        }
    }
    tangents
}

/// Incremental potentials of a step of length `step`, s, of all pairs of groups that touch in a frame.
pub(crate) fn potentials_of_frame(frame: &Given<'_>, step: f64) -> Result<Vec<PairPotential>, Unknown> {
    let mut potentials = Vec::new();
    for refs in frame.pairs() {
        let mut potential = PairPotential::of_groups(frame.given.scene.stamp, frame.bodies(refs));
        let mut touches = false;
        frame.each_direction(refs, |side, refs| {
            if let Some(increment) = side.increment(refs, step)? {
                potential.add(&increment, frame.motions, frame.bodies_of(side));
                touches = true;
            }
            Ok(())
        })?;
        if touches {
            potentials.push(potential);
        }
    }
    Ok(potentials)
}

impl<'a> Given<'a> {
    /// References to the contacts of each pair of groups.
    fn pairs(&self) -> impl Iterator<Item = &'a [ContactRef]> {
        let pair_of = |reference: &ContactRef| reference.direction().group_pair;
        self.results.contacts.order.chunk_by(move |a, b| pair_of(a) == pair_of(b))
    }

    fn bodies(&self, refs: &[ContactRef]) -> [usize; 2] {
        self.given.sealed.group_pairs[refs[0].direction().group_pair as usize].sides()
    }

    /// Bodies A and B of a direction.
    fn bodies_of(&self, side: &Frame<'_>) -> (usize, usize) {
        self.given.sealed.bodies_of(side.direction)
    }

    /// Calls `visit` for each direction of a pair of groups, with the references to its contacts.
    fn each_direction(
        &self,
        refs: &[ContactRef],
        mut visit: impl FnMut(&Frame<'_>, &[ContactRef]) -> Result<(), Unknown>,
    ) -> Result<(), Unknown> {
        refs.chunk_by(|a, b| a.direction() == b.direction()).try_for_each(|refs| {
            let direction = refs[0].direction();
            let motion = self.motions.known(self.input, direction);
            let context = PairContext::new(&self.given.round(self.input), direction, &motion);
            visit(&Frame { context: &context, results: self.results, direction }, refs)
        })
    }
}

/// One direction of a pair of groups in the last frame.
struct Frame<'a> {
    context: &'a PairContext<'a>,
    results: &'a FrameResults<'a>,
    direction: Direction,
}

impl<'a> Frame<'a> {
    /// Sum of the derivatives over the contacts.
    fn slopes(&self, refs: &[ContactRef]) -> Result<DirectionSlopes, Unknown> {
        let mut sum = DirectionSlopes::default();
        self.each_surface(refs, |moving| {
            let unknown = |why| self.unknown(moving.contact, why);
            let slopes = moving.slopes(self.context).ok_or_else(|| unknown(Missing::HostLaw))?;
            sum.add(&slopes, moving.contact);
            if self.context.props(&moving.contact.found).has_resistance() {
                let couple = resistance::couple(moving, self.context, &slopes);
                sum.add_couple(&couple.ok_or_else(|| unknown(Missing::Resistance))?);
            }
            Ok(())
        })?;
        Ok(sum)
    }

    /// Incremental potential of the contacts; `None` if none pushes.
    fn increment(&self, refs: &[ContactRef], step: f64) -> Result<Option<Increment>, Unknown> {
        let mut sum = None;
        self.each_surface(refs, |moving| {
            if self.context.props(&moving.contact.found).has_resistance() {
                return Err(self.unknown(moving.contact, Missing::Resistance));
            }
            let added = sum.get_or_insert_with(Increment::default).add(moving, self.context, step);
            added.ok_or_else(|| self.unknown(moving.contact, Missing::HostLaw))
        })?;
        Ok(sum)
    }

    /// Calls `visit` for each contact that pushes, with the derivatives of its geometry and weight, surface by surface.
    fn each_surface(
        &self,
        refs: &[ContactRef],
        mut visit: impl FnMut(&Moving<'_>) -> Result<(), Unknown>,
    ) -> Result<(), Unknown> {
        let contact = |reference: &ContactRef| self.results.contacts.found.contact(reference);
        let surface = |reference: &ContactRef| {
            let key = &contact(reference).found.key;
            (key.head(), key.shell_b)
        };
        for refs in refs.chunk_by(|a, b| surface(a) == surface(b)) {
            let mut contacts = Vec::new();
            for reference in refs.iter().filter(|reference| reference.pushes()) {
                let contact = contact(reference);
                let is_couple = !contact.found.key.is_tested() && !contact.found.key.is_of_solids();
                if contact.found.role == ContactRole::Active && !is_couple {
                    contacts.push(self.moving(reference, contact)?);
                }
            }
            let Some(kind_a) = contacts.first().map(|moving| moving.kind_a) else { continue };
            if sharing::weigh(kind_a, &mut contacts).is_none() {
                return Err(self.unknown(contacts[0].contact, Missing::Shapes));
            }
            sharing::share_bristles(&mut contacts);
            contacts.iter().try_for_each(&mut visit)?;
        }
        Ok(())
    }

    fn unknown(&self, contact: &FrameContact, why: Missing) -> Unknown {
        let found = &contact.found;
        Unknown { direction: self.direction, kinds: [self.kind_a(contact), found.kind_b], why }
    }

    fn kind_a(&self, contact: &FrameContact) -> PrimitiveKind {
        self.context.body_a.primitives[contact.found.key.primitive_a as usize].kind
    }

    /// A contact with the derivatives of its geometry.
    fn moving(&self, reference: &ContactRef, contact: &'a FrameContact) -> Result<Moving<'a>, Unknown> {
        let unknown = |why| Err(self.unknown(contact, why));
        if contact.found.key.is_of_solids() {
            return unknown(Missing::Solids);
        }
        let props = self.context.props(&contact.found);
        if matches!(props.normal, NormalProps::Custom { .. })
            || matches!(props.friction, FrictionProps::Custom { .. })
        {
            return unknown(Missing::HostLaw);
        }
        let known = match self.of_yielding_ends(contact) {
            Some(at_end) => at_end.map(|MovesAtEnd { moves, pressing, weight }| (moves, pressing, weight)),
            None => self.moves(contact).map(|moves| (moves, moves.depth, RowVector6::zeros())),
        };
        let Some((moves, pressing, weight)) = known else { return unknown(Missing::Shapes) };
        Ok(Moving {
            contact,
            kind_a: self.kind_a(contact),
            record: reference.continues().map(|index| &self.context.memory.records[index]),
            moves,
            pressing,
            weight,
            share: 0.0,
            share_slope: RowVector6::zeros(),
        })
    }

    /// Motion of a contact of a segment or a capsule with a round part or a convex solid, `Some(None)` where it has none;
    /// `None` for other kinds, and for pieces of other bodies.
    fn of_yielding_ends(&self, contact: &FrameContact) -> Option<Option<MovesAtEnd>> {
        let (context, found) = (self.context, &contact.found);
        let element_a = context.body_a.element(self.kind_a(contact), found.element_a);
        let (ends, radius) = match element_a {
            PrimitiveRef::LineSegment(segment) => (segment.ends, 0.0),
            PrimitiveRef::Capsule(capsule) => (capsule.ends, capsule.radius),
            _ => return None,
        };
        let ends = ends.map(|end| context.motion.x_ba.point(&end));
        let end = found.key.end as usize;
        match context.body_b.element(found.kind_b, found.element_b) {
            PrimitiveRef::Capsule(b) => Some(moves_at_end(&TwoAxes::new(&ends, radius, b), radius, end)),
            PrimitiveRef::Cylinder(b) | PrimitiveRef::Cone(b) => {
                Some(moves_on_round(&BarOnFrustum::new(&ends, radius, b), radius, end))
            }
            PrimitiveRef::Polyhedron(_) => {
                let item = Item { primitive: found.primitive_b, element: found.element_b };
                let (_, solid) = context.body_b.convex_solid(item)?;
                Some(BarOnSolid { ends_b: ends, radius, solid }.moves_of(found))
            }
            _ => None,
        }
    }

    fn moves(&self, contact: &FrameContact) -> Option<Moves> {
        let (context, found) = (self.context, &contact.found);
        let normal = found.normal_b;
        let touch = Touch { normal_b: normal, depth: found.depth, deepest_b: found.deepest_b };
        let kind_a = self.kind_a(contact);
        let element_b = match context.body_b.element(found.kind_b, found.element_b) {
            // Features are those of the convex solid that the pieces form.
            PrimitiveRef::Polyhedron(piece)
                if matches!(kind_a, PrimitiveKind::Cylinder | PrimitiveKind::Cone) =>
            {
                let item = Item { primitive: found.primitive_b, element: found.element_b };
                PrimitiveRef::Polyhedron(context.body_b.convex_solid(item).map_or(piece, |(_, solid)| solid))
            }
            other => other,
        };
        let of_b = AtContact::new(element_b, found.deepest_b + normal * found.depth, normal);
        let x_ba = &context.motion.x_ba;
        let x_ab = x_ba.inverse();
        let element_a = context.body_a.element(kind_a, found.element_a);
        if let PrimitiveRef::Ray(ray) = element_a {
            return self.moves_of_ray(&ray.carried(x_ba), found);
        }
        let on_edge = !found.feature.is_face();
        // A segment that leaves a piece through a face may push along another line than that of the edge.
        if on_edge && (kind_a, found.kind_b) == (PrimitiveKind::LineSegment, PrimitiveKind::Polyhedron) {
            return None;
        }
        let of_a = AtContact::new(element_a, x_ab.point(&found.deepest_b), -x_ab.vector(&normal));
        let shape_a: Shape = of_a.shape_of_a(on_edge)?.rotated(&x_ba.rotation);
        let shape_b = of_b.shape_of_b(found.feature)?;
        // On a flat face the face gives the normal; elsewhere the end of a wall does not turn it like a rim.
        let is_unique = matches!(shape_b, Shape::Flat) || !of_a.is_end_of_wall();
        if is_unique { touch.moves(&shape_a, &shape_b) } else { None }
    }

    fn moves_of_ray(&self, ray: &Ray, found: &ContactCandidate) -> Option<Moves> {
        let element = self.context.body_b.element(found.kind_b, found.element_b);
        let distance = found.ray_distance;
        let place = ray.origin + ray.direction * distance;
        let normal = ray::normal_at(&element, found.feature, &place)?;
        let of_b = AtContact::new(element, place, normal);
        RayHit { ray: *ray, distance, normal_b: normal }.moves(&of_b.shape_of_b(found.feature)?)
    }
}
