//! Use of a wrench by the host: one choice, for energy accounts and for the step adviser.

use pong_engine::WrenchCoupling;

/// Use of the wrench by the host: PONG_COUPLING_...
pub type pong_coupling = u32;

/// The host evaluates the wrench again at every stage of an integrator of higher order (the classic Runge-Kutta
/// method).
pub const PONG_COUPLING_STAGES: pong_coupling = 1;
/// The host evaluates the wrench once a step; it gives the velocities with which the bodies then move
/// (semi-implicit Euler).
pub const PONG_COUPLING_SEMI_IMPLICIT: pong_coupling = 2;
/// The host evaluates the wrench once a frame and holds it from one commit to the next.
pub const PONG_COUPLING_ZERO_ORDER_HOLD: pong_coupling = 3;

/// The coupling of this number; `None` if there is no such number.
pub(crate) fn of_number(coupling: u32, delay_frames: u32) -> Option<WrenchCoupling> {
    match coupling {
        PONG_COUPLING_STAGES => Some(WrenchCoupling::Stages),
        PONG_COUPLING_SEMI_IMPLICIT => Some(WrenchCoupling::SemiImplicit),
        PONG_COUPLING_ZERO_ORDER_HOLD => Some(WrenchCoupling::ZeroOrderHold { delay_frames }),
        _ => None,
    }
}
