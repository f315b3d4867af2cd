//! Inputs and outputs of the force laws given by C callbacks.

use std::ffi::c_void;

/// Input of a normal force law.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pong_normal_input {
    /// Depth, m; positive.
    pub depth: f64,
    /// Rate of the depth, m/s, positive while closing.
    pub depth_rate: f64,
    /// Stiffness of the pair of surfaces, N/m.
    pub stiffness: f64,
    /// The law's parameters as the model gives them; valid during the call.
    pub parameters: *const f64,
    /// Number of parameters.
    pub parameter_count: usize,
}

/// Input of a friction law. Vectors are expressed in the frame of B's movable group and lie in the present
/// contact plane.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct pong_friction_input {
    /// Present normal force, N; positive.
    pub normal_force: f64,
    /// Unit normal, from B to A.
    pub normal_b: [f64; 3],
    /// Tangential displacement of A against B since the last commit, m; in the step in which a contact
    /// begins, since the touch.
    pub slip_b: [f64; 3],
    /// Tangential velocity of A against B, m/s.
    pub slip_velocity_b: [f64; 3],
    /// Share of the pair's friction that this contact carries, 0 to 1: scale stiffness and damping by it.
    pub share: f64,
    /// Tangential stiffness of the pair, N/m.
    pub stiffness: f64,
    /// The law's parameters as the model gives them; valid during the call.
    pub parameters: *const f64,
    /// Number of parameters.
    pub parameter_count: usize,
    /// 1: the contact stuck at the last commit or is new. 0: it slipped.
    pub stuck: i32,
    /// Zero.
    pub reserved: i32,
}

/// Output of a friction law. It is all zero when the law is called.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct pong_friction_output {
    /// Force on A, N, in the frame of B's movable group. A part along the normal is removed.
    pub force_b: [f64; 3],
    /// Energy stored in the law's state, J; for the ledger.
    pub stored: f64,
    /// 1: the contact sticks. 0: it slips.
    pub sticks: i32,
    /// Leave it zero.
    pub reserved: i32,
}

/// A normal force law, or the energy it stores: returns N, or J. See pong_register_normal_law().
pub type pong_normal_law =
    Option<unsafe extern "C" fn(input: *const pong_normal_input, user: *mut c_void) -> f64>;

/// A friction law. `state` holds the numbers that the law keeps for this contact, as committed (zero for a new
/// contact), and takes the new ones, which count only if the host commits; vectors in it are the law's to turn with
/// the normal. See pong_register_friction_law().
pub type pong_friction_law = Option<
    unsafe extern "C" fn(
        input: *const pong_friction_input,
        state: *mut f64,
        output: *mut pong_friction_output,
        user: *mut c_void,
    ),
>;
