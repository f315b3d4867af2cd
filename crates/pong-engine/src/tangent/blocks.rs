//! Sum of the contacts of two movable groups, and its blocks in common axes.

use super::contact::{ContactSlopes, VARIABLES};
use super::resistance::CoupleSlopes;
use crate::frame::FrameContact;
use crate::frame::input::PairContext;
use crate::frame::input::relative::Motions;
use crate::ids::{InterfaceId, WorldStamp};
use nalgebra::{SMatrix, SVector};
use pong_geometry::{Mat3, Vec3, Wrench};

/// Derivative of a wrench (rows: force, moment) with respect to a pose or a twist (columns: translation, rotation).
pub type TangentMatrix = SMatrix<f64, 6, 6>;

/// Derivatives of the wrenches that two movable groups put on each other in the last frame.
///
/// `stiffness[i][j]` is −∂W/∂x: the wrench W on group i (N, N·m, about the origin of this group, along common
/// axes), with respect to the pose x of group j: translation of its origin, m, and rotation vector, rad, both along
/// common axes. `damping[i][j]` is −∂W/∂v with respect to the twist of group j: velocity of its origin, m/s, and
/// angular velocity, rad/s. i and j are 0 for the first group, 1 for the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairTangent {
    /// The two movable groups.
    pub groups: [InterfaceId; 2],
    /// True if central differences gave the blocks.
    pub by_differences: bool,
    /// −∂W/∂x, N/m, N/rad, N, N·m/rad.
    pub stiffness: [[TangentMatrix; 2]; 2],
    /// −∂W/∂v, N·s/m, N·s/rad, N·s, N·m·s/rad.
    pub damping: [[TangentMatrix; 2]; 2],
    pub(super) touches: bool,
    bodies: [usize; 2],
}

/// Derivatives of the force of B on A and of its moment about B's origin, in B's frame. Columns: displacement and
/// rotation of A relative to B, relative velocity and relative angular velocity; the first and the third at B's
/// origin.
pub(super) struct DirectionSlopes {
    slopes: SMatrix<f64, 6, 12>,
    wrench: Wrench,
    touches: bool,
}

impl Default for DirectionSlopes {
    fn default() -> Self {
        Self { slopes: SMatrix::zeros(), wrench: Wrench::zero(), touches: false }
    }
}

impl DirectionSlopes {
    /// Adds a contact.
    pub fn add(&mut self, slopes: &ContactSlopes, contact: &FrameContact) {
        let (point, force) = (contact.point_b, contact.force());
        let mut moment: SMatrix<f64, 3, VARIABLES> = point.cross_matrix() * slopes.force;
        let turned = moment.fixed_columns::<6>(0) - force.cross_matrix() * slopes.point;
        moment.fixed_columns_mut::<6>(0).copy_from(&turned);
        self.add_rows(0, &slopes.force, &point);
        self.add_rows(3, &moment, &point);
        self.wrench += Wrench::of_force_at(force, &point);
        self.touches = true;
    }

    /// Adds the couple that resists rolling and spinning at a contact.
    pub fn add_couple(&mut self, couple: &CoupleSlopes) {
        let mut moment = self.slopes.fixed_rows_mut::<3>(3);
        moment += couple.slopes;
        self.wrench.moment += couple.moment_b;
    }

    /// Adds three rows. An angular velocity moves the contact point, to which the velocity belongs.
    fn add_rows(&mut self, first: usize, rows: &SMatrix<f64, 3, VARIABLES>, point: &Vec3) {
        let lever = -point.cross_matrix();
        let part = |column: usize| rows.fixed_columns::<3>(column).into_owned();
        let columns = [part(0), part(3), part(6), part(6) * lever];
        for (index, column) in columns.into_iter().enumerate() {
            let mut sum = self.slopes.fixed_view_mut::<3, 3>(first, 3 * index);
            sum += column;
        }
    }
}

impl PairTangent {
    /// Zero tangent of two movable groups.
    pub(crate) fn of_groups(stamp: WorldStamp, bodies: [usize; 2]) -> Self {
        let zero = [[TangentMatrix::zeros(); 2]; 2];
        Self {
            groups: bodies.map(|body| InterfaceId::new(stamp, body)),
            by_differences: false,
            stiffness: zero,
            damping: zero,
            touches: false,
            bodies,
        }
    }

