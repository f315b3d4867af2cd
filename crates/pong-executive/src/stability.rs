//! The step adviser, asked for the bodies and the integrator at hand. The mathematics is that of
//! [`pong_advise`].

use crate::body::{Motion, RigidBody};
use crate::integrate::Integrator;
use crate::mass::MassProperties;
use pong_advise::GroupMass;

/// The longest step (s) at which one contact of stiffness `k` (N/m) and damping `c` (N·s/m) on an effective mass `m`
/// (kg) is stable; 0 if no step is.
pub fn longest_stable_step(integrator: Integrator, k: f64, c: f64, m: f64) -> f64 {
    pong_advise::longest_stable_step(integrator.coupling(), k, c, m)
}

/// What the adviser must know of a body.
pub fn group_mass(body: &RigidBody) -> GroupMass {
    match &body.motion {
        Motion::Free(mass) => of_free(mass),
        Motion::Fixed | Motion::Prescribed(_) => GroupMass::immovable(),
    }
}

fn of_free(mass: &MassProperties) -> GroupMass {
    let i = &mass.inertia;
    GroupMass {
        mass: mass.mass,
        inertia: [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23],
        mass_center: mass.mass_center.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_integrator_has_its_row_of_the_stability_table() {
        assert_eq!(longest_stable_step(Integrator::SemiImplicitEuler, 1e4, 0.0, 1.0), 0.02);
        let stages = longest_stable_step(Integrator::RungeKutta4, 1e4, 0.0, 1.0);
        assert!((stages - 0.02828).abs() < 1e-5);
        let hold = |delay_frames| Integrator::ZeroOrderHold { substeps: 1, delay_frames };
        assert_eq!(longest_stable_step(hold(0), 1e4, 5.0, 1.0), 1e-3);
        assert!(longest_stable_step(hold(1), 1e4, 15.0, 1.0) < 1e-3);
    }
}
