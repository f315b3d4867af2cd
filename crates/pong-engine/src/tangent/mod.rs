//! Tangent of the last frame: derivatives of the wrenches of every two movable groups that touch with respect to
//! their poses and twists (docs/theory.md, 7). Computed on request; a frame pays nothing for it.
//!
//! | file | step |
//! |---|---|
//! | `shape.rs` | radii of curvature of both surfaces at a contact |
//! | `moves.rs`, `ray.rs` | derivatives of depth, normal and contact point with the relative pose |
//! | `sharing.rs` | derivatives of the weights of contacts that share a spring |
//! | `friction.rs`, `contact.rs` | derivatives of the force of one contact |
//! | `resistance.rs` | derivatives of the couple that resists rolling and spinning |
//! | `blocks.rs` | sum over the contacts of two groups; common axes |

mod blocks;
mod contact;
mod friction;
mod moves;
mod ray;
mod resistance;
mod shape;
mod sharing;

pub use blocks::{PairTangent, TangentMatrix};

use crate::frame::forces::contact_ref::ContactRef;
use crate::frame::input::relative::Motions;
use crate::frame::input::{EvaluationInput, PairContext, WorkerInput};
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::frame::{FrameContact, FrameResults};
use crate::law::{FrictionProps, NormalProps};
use crate::seal::Direction;
use crate::state::ContactRole;
use blocks::DirectionSlopes;
use contact::Moving;
use moves::{Moves, Touch};
use nalgebra::RowVector6;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::primitive::{PrimitiveKind, Ray};
use ray::RayHit;
use shape::{AtContact, Shape};

/// Reason why a contact has no tangent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Missing {
    /// A law of the host's.
    HostLaw,
    /// Two solids.
    Solids,
    /// Rolling or spinning resistance of a surface that moves along itself.
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

/// Tangents of all pairs of groups that touch in a frame, each with the index of the pair. `input` is that of the
/// frame.
pub(crate) fn of_frame(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    results: &FrameResults<'_>,
) -> Vec<(u32, Result<PairTangent, Unknown>)> {
    let mut tangents = Vec::new();
    let pair_of = |reference: &ContactRef| reference.direction().group_pair;
    for refs in results.contacts.order.chunk_by(|a, b| pair_of(a) == pair_of(b)) {
        let group_pair = pair_of(&refs[0]);
        let tangent = of_pair(given, motions, input, results, refs);
        if tangent.as_ref().is_ok_and(|tangent| !tangent.touches) {
            continue;
        }
        tangents.push((group_pair, tangent));
    }
    tangents
}

/// Tangent of one pair of groups, from the references to its contacts.
fn of_pair(
    given: &EvaluationInput<'_>,
    motions: &Motions<'_>,
    input: &WorkerInput,
    results: &FrameResults<'_>,
    refs: &[ContactRef],
) -> Result<PairTangent, Unknown> {
    let bodies = given.sealed.group_pairs[refs[0].direction().group_pair as usize].sides();
    let mut tangent = PairTangent::of_groups(given.scene.stamp, bodies);
    for refs in refs.chunk_by(|a, b| a.direction() == b.direction()) {
        let direction = refs[0].direction();
        let motion = motions.known(input, direction);
        let context = PairContext::new(&given.round(input), direction, &motion);
        let slopes = Frame { context: &context, results, direction }.slopes(refs)?;
        tangent.add(&slopes, &context, motions, given.sealed.bodies_of(direction));
    }
    Ok(tangent)
}

/// One direction of a pair of groups in the last frame.
struct Frame<'a> {
    context: &'a PairContext<'a>,
    results: &'a FrameResults<'a>,
    direction: Direction,
}

impl<'a> Frame<'a> {
    /// Sum over the contacts, surface by surface.
    fn slopes(&self, refs: &[ContactRef]) -> Result<DirectionSlopes, Unknown> {
        let mut sum = DirectionSlopes::default();
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
            if contacts.is_empty() {
                continue;
            }
            let unknown = |of: &Moving<'_>, why| self.unknown(of.contact, why);
            let kind_a = contacts[0].kind_a;
            if sharing::weigh(kind_a, &mut contacts).is_none() {
                return Err(unknown(&contacts[0], Missing::Shapes));
            }
            sharing::share_bristles(&mut contacts);
            for moving in &contacts {
                let slopes = moving.slopes(self.context).ok_or_else(|| unknown(moving, Missing::HostLaw))?;
                sum.add(&slopes, moving.contact);
                if self.context.props(&moving.contact.found).has_resistance() {
                    let couple = resistance::couple(moving, self.context, &slopes);
                    sum.add_couple(&couple.ok_or_else(|| unknown(moving, Missing::Resistance))?);
                }
            }
        }
        Ok(sum)
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
        let Some(moves) = self.moves(contact) else { return unknown(Missing::Shapes) };
        Ok(Moving {
            contact,
            kind_a: self.kind_a(contact),
            record: reference.continues().map(|index| &self.context.memory.records[index]),
            moves,
            weight: RowVector6::zeros(),
            share: 0.0,
            share_slope: RowVector6::zeros(),
        })
    }

    fn moves(&self, contact: &FrameContact) -> Option<Moves> {
        let (context, found) = (self.context, &contact.found);
        let normal = found.normal_b;
        let touch = Touch { normal_b: normal, depth: found.depth, deepest_b: found.deepest_b };
        let of_b = AtContact::new(
            context.body_b.element(found.kind_b, found.element_b),
            found.deepest_b + normal * found.depth,
            normal,
        );
        let kind_a = self.kind_a(contact);
        let x_ba = &context.motion.x_ba;
        let x_ab = x_ba.inverse();
        let element_a = context.body_a.element(kind_a, found.element_a);
        if let PrimitiveRef::Ray(ray) = element_a {
            return self.moves_of_ray(&ray.carried(x_ba), found);
        }
        let on_edge = !found.feature.is_face();
        // A segment that leaves a solid through a face may push along another line than that of the edge.
        if on_edge && (kind_a, found.kind_b) == (PrimitiveKind::LineSegment, PrimitiveKind::Polyhedron) {
            return None;
        }
        let of_a = AtContact::new(element_a, x_ab.point(&found.deepest_b), -x_ab.vector(&normal));
        let shape_a: Shape = of_a.shape_of_a(on_edge)?.rotated(&x_ba.rotation);
        touch.moves(&shape_a, &of_b.shape_of_b(found.feature)?)
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
