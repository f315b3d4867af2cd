//! Equivalent linear interface: stiffness and damping of the contacts between two sets of movable groups at a preload,
//! and the loads up to which they hold (docs/modes.md).
//!
//! | file | content |
//! |---|---|
//! | `limits.rs` | the contact that opens first and the one that slides first under each load |

mod limits;

pub use limits::{Ending, LoadLimit};

use limits::PreloadedContact;
use nalgebra::{Matrix6, SMatrix, Vector6};
use pong_engine::{Contact, EngineError, InterfaceId, Scene, TangentMatrix, World};
use pong_geometry::{Pose, Vec3, Wrench};

/// Singular value below which a stiffness counts as zero, relative to the largest one.
const NO_STIFFNESS: f64 = 1e-9;
/// Part of a unit load that may stay unbalanced in a motion that holds this load.
const UNBALANCED: f64 = 1e-6;

/// Linear interface of a set of movable groups on another set. The groups of a set move as one rigid body. The
/// reference point and the axes are the origin and the axes of the first group of the first set.
#[derive(Clone, Debug)]
pub struct LinearInterface {
    /// Pose of the reference point and the axes in the common frame, m.
    pub frame: Pose,
    /// −∂W/∂x: W the wrench on the first set, x its translation and its rotation vector while the second set is
    /// fixed. N/m, N/rad, N, N·m/rad.
    pub stiffness: TangentMatrix,
    /// −∂W/∂v: v the velocity and the angular velocity of the first set. N·s/m, N·s/rad, N·s, N·m·s/rad.
    pub damping: TangentMatrix,
    /// Wrench of the second set on the first one in the state, N and N·m.
    pub preload: Wrench,
    /// Loads at which the first contact opens and the first bristle lets go, by component and sign of the load.
    pub limits: Vec<LoadLimit>,
    /// True for each component of a load that the contacts hold; 0 to 2 force, 3 to 5 moment.
    pub holds: [bool; 6],
    /// Number of contacts between the two sets.
    pub contacts: usize,
    /// Number of these contacts whose friction slips.
    pub slipping: usize,
    /// Number of these contacts that have no stiffness in closed form: `limits` leaves them out.
    pub without_limit: usize,
    /// True if central differences gave a part of the stiffness and the damping.
    pub by_differences: bool,
}

impl LinearInterface {
    /// Interface of the frame last evaluated.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] for an empty set, a group in both sets, and sets that do not touch each other; errors
    /// of [`World::complete_tangents`].
    pub fn between(
        world: &mut World,
        first: &[InterfaceId],
        second: &[InterfaceId],
    ) -> Result<Self, EngineError> {
        let refused = |cause: &str| EngineError::BadValue {
            what: "linear interface".to_owned(),
            cause: cause.to_owned(),
        };
        let Some(reference) = first.first() else {
            return Err(refused("the first set has no group; name one"));
        };
        if first.iter().any(|group| second.contains(group)) {
            return Err(refused("a group is in both sets; name it in one"));
        }
        let tangents = world.complete_tangents()?;
        let frame = pose(world, *reference)?;
        let mut interface = Self {
            frame,
            stiffness: TangentMatrix::zeros(),
            damping: TangentMatrix::zeros(),
            preload: Wrench::zero(),
            limits: Vec::new(),
            holds: [false; 6],
            contacts: 0,
            slipping: 0,
            without_limit: 0,
            by_differences: false,
        };
        for tangent in &tangents {
            let is_between = |own: usize| {
                first.contains(&tangent.groups[own]) && second.contains(&tangent.groups[1 - own])
            };
            let Some(own) = (0..2).find(|own| is_between(*own)) else { continue };
            let arm = pose(world, tangent.groups[own])?.position - frame.position;
            let wrench = world.wrench_from_common(tangent.groups[own], tangent.groups[1 - own])?;
            interface.add(&arm, &wrench, (&tangent.stiffness[own][own], &tangent.damping[own][own]));
            interface.by_differences |= tangent.by_differences;
        }
        let contacts = interface.preloaded_contacts(world, first, second)?;
        if interface.contacts == 0 {
            return Err(refused("the two sets do not touch each other; choose a state in which they do"));
        }
        let lever = contacts.iter().map(PreloadedContact::lever).fold(0.0, f64::max);
        interface.find_limits(&contacts, if lever > 0.0 { lever } else { 1.0 });
        interface.turn_to_axes();
        Ok(interface)
    }

