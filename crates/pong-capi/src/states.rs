//! States in.

use crate::failure::{Failure, Outcome};
use crate::guard::{get, with_world};
use crate::handle::{Inner, pong_world};
use crate::ids::pong_interface_id;
use crate::pointers::array;
use crate::status::pong_status;
use pong_engine::State;
use pong_geometry::{Pose, Twist};

/// State of a movable group, relative to and expressed in the common frame: any frame that paired Objects share.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct pong_state {
    /// Position of the group's origin in the common frame, m.
    pub position: [f64; 3],
    /// Quaternion (w, x, y, z), Hamilton, that takes group components to common components. Normalised on entry;
    /// refused if its norm is off by more than 1e-3.
    pub orientation: [f64; 4],
    /// Velocity of the group's origin, m/s, along common axes.
    pub linear_velocity: [f64; 3],
    /// Angular velocity, rad/s, along common axes.
    pub angular_velocity: [f64; 3],
}

/// State at rest at the common origin, along the common axes.
#[unsafe(no_mangle)]
pub extern "C" fn pong_default_state() -> pong_state {
    State::identity().into()
}

/// Sets the states of `n` movable groups in one call: all of them or, if any is refused, none. Groups that are
/// not named keep their state. With n = 0 the arrays may be NULL. In set-up and in frames.
/// PONG_STATUS_BAD_STATE: a number is not finite or beyond 1e100, or a quaternion is not of unit length.
/// PONG_STATUS_DUPLICATE: a group is named twice.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_states(
    world: *mut pong_world,
    interfaces: *const pong_interface_id,
    states: *const pong_state,
    n: usize,
) -> pong_status {
    with_world(world, |inner| {
        let ids = array(interfaces, n, "interfaces")?;
        let states = array(states, n, "states")?;
        inner.check_named_once(ids)?;
        inner.states.clear();
        inner.states.extend(ids.iter().zip(states).map(|(id, state)| (id.id(), State::from(*state))));
        Ok(inner.phase.set_states(&inner.states)?)
    })
}

/// Sets the state of one movable group. In set-up and in frames. PONG_STATUS_BAD_STATE as for
/// pong_set_states().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_set_state(
    world: *mut pong_world,
    interface: pong_interface_id,
    state: *const pong_state,
) -> pong_status {
    with_world(world, |inner| {
        let state = State::from(*crate::pointers::one(state, "state")?);
        Ok(inner.phase.set_states(&[(interface.id(), state)])?)
    })
}

/// Copies the state last set for a movable group, its quaternion normalised. PONG_STATUS_UNSET_STATE if there
/// is none.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn pong_get_state(
    world: *const pong_world,
    interface: pong_interface_id,
    state: *mut pong_state,
) -> pong_status {
    get(world, (state, "state"), |inner| {
        let Some(known) = inner.phase.state_as_set(interface.id())? else {
            let path = inner.names.path(interface)?.to_string_lossy();
            let message = format!("state of `{path}`: never set; set it first");
            return Err(Failure::new(pong_status::UnsetState, message));
        };
        Ok(pong_state::from_motion(&known.pose(), &known.twist()))
    })
}

impl Inner {
    /// Refuses ids of other worlds; the message has their index in the caller's array.
    pub(crate) fn check_interfaces(&self, ids: &[pong_interface_id]) -> Outcome {
        match ids.iter().position(|id| !self.names.has_interface(*id)) {
            None => Ok(()),
            Some(index) => Err(crate::names::unknown(&format!("interfaces[{index}]"))),
        }
    }
}

impl Inner {
    /// Refuses ids of other worlds, and a group that is given two states; the message has their index in the
    /// caller's array.
    pub(crate) fn check_named_once(&self, ids: &[pong_interface_id]) -> Outcome {
        let Some(place) = self.names.unknown_or_named_twice(ids) else { return Ok(()) };
        let Ok(path) = self.names.path(ids[place]) else {
            return Err(crate::names::unknown(&format!("interfaces[{place}]")));
        };
        let first = ids.iter().position(|id| *id == ids[place]).unwrap_or(place);
        let path = path.to_string_lossy();
        let message = format!(
            "interfaces[{first}] and interfaces[{place}] are both `{path}`; give one state for each group"
        );
        Err(Failure::new(pong_status::Duplicate, message))
    }
}

impl pong_state {
    pub(crate) fn from_motion(pose: &Pose, twist: &Twist) -> Self {
        State::from_motion(pose, twist).into()
    }
}

impl From<State> for pong_state {
    fn from(state: State) -> Self {
        let State { position, orientation, linear_velocity, angular_velocity } = state;
        Self { position, orientation, linear_velocity, angular_velocity }
    }
}

impl From<pong_state> for State {
    fn from(state: pong_state) -> Self {
        let pong_state { position, orientation, linear_velocity, angular_velocity } = state;
        Self { position, orientation, linear_velocity, angular_velocity }
    }
}
