//! Derivatives of the force of one contact.

use super::friction::{FrictionSlopes, Rubbing};
use super::moves::{Moves, plane_axes};
use crate::frame::FrameContact;
use crate::frame::input::PairContext;
use crate::frame::input::moving_surfaces::MovingPlace;
use crate::law::normal_tangent;
use crate::state::ContactRecord;
use nalgebra::{Matrix3x6, RowVector6, SMatrix};
use pong_geometry::pose::{carry_by_smallest_rotation, displacement_slopes};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Mat3, Vec3};

/// Variables of a contact, in B's frame: u and φ of the relative pose (3 and 3, at B's origin), and the relative
/// velocity at the contact point (3).
pub(super) const VARIABLES: usize = 9;
pub(super) type Row = SMatrix<f64, 1, VARIABLES>;
type Rows3 = SMatrix<f64, 3, VARIABLES>;

/// A contact and how it moves.
pub(super) struct Moving<'a> {
    pub contact: &'a FrameContact,
    pub kind_a: PrimitiveKind,
    /// Committed record that the contact continues.
    pub record: Option<&'a ContactRecord>,
    pub moves: Moves,
    /// Derivative of the depth by the motion of A at the contact alone, without that of the place of the load.
    pub pressing: RowVector6<f64>,
    /// Derivative of the weight with respect to (u, φ).
    pub weight: RowVector6<f64>,
    /// Share of the tangential spring, no unit, and its derivative with respect to (u, φ).
    pub share: f64,
    pub share_slope: RowVector6<f64>,
}

/// Derivatives of the force of a contact on A and of its point, in B's frame, with respect to the variables.
pub(super) struct ContactSlopes {
    pub force: Rows3,
    pub point: Matrix3x6<f64>,
    /// Normal force.
    pub pressed: Row,
}

/// Columns of (u, φ) in the columns of all variables.
fn padded<const R: usize>(pose: &SMatrix<f64, R, 6>) -> SMatrix<f64, R, VARIABLES> {
    let mut all = SMatrix::<f64, R, VARIABLES>::zeros();
    all.fixed_columns_mut::<6>(0).copy_from(pose);
    all
}

