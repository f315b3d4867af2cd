//! Report of a frame.

use pong_engine::{InterfaceId, StatusBits};

/// Warnings of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrameStatus {
    /// The contacts needed more substeps than [`Settings::substeps_max`](crate::Settings::substeps_max).
    pub substep_limit: bool,
    /// The substeps were too few to follow the contacts at all. The wrench is that of one implicit step, which gains no
    /// energy and gives no rebound.
    pub unresolved: bool,
    /// A body left what it touched and touched something else within the frame. The host sees the mean of both.
    pub met_another: bool,
    /// θ measured from the motion differs from the setting by more than 0.1: energy is gained without bound.
    pub theta_mismatch: bool,
    /// The guard reduced the energy of the velocity nearest to the copies.
    pub energy_limited: bool,
    /// Flags of the engine in any substep.
    pub engine: StatusBits,
}

/// Difference between what the host did and what was predicted, for one movable group. With delay frames both are
/// carried forward to the time at which the wrench of this frame acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupReport {
    /// The movable group.
    pub interface: InterfaceId,
    /// Found minus predicted leading position, m: of the mass centre of a free body along common axes, of the origin of a
    /// jointed one along the group's axes.
    pub position: [f64; 3],
    /// Found minus predicted orientation as a rotation vector, rad, along the same axes.
    pub rotation: [f64; 3],
    /// Found minus predicted linear velocity, m/s, along the same axes.
    pub linear_velocity: [f64; 3],
    /// Found minus predicted angular velocity, rad/s, along the same axes.
    pub angular_velocity: [f64; 3],
    /// Energy that this difference inserted, J: kinetic, of the forces without contact, and half of that of the normal
    /// springs of the group's contacts (all of it against a prescribed group). Coupled groups share the first two equally. 0
    /// in the first frame.
    pub inserted: f64,
}

/// Report of a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Substeps taken; 0 if the frame was evaluated without dynamics.
    pub substeps: u32,
    /// Substeps that the contacts need.
    pub substeps_wanted: u32,
    /// Evaluations of the engine, those of the substeps included.
    pub evaluations: u32,
    /// Contacts of the copies at the end of the frame.
    pub contacts: u32,
    /// Largest rate of the contacts in the frame, rad/s; 0 if nothing touched.
    pub rate: f64,
    /// Warnings of the frame.
    pub status: FrameStatus,
    /// Position rule θ, 0…1, dimensionless, as the motion of the last frame shows it; `None` without acceleration.
    pub theta_measured: Option<f64>,
    /// Sum of the inserted energies, J.
    pub inserted: f64,
    /// One entry per movable group, in the order of the world.
    pub groups: Vec<GroupReport>,
}
