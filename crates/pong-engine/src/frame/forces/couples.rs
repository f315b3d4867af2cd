//! Couples that resist rolling and spinning (docs/theory.md, 4). The couple of a contact is a pair of opposite
//! forces, each a contact of its own, so that the layout of contacts and records has no moments.

use super::contact::FrameContact;
use super::contact_buffer::ContactBuffer;
use super::contact_ref::ContactRef;
use crate::frame::input::PairContext;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::law::friction::{Resistance, ResistingMoment, shortened};
use crate::law::{FrictionProps, normal_force};
use crate::seal::Sealed;
use crate::state::{ContactRecord, ContactRole, NO_FACE};
use pong_geometry::Vec3;
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::pose::carry_by_smallest_rotation;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::MovableGroup;

/// Resistance of one contact, as it is evaluated.
pub(crate) struct Resisted<'a> {
    pub resistance: Resistance,
    /// Contact point c, m.
    pub point_b: Vec3,
    /// Committed records of the two contacts, with their indices.
    pub earlier: [Option<(usize, &'a ContactRecord)>; 2],
}

impl<'a> Resisted<'a> {
    /// Resistance of a contact that carries the given share of the tangential spring; `None` without normal force, or
    /// if its surfaces do not resist.
    pub fn of(
        context: &PairContext<'a>,
        kind_a: PrimitiveKind,
        found: &ContactCandidate,
        share: f64,
    ) -> Option<Self> {
        let props = context.props(found);
        let FrictionProps::Bristle { stiffness, damping, rolling, spinning, .. } = props.friction else {
            return None;
        };
        if !props.has_resistance() {
            return None;
        }
        let normal = found.normal_b;
        let point = found.deepest_b + normal * (props.share_a * found.depth);
        let closing = -normal.dot(&context.motion.velocity_at(&point));
        let pressed = normal_force(props, found.full_weight(), found.depth, closing);
        if pressed <= 0.0 {
            return None;
        }
        let earlier = found
            .key
            .of_couple()
            .map(|key| context.memory.under(&key).matching(&normal, ContactRole::Active));
        let first = earlier[0].map(|(_, record)| record);
        let radii = [
            radius(context.body_a, kind_a, found.element_a),
            radius(context.body_b, found.kind_b, found.element_b),
        ];
        let lever = radii.into_iter().flatten().reduce(f64::min).unwrap_or(rolling.max(spinning));
        let mut rate_b = context.motion.omega_a_b - context.motion.omega_b_b;
        if let Some(surfaces) = context.surfaces.motions() {
            rate_b += surfaces.angular_velocity(context.motion);
        }
        let resistance = Resistance {
            normal_b: normal,
            lever,
            stiffness: share * stiffness,
            damping: share * damping,
            limits: [rolling, spinning].map(|length| length * pressed),
            carried_b: first.map_or(Vec3::zeros(), |record| {
                carry_by_smallest_rotation(&record.bristle_b, &record.normal_b, &normal)
            }),
            turned_b: turned(context, found, &point, first),
            rate_b,
            stuck: earlier.map(|record| record.is_none_or(|(_, record)| record.sticks)),
        };
        Some(Self { resistance, point_b: point, earlier })
    }
}

/// Couple of one contact.
pub(super) struct Couple<'a> {
    found: &'a ContactCandidate,
    /// Contact point c in B's frame, m.
    point_b: Vec3,
    /// Lever L, m.
    lever: f64,
    /// Angular velocity of A relative to B in B's frame, rad/s.
    rate_b: Vec3,
    resisting: ResistingMoment,
    /// Indices of the committed records of the two contacts.
    continues: [Option<u32>; 2],
}

impl<'a> Couple<'a> {
    /// Couple of a contact, as [`Resisted::of`].
    pub fn of(
        context: &PairContext<'_>,
        kind_a: PrimitiveKind,
        found: &'a ContactCandidate,
        share: f64,
    ) -> Option<Self> {
        let Resisted { resistance, point_b, earlier } = Resisted::of(context, kind_a, found, share)?;
        let Resistance { lever, rate_b, .. } = resistance;
        let continues = earlier.map(|record| record.map(|(index, _)| index as u32));
        Some(Self { found, point_b, lever, rate_b, resisting: resistance.evaluate(), continues })
    }

