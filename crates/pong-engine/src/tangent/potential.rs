//! Incremental potential of a step: a function of the poses at its end (docs/theory.md, 7).

use super::contact::Moving;
use crate::frame::input::PairContext;
use crate::frame::input::relative::Motions;
use crate::ids::{InterfaceId, WorldStamp};
use crate::law::{BristleIncrement, FrictionProps, bristle_increment, normal_increment};
use crate::tangent::TangentMatrix;
use nalgebra::{Matrix6, RowVector6, SMatrix, Vector6};
use pong_geometry::{Mat3, Vec3, Wrench};

/// Length, m, whose inverse times a force is finite.
const SHORT_M: f64 = 1e-120;

/// Incremental potential of the contacts of two movable groups in the last frame: the energy Φ that they add, as a
/// function of the poses at the end of a step of a given length, with the contact state of its start.
///
/// The wrenches −∂Φ/∂x come close to those that [`evaluate`](crate::World::evaluate) returns and are not the same:
/// the limit of friction follows the load at the start of the step, and the damping the depth gained in the step over
/// its length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairPotential {
    /// The two movable groups.
    pub groups: [InterfaceId; 2],
    /// Φ, J.
    pub energy: f64,
    /// −∂Φ/∂x on each group: force, N, and moment about the group's origin, N·m, along common axes.
    pub wrenches: [Wrench; 2],
    /// Second derivatives of Φ without the turning of normals and levers, N/m, N/rad, N, N·m/rad: blocks as those of
    /// [`PairTangent::stiffness`](crate::PairTangent::stiffness), together symmetric and without a negative eigenvalue
    /// while no damper pulls.
    pub stiffness: [[TangentMatrix; 2]; 2],
    bodies: [usize; 2],
}

/// Potential of one direction of a pair of groups, and its derivatives with respect to (u, φ) in B's frame.
#[derive(Default)]
pub(super) struct Increment {
    pub energy: f64,
    slope: RowVector6<f64>,
    curvature: Matrix6<f64>,
}

impl Increment {
    /// Adds a contact. `None` for a host's law.
    pub fn add(&mut self, moving: &Moving<'_>, context: &PairContext<'_>, step: f64) -> Option<()> {
        let found = &moving.contact.found;
        let props = context.props(found);
        let point = moving.point(props.share_a);
        let travel = moving.travel(context, &point);
        let (start, of_start) = match travel.approach < found.depth {
            true => (found.depth - travel.approach, moving.moves.depth - travel.approach_slopes),
            false => (0.0, RowVector6::zeros()),
        };
        let weight = found.full_weight();
        let normal = normal_increment(props, found.depth, start, step)?;
        let of_weight = moving.weight * found.half_or_whole();
        self.energy += weight * normal.energy;
        self.slope += (moving.moves.depth * normal.force + of_start * normal.by_start) * weight
            + of_weight * normal.energy;
        self.curvature += moving.pressing.transpose() * moving.pressing * (weight * normal.stiffness);
        self.add_friction(moving, &props.friction, (&travel.across_b, &travel.across_slopes), step)
    }

    fn add_friction(
        &mut self,
        moving: &Moving<'_>,
        law: &FrictionProps,
        (slip, slip_slopes): (&Vec3, &SMatrix<f64, 3, 6>),
        step: f64,
    ) -> Option<()> {
        let limit = match law {
            FrictionProps::None => return Some(()),
            FrictionProps::Bristle { mu_kinetic, .. } => mu_kinetic * moving.load_before(),
            FrictionProps::Coulomb { mu, .. } => mu * moving.load_before(),
            FrictionProps::Custom { .. } => return None,
        };
        let BristleIncrement { stiffness, carried, is_shared } = bristle_increment(law, limit, step)?;
        let normal = moving.contact.found.normal_b;
        let (bristle, of_bristle) = moving.carried(&normal, &moving.moves.normal);
        let (stretch, of_stretch) = (bristle * carried + slip, of_bristle * carried + slip_slopes);
        let (share, of_share) = match is_shared {
            true => (moving.share, moving.share_slope),
            false => (1.0, RowVector6::zeros()),
        };
        let (spring, length) = (stiffness * share, stretch.norm());
        let in_plane = Mat3::identity() - normal * normal.transpose();
        // Stretch at the limit, of a finite length for a bristle without stiffness as well.
        let yielding = limit / spring.max(limit * SHORT_M).max(f64::MIN_POSITIVE);
        let (energy, force, hessian) = if spring * length <= limit {
            (0.5 * spring * length * length, stretch * spring, in_plane * spring)
        } else {
            let along = stretch / length.max(f64::MIN_POSITIVE);
            let round = (in_plane - along * along.transpose()) * (limit / length.max(SHORT_M));
            (limit * (length - 0.5 * yielding), along * limit, round)
        };
        let held = length.min(yielding);
        self.energy += energy;
        self.slope += force.transpose() * of_stretch + of_share * (0.5 * stiffness * held * held);
        self.curvature += of_stretch.transpose() * hessian * of_stretch;
        Some(())
    }
}

impl PairPotential {
    /// Zero potential of two movable groups.
    pub(super) fn of_groups(stamp: WorldStamp, bodies: [usize; 2]) -> Self {
        Self {
            groups: bodies.map(|body| InterfaceId::new(stamp, body)),
            energy: 0.0,
            wrenches: [Wrench::zero(); 2],
            stiffness: [[TangentMatrix::zeros(); 2]; 2],
            bodies,
        }
    }

    /// Adds the contacts of one direction, A of body `a` and B of body `b`.
    pub(super) fn add(&mut self, of: &Increment, motions: &Motions<'_>, (a, b): (usize, usize)) {
        self.energy += of.energy;
        let side = |body: usize| usize::from(body == self.bodies[1]);
        let sides = [side(a), side(b)];
        let rotation = motions.poses[b].orientation.to_rotation_matrix().into_inner();
        let maps = relative_motions(&rotation, &(motions.poses[b].position - motions.poses[a].position));
        for (row, map) in sides.into_iter().zip(&maps) {
            let down: Vector6<f64> = -(of.slope * map).transpose();
            let [force, moment] = [0, 3].map(|first| down.fixed_rows::<3>(first).into_owned());
            self.wrenches[row] += Wrench { force, moment };
            for (column, other) in sides.into_iter().zip(&maps) {
                self.stiffness[row][column] += map.transpose() * of.curvature * other;
            }
        }
    }
}

/// Derivatives of (u, φ), in B's frame at B's origin, with respect to the poses of A and of B along common axes. `arm`
/// goes from A's origin to B's.
fn relative_motions(rotation: &Mat3, arm: &Vec3) -> [Matrix6<f64>; 2] {
    let to_b = rotation.transpose();
    let mut of_a = Matrix6::zeros();
    of_a.fixed_view_mut::<3, 3>(0, 0).copy_from(&to_b);
    of_a.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-to_b * arm.cross_matrix()));
    of_a.fixed_view_mut::<3, 3>(3, 3).copy_from(&to_b);
    let mut of_b = Matrix6::zeros();
    of_b.fixed_view_mut::<3, 3>(0, 0).copy_from(&-to_b);
    of_b.fixed_view_mut::<3, 3>(3, 3).copy_from(&-to_b);
    [of_a, of_b]
}