    /// Adds the contacts of one direction.
    pub(super) fn add(
        &mut self,
        direction: &DirectionSlopes,
        context: &PairContext<'_>,
        motions: &Motions<'_>,
        (a, b): (usize, usize),
    ) {
        if !direction.touches {
            return;
        }
        self.touches = true;
        let side = |body: usize| usize::from(body == self.bodies[1]);
        let of_pair = InCommonAxes::new(direction, context, motions, (a, b));
        let places = [side(a), side(b)];
        for column in 0..12 {
            let mut direction = SVector::<f64, 12>::zeros();
            direction[column] = 1.0;
            let by_pose = of_pair.by_pose(&direction);
            let by_twist = of_pair.by_twist(&direction);
            let of_group = places[column / 6];
            for (row, &on) in places.iter().enumerate() {
                let mut stiffness = self.stiffness[on][of_group].column_mut(column % 6);
                stiffness -= by_pose.fixed_rows::<6>(6 * row);
                let mut damping = self.damping[on][of_group].column_mut(column % 6);
                damping -= by_twist.fixed_rows::<6>(6 * row);
            }
        }
    }
}

/// Directional derivatives of the wrenches on A and B, in common axes. Directions: translation and rotation of A,
/// then of B.
struct InCommonAxes<'a> {
    slopes: &'a DirectionSlopes,
    /// Rotation from B's axes to common axes.
    rotation: Mat3,
    /// Vector from A's origin to B's.
    arm: Vec3,
    /// Angular velocity of A, and of A relative to B, rad/s.
    omega_a: Vec3,
    omega: Vec3,
    /// Velocity of A relative to B at B's origin, m/s.
    velocity: Vec3,
    /// Force on A, N, and its moment about B's origin, N·m.
    force: Vec3,
    moment: Vec3,
}

impl<'a> InCommonAxes<'a> {
    fn new(
        slopes: &'a DirectionSlopes,
        context: &PairContext<'_>,
        motions: &Motions<'_>,
        (a, b): (usize, usize),
    ) -> Self {
        let rotation = motions.poses[b].orientation.to_rotation_matrix().into_inner();
        let motion = context.motion;
        Self {
            slopes,
            rotation,
            arm: motions.poses[b].position - motions.poses[a].position,
            omega_a: rotation * motion.omega_a_b,
            omega: rotation * (motion.omega_a_b - motion.omega_b_b),
            velocity: rotation * motion.velocity_at(&Vec3::zeros()),
            force: rotation * slopes.wrench.force,
            moment: rotation * slopes.wrench.moment,
        }
    }

    /// Change of both wrenches by small motions of A and B.
    fn by_pose(&self, direction: &SVector<f64, 12>) -> SVector<f64, 12> {
        let part = |k: usize| direction.fixed_rows::<3>(3 * k).into_owned();
        let [move_a, turn_a, move_b, turn_b] = [part(0), part(1), part(2), part(3)];
        let moved = move_a + turn_a.cross(&self.arm) - move_b;
        let velocity = self.omega_a.cross(&(move_b - move_a)) - turn_b.cross(&self.velocity);
        let changes = [moved, turn_a - turn_b, velocity, -turn_b.cross(&self.omega)];
        let [force, moment] = self.changed(changes);
        let force = force + turn_b.cross(&self.force);
        let moment = moment + turn_b.cross(&self.moment);
        let moment_a = moment + (move_b - move_a).cross(&self.force) + self.arm.cross(&force);
        stacked([force, moment_a, -force, -moment])
    }

    /// Change of both wrenches by small changes of the twists of A and B.
    fn by_twist(&self, direction: &SVector<f64, 12>) -> SVector<f64, 12> {
        let part = |k: usize| direction.fixed_rows::<3>(3 * k).into_owned();
        let [linear_a, angular_a, linear_b, angular_b] = [part(0), part(1), part(2), part(3)];
        let velocity = linear_a + angular_a.cross(&self.arm) - linear_b;
        let [force, moment] = self.changed([Vec3::zeros(), Vec3::zeros(), velocity, angular_a - angular_b]);
        stacked([force, moment + self.arm.cross(&force), -force, -moment])
    }

    /// Change of the force on A and of its moment about B's origin, seen from B.
    fn changed(&self, changes: [Vec3; 4]) -> [Vec3; 2] {
        let to_b = self.rotation.transpose();
        let changes = stacked(changes.map(|change| to_b * change));
        let changed = self.slopes.slopes * changes;
        [0, 3].map(|row| self.rotation * changed.fixed_rows::<3>(row))
    }
}

fn stacked(parts: [Vec3; 4]) -> SVector<f64, 12> {
    SVector::from_fn(|row, _| parts[row / 3][row % 3])
}
