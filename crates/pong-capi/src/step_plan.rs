//! Input of the step adviser before the seal: masses, and the host's use of the wrench.

use crate::coupling::{self, PONG_COUPLING_ZERO_ORDER_HOLD, pong_coupling};
use crate::failure::{Failure, Outcome};
use crate::guard::{get, setting_up};
use crate::handle::pong_world;
use crate::ids::pong_interface_id;
use crate::pointers::one;
use crate::status::pong_status;
use pong_advise::{Accuracy, GroupMass, Joints, SpringRates, StepPlan};

/// Mass properties of a movable group, for the step adviser and for slow hosts: no frame of a world reads them.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_mass {
    /// Mass, kg; for the step adviser INFINITY if the group does not yield (fixed, or on a prescribed path).
    pub mass: f64,
    /// Inertia about the mass centre along the axes of the group frame, kg m^2: Ixx, Iyy, Izz, Ixy, Ixz, Iyz,
    /// the products as elements of the tensor itself (Ixy = minus the integral of x y dm). All zero, for
    /// the step adviser alone, if it is not known: lever arms are then left out.
    pub inertia: [f64; 6],
    /// The mass centre in the group frame, m.
    pub mass_center: [f64; 3],
}

/// Response of a movable group on joints to a wrench at one pose of its mechanism, for the step adviser
/// alone. Make it with zeros and set what is known.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_joints {
    /// Acceleration (linear of the group's origin, then angular) per wrench (force, then moment about the origin), by rows,
    /// along the axes of the group frame: J M^-1 J^T of a mechanism with the mass matrix M.
    pub inverse_inertia: [f64; 36],
    /// Upper bound of the largest eigenvalue of M^-1 K of the host's springs on the mechanism, 1/s^2; 0
    /// without springs.
    pub spring_rate: f64,
    /// Upper bound of the largest eigenvalue of M^-1 C of the host's dampers on the mechanism, 1/s; 0 without
    /// dampers.
    pub damper_rate: f64,
    /// Groups with the same number share joints: a push on one moves the others.
    pub mechanism: u32,
    /// Zero.
    pub reserved: u32,
}

/// The host's step and its use of the wrench. Make it with pong_default_step_plan() and change what you like.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_step_plan {
    /// The step or frame, s; must be set.
    pub step: f64,
    /// Use of the wrench: one of PONG_COUPLING_...; PONG_COUPLING_ZERO_ORDER_HOLD by default.
    pub wrench_coupling: pong_coupling,
    /// With PONG_COUPLING_ZERO_ORDER_HOLD: delay of the wrench in whole frames after the first possible one,
    /// at most 100; 0 by default.
    pub delay_frames: u32,
    /// Speed at which things touch, m/s; 0 (default) if it is not known. Laws whose stiffness or damping follows the
    /// depth are judged at the depth that this speed makes.
    pub closing_speed: f64,
    /// Largest relative error of the depth of a bounce against its closed form; 0.05 by default. 0 in both
    /// accuracies: warn only of contacts that gain energy.
    pub depth_within: f64,
    /// Largest relative error of the rebound of a bounce against its closed form; 0.02 by default.
    pub rebound_within: f64,
    /// Zero.
    pub reserved: [u64; 4],
}

/// Stability of the contacts of one frame at the planned step.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_step_check {
    /// Contacts with at least one movable body that yields.
    pub contacts: u64,
    /// Contacts whose masses or laws are not known.
    pub not_judged: u64,
    /// The longest step at which they are surely stable together, s; 0 if there is none, infinite if nothing acts.
    pub stable_step: f64,
    /// Stiffness over mass of the stiffest mode, 1/s^2: the square of its frequency in rad/s.
    pub stiffness_rate: f64,
    /// Damping over mass of the most damped mode, 1/s.
    pub damping_rate: f64,
}

/// The default plan: held wrenches, depth within 5 % and rebound within 2 %. Its step is 0 and must be set.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_step_plan() -> pong_step_plan {
    let Accuracy { depth, rebound } = Accuracy::default();
    pong_step_plan {
        step: 0.0,
        wrench_coupling: PONG_COUPLING_ZERO_ORDER_HOLD,
        delay_frames: 0,
        closing_speed: 0.0,
        depth_within: depth,
        rebound_within: rebound,
        reserved: [0; 4],
    }
}

