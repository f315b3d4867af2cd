//! Surfaces of two movable groups that move along themselves (docs/theory.md, 4).

use super::motion::{Motion, SinceCommit};
use crate::scene::{SurfaceField, SurfaceMotion};
use crate::state::{CommittedPoses, ContactRecord};
use nalgebra::Matrix3x6;
use pong_geometry::pose::{displacement_slopes, turn_slopes};
use pong_geometry::{Transform, Vec3};

/// Velocity and travel of the surface of a movable group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupSurface {
    velocity: SurfaceField,
    pub travel: SurfaceField,
}

/// Surfaces of A and B. Their motions are large and rarely there, so they are computed where they are used.
#[derive(Clone, Copy)]
pub(crate) struct PairSurfaces<'a> {
    /// Surfaces of all movable groups; empty where none moves or has moved.
    pub all: &'a [GroupSurface],
    /// Movable groups A and B.
    pub bodies: [usize; 2],
    /// Pair of Objects.
    pub pair: usize,
    pub committed: &'a CommittedPoses,
}

impl PairSurfaces<'_> {
    /// Motions of the surfaces along themselves; `None` where neither moves.
    #[inline]
    pub fn motions(&self) -> Option<MovingSurfaces> {
        match self.all.is_empty() {
            true => None,
            false => MovingSurfaces::of(self.all, self.bodies, (self.pair, self.committed)),
        }
    }
}

/// Motion of the surfaces of A and B relative to their movable groups, each in the frame of its group.
pub(crate) struct MovingSurfaces {
    velocities: [SurfaceField; 2],
    /// Travel since the last commit; zero without an earlier pose.
    travels: [SurfaceField; 2],
}

impl From<&SurfaceMotion> for GroupSurface {
    fn from(motion: &SurfaceMotion) -> Self {
        Self { velocity: motion.velocity(), travel: motion.travel() }
    }
}

impl MovingSurfaces {
    /// Motion of the surfaces of `bodies`, A and B, of a pair of Objects; `None` where neither moves. `surfaces` are
    /// those of all movable groups.
    #[inline(never)]
    pub fn of(
        surfaces: &[GroupSurface],
        bodies: [usize; 2],
        (pair, committed): (usize, &CommittedPoses),
    ) -> Option<Self> {
        let velocities = bodies.map(|body| surfaces[body].velocity);
        let travels = bodies.map(|body| {
            let earlier = committed.travel(pair, body);
            earlier.map_or_else(SurfaceField::default, |earlier| surfaces[body].travel.minus(&earlier))
        });
        let moves = velocities.iter().chain(&travels).any(|field| !field.is_zero());
        moves.then_some(Self { velocities, travels })
    }

    /// Velocity of A's surface relative to A's group minus that of B's surface relative to B's group, in B's frame,
    /// m/s. It lies in the contact plane.
    #[inline(never)]
    pub fn velocity(&self, motion: &Motion, point_b: &Vec3, normal_b: &Vec3) -> Vec3 {
        tangential(&relative(&self.velocities, &motion.x_ba, point_b, normal_b), normal_b)
    }

    /// Angular velocity of A's surface relative to A's group minus that of B's, in B's frame, rad/s.
    pub fn angular_velocity(&self, motion: &Motion) -> Vec3 {
        motion.x_ba.vector(self.velocities[0].angular()) - self.velocities[1].angular()
    }

    /// Angle by which A's surface has turned relative to A's group since the last commit minus that of B's, in B's
    /// frame, rad.
    pub fn turned(&self, motion: &Motion) -> Vec3 {
        motion.x_ba.vector(self.travels[0].angular()) - self.travels[1].angular()
    }

    /// Travel of A's surface since the last commit minus that of B's, at a contact that moves from `earlier` (point
    /// and normal) to the present point: the mean of the travels at both. In B's frame, m; in the contact plane.
    #[inline(never)]
    pub fn travel(
        &self,
        (motion, since): (&Motion, &SinceCommit),
        earlier: Option<(Vec3, Vec3)>,
        point_b: &Vec3,
        normal_b: &Vec3,
    ) -> Vec3 {
        let now = self.travel_at(&motion.x_ba, point_b, normal_b);
        let mean =
            earlier.map_or(now, |(point, normal)| (self.travel_at(&since.x_ba, &point, &normal) + now) * 0.5);
        tangential(&mean, normal_b)
    }

    /// Travel of A's surface minus that of B's at one point, for a pose of A, in B's frame, m. It may have a part along
    /// the normal.
    fn travel_at(&self, x_ba: &Transform, point_b: &Vec3, normal_b: &Vec3) -> Vec3 {
        relative(&self.travels, x_ba, point_b, normal_b)
    }

