//! Springs and dampers of a contact between two surfaces, at the expected depth.

use pong_engine::{FrictionProps, NormalProps, PairProps};
use pong_model::Exponent;

/// A spring and its damper.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spring {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N·s/m.
    pub damping: f64,
}

/// A whole contact of two surfaces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactSprings {
    /// Spring along the normal; for laws that follow the depth, the tangent there.
    pub normal: Spring,
    /// Spring in the contact plane, while it sticks.
    pub friction: Option<Spring>,
    /// True if the closed forms of `bounce.rs` hold for the law.
    pub bounces_by_formula: bool,
}

impl ContactSprings {
    /// The least damping over stiffness of its springs, s.
    pub fn least_damped(&self) -> f64 {
        let of = |spring: &Spring| {
            if spring.stiffness > 0.0 { spring.damping / spring.stiffness } else { f64::INFINITY }
        };
        of(&self.normal).min(self.friction.as_ref().map_or(f64::INFINITY, of))
    }
}

/// The springs of a pair of surfaces on an effective mass (kg), or the reason why they are not known.
pub(crate) fn springs(
    props: &PairProps,
    mass: f64,
    speed: Option<f64>,
) -> Result<ContactSprings, &'static str> {
    let k = props.stiffness;
    let depth = match (props.normal.exponent(), speed) {
        (Exponent::ThreeHalves, None) => {
            return Err("a contact of exponent 3/2 is as stiff as it is deep, and no closing speed is given");
        }
        (Exponent::ThreeHalves, Some(speed)) => hertz_depth(k, mass, speed),
        // Without a speed the damping is the one at touch.
        _ => speed.map_or(0.0, |speed| speed * (mass / k).sqrt()),
    };
    let (normal, bounces_by_formula) = normal_spring(props, depth)?;
    // The peak load of a bounce.
    let load = speed.map(|speed| speed * (normal.stiffness * mass).sqrt().max(normal.damping));
    Ok(ContactSprings { normal, friction: friction_spring(props, load)?, bounces_by_formula })
}

/// The springs of a contact at a depth (m) and a load (N), or the reason why they are not known.
pub(crate) fn pressed_springs(
    props: &PairProps,
    depth: f64,
    load: f64,
) -> Result<ContactSprings, &'static str> {
    let (normal, bounces_by_formula) = normal_spring(props, depth)?;
    Ok(ContactSprings { normal, friction: friction_spring(props, Some(load))?, bounces_by_formula })
}

/// The tangent at a depth, and whether the law is that of `bounce.rs`.
fn normal_spring(props: &PairProps, depth: f64) -> Result<(Spring, bool), &'static str> {
    let k = props.stiffness;
    Ok(match &props.normal {
        NormalProps::Linear { damping, ramp } => (Spring { stiffness: k, damping: *damping }, *ramp == 0.0),
        NormalProps::HuntCrossley { dissipation, exponent: Exponent::One } => {
            (Spring { stiffness: k, damping: k * depth * dissipation }, false)
        }
        NormalProps::HuntCrossley { dissipation, exponent: Exponent::ThreeHalves } => {
            let root = depth.sqrt();
            let damping = k * root * root * root * dissipation;
            (Spring { stiffness: 1.5 * k * root, damping }, false)
        }
        NormalProps::PowerLaw { damping, exponent, damping_exponent } => {
            let damping = damping * libm::pow(depth, *damping_exponent);
            match exponent {
                Exponent::One => (Spring { stiffness: k, damping }, *damping_exponent == 0.0),
                Exponent::ThreeHalves => (Spring { stiffness: 1.5 * k * depth.sqrt(), damping }, false),
            }
        }
        NormalProps::Custom { .. } => return Err("a normal law of the host's is not known here"),
    })
}

/// The spring of sticking friction under a load; `None` without friction.
fn friction_spring(props: &PairProps, load: Option<f64>) -> Result<Option<Spring>, &'static str> {
    Ok(match &props.friction {
        FrictionProps::None => None,
        FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, .. } => {
            let grips = *mu_kinetic > 0.0 || *mu_static > 0.0;
            grips.then_some(Spring { stiffness: *stiffness, damping: *damping })
        }
        // The slope is μN/v_ε up to the slip speed; unknown without a load.
        FrictionProps::Coulomb { mu, slip_speed } => {
            load.map(|load| Spring { stiffness: 0.0, damping: mu * load / slip_speed })
        }
        FrictionProps::Custom { .. } => return Err("a friction law of the host's is not known here"),
    })
}

