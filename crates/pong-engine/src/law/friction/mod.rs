//! Friction laws (theory manual, section 4): the force in the contact plane.

mod bristle;
mod coulomb;
mod force;
mod slip_path;

pub(crate) use bristle::shortened;
pub use force::{FrictionForce, FrictionInput, FrictionOutput};

use super::props::FrictionProps;

/// Friction force of one contact with `input.normal_force > 0`.
#[inline(always)]
pub(crate) fn friction_force(
    props: &FrictionProps,
    input: &FrictionInput<'_>,
    state: &mut [f64],
) -> FrictionOutput {
    match props {
        FrictionProps::None => FrictionOutput::free(),
        FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static } => {
            let law = bristle::Bristle {
                stiffness: input.share * stiffness,
                damping: input.share * damping,
                kinetic_limit: mu_kinetic * input.normal_force,
                static_limit: mu_static * input.normal_force,
            };
            law.evaluate(input)
        }
        FrictionProps::Coulomb { mu, slip_speed } => coulomb::evaluate(*mu, *slip_speed, input),
        FrictionProps::Custom { law, stiffness, parameters } => {
            let input = FrictionInput { stiffness: *stiffness, parameters, ..*input };
            let output = law.evaluate(&input, &mut state[..law.state_len()]);
            let along_normal = input.normal_b * input.normal_b.dot(&output.force_b);
            FrictionOutput { force_b: output.force_b - along_normal, ..output }
        }
    }
}
