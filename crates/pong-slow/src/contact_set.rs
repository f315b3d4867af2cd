//! Contacts of a set of poses: force, stiffness and energy of their normal springs.

use crate::body::Body;
use crate::chart;
use crate::error::SlowError;
use nalgebra::Vector6;
use pong_engine::{Contact, NormalTangent, World};
use pong_geometry::{Pose, Vec3};

/// A direction at a contact: how far it opens with the displacements of two bodies.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub a: usize,
    pub b: usize,
    /// Opening of the contact per displacement of A, and of B.
    pub on_a: Vector6<f64>,
    pub on_b: Vector6<f64>,
}

impl Row {
    /// A direction (unit, common axes) at a point of A and a point of B (common frame).
    pub fn new(
        bodies: &[Body],
        poses: &[Pose],
        (a, b): (usize, usize),
        points: [&Vec3; 2],
        direction: &Vec3,
    ) -> Self {
        let on = |body: usize, point, direction: &Vec3| {
            chart::of_force_at(bodies[body].axes, &poses[body], point, direction)
        };
        Self { a, b, on_a: on(a, points[0], direction), on_b: on(b, points[1], &-direction) }
    }
}

/// A contact that pushes, as a spring along its normal.
#[derive(Clone, Debug)]
pub(crate) struct Spring {
    pub normal: Row,
    /// Normal force, N.
    pub force: f64,
    /// Derivative of the force by the depth, N/m.
    pub stiffness: f64,
    /// Stored energy, J, without that of friction.
    pub energy: f64,
}

/// Normal, and two unit vectors across it.
pub(crate) fn axes_of(normal: &Vec3) -> [Vec3; 3] {
    let least = normal.iamin();
    let mut axis = Vec3::zeros();
    axis[least] = 1.0;
    let across = normal.cross(&axis);
    let across = across / across.norm().max(f64::MIN_POSITIVE);
    [*normal, across, normal.cross(&across)]
}

/// Indices of the movable groups of a contact.
pub(crate) fn groups(contact: &Contact) -> (usize, usize) {
    (contact.a.interface.index(), contact.b.interface.index())
}

/// Sets the states of all bodies.
pub(crate) fn place(
    world: &mut World,
    bodies: &[Body],
    motion: impl Fn(usize) -> (Pose, Vector6<f64>),
) -> Result<(), SlowError> {
    for (index, body) in bodies.iter().enumerate() {
        let (pose, velocity) = motion(index);
        world.set_state(body.interface, &body.state_at(&pose, &velocity))?;
    }
    Ok(())
}

/// Contacts of bodies that stand still at these poses. Nothing is committed.
pub(crate) fn springs_at(
    world: &mut World,
    bodies: &[Body],
    poses: &[Pose],
) -> Result<Vec<Spring>, SlowError> {
    place(world, bodies, |index| (poses[index], Vector6::zeros()))?;
    world.evaluate()?;
    let listed = world.contacts_iter().zip(world.normal_tangents());
    let springs = listed.filter(|(contact, _)| contact.normal_force > 0.0);
    Ok(springs.map(|(contact, tangent)| spring(bodies, poses, &contact, tangent)).collect())
}

fn spring(bodies: &[Body], poses: &[Pose], contact: &Contact, tangent: Option<NormalTangent>) -> Spring {
    let normal = Row::new(bodies, poses, groups(contact), [&contact.point; 2], &contact.normal);
    let (force, depth) = (contact.normal_force, contact.depth);
    let secant = force / depth.max(f64::MIN_POSITIVE);
    let stiffness = tangent.map_or(secant, |tangent| tangent.stiffness);
    // F = k·δᵉ stores F·δ/(e + 1), and e is the ratio of tangent and secant. Cells of solids store what they say.
    let is_cell = contact.end >> 31 == 1;
    let energy = if is_cell { contact.stored } else { force * depth / (1.0 + stiffness / secant) };
    Spring { normal, force, stiffness, energy }
}