/// Depth at which ½mv² = ⅖·k·δ^(5/2).
fn hertz_depth(k: f64, mass: f64, speed: f64) -> f64 {
    libm::pow(1.25 * mass * speed * speed / k, 0.4)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn props(normal: NormalProps, friction: FrictionProps) -> PairProps {
        PairProps { share_a: 0.5, stiffness: 1e7, normal, friction }
    }

    /// The tangent of k·δ^(3/2) where all of ½mv² is stored.
    #[test]
    fn a_hertz_contact_is_judged_where_the_speed_takes_it() {
        let law = NormalProps::HuntCrossley { dissipation: 0.5, exponent: Exponent::ThreeHalves };
        let hertz = props(law, FrictionProps::None);
        assert!(springs(&hertz, 2.0, None).is_err());
        let made = springs(&hertz, 2.0, Some(0.3)).unwrap().normal;
        let depth = (made.stiffness / 1.5e7) * (made.stiffness / 1.5e7);
        assert!((0.4 * 1e7 * libm::pow(depth, 2.5) / (0.5 * 2.0 * 0.09) - 1.0).abs() < 1e-12);
        let force = |d: f64, v: f64| 1e7 * libm::pow(d, 1.5) * (1.0 + 0.5 * v);
        let slope = (force(depth * (1.0 + 1e-6), 0.0) - force(depth * (1.0 - 1e-6), 0.0)) / (2e-6 * depth);
        assert!((made.stiffness / slope - 1.0).abs() < 1e-8);
        assert!((made.damping / (force(depth, 1.0) - force(depth, 0.0)) - 1.0).abs() < 1e-8);
    }

    /// The power law's spring and damper at that depth; q = 0 on a linear spring is the linear law, q = p
    /// that of Hunt and Crossley.
    #[test]
    fn a_power_law_is_judged_at_the_depth_of_the_bounce() {
        let springs_of = |law, speed| springs(&props(law, FrictionProps::None), 2.0, speed).unwrap();
        let power_law = |damping, exponent, damping_exponent| NormalProps::PowerLaw {
            damping,
            exponent,
            damping_exponent,
        };
        for exponent in [Exponent::One, Exponent::ThreeHalves] {
            let same = NormalProps::HuntCrossley { dissipation: 0.5, exponent };
            let (same, own) = (
                springs_of(same, Some(0.3)).normal,
                springs_of(power_law(5e6, exponent, exponent.value()), Some(0.3)).normal,
            );
            assert!((own.stiffness / same.stiffness - 1.0).abs() < 1e-14);
            assert!((own.damping / same.damping - 1.0).abs() < 1e-14);
        }
        let linear = springs_of(power_law(300.0, Exponent::One, 0.0), None);
        assert_eq!((linear.normal.damping, linear.bounces_by_formula), (300.0, true));
        assert!(!springs_of(power_law(300.0, Exponent::One, 0.5), Some(0.3)).bounces_by_formula);
        assert_eq!(springs_of(power_law(300.0, Exponent::One, 0.5), None).normal.damping, 0.0);
        let unknown = props(power_law(300.0, Exponent::ThreeHalves, 0.0), FrictionProps::None);
        assert!(springs(&unknown, 2.0, None).is_err());
    }

    #[test]
    fn regularised_friction_is_a_damper_below_the_slip_speed() {
        let law = NormalProps::Linear { damping: 10.0, ramp: 0.0 };
        let rough = props(law, FrictionProps::Coulomb { mu: 0.3, slip_speed: 1e-3 });
        let made = springs(&rough, 0.1, Some(0.2)).unwrap();
        // Peak load of an elastic bounce: v·√(km) = 200 N.
        assert!((made.friction.unwrap().damping / (0.3 * 200.0 / 1e-3) - 1.0).abs() < 1e-12);
    }
}
