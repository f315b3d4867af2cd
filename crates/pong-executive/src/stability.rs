//! Step advice for the present bodies and integrator, computed by [`pong_advise`].

use crate::body::{Motion, RigidBody};
use crate::integrate::Integrator;
use crate::mass::MassProperties;
use crate::spring::{Spring, SpringEnd};
use crate::system::System;
use pong_advise::{GroupMass, HostSpring, HostSpringEnd, SpringRates, spring_rates};
use pong_geometry::Pose;

/// The longest step (s) at which one contact of stiffness `k` (N/m) and damping `c` (N·s/m) on an effective mass `m`
/// (kg) is stable; 0 if no step is.
pub fn longest_stable_step(integrator: Integrator, k: f64, c: f64, m: f64) -> f64 {
    pong_advise::longest_stable_step(integrator.coupling(), k, c, m)
}

/// Mass properties of a body in the adviser's form, without springs.
pub fn group_mass(body: &RigidBody) -> GroupMass {
    match &body.motion {
        Motion::Free(mass) => of_free(mass),
        Motion::Fixed | Motion::Prescribed(_) => GroupMass::immovable(),
    }
}

fn of_free(mass: &MassProperties) -> GroupMass {
    let i = &mass.inertia;
    GroupMass {
        inertia: [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23],
        mass_center: mass.mass_center.into(),
        ..GroupMass::point(mass.mass)
    }
}

impl System {
    /// Mass properties of every body for the adviser, with the springs at their present stretch.
    pub(crate) fn masses_on_springs(&self, integrator: Integrator) -> Vec<GroupMass> {
        let mut masses: Vec<GroupMass> = self.bodies.iter().map(group_mass).collect();
        let springs: Vec<HostSpring> = self.springs.iter().map(|spring| self.host_spring(spring)).collect();
        // Between held wrenches the springs are integrated with shorter steps.
        let shorter = match integrator {
            Integrator::ZeroOrderHold { substeps, .. } => f64::from(substeps),
            _ => 1.0,
        };
        let rates = spring_rates(&masses, &springs);
        for (mass, rates) in masses.iter_mut().zip(rates) {
            let (stiffness, damping) = (rates.stiffness / (shorter * shorter), rates.damping / shorter);
            mass.springs = SpringRates { stiffness, damping };
        }
        masses
    }

    fn host_spring(&self, spring: &Spring) -> HostSpring {
        let pose =
            |end: &SpringEnd| end.body.map_or_else(Pose::identity, |body| self.motions[body.index()].0);
        let (first, second) = (pose(&spring.first), pose(&spring.second));
        let place = second.position - first.position + second.orientation * spring.second.frame.position;
        let body = |end: &SpringEnd| end.body.map(|body| body.index());
        // Rotated by an angle, a rotational spring is stiffer across the axis: ‖J⁻¹‖ = (½θ)/sin ½θ.
        let half = 0.5 * self.spring_angle(spring);
        let turned = if half > 0.0 { half / libm::sin(half) } else { 1.0 };
        let mut stiffness = spring.stiffness;
        stiffness[3..].iter_mut().for_each(|value| *value *= turned * turned);
        HostSpring {
            ends: [
                HostSpringEnd { body: body(&spring.first), place: first.orientation.inverse() * place },
                HostSpringEnd { body: body(&spring.second), place: spring.second.frame.position },
            ],
            axes: spring.first.frame.orientation.to_rotation_matrix().into_inner(),
            stiffness,
            damping: spring.damping,
        }
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
