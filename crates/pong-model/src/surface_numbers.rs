//! Numbers of a surface, by name.

use crate::surface::{Exponent, FrictionLaw, NormalLaw, Surface};

impl Surface {
    /// Names and units of the finite numbers that the surface gives, in the order of the model format: `stiffness`,
    /// `normal.damping`, `friction.mu`, ….
    pub fn numbers(&self) -> Vec<(&'static str, &'static str)> {
        let known = [
            ("stiffness", stiffness_unit(self)),
            ("foundation", "N/m³"),
            ("area", "m²"),
            ("normal.damping", damping_unit(self)),
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
        let mut copy = self.clone();
        let mut has = |name: &str| copy.number_mut(name).is_some_and(|value| value.is_finite());
        known.into_iter().filter(|(name, _)| has(name)).collect()
    }

    /// Number of the surface by its name in [`numbers`](Self::numbers), to read or to set; `None` if its laws have no
    /// such number or leave it out.
    pub fn number_mut(&mut self, name: &str) -> Option<&mut f64> {
        match (name, &mut self.normal, &mut self.friction) {
            ("stiffness", ..) => Some(&mut self.stiffness),
            ("foundation", ..) => self.foundation.as_mut(),
            ("area", ..) => self.area.as_mut(),
            (
                "normal.damping",
                NormalLaw::Linear { damping, .. } | NormalLaw::PowerLaw { damping, .. },
                _,
            ) => Some(damping),
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