impl Moving<'_> {
    /// Derivatives of the force; `None` for a host's law.
    pub fn slopes(&self, context: &PairContext<'_>) -> Option<ContactSlopes> {
        let Self { contact, moves, .. } = self;
        let found = &contact.found;
        let props = context.props(found);
        let normal = found.normal_b;
        let point = self.point(props.share_a);
        let velocity = context.motion.velocity_at(&contact.point_b);
        let of_velocity = self.velocity_slopes(context, &point);
        // rate = −n·v
        let rate = -padded(&(velocity.transpose() * moves.normal)) - normal.transpose() * of_velocity;
        let weight = found.full_weight();
        let tangent = normal_tangent(props, weight, found.depth, contact.rate)?;
        let pressed = padded(&moves.depth) * tangent.stiffness
            + rate * tangent.damping
            + padded(&self.weight) * (contact.normal_force / found.weight.max(f64::MIN_POSITIVE));
        let mut force = normal * pressed + padded(&moves.normal) * contact.normal_force;
        if contact.normal_force > 0.0 {
            let mut slip_velocity = of_velocity + padded(&moves.normal) * contact.rate;
            if let Some(surfaces) = context.surfaces.motions() {
                let place = self.place(&point);
                slip_velocity += padded(&surfaces.velocity_slopes(context.motion, &place));
            }
            force += self.friction_slopes(context, &point, (&pressed, &slip_velocity))?;
        }
        Some(ContactSlopes { force, point, pressed })
    }

    /// Derivatives of the contact point.
    pub fn point(&self, share_a: f64) -> Matrix3x6<f64> {
        let found = &self.contact.found;
        let of_depth = self.moves.normal * found.depth + found.normal_b * self.moves.depth;
        self.moves.deepest + of_depth * share_a
    }

    /// Normal force at the last commit, N: zero for a contact that begins.
    pub fn load_before(&self) -> f64 {
        self.record.map_or(0.0, |record| record.force_b.dot(&record.normal_b).max(0.0))
    }

    /// The contact point and its normal, with their derivatives.
    fn place<'p>(&'p self, point: &'p Matrix3x6<f64>) -> MovingPlace<'p> {
        MovingPlace {
            point_b: &self.contact.point_b,
            normal_b: &self.contact.found.normal_b,
            point_slopes: point,
            normal_slopes: &self.moves.normal,
        }
    }

    /// Derivatives of the relative velocity at the contact point.
    fn velocity_slopes(&self, context: &PairContext<'_>, point: &Matrix3x6<f64>) -> Rows3 {
        let spin = context.motion.omega_a_b - context.motion.omega_b_b;
        let mut slopes = padded(&(spin.cross_matrix() * point));
        slopes.fixed_view_mut::<3, 3>(0, 6).copy_from(&Mat3::identity());
        slopes
    }

    fn friction_slopes(
        &self,
        context: &PairContext<'_>,
        point: &Matrix3x6<f64>,
        (pressed, slip_velocity): (&Row, &Rows3),
    ) -> Option<Rows3> {
        let (contact, moves) = (self.contact, &self.moves);
        let normal = contact.found.normal_b;
        let (slip, slip_slopes) = self.slip(context, point);
        let (carried, carried_slopes) = self.carried(&normal, &moves.normal);
        let rubbing = Rubbing {
            normal_b: normal,
            carried_b: carried,
            slip_b: slip,
            slip_velocity_b: contact.slip_velocity_b,
            pressed: contact.normal_force,
            share: self.share,
            stuck: self.record.is_none_or(|record| record.sticks),
        };
        let FrictionSlopes { force, slopes } = rubbing.slopes(&context.props(&contact.found).friction)?;
        let axes = plane_axes(&normal);
        let mut inputs = SMatrix::<f64, 8, VARIABLES>::zeros();
        for (k, axis) in axes.iter().enumerate() {
            let across = axis.transpose();
            inputs.fixed_rows_mut::<1>(k).copy_from(&padded(&(across * carried_slopes)));
            inputs.fixed_rows_mut::<1>(2 + k).copy_from(&padded(&(across * slip_slopes)));
            inputs.fixed_rows_mut::<1>(4 + k).copy_from(&(across * slip_velocity));
        }
        inputs.fixed_rows_mut::<1>(6).copy_from(pressed);
        inputs.fixed_rows_mut::<1>(7).copy_from(&padded(&self.share_slope));
        let along = slopes * inputs;
        let in_space = axes[0] * force[0] + axes[1] * force[1];
        // The axes of the plane turn with the normal: de = −(e·dn)·n.
        let leaning = normal * (in_space.transpose() * moves.normal);
        Some(axes[0] * along.row(0) + axes[1] * along.row(1) - padded(&leaning))
    }

    /// Bristle of the last commit in the present contact plane, m, and its derivatives with the normal.
    pub fn carried(&self, normal: &Vec3, turned: &Matrix3x6<f64>) -> (Vec3, Matrix3x6<f64>) {
        let Some(record) = self.record else { return (Vec3::zeros(), Matrix3x6::zeros()) };
        let carried = carry_by_smallest_rotation(&record.bristle_b, &record.normal_b, normal);
        (carried, carried_slopes(record, normal, turned))
    }

    /// Slip since the last commit, m, and its derivatives in the contact plane.
    fn slip(&self, context: &PairContext<'_>, point: &Matrix3x6<f64>) -> (Vec3, Matrix3x6<f64>) {
        let travel = self.travel(context, point);
        (travel.across_b, travel.across_slopes)
    }

    /// Motion of the contact point of A relative to B since the last commit.
    pub fn travel(&self, context: &PairContext<'_>, point: &Matrix3x6<f64>) -> Travel {
        let Some(since) = &context.motion.since_commit else { return Travel::none() };
        let (contact, moves) = (self.contact, &self.moves);
        let found = &contact.found;
        let element = context.body_a.element(self.kind_a, found.element_a);
        let reference = element.reference_point(found.key.end);
        let (before, now) = (since.x_ba.point(&reference), context.motion.x_ba.point(&reference));
        let of_now = displacement_slopes(&now);
        let present = contact.point_b - now;
        let half = if self.record.is_some() { 0.5 } else { 1.0 };
        let lever = self.record.map_or(present, |record| ((record.point_b - before) + present) * 0.5);
        let of_lever = (point - of_now) * half;
        let rotation = context.rotation(since);
        let of_rotation = rotation_slopes(rotation);
        let displaced = now - before + rotation.cross(&lever);
        let of_displaced = of_now - lever.cross_matrix() * of_rotation + rotation.cross_matrix() * of_lever;
        let normal = found.normal_b;
        let approach = -normal.dot(&displaced);
        let approach_slopes = -(displaced.transpose() * moves.normal) - normal.transpose() * of_displaced;
        let mut across = displaced + normal * approach;
        let mut across_slopes = of_displaced + moves.normal * approach + normal * approach_slopes;
        if let Some(surfaces) = context.surfaces.motions() {
            let earlier = self.record.map(|record| (record.point_b, record.normal_b));
            let motions = (context.motion, since);
            across += surfaces.travel(motions, earlier, &contact.point_b, &normal);
            across_slopes += surfaces.travel_slopes(motions, earlier, &self.place(point));
        }
        if self.record.is_none() && approach > found.depth {
            // Only the part after the first touch counts.
            let part = found.depth / approach;
            let of_part = (moves.depth - approach_slopes * part) / approach;
            across_slopes = across_slopes * part + across * of_part;
            across *= part;
        }
        Travel { approach, approach_slopes, across_b: across, across_slopes }
    }
}

