//! Numbers of a surface, by name.

use pong_model::{Exponent, FrictionLaw, NormalLaw, Surface};

/// Names and units of the numbers that a surface has, in the order of the model format.
pub(crate) fn values_of(surface: &Surface) -> Vec<(&'static str, &'static str)> {
    let known = [
        ("stiffness", stiffness_unit(surface)),
        ("foundation", "N/m³"),
        ("area", "m²"),
        ("normal.damping", damping_unit(surface)),
        ("normal.ramp", "m"),
        ("normal.dissipation", "s/m"),
        ("friction.mu", ""),
        ("friction.static_excess", ""),
        ("friction.stiffness", "N/m"),
        ("friction.damping", "N·s/m"),
        ("friction.rolling", "m"),
        ("friction.spinning", "m"),
        ("friction.slip_speed", "m/s"),
    ];
    let mut copy = surface.clone();
    let has = |name: &str| number(&mut copy, name).is_some_and(|value| value.is_finite());
    let mut has = has;
    known.into_iter().filter(|(name, _)| has(name)).collect()
}

fn stiffness_unit(surface: &Surface) -> &'static str {
    match surface.normal.exponent() {
        Exponent::One => "N/m",
        Exponent::ThreeHalves => "N/m^1.5",
    }
}

fn damping_unit(surface: &Surface) -> &'static str {
    match surface.normal {
        NormalLaw::PowerLaw { damping_exponent, .. } if damping_exponent != 0.0 => "N·s/m^(1+q)",
        _ => "N·s/m",
    }
}

/// A number of a surface, to read or to set; `None` if its laws have no such number or leave it out.
pub(crate) fn number<'s>(surface: &'s mut Surface, name: &str) -> Option<&'s mut f64> {
    match (name, &mut surface.normal, &mut surface.friction) {
        ("stiffness", ..) => Some(&mut surface.stiffness),
        ("foundation", ..) => surface.foundation.as_mut(),
        ("area", ..) => surface.area.as_mut(),
        ("normal.damping", NormalLaw::Linear { damping, .. } | NormalLaw::PowerLaw { damping, .. }, _) => {
            Some(damping)
        }
        ("normal.ramp", NormalLaw::Linear { ramp, .. }, _) => Some(ramp),
        ("normal.dissipation", NormalLaw::HuntCrossley { dissipation, .. }, _) => Some(dissipation),
        ("friction.mu", _, FrictionLaw::Bristle { mu, .. } | FrictionLaw::Coulomb { mu, .. }) => Some(mu),
        ("friction.static_excess", _, FrictionLaw::Bristle { static_excess, .. }) => Some(static_excess),
        ("friction.stiffness", _, FrictionLaw::Bristle { stiffness, .. }) => stiffness.as_mut(),
        ("friction.damping", _, FrictionLaw::Bristle { damping, .. }) => damping.as_mut(),
        ("friction.rolling", _, FrictionLaw::Bristle { rolling, .. }) => Some(rolling),
        ("friction.spinning", _, FrictionLaw::Bristle { spinning, .. }) => Some(spinning),
        ("friction.slip_speed", _, FrictionLaw::Coulomb { slip_speed, .. }) => Some(slip_speed),
        _ => None,
    }
}
