//! Report of a frame of a slow host.

use crate::ids::pong_interface_id;
use crate::report::pong_flags;
use pong_slow::{FrameStatus, GroupReport, Report};

/// Warnings of a frame of a slow host: a sum of PONG_SLOW_....
pub type pong_slow_warnings = u32;

/// The contacts needed more substeps than `substeps_max`.
pub const PONG_SLOW_SUBSTEP_LIMIT: pong_slow_warnings = 1;
/// The substeps were too few to follow the contacts at all. The wrench is that of one implicit step, which gains no
/// energy and gives no rebound.
pub const PONG_SLOW_UNRESOLVED: pong_slow_warnings = 2;
/// A body left what it touched and touched something else within the frame. The host sees the mean of both.
pub const PONG_SLOW_MET_ANOTHER: pong_slow_warnings = 4;
/// theta as measured from the motion differs from the setting by more than 0.1: energy is gained without bound.
pub const PONG_SLOW_THETA_MISMATCH: pong_slow_warnings = 8;
/// The velocity nearest to the copies would have had too much energy, and was reduced.
pub const PONG_SLOW_ENERGY_LIMITED: pong_slow_warnings = 16;

/// Report of the last frame of a slow host.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_slow_report {
    /// Substeps taken.
    pub substeps: u32,
    /// Substeps that the contacts need.
    pub substeps_wanted: u32,
    /// Evaluations of the engine, those of the substeps included.
    pub evaluations: u32,
    /// Sum of PONG_SLOW_....
    pub warnings: pong_slow_warnings,
    /// Sum of PONG_FLAG_... of all substeps.
    pub flags: pong_flags,
    /// Contacts of the copies at the end of the frame.
    pub contacts: u32,
    /// Number of movable groups: that of the entries of pong_get_slow_differences().
    pub groups: u32,
    /// Zero.
    pub reserved_flags: u32,
    /// Largest rate of the contacts in the frame, rad/s; 0 if nothing touched.
    pub rate: f64,
    /// The fraction theta as the motion since the last frame shows it; not a number (NaN) without acceleration.
    pub theta_measured: f64,
    /// Sum of the inserted energies of all groups, J.
    pub inserted: f64,
    /// Zero.
    pub reserved: [u64; 4],
}

/// Difference between what the host did and what the last frame predicted, for one movable group. With delay frames
/// both are carried forward to the time at which the wrench of this frame acts.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_slow_difference {
    /// The movable group.
    pub interface: pong_interface_id,
    /// Found minus predicted leading position, m (docs/theory.md, 9): of the mass centre of a free body along common
    /// axes, of the origin of a jointed one along the axes of the group.
    pub position: [f64; 3],
    /// Found minus predicted orientation as a rotation vector, rad, along the same axes.
    pub rotation: [f64; 3],
    /// Found minus predicted linear velocity, m/s, along the same axes.
    pub linear_velocity: [f64; 3],
    /// Found minus predicted angular velocity, rad/s, along the same axes.
    pub angular_velocity: [f64; 3],
    /// Energy that this difference inserted, J. 0 in the first frame.
    pub inserted: f64,
}

impl From<&Report> for pong_slow_report {
    fn from(report: &Report) -> Self {
        Self {
            substeps: report.substeps,
            substeps_wanted: report.substeps_wanted,
            evaluations: report.evaluations,
            warnings: warnings(&report.status),
            flags: report.status.engine.bits(),
            contacts: report.contacts,
            groups: report.groups.len() as u32,
            reserved_flags: 0,
            rate: report.rate,
            theta_measured: report.theta_measured.unwrap_or(f64::NAN),
            inserted: report.inserted,
            reserved: [0; 4],
        }
    }
}

fn warnings(status: &FrameStatus) -> pong_slow_warnings {
    let all = [
        (status.substep_limit, PONG_SLOW_SUBSTEP_LIMIT),
        (status.unresolved, PONG_SLOW_UNRESOLVED),
        (status.met_another, PONG_SLOW_MET_ANOTHER),
        (status.theta_mismatch, PONG_SLOW_THETA_MISMATCH),
        (status.energy_limited, PONG_SLOW_ENERGY_LIMITED),
    ];
    all.iter().filter(|(is_set, _)| *is_set).map(|(_, warning)| warning).sum()
}

impl From<&GroupReport> for pong_slow_difference {
    fn from(group: &GroupReport) -> Self {
        let GroupReport { interface, position, rotation, linear_velocity, angular_velocity, inserted } =
            *group;
        let interface = interface.into();
        Self { interface, position, rotation, linear_velocity, angular_velocity, inserted }
    }
}
