//! Friction laws (theory manual, section 4): the force in the contact plane. Bristles are evaluated for eight
//! contacts at a time, the other laws one by one.

mod bristle;
mod coulomb;
mod force;
mod patch_bristle;
mod resistance;
mod slip_path;

pub(crate) use bristle::{BristleForces, Bristles, shortened};
pub use force::{FrictionForce, FrictionInput, FrictionOutput};
pub(crate) use patch_bristle::PatchBristle;
pub(crate) use resistance::{Resistance, ResistingMoment};

use super::props::FrictionProps;

/// Friction of one contact with `input.normal_force > 0`, for laws that are evaluated one by one. Returns no
/// friction for a bristle.
pub(crate) fn friction_alone(
    props: &FrictionProps,
    input: &FrictionInput<'_>,
    state: &mut [f64],
) -> FrictionOutput {
    match props {
        FrictionProps::None | FrictionProps::Bristle { .. } => FrictionOutput::free(),
        FrictionProps::Coulomb { mu, slip_speed } => coulomb::evaluate(*mu, *slip_speed, input),
        FrictionProps::Custom { law, stiffness, parameters } => {
            let input = FrictionInput { stiffness: *stiffness, parameters, ..*input };
            let output = law.evaluate(&input, &mut state[..law.state_len()]);
            let along_normal = input.normal_b * input.normal_b.dot(&output.force_b);
            FrictionOutput { force_b: output.force_b - along_normal, ..output }
        }
    }
}
