//! Input of a frame of a slow host.

use crate::failure::{Failure, Outcome};
use crate::ids::pong_interface_id;
use crate::states::pong_state;
use crate::status::pong_status;
use crate::step_plan::pong_mass;
use pong_slow::{Coupling, Dynamics, GroupInput};

/// Answer of a movable group to an impulse: PONG_DYNAMICS_...; 0 is none of them and refused.
pub type pong_dynamics = u32;

/// A free rigid body with `mass`. It holds the wrench along common axes.
pub const PONG_DYNAMICS_FREE: pong_dynamics = 1;
/// A body that joints hold, with `mobility`. It holds the wrench along the axes of the group, which turn with it.
pub const PONG_DYNAMICS_JOINTED: pong_dynamics = 2;
/// A body that contact does not move: the ground, or a body on a prescribed path.
pub const PONG_DYNAMICS_PRESCRIBED: pong_dynamics = 3;

/// State and dynamics of one movable group at the start of a frame of a slow host. Make it with zeros and set what its
/// dynamics need.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_slow_input {
    /// The movable group.
    pub interface: pong_interface_id,
    /// State at the start of the frame, as for pong_set_states().
    pub state: pong_state,
    /// One of PONG_DYNAMICS_...; must be set.
    pub dynamics: pong_dynamics,
    /// Zero.
    pub reserved: u32,
    /// With PONG_DYNAMICS_FREE: mass and inertia, both positive, and mass centre.
    pub mass: pong_mass,
    /// With PONG_DYNAMICS_JOINTED: velocity of the group's origin (linear, then angular) per impulse (linear, then
    /// angular, about the origin) as the joints let it move, 1/kg, 1/(kg m) and 1/(kg m^2), by rows, along the axes of
    /// the group. Symmetric, without negative eigenvalues; singular where joints hold.
    pub mobility: [f64; 36],
    /// Acceleration without contact, m/s^2, along common axes: of the mass centre of a free body, otherwise of the
    /// group's origin, with the centripetal part. Gravity, thrusters and forces of joints are in it.
    pub linear_acceleration: [f64; 3],
    /// Angular acceleration without contact, rad/s^2, along common axes.
    pub angular_acceleration: [f64; 3],
}

impl pong_slow_input {
    /// The input of the crate, which checks the numbers; `index` is that in the caller's array.
    pub(crate) fn group_input(&self, index: usize) -> Outcome<GroupInput> {
        let refused = |message: String| Err(Failure::new(pong_status::BadValue, message));
        if self.reserved != 0 {
            return refused(format!("inputs[{index}].reserved: it is {}; give 0", self.reserved));
        }
        let dynamics = match self.dynamics {
            PONG_DYNAMICS_FREE => {
                let [xx, yy, zz, xy, xz, yz] = self.mass.inertia;
                Dynamics::Free {
                    mass: self.mass.mass,
                    inertia: [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
                    mass_center: self.mass.mass_center,
                }
            }
            PONG_DYNAMICS_JOINTED => Dynamics::Jointed { mobility: rows(&self.mobility) },
            PONG_DYNAMICS_PRESCRIBED => Dynamics::Prescribed,
            other => {
                return refused(format!("inputs[{index}].dynamics: it is {other}; give PONG_DYNAMICS_..."));
            }
        };
        Ok(GroupInput {
            interface: self.interface.id(),
            state: self.state.into(),
            dynamics,
            linear_acceleration: self.linear_acceleration,
            angular_acceleration: self.angular_acceleration,
        })
    }
}

/// Velocity that an impulse on one jointed group gives another one, because joints connect them.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_slow_coupling {
    /// The group that moves.
    pub of: pong_interface_id,
    /// The group that gets the impulse.
    pub by: pong_interface_id,
    /// Velocity of the origin of `of` (linear, then angular), along its axes, per impulse on `by` (linear, then angular,
    /// about its origin), along the axes of `by`; 1/kg, 1/(kg m) and 1/(kg m^2), by rows. That of `by` per impulse on
    /// `of` is the transpose.
    pub mobility: [f64; 36],
}

impl pong_slow_coupling {
    /// The coupling of the crate, which checks the numbers.
    pub(crate) fn coupling(&self) -> Coupling {
        Coupling { of: self.of.id(), by: self.by.id(), mobility: rows(&self.mobility) }
    }
}

/// A 6×6 matrix by rows.
fn rows(numbers: &[f64; 36]) -> [[f64; 6]; 6] {
    std::array::from_fn(|row| std::array::from_fn(|column| numbers[6 * row + column]))
}