    /// Derivatives of [`velocity`](Self::velocity) along the contact plane, for a contact that moves.
    pub fn velocity_slopes(&self, motion: &Motion, place: &MovingPlace<'_>) -> Matrix3x6<f64> {
        let field = relative(&self.velocities, &motion.x_ba, place.point_b, place.normal_b);
        tangential_slopes(&relative_slopes(&self.velocities, &motion.x_ba, place), &field, place)
    }

    /// Derivatives of [`travel`](Self::travel) along the contact plane, for a contact that moves.
    pub fn travel_slopes(
        &self,
        (motion, since): (&Motion, &SinceCommit),
        earlier: Option<(Vec3, Vec3)>,
        place: &MovingPlace<'_>,
    ) -> Matrix3x6<f64> {
        let now = self.travel_at(&motion.x_ba, place.point_b, place.normal_b);
        let slopes = relative_slopes(&self.travels, &motion.x_ba, place);
        match earlier {
            None => tangential_slopes(&slopes, &now, place),
            Some((point, normal)) => {
                let mean = (self.travel_at(&since.x_ba, &point, &normal) + now) * 0.5;
                tangential_slopes(&(slopes * 0.5), &mean, place)
            }
        }
    }

    /// Work of the drives of the two surfaces since the last commit, J, against the friction of a contact, by the
    /// trapezoidal rule. `before` is its record of the last commit, and `now` its point, normal and friction force.
    pub fn drive_work(
        &self,
        (motion, since): (&Motion, &SinceCommit),
        before: &ContactRecord,
        now: Option<(&Vec3, &Vec3, &Vec3)>,
    ) -> f64 {
        let half = |x_ba: &Transform, point: &Vec3, normal: &Vec3, friction: &Vec3| {
            -0.5 * friction.dot(&self.travel_at(x_ba, point, normal))
        };
        let friction = tangential(&before.force_b, &before.normal_b);
        half(&since.x_ba, &before.point_b, &before.normal_b, &friction)
            + now.map_or(0.0, |(point, normal, friction)| half(&motion.x_ba, point, normal, friction))
    }
}

/// Field of A minus that of B at a point, in B's frame. The outward normal of B is `normal_b`, that of A opposite.
fn relative(fields: &[SurfaceField; 2], x_ba: &Transform, point_b: &Vec3, normal_b: &Vec3) -> Vec3 {
    let x_ab = x_ba.inverse();
    let of_a = fields[0].at(&x_ab.point(point_b), &-x_ab.vector(normal_b));
    x_ba.vector(&of_a) - fields[1].at(point_b, normal_b)
}

/// A contact point and its normal, with their derivatives with respect to a translation and a rotation of A at B's
/// origin (docs/theory.md, 7).
pub(crate) struct MovingPlace<'a> {
    pub point_b: &'a Vec3,
    pub normal_b: &'a Vec3,
    pub point_slopes: &'a Matrix3x6<f64>,
    pub normal_slopes: &'a Matrix3x6<f64>,
}

/// Derivatives of [`relative`].
fn relative_slopes(fields: &[SurfaceField; 2], x_ba: &Transform, place: &MovingPlace<'_>) -> Matrix3x6<f64> {
    let MovingPlace { point_b, normal_b, point_slopes, normal_slopes } = *place;
    let [linear, angular, belt] = fields[0].parts().map(|part| x_ba.vector(&part));
    let arm = point_b - x_ba.translation;
    let of_a = turn_slopes(&linear) - arm.cross_matrix() * turn_slopes(&angular)
        + angular.cross_matrix() * (point_slopes - displacement_slopes(&x_ba.translation))
        + normal_b.cross_matrix() * turn_slopes(&belt)
        - belt.cross_matrix() * normal_slopes;
    let [_, angular, belt] = fields[1].parts();
    of_a - angular.cross_matrix() * point_slopes - belt.cross_matrix() * normal_slopes
}

/// Derivatives of the part of a vector in the contact plane, but for those along the normal.
fn tangential_slopes(slopes: &Matrix3x6<f64>, vector: &Vec3, place: &MovingPlace<'_>) -> Matrix3x6<f64> {
    slopes - place.normal_slopes * place.normal_b.dot(vector)
}

/// Part of a vector in the plane with a unit normal.
fn tangential(vector: &Vec3, normal: &Vec3) -> Vec3 {
    vector - normal * normal.dot(vector)
}
