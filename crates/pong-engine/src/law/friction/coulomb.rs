//! F_t = −μ·F_n·v_t/max(|v_t|, v_ε): regularised Coulomb friction.
//!
//! It has no memory and creeps under any load: below v_ε it is a damper.

use super::force::{FrictionInput, FrictionOutput};

pub(super) fn evaluate(mu: f64, slip_speed: f64, input: &FrictionInput<'_>) -> FrictionOutput {
    let speed = input.slip_velocity_b.norm();
    let force = input.slip_velocity_b * (-mu * input.normal_force / speed.max(slip_speed));
    FrictionOutput { force_b: force, sticks: speed < slip_speed, ..FrictionOutput::free() }
}