/// Sets the mass properties of a movable group, for the check that pong_plan_step() requests. Before sealing. A
/// hinged body gets its own mass and inertia, as if it were free; that is on the safe side, and
/// pong_set_joints() gives a sharp limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_mass(
    world: *mut pong_world,
    interface: pong_interface_id,
    mass: *const pong_mass,
) -> pong_status {
    setting_up(world, |inner| {
        let pong_mass { mass, inertia, mass_center } = *one(mass, "mass")?;
        let scene = inner.phase.set_up("set a mass")?.scene();
        let mass = GroupMass { inertia, mass_center, ..GroupMass::point(mass) };
        Ok(inner.advice.set_mass(scene, interface.id(), mass)?)
    })
}

/// Sets the response of a movable group on joints, in addition to its mass of pong_set_mass(), which must be
/// set first. Before sealing for the check of pong_plan_step(), and as often as the pose changes for
/// pong_check_step().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_joints(
    world: *mut pong_world,
    interface: pong_interface_id,
    joints: *const pong_joints,
) -> pong_status {
    setting_up(world, |inner| {
        let joints = one(joints, "joints")?;
        if joints.reserved != 0 {
            let message = "joints: its reserved field is not zero; make it with zeros".to_owned();
            return Err(Failure::new(pong_status::BadValue, message));
        }
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| joints.inverse_inertia[6 * i + j]));
        let springs = SpringRates { stiffness: joints.spring_rate, damping: joints.damper_rate };
        let joints = Joints { inverse_inertia: rows, mechanism: joints.mechanism };
        Ok(inner.advice.set_joints(inner.phase.scene(), interface.id(), joints, springs)?)
    })
}

/// Makes the seal check every contact against the host's step, by the masses of pong_set_mass(). Contacts for
/// which the step is too long, or which cannot be judged, appear in pong_seal_warning(); those for which it may
/// be too long, if enough contacts act at once, in pong_seal_note(). Before sealing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_plan_step(world: *mut pong_world, plan: *const pong_step_plan) -> pong_status {
    setting_up(world, |inner| {
        let plan = one(plan, "plan")?.check()?;
        let builder = inner.phase.set_up("plan the step")?;
        plan.check()?;
        builder.leave_room_per_pair(pong_advise::BYTES_PER_PAIR);
        inner.advice.plan = Some(plan);
        Ok(())
    })
}

/// Checks the planned step against the contacts of the last frame, with their actual lever arms and normals.
/// Allocates. PONG_STATUS_WRONG_PHASE: no step was planned before the seal, or there is no frame.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_check_step(
    world: *const pong_world,
    check: *mut pong_step_check,
) -> pong_status {
    get(world, (check, "check"), |inner| {
        let Some(plan) = &inner.advice.plan else {
            let message = "no step is planned; call pong_plan_step() before the seal".to_owned();
            return Err(Failure::new(pong_status::WrongPhase, message));
        };
        let world = inner.phase.frames("inspect the scene")?;
        let found = pong_advise::acting_report(world, plan, &inner.advice.masses())?;
        Ok(pong_step_check {
            contacts: found.contacts as u64,
            not_judged: found.not_judged as u64,
            stable_step: found.stable_step,
            stiffness_rate: found.stiffness_rate,
            damping_rate: found.damping_rate,
        })
    })
}

impl pong_step_plan {
    fn check(&self) -> Outcome<StepPlan> {
        let bad = |message: String| Failure::new(pong_status::BadValue, message);
        let late = self.delay_frames;
        let Some(coupling) = coupling::of_number(self.wrench_coupling, late) else {
            let given = self.wrench_coupling;
            return Err(bad(format!("plan: wrench_coupling is {given}; give one of PONG_COUPLING_...")));
        };
        if late > 0 && self.wrench_coupling != PONG_COUPLING_ZERO_ORDER_HOLD {
            let cause = "only a wrench that is held can be delayed; give 0, or PONG_COUPLING_ZERO_ORDER_HOLD";
            return Err(bad(format!("plan: delay_frames is {late}: {cause}")));
        }
        if self.reserved != [0; 4] {
            let cause = "it has values in its reserved fields; start from pong_default_step_plan()";
            return Err(bad(format!("plan: {cause}")));
        }
        let none = (self.depth_within, self.rebound_within) == (0.0, 0.0);
        let accuracy = Accuracy { depth: self.depth_within, rebound: self.rebound_within };
        Ok(StepPlan {
            step: self.step,
            coupling,
            closing_speed: (self.closing_speed != 0.0).then_some(self.closing_speed),
            fall_speed: None,
            accuracy: (!none).then_some(accuracy),
        })
    }
}