    /// Adds the two contacts: forces ±f at c ± e, so that 2·e × f is the moment.
    pub fn add(&self, sealed: &Sealed, out: &mut ContactBuffer) {
        let Self { found, resisting, .. } = self;
        let arm = arm(&resisting.moment_b, &found.normal_b) * self.lever;
        let force = resisting.moment_b.cross(&arm) / (2.0 * self.lever * self.lever);
        let sliding = self.rate_b.cross(&arm);
        let sliding = sliding - found.normal_b * found.normal_b.dot(&sliding);
        let keys = found.key.of_couple();
        for (index, sign) in [1.0, -1.0].into_iter().enumerate() {
            let Some(slot) = out.slot(ContactRole::Active, sealed) else { return };
            out.contacts[slot] = FrameContact {
                found: ContactCandidate {
                    key: keys[index],
                    entry_face: NO_FACE,
                    remembered: None,
                    half: false,
                    shares: false,
                    weight: 0.0,
                    ..**found
                },
                point_b: self.point_b + arm * sign,
                friction_force_b: force * sign,
                slip_velocity_b: sliding * sign,
                bristle_b: resisting.bristle_b,
                stored: 0.5 * resisting.stored,
                sticks: resisting.sticks[index],
                ..FrameContact::blank()
            };
            out.refs[slot] =
                ContactRef::new(keys[index].head(), out.slot_of(slot), true, self.continues[index]);
        }
    }
}

/// Rotation vector of A relative to B since the last commit, rad. In the step in which the contact begins, the
/// part of it after the touch.
fn turned(
    context: &PairContext<'_>,
    found: &ContactCandidate,
    point: &Vec3,
    earlier: Option<&ContactRecord>,
) -> Vec3 {
    let Some(since) = &context.motion.since_commit else { return Vec3::zeros() };
    let mut turned = *context.rotation(since);
    if let Some(surfaces) = context.surfaces.motions() {
        turned += surfaces.turned(context.motion);
    }
    if earlier.is_some() {
        return turned;
    }
    let before = since.x_ba.point(&context.motion.x_ba.inverse().point(point));
    let approach = found.normal_b.dot(&(before - point));
    shortened(turned, approach, found.depth)
}

/// Unit vector normal to the moment, along which the two forces are apart. It is chosen so that the forces lie
/// in the contact plane: along the normal of the contact if the moment is against rolling alone, and in the
/// contact plane if it is against spinning alone.
fn arm(moment: &Vec3, normal: &Vec3) -> Vec3 {
    /// Sine of the angle between moment and normal below which rounding would decide the direction of the forces.
    const LEAST_SINE: f64 = 1e-6;
    let size = moment.norm();
    if size == 0.0 {
        return *normal;
    }
    let axis = moment / (size + f64::MIN_POSITIVE);
    let mut along_force = normal.cross(&axis);
    if along_force.norm() < LEAST_SINE {
        let mut guide = Vec3::zeros();
        guide[axis.iamin()] = 1.0;
        along_force = guide.cross(&axis);
    }
    along_force.normalize().cross(&axis)
}

/// Smallest radius of a round primitive, m; `None` for other kinds.
fn radius(body: &MovableGroup, kind: PrimitiveKind, element: u32) -> Option<f64> {
    match body.element(kind, element) {
        PrimitiveRef::Sphere(sphere) => Some(sphere.radius),
        PrimitiveRef::Ellipsoid(ellipsoid) => Some(ellipsoid.semi_axes.min()),
        PrimitiveRef::Capsule(capsule) => Some(capsule.radius),
        PrimitiveRef::Cylinder(solid) | PrimitiveRef::Cone(solid) => Some(solid.radii[0].max(solid.radii[1])),
        _ => None,
    }
}