/// Motion of a contact since the last commit, and its derivatives with respect to (u, φ).
pub(super) struct Travel {
    /// Depth gained, m; infinite without a committed pose, where every contact begins.
    pub approach: f64,
    pub approach_slopes: RowVector6<f64>,
    /// Slip in the contact plane, m; of a contact that begins, since its first touch.
    pub across_b: Vec3,
    pub across_slopes: Matrix3x6<f64>,
}

impl Travel {
    /// No motion: the pair has no committed pose.
    fn none() -> Self {
        Self {
            approach: f64::INFINITY,
            approach_slopes: RowVector6::zeros(),
            across_b: Vec3::zeros(),
            across_slopes: Matrix3x6::zeros(),
        }
    }
}

/// Derivatives of the bristle of a record, carried to a normal that turns.
pub(super) fn carried_slopes(
    record: &ContactRecord,
    normal: &Vec3,
    turned: &Matrix3x6<f64>,
) -> Matrix3x6<f64> {
    let (p, from) = (&record.bristle_b, &record.normal_b);
    let (cosine, axis) = (from.dot(normal), from.cross(normal));
    let denominator = (1.0 + cosine).max(f64::MIN_POSITIVE);
    let (of_cosine, of_axis) = (from.transpose() * turned, from.cross_matrix() * turned);
    let along = axis.dot(p) / denominator;
    p * of_cosine - p.cross_matrix() * of_axis
        + of_axis * along
        + axis * ((p.transpose() * of_axis - of_cosine * along) / denominator)
}

/// Derivatives of the rotation vector of A with a further small rotation φ: the inverse of the left Jacobian of
/// rotations.
pub(super) fn rotation_slopes(rotation: &Vec3) -> Matrix3x6<f64> {
    /// Angle, rad, below which the series is exact to rounding.
    const SMALL: f64 = 1e-2;
    let square = rotation.norm_squared();
    let angle = square.sqrt();
    // No divisor is zero, as a compiler may divide ahead of the branch.
    let least = angle.max(SMALL);
    let closed = 1.0 / (least * least) - (1.0 + libm::cos(least)) / (2.0 * least * libm::sin(least));
    let series = 1.0 / 12.0 + square * (1.0 / 720.0 + square / 30240.0);
    let factor = if angle < SMALL { series } else { closed };
    let cross = rotation.cross_matrix();
    let mut slopes = Matrix3x6::zeros();
    slopes.fixed_view_mut::<3, 3>(0, 3).copy_from(&(Mat3::identity() - cross * 0.5 + cross * cross * factor));
    slopes
}