    /// Adds a group of the first set whose origin is at `arm` from the reference point, along common axes.
    fn add(&mut self, arm: &Vec3, wrench: &Wrench, (stiffness, damping): (&TangentMatrix, &TangentMatrix)) {
        let mut moved = Matrix6::identity();
        moved.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm.cross_matrix());
        self.stiffness += moved.transpose() * stiffness * moved;
        self.damping += moved.transpose() * damping * moved;
        // The arm turns with the set, and with it the moment of the force.
        let mut turned = self.stiffness.fixed_view_mut::<3, 3>(3, 3);
        turned -= wrench.force.cross_matrix() * arm.cross_matrix();
        self.preload.force += wrench.force;
        self.preload.moment += wrench.moment + arm.cross(&wrench.force);
    }

    /// Contacts between the two sets whose stiffness is known; counts all of them.
    fn preloaded_contacts(
        &mut self,
        world: &World,
        first: &[InterfaceId],
        second: &[InterfaceId],
    ) -> Result<Vec<PreloadedContact>, EngineError> {
        let mut known = Vec::new();
        for (contact, springs) in world.contacts_iter().zip(world.contact_tangents()) {
            let sides = [contact.a.interface, contact.b.interface];
            let is_between = |own: usize| first.contains(&sides[own]) && second.contains(&sides[1 - own]);
            let Some(own) = (0..2).find(|own| is_between(*own)) else { continue };
            self.contacts += 1;
            self.slipping += usize::from(!contact.sticks && contact.friction_force.norm() > 0.0);
            let Some(springs) = springs else {
                self.without_limit += 1;
                continue;
            };
            let name = contact_name(world.scene(), &contact)?;
            let friction = limits::static_friction(world, &contact)?;
            known.push(PreloadedContact::new(
                name,
                &contact,
                own == 0,
                &self.frame.position,
                (&springs, friction),
            ));
        }
        Ok(known)
    }

    /// Motion under each unit load along the axes of the interface, and the limits. `lever` (m) makes rotations and
    /// translations comparable.
    fn find_limits(&mut self, contacts: &[PreloadedContact], lever: f64) {
        let scale = Matrix6::from_diagonal(&Vector6::from_fn(|i, _| if i < 3 { 1.0 } else { 1.0 / lever }));
        let scaled = scale * self.stiffness * scale;
        let Ok(compliance) = scaled.pseudo_inverse(NO_STIFFNESS * scaled.amax()) else { return };
        let turn = self.frame.orientation.to_rotation_matrix().into_inner();
        for component in 0..6 {
            let mut load = Vector6::zeros();
            let column = turn.column(component % 3).into_owned();
            load.fixed_rows_mut::<3>(component / 3 * 3).copy_from(&column);
            let scaled_load = scale * load;
            let scaled_motion = compliance * scaled_load;
            let unbalanced = (scaled * scaled_motion - scaled_load).norm();
            self.holds[component] = unbalanced <= UNBALANCED * scaled_load.norm();
            if self.holds[component] {
                self.limits.extend(limits::of_load(component, &(scale * scaled_motion), contacts, lever));
            }
        }
    }

    /// Changes matrices and preload from common axes to those of the interface.
    fn turn_to_axes(&mut self) {
        let turn = self.frame.orientation.to_rotation_matrix().into_inner();
        let mut both = SMatrix::<f64, 6, 6>::zeros();
        both.fixed_view_mut::<3, 3>(0, 0).copy_from(&turn);
        both.fixed_view_mut::<3, 3>(3, 3).copy_from(&turn);
        self.stiffness = both.transpose() * self.stiffness * both;
        self.damping = both.transpose() * self.damping * both;
        self.preload.force = turn.transpose() * self.preload.force;
        self.preload.moment = turn.transpose() * self.preload.moment;
    }
}

fn pose(world: &World, group: InterfaceId) -> Result<Pose, EngineError> {
    let state = world.state(group)?;
    let unset = || EngineError::BadValue {
        what: "linear interface".to_owned(),
        cause: "a group has no state; set it and evaluate".to_owned(),
    };
    state.map(|(pose, _)| pose).ok_or_else(unset)
}

/// Names of the two primitives of a contact: `object/path · object/path`.
///
/// # Errors
/// A contact of another world.
pub fn contact_name(scene: &Scene, contact: &Contact) -> Result<String, EngineError> {
    let [a, b] = [&contact.a, &contact.b].map(|side| {
        let object = scene.object_name(side.object)?;
        Ok::<_, EngineError>(format!("{object}/{}", scene.primitive_path(side.interface, side.primitive)?))
    });
    Ok(format!("{} · {}", a?, b?))
}
