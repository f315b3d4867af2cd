//! Derivatives of the couple that resists rolling and spinning at a contact (docs/theory.md, 4).
//!
//! Both bristles of the couple follow the law of friction, with the angle turned times the lever as slip.

use super::contact::{ContactSlopes, Moving, carried_slopes, rotation_slopes};
use super::friction::Rubbing;
use super::moves::plane_axes;
use crate::frame::forces::couples::Resisted;
use crate::frame::input::PairContext;
use crate::law::FrictionProps;
use nalgebra::{Matrix3x6, SMatrix};
use pong_geometry::pose::displacement_slopes;
use pong_geometry::{Mat3, Vec3};

/// Variables: u and φ of the relative pose, relative velocity and relative angular velocity, at B's origin, in B's
/// frame.
const VARIABLES: usize = 12;
type Row = SMatrix<f64, 1, VARIABLES>;
type Rows3 = SMatrix<f64, 3, VARIABLES>;

/// Moment of a couple on A, N·m, and its derivatives, in B's frame.
pub(super) struct CoupleSlopes {
    pub moment_b: Vec3,
    pub slopes: Rows3,
}

/// A vector of the couple and its derivatives.
struct Turned {
    vector: Vec3,
    slopes: Rows3,
}

impl Turned {
    /// Part in the contact plane along an axis of this plane: the plane turns with the normal.
    fn across(&self, axis: &Vec3, normal: &Vec3, turned: &Rows3) -> Row {
        axis.transpose() * (self.slopes - turned * normal.dot(&self.vector))
    }

    /// Part along the normal.
    fn along(&self, normal: &Vec3, turned: &Rows3) -> Row {
        self.vector.transpose() * turned + normal.transpose() * self.slopes
    }
}

/// Couple of a contact with a normal force, given the derivatives of this force and of the contact point. `None` where
/// surfaces move along themselves as well.
pub(super) fn couple(
    moving: &Moving<'_>,
    context: &PairContext<'_>,
    contact: &ContactSlopes,
) -> Option<CoupleSlopes> {
    let found = &moving.contact.found;
    let FrictionProps::Bristle { stiffness, damping, rolling, spinning, .. } = context.props(found).friction
    else {
        return None;
    };
    if context.surfaces.motions().is_some() {
        return None;
    }
    let Some(resisted) = Resisted::of(context, moving.kind_a, found, moving.share) else {
        return Some(CoupleSlopes { moment_b: Vec3::zeros(), slopes: Rows3::zeros() });
    };
    let resistance = &resisted.resistance;
    let normal = resistance.normal_b;
    let turned_normal = widened(&moving.moves.normal);
    let [carried, angle, rate] = vectors(moving, context, &resisted, &contact.point);
    let lever = resistance.lever;
    let axes = plane_axes(&normal);
    let pressed = at_origin(&contact.pressed, &resisted.point_b);
    let share = widened(&moving.share_slope);
    let mut sum = CoupleSlopes { moment_b: Vec3::zeros(), slopes: Rows3::zeros() };
    for (index, length) in [rolling, spinning].into_iter().enumerate().filter(|(_, length)| *length > 0.0) {
        let in_plane = |of: &Turned, factor: f64| match index {
            0 => (of.vector - normal * normal.dot(&of.vector)) * factor,
            _ => axes[0] * (normal.dot(&of.vector) * factor),
        };
        let rubbing = Rubbing {
            normal_b: normal,
            carried_b: in_plane(&carried, 1.0),
            slip_b: in_plane(&angle, lever),
            slip_velocity_b: in_plane(&rate, lever),
            pressed: moving.contact.normal_force,
            share: moving.share,
            stuck: resistance.stuck[index],
        };
        let mu = length / lever;
        let law = FrictionProps::Bristle {
            stiffness,
            damping,
            mu_kinetic: mu,
            mu_static: mu,
            rolling: 0.0,
            spinning: 0.0,
        };
        let friction = rubbing.slopes(&law)?;
        let mut inputs = SMatrix::<f64, 8, VARIABLES>::zeros();
        for (first, of, factor) in [(0, &carried, 1.0), (2, &angle, lever), (4, &rate, lever)] {
            if index == 1 {
                inputs.fixed_rows_mut::<1>(first).copy_from(&(of.along(&normal, &turned_normal) * factor));
                continue;
            }
            for (k, axis) in axes.iter().enumerate() {
                let row = of.across(axis, &normal, &turned_normal) * factor;
                inputs.fixed_rows_mut::<1>(first + k).copy_from(&row);
            }
        }
        inputs.fixed_rows_mut::<1>(6).copy_from(&pressed);
        inputs.fixed_rows_mut::<1>(7).copy_from(&share);
        let forces = friction.slopes * inputs;
        let [e, f] = friction.force;
        let (moment, slopes) = if index == 0 {
            let moment = axes[0] * e + axes[1] * f;
            let leaning = normal * (moment.transpose() * turned_normal);
            (moment, axes[0] * forces.row(0) + axes[1] * forces.row(1) - leaning)
        } else {
            (normal * e, normal * forces.row(0) + turned_normal * e)
        };
        sum.moment_b += moment * lever;
        sum.slopes += slopes * lever;
    }
    Some(sum)
}

