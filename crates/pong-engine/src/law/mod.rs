//! Normal force laws (docs/theory.md, 3): force and stored energy from depth and depth rate.

mod combine;
mod elastic;
pub(crate) mod friction;
mod hunt_crossley;
mod increment;
mod linear;
mod normal;
mod power_law;
mod props;
pub(crate) mod registry;

use power_law::Damper;

pub use combine::combine;
pub(crate) use combine::friction_name;
pub(crate) use increment::{BristleIncrement, bristle_increment, normal_increment};
pub use normal::{NormalForce, NormalInput};
pub use props::{CombineError, FrictionProps, NormalProps, PairProps};

/// Normal force of a contact of weight `w`, N, never negative.
pub(crate) fn normal_force(props: &PairProps, w: f64, depth: f64, rate: f64) -> f64 {
    let k = props.stiffness;
    // The default law is tested first, because a `match` over all laws costs an indirect jump.
    let force = match &props.normal {
        NormalProps::Linear { damping, ramp } => linear::force(k, *damping, *ramp, depth, rate),
        other => force_of_other_law(other, k, depth, rate),
    };
    (w * force).max(0.0)
}

/// Force of a law other than `Linear` for weight 1, N; negative where it would pull.
#[inline(never)]
fn force_of_other_law(law: &NormalProps, k: f64, depth: f64, rate: f64) -> f64 {
    match law {
        NormalProps::Linear { damping, ramp } => linear::force(k, *damping, *ramp, depth, rate),
        NormalProps::HuntCrossley { dissipation, exponent } => {
            hunt_crossley::force(k, *dissipation, *exponent, depth, rate)
        }
        NormalProps::PowerLaw { damping, exponent, damping_exponent } => {
            let damper = Damper { damping: *damping, exponent: *damping_exponent };
            power_law::force(k, *exponent, damper, depth, rate)
        }
        NormalProps::Custom { law, parameters } => {
            law.force(&NormalInput { depth, rate, stiffness: k, parameters })
        }
    }
}

/// Derivatives of a contact's normal force with respect to depth and depth rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalTangent {
    /// Stiffness ∂F/∂δ, N/m.
    pub stiffness: f64,
    /// Damping ∂F/∂δ', N·s/m.
    pub damping: f64,
}

/// Stiffness and damping that act in one contact, weights included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactTangent {
    /// Derivatives of the normal force; zero where it is cut at zero.
    pub normal: NormalTangent,
    /// Stiffness, N/m, and damping, N·s/m, of the bristle while it sticks. Zero while it slips, where its force
    /// follows the load and the direction of the slip, and for laws without a bristle.
    pub tangential: NormalTangent,
}

/// Derivatives of [`normal_force`] at a depth and rate; zero where the force is cut at zero, `None` for a
/// host's law.
pub(crate) fn normal_tangent(props: &PairProps, w: f64, depth: f64, rate: f64) -> Option<NormalTangent> {
    let k = props.stiffness;
    let (stiffness, damping) = match &props.normal {
        NormalProps::Linear { damping, ramp } => linear::tangent(k, *damping, *ramp, depth, rate),
        NormalProps::HuntCrossley { dissipation, exponent } => {
            hunt_crossley::tangent(k, *dissipation, *exponent, depth, rate)
        }
        NormalProps::PowerLaw { damping, exponent, damping_exponent } => {
            let damper = Damper { damping: *damping, exponent: *damping_exponent };
            power_law::tangent(k, *exponent, damper, depth, rate)
        }
        NormalProps::Custom { .. } => return None,
    };
    let acts = if normal_force(props, w, depth, rate) > 0.0 { w } else { 0.0 };
    Some(NormalTangent { stiffness: acts * stiffness, damping: acts * damping })
}

/// Energy stored by a contact of weight `w`, J.
pub(crate) fn stored_energy(props: &PairProps, w: f64, depth: f64) -> f64 {
    let k = props.stiffness;
    w * match &props.normal {
        NormalProps::Linear { .. } => linear::stored(k, depth),
        NormalProps::HuntCrossley { exponent, .. } | NormalProps::PowerLaw { exponent, .. } => {
            elastic::stored(k, *exponent, depth)
        }
        NormalProps::Custom { law, parameters } => {
            law.stored(&NormalInput { depth, rate: 0.0, stiffness: k, parameters })
        }
    }
}