/// Bristle in the present contact plane, angle turned since the last commit, and angular velocity, with their derivatives.
fn vectors(
    moving: &Moving<'_>,
    context: &PairContext<'_>,
    resisted: &Resisted<'_>,
    point: &Matrix3x6<f64>,
) -> [Turned; 3] {
    let resistance = &resisted.resistance;
    let first = resisted.earlier[0].map(|(_, record)| record);
    let carried = first.map_or(Matrix3x6::zeros(), |record| {
        carried_slopes(record, &resistance.normal_b, &moving.moves.normal)
    });
    let turned = match first {
        Some(_) => context
            .motion
            .since_commit
            .as_ref()
            .map_or(Matrix3x6::zeros(), |since| rotation_slopes(context.rotation(since))),
        None => since_touch(moving, context, &resisted.point_b, point),
    };
    let mut rate = Rows3::zeros();
    rate.fixed_columns_mut::<3>(9).copy_from(&Mat3::identity());
    [
        Turned { vector: resistance.carried_b, slopes: widened(&carried) },
        Turned { vector: resistance.turned_b, slopes: widened(&turned) },
        Turned { vector: resistance.rate_b, slopes: rate },
    ]
}

/// Derivatives of the angle turned by a contact that begins: the part of the rotation after the touch.
fn since_touch(
    moving: &Moving<'_>,
    context: &PairContext<'_>,
    point_b: &Vec3,
    point: &Matrix3x6<f64>,
) -> Matrix3x6<f64> {
    let Some(since) = &context.motion.since_commit else { return Matrix3x6::zeros() };
    let (found, moves) = (&moving.contact.found, &moving.moves);
    let rotation = context.rotation(since);
    let slopes = rotation_slopes(rotation);
    let to_before = since.x_ba.rotation * context.motion.x_ba.rotation.transpose();
    let before = since.x_ba.point(&context.motion.x_ba.inverse().point(point_b));
    let approach = found.normal_b.dot(&(before - point_b));
    if approach <= found.depth {
        return slopes;
    }
    let of_before = to_before * (point - displacement_slopes(point_b));
    let of_approach =
        (before - point_b).transpose() * moves.normal + found.normal_b.transpose() * (of_before - point);
    let part = found.depth / approach;
    slopes * part + rotation * ((moves.depth - of_approach * part) / approach)
}

/// Columns of (u, φ) in those of all variables.
fn widened<const R: usize>(pose: &SMatrix<f64, R, 6>) -> SMatrix<f64, R, VARIABLES> {
    let mut all = SMatrix::<f64, R, VARIABLES>::zeros();
    all.fixed_columns_mut::<6>(0).copy_from(pose);
    all
}

/// A row whose velocity belongs to the contact point, with velocities at B's origin.
fn at_origin(row: &SMatrix<f64, 1, 9>, point: &Vec3) -> Row {
    let mut all = Row::zeros();
    all.fixed_columns_mut::<9>(0).copy_from(row);
    let velocity = row.fixed_columns::<3>(6).into_owned();
    all.fixed_columns_mut::<3>(9).copy_from(&(velocity * -point.cross_matrix()));
    all
}
