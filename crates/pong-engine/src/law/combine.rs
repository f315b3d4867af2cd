//! Combination of two surfaces in series into one set of values for the pair (docs/theory.md, 3).
//!
//! ```text
//! s_A = k_B/(k_A + k_B)     k = k_A·s_A     c = c_A·s_A² + c_B·s_B²     χ = χ_A·s_A + χ_B·s_B
//! ```
//!
//! The power law's c is c_A·s_A^(2+q) + c_B·s_B^(2+q). With the exponent 3/2, κ_i = k_i^(2/3) replaces k_i in
//! s_A, and k = (κ_A·κ_B/(κ_A + κ_B))^(3/2). Friction: k_t follows from the series rule, c_t from the squared
//! shares of k_t, and each μ from 2·μ_A·μ_B/(μ_A + μ_B). The
//! lengths of the rolling resistances add up, and so do those of the spinning resistances. A bristle without given damping takes the damping
//! ratio of the normal law, c·√(k_t/k) (docs/theory.md, 4).
//!
//! A rigid surface has no share of the depth; values that it leaves out of a law are taken from the other
//! surface.

use super::power_law::series_damping;
use super::props::{CombineError, FrictionProps, NormalProps, PairProps};
use super::registry::Laws;
use pong_model::{Exponent, FrictionLaw, LARGEST, NormalLaw, PairOverride, Surface};
use std::borrow::Cow;

/// Combines surface `a` (of A) with surface `b` (of B); values that `table` gives for the pair take
/// precedence.
///
/// # Errors
/// Two rigid surfaces, a surface that names no law and is not rigid, different laws without an entry for the
/// pair, or a law that is not registered. The error states the cause and the cure.
pub fn combine(
    a: &Surface,
    b: &Surface,
    table: Option<&PairOverride>,
    laws: &Laws,
) -> Result<PairProps, CombineError> {
    if a.stiffness.is_infinite() && b.stiffness.is_infinite() {
        return Err(CombineError {
            cause: "both surfaces are rigid: the pair has no stiffness".to_owned(),
            cure: "give one of the two surfaces a finite stiffness".to_owned(),
        });
    }
    let (a, b) = (&*completed(a, b)?, &*completed(b, a)?);
    let exponent = pair_exponent(a, b, table);
    let (share_a, series) = in_series(a.stiffness, b.stiffness, exponent);
    let stiffness = table.and_then(|entry| entry.stiffness).unwrap_or(series);
    let law = match table.and_then(|entry| entry.normal.as_ref()) {
        Some(law) => law.clone(),
        None => combined_normal(a, b, share_a)?,
    };
    let normal = normal_props(&law, laws)?;
    let mut friction = match table.and_then(|entry| entry.friction.as_ref()) {
        Some(law) => table_friction(law, stiffness, laws)?,
        None => combined_friction(a, b, laws)?,
    };
    if let (FrictionProps::Bristle { stiffness: k_t, damping, .. }, Some(entry)) = (&mut friction, table)
        && matches!(entry.friction, Some(FrictionLaw::Bristle { damping: None, .. }))
    {
        *damping = entry_damping((a, b), entry, *k_t, law.bristle_damping(stiffness, *k_t), laws)?;
    }
    Ok(PairProps { share_a, stiffness, normal, friction })
}

/// Damping c_t, N·s/m, of a bristle of stiffness `k_t`, N/m, if the entry of the pair gives none:
///
/// * `by_normal_law`, if the entry names a normal law or a surface has no bristle;
/// * otherwise the damping with the damping ratio that the two surfaces' bristles have in series.
fn entry_damping(
    (a, b): (&Surface, &Surface),
    entry: &PairOverride,
    k_t: f64,
    by_normal_law: f64,
    laws: &Laws,
) -> Result<f64, CombineError> {
    let together = if entry.normal.is_none() { combined_friction(a, b, laws).ok() } else { None };
    let c_t = match together {
        Some(FrictionProps::Bristle { stiffness, damping, .. }) => damping * (k_t / stiffness).sqrt(),
        _ => by_normal_law,
    };
    if c_t <= LARGEST {
        return Ok(c_t);
    }
    Err(CombineError {
        cause: format!(
            "the bristle that the entry for the pair gives on {k_t:e} N/m has a damping of {c_t:e} N·s/m"
        ),
        cure: format!("give that bristle a `damping` of at most {LARGEST:e}"),
    })
}

/// A surface completed with the values that it takes from the other surface.
fn completed<'s>(own: &'s Surface, other: &Surface) -> Result<Cow<'s, Surface>, CombineError> {
    if own.inherits() && own.stiffness.is_finite() {
        return Err(CombineError {
            cause: format!("`{}` names no law, and is not rigid", own.name),
            cure: "give it a normal and a friction law, or an infinite stiffness".to_owned(),
        });
    }
    let mut full = Cow::Borrowed(own);
    if own.normal == NormalLaw::Inherited {
        full.to_mut().normal = other.normal.clone();
    }
    if own.friction == FrictionLaw::Inherited {
        full.to_mut().friction = match other.friction.clone() {
            // The bristle of a rigid surface does not yield, so it takes no stiffness from the other surface, and
            // no resistance, because those of the two surfaces add up.
            FrictionLaw::Bristle { mu, static_excess, damping, .. } => {
                let (rolling, spinning) = (0.0, 0.0);
                FrictionLaw::Bristle { mu, static_excess, stiffness: None, damping, rolling, spinning }
            }
            law => law,
        };
    }
    // A rigid surface has no share of the damping, so a ramp that it leaves out is that of the other surface.
    if own.stiffness.is_infinite()
        && let (NormalLaw::Linear { damping, ramp: 0.0 }, NormalLaw::Linear { ramp, .. }) =
            (&own.normal, &other.normal)
    {
        full.to_mut().normal = NormalLaw::Linear { damping: *damping, ramp: *ramp };
    }
    Ok(full)
}

fn pair_exponent(a: &Surface, b: &Surface, table: Option<&PairOverride>) -> Exponent {
    let law = table.and_then(|entry| entry.normal.as_ref());
    match law {
        Some(law) => law.exponent(),
        None if a.normal.exponent() == b.normal.exponent() => a.normal.exponent(),
        None => Exponent::One,
    }
}

/// A's share of the depth, and the stiffness of the two springs in series.
fn in_series(k_a: f64, k_b: f64, exponent: Exponent) -> (f64, f64) {
    if k_a.is_infinite() {
        return (0.0, k_b);
    }
    if k_b.is_infinite() {
        return (1.0, k_a);
    }
    match exponent {
        Exponent::One => {
            let share_a = k_b / (k_a + k_b);
            (share_a, k_a * share_a)
        }
        Exponent::ThreeHalves => {
            let kappa = |k: f64| libm::cbrt(k) * libm::cbrt(k);
            let share_a = kappa(k_b) / (kappa(k_a) + kappa(k_b));
            // k = k_A·s_A^(3/2), the closed form of the rule in the head comment.
            (share_a, k_a * share_a * share_a.sqrt())
        }
    }
}

/// Error for two surfaces that differ in a value without an entry for the pair; `of` returns the value of a
/// surface, as text.
fn needs_entry(a: &Surface, b: &Surface, what: &str, of: impl Fn(&Surface) -> String) -> CombineError {
    CombineError {
        cause: format!("they differ in {what}: {} and {}", of(a), of(b)),
        cure: format!(
            "add an entry to `pairs` for (\"{}\", \"{}\") that says what holds between them",
            a.name, b.name
        ),
    }
}

/// Name of a surface's normal law in a model file.
fn law_name(surface: &Surface) -> String {
    match &surface.normal {
        NormalLaw::Linear { .. } => "Linear".to_owned(),
        NormalLaw::HuntCrossley { .. } => "HuntCrossley".to_owned(),
        NormalLaw::PowerLaw { .. } => "PowerLaw".to_owned(),
        NormalLaw::Custom { name, parameters } => format!("Custom `{name}` with {parameters:?}"),
        NormalLaw::Inherited => "none".to_owned(),
    }
}

/// Name of a surface's friction law in a model file.
pub(crate) fn friction_name(surface: &Surface) -> String {
    match &surface.friction {
        FrictionLaw::None => "None".to_owned(),
        FrictionLaw::Bristle { .. } => "Bristle".to_owned(),
        FrictionLaw::Coulomb { .. } => "Coulomb".to_owned(),
        FrictionLaw::Custom { name, parameters } => format!("Custom `{name}` with {parameters:?}"),
        FrictionLaw::Inherited => "none".to_owned(),
    }
}

fn combined_normal(a: &Surface, b: &Surface, share_a: f64) -> Result<NormalLaw, CombineError> {
    let share_b = 1.0 - share_a;
    match (&a.normal, &b.normal) {
        (NormalLaw::Linear { damping: c_a, ramp }, NormalLaw::Linear { damping: c_b, ramp: other }) => {
            if ramp != other {
                return Err(needs_entry(a, b, "the ramp of their damping", |surface| match surface.normal {
                    NormalLaw::Linear { ramp, .. } => format!("{ramp} m"),
                    _ => law_name(surface),
                }));
            }
            Ok(NormalLaw::Linear { damping: c_a * share_a * share_a + c_b * share_b * share_b, ramp: *ramp })
        }
        (
            NormalLaw::HuntCrossley { dissipation: chi_a, exponent },
            NormalLaw::HuntCrossley { dissipation: chi_b, exponent: other },
        ) => {
            if exponent != other {
                return Err(exponents_differ(a, b));
            }
            Ok(NormalLaw::HuntCrossley {
                dissipation: chi_a * share_a + chi_b * share_b,
                exponent: *exponent,
            })
        }
        (
            NormalLaw::PowerLaw { damping: c_a, exponent, damping_exponent },
            NormalLaw::PowerLaw { damping: c_b, exponent: other, damping_exponent: other_damping },
        ) => {
            if exponent != other {
                return Err(exponents_differ(a, b));
            }
            if damping_exponent != other_damping {
                return Err(needs_entry(a, b, "the exponent of their damping", damping_exponent_of));
            }
            let damping = series_damping(*c_a, *c_b, share_a, *damping_exponent);
            Ok(NormalLaw::PowerLaw { damping, exponent: *exponent, damping_exponent: *damping_exponent })
        }
        (custom @ NormalLaw::Custom { .. }, other) if custom == other => Ok(custom.clone()),
        _ => Err(needs_entry(a, b, "their normal force law", law_name)),
    }
}

fn exponents_differ(a: &Surface, b: &Surface) -> CombineError {
    needs_entry(a, b, "the exponent of their force law", |surface| {
        surface.normal.exponent().value().to_string()
    })
}

fn damping_exponent_of(surface: &Surface) -> String {
    match &surface.normal {
        NormalLaw::PowerLaw { damping_exponent, .. } => damping_exponent.to_string(),
        _ => law_name(surface),
    }
}

fn normal_props(law: &NormalLaw, laws: &Laws) -> Result<NormalProps, CombineError> {
    Ok(match law {
        NormalLaw::Linear { damping, ramp } => NormalProps::Linear { damping: *damping, ramp: *ramp },
        NormalLaw::HuntCrossley { dissipation, exponent } => {
            NormalProps::HuntCrossley { dissipation: *dissipation, exponent: *exponent }
        }
        NormalLaw::PowerLaw { damping, exponent, damping_exponent } => NormalProps::PowerLaw {
            damping: *damping,
            exponent: *exponent,
            damping_exponent: *damping_exponent,
        },
        NormalLaw::Custom { name, parameters } => {
            NormalProps::Custom { law: laws.normal(name)?, parameters: parameters.clone() }
        }
        NormalLaw::Inherited => return Err(no_law("normal")),
    })
}

fn combined_friction(a: &Surface, b: &Surface, laws: &Laws) -> Result<FrictionProps, CombineError> {
    match (&a.friction, &b.friction) {
        (FrictionLaw::None, _) | (_, FrictionLaw::None) => Ok(FrictionProps::None),
        (
            FrictionLaw::Bristle {
                mu: mu_a, static_excess: excess_a, rolling: roll_a, spinning: spin_a, ..
            },
            FrictionLaw::Bristle {
                mu: mu_b, static_excess: excess_b, rolling: roll_b, spinning: spin_b, ..
            },
        ) => {
            let ((kt_a, ct_a), (kt_b, ct_b)) = (spring_of(a), spring_of(b));
            let (share_a, stiffness) = in_series(kt_a, kt_b, Exponent::One);
            if stiffness.is_infinite() {
                return Err(CombineError {
                    cause: "both bristle stiffnesses are infinite".to_owned(),
                    cure: "give one of the two surfaces a finite friction stiffness".to_owned(),
                });
            }
            let share_b = 1.0 - share_a;
            Ok(FrictionProps::Bristle {
                stiffness,
                damping: ct_a * share_a * share_a + ct_b * share_b * share_b,
                mu_kinetic: harmonic(*mu_a, *mu_b),
                mu_static: harmonic((1.0 + excess_a) * mu_a, (1.0 + excess_b) * mu_b),
                rolling: roll_a + roll_b,
                spinning: spin_a + spin_b,
            })
        }
        (
            FrictionLaw::Coulomb { mu: mu_a, slip_speed },
            FrictionLaw::Coulomb { mu: mu_b, slip_speed: other },
        ) => {
            if slip_speed != other {
                return Err(needs_entry(
                    a,
                    b,
                    "the slip speed of their friction law",
                    |surface| match surface.friction {
                        FrictionLaw::Coulomb { slip_speed, .. } => format!("{slip_speed} m/s"),
                        _ => friction_name(surface),
                    },
                ));
            }
            Ok(FrictionProps::Coulomb { mu: harmonic(*mu_a, *mu_b), slip_speed: *slip_speed })
        }
        (custom @ FrictionLaw::Custom { .. }, other) if custom == other => {
            let (_, stiffness) = in_series(a.stiffness, b.stiffness, Exponent::One);
            table_friction(custom, stiffness, laws)
        }
        _ => Err(needs_entry(a, b, "their friction law", friction_name)),
    }
}

fn table_friction(
    law: &FrictionLaw,
    pair_stiffness: f64,
    laws: &Laws,
) -> Result<FrictionProps, CombineError> {
    Ok(match law {
        FrictionLaw::None => FrictionProps::None,
        FrictionLaw::Bristle { mu, static_excess, stiffness, damping, rolling, spinning } => {
            FrictionProps::Bristle {
                stiffness: stiffness.unwrap_or(default_tangential(pair_stiffness)),
                // If the entry gives none, `combine` computes it later.
                damping: damping.unwrap_or(0.0),
                mu_kinetic: *mu,
                mu_static: (1.0 + static_excess) * mu,
                rolling: *rolling,
                spinning: *spinning,
            }
        }
        FrictionLaw::Coulomb { mu, slip_speed } => {
            FrictionProps::Coulomb { mu: *mu, slip_speed: *slip_speed }
        }
        FrictionLaw::Custom { name, parameters } => FrictionProps::Custom {
            law: laws.friction(name)?,
            stiffness: default_tangential(pair_stiffness),
            parameters: parameters.clone(),
        },
        FrictionLaw::Inherited => return Err(no_law("friction")),
    })
}

fn no_law(which: &str) -> CombineError {
    CombineError {
        cause: format!("nothing says which {which} law holds"),
        cure: format!("give one of the two surfaces, or an entry of `pairs`, a {which} law"),
    }
}

/// Bristle stiffness k_t and damping c_t of a surface.
fn spring_of(surface: &Surface) -> (f64, f64) {
    surface.bristle().expect("it has a bristle")
}

fn default_tangential(stiffness: f64) -> f64 {
    Surface::BRISTLE_SHARE * stiffness
}

fn harmonic(mu_a: f64, mu_b: f64) -> f64 {
    // Zero for two zeros, without a division by zero.
    2.0 * mu_a * mu_b / (mu_a + mu_b).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(stiffness: f64, damping: f64) -> Surface {
        Surface {
            name: format!("k{stiffness}"),
            stiffness,
            foundation: None,
            area: None,
            normal: NormalLaw::Linear { damping, ramp: 0.0 },
            friction: FrictionLaw::None,
        }
    }

    fn damping_of(props: &PairProps) -> f64 {
        match props.normal {
            NormalProps::Linear { damping, .. } => damping,
            _ => unreachable!(),
        }
    }

    #[test]
    fn springs_in_series_share_the_depth_by_compliance() {
        let props = combine(&surface(3e5, 900.0), &surface(1e5, 100.0), None, &Laws::default()).unwrap();
        assert!((props.stiffness - 7.5e4).abs() < 1e-9);
        assert!((props.share_a - 0.25).abs() < 1e-15);
        // Each damper acts on its own part of the rate; the powers add.
        assert!((damping_of(&props) - (900.0 / 16.0 + 100.0 * 9.0 / 16.0)).abs() < 1e-9);
    }

    #[test]
    fn a_rigid_surface_leaves_all_the_yield_to_the_other() {
        let props =
            combine(&surface(f64::INFINITY, 0.0), &surface(1e5, 7.0), None, &Laws::default()).unwrap();
        assert_eq!((props.share_a, props.stiffness, damping_of(&props)), (0.0, 1e5, 7.0));
        let both = surface(f64::INFINITY, 0.0);
        assert!(combine(&both, &both, None, &Laws::default()).is_err());
    }

    #[test]
    fn each_surface_damps_its_own_share() {
        let hunt_crossley = |stiffness, dissipation| Surface {
            normal: NormalLaw::HuntCrossley { dissipation, exponent: Exponent::One },
            ..surface(stiffness, 0.0)
        };
        let (a, b) = (hunt_crossley(3e5, 0.2), hunt_crossley(1e5, 0.8));
        let props = combine(&a, &b, None, &Laws::default()).unwrap();
        let NormalProps::HuntCrossley { dissipation, exponent } = props.normal else {
            panic!("not the law of both")
        };
        // A takes a quarter of the depth.
        assert!((dissipation - (0.25 * 0.2 + 0.75 * 0.8)).abs() < 1e-15);
        assert_eq!(exponent, Exponent::One);
    }

    /// Power law: the two dampers dissipate what the pair's damper does, at any depth; q = 0 is the linear
    /// law.
    #[test]
    fn dampers_of_the_power_law_dissipate_what_their_pair_does() {
        for (exponent, q) in [
            (Exponent::One, 0.0),
            (Exponent::One, 0.6),
            (Exponent::ThreeHalves, 0.25),
            (Exponent::ThreeHalves, 1.0),
            (Exponent::ThreeHalves, 1.5),
        ] {
            let power_law = |stiffness, damping| Surface {
                normal: NormalLaw::PowerLaw { damping, exponent, damping_exponent: q },
                ..surface(stiffness, 0.0)
            };
            let (a, b) = (power_law(3e5, 900.0), power_law(1e5, 100.0));
            let props = combine(&a, &b, None, &Laws::default()).unwrap();
            let NormalProps::PowerLaw { damping, .. } = props.normal else { panic!("not the law of both") };
            for (depth, rate) in [(1e-3, 0.2), (0.3, -2.0)] {
                let taken =
                    |c: f64, share: f64| c * libm::pow(share * depth, q) * (share * rate) * (share * rate);
                let both = taken(900.0, props.share_a) + taken(100.0, 1.0 - props.share_a);
                assert!((taken(damping, 1.0) / both - 1.0).abs() < 1e-14, "{q}");
            }
            if q == 0.0 {
                let linear =
                    combine(&surface(3e5, 900.0), &surface(1e5, 100.0), None, &Laws::default()).unwrap();
                assert_eq!((damping, props.share_a), (damping_of(&linear), linear.share_a));
            }
        }
    }

    #[test]
    fn hertz_surfaces_carry_the_same_force_at_their_share_of_the_depth() {
        let hertz = |stiffness| Surface {
            normal: NormalLaw::HuntCrossley { dissipation: 0.0, exponent: Exponent::ThreeHalves },
            ..surface(stiffness, 0.0)
        };
        let (a, b) = (hertz(4e6), hertz(9e5));
        let props = combine(&a, &b, None, &Laws::default()).unwrap();
        let depth = 1e-3_f64;
        let of = |k: f64, d: f64| k * d * d.sqrt();
        let whole = of(props.stiffness, depth);
        assert!((of(a.stiffness, depth * props.share_a) / whole - 1.0).abs() < 1e-14);
        assert!((of(b.stiffness, depth * (1.0 - props.share_a)) / whole - 1.0).abs() < 1e-14);
    }

    #[test]
    fn friction_combines_by_the_harmonic_mean() {
        let rough = |mu, stiffness| Surface {
            friction: FrictionLaw::Bristle {
                mu,
                static_excess: 0.5,
                stiffness: Some(stiffness),
                damping: Some(4.0),
                rolling: mu * 0.01,
                spinning: 0.0,
            },
            ..surface(1e5, 0.0)
        };
        let props = combine(&rough(0.2, 1e4), &rough(0.6, 3e4), None, &Laws::default()).unwrap();
        let FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, rolling, spinning } =
            props.friction
        else {
            panic!("not a bristle")
        };
        assert!((rolling - 0.008).abs() < 1e-17 && spinning == 0.0);
        assert!((mu_kinetic - 0.3).abs() < 1e-15 && (mu_static - 0.45).abs() < 1e-15);
        assert!((stiffness - 7500.0).abs() < 1e-9);
        assert!((damping - 4.0 * (0.75 * 0.75 + 0.25 * 0.25)).abs() < 1e-12);
    }

    /// Without a given bristle stiffness, k_t = ⅔·k, for surfaces in series and for an entry of the pair.
    #[test]
    fn what_is_not_said_of_friction_follows_the_normal_spring() {
        let friction = || FrictionLaw::Bristle {
            mu: 0.3,
            static_excess: 0.0,
            stiffness: None,
            damping: None,
            rolling: 0.0,
            spinning: 0.0,
        };
        let rough = |stiffness| Surface { friction: friction(), ..surface(stiffness, 0.0) };
        let stiffness_of = |a: &Surface, b: &Surface, table| {
            let props = combine(a, b, table, &Laws::default()).unwrap();
            let FrictionProps::Bristle { stiffness, .. } = props.friction else { panic!("not a bristle") };
            stiffness
        };
        let series = stiffness_of(&rough(3e5), &rough(1e5), None);
        assert!((series - 2.0 / 3.0 * 7.5e4).abs() < 1e-9);
        let one_rigid = stiffness_of(&rough(f64::INFINITY), &rough(1e5), None);
        assert!((one_rigid - 2.0 / 3.0 * 1e5).abs() < 1e-9);
        let entry =
            PairOverride { stiffness: Some(6e4), friction: Some(friction()), ..PairOverride::default() };
        let told = stiffness_of(&rough(3e5), &rough(1e5), Some(&entry));
        assert!((told - 4e4).abs() < 1e-9);
    }

    #[test]
    fn an_entry_says_what_holds_for_the_pair() {
        let friction = FrictionLaw::Bristle {
            mu: 0.4,
            static_excess: 0.5,
            stiffness: Some(9e3),
            damping: Some(7.0),
            rolling: 0.0,
            spinning: 0.0,
        };
        let entry =
            PairOverride { stiffness: Some(6e4), friction: Some(friction), ..PairOverride::default() };
        let props = combine(&surface(3e5, 0.0), &surface(1e5, 0.0), Some(&entry), &Laws::default()).unwrap();
        assert_eq!((props.stiffness, props.share_a), (6e4, 0.25));
        let FrictionProps::Bristle { stiffness, damping, mu_kinetic, mu_static, .. } = props.friction else {
            panic!("not a bristle")
        };
        assert_eq!((stiffness, damping, mu_kinetic), (9e3, 7.0, 0.4));
        assert!((mu_static - 0.6).abs() < 1e-15);
    }

    fn bristle(mu: f64, stiffness: Option<f64>, damping: Option<f64>) -> FrictionLaw {
        FrictionLaw::Bristle { mu, static_excess: 0.0, stiffness, damping, rolling: 0.0, spinning: 0.0 }
    }

    /// Whatever the normal dampings are, the bristle of two surfaces in series has the damping ratio of their
    /// normal spring.
    #[test]
    fn bristles_in_series_keep_the_damping_ratio_of_the_normal_law() {
        let rough = |k: f64, c: f64| Surface { friction: bristle(0.3, None, None), ..surface(k, c) };
        let ratios = |a: &Surface, b: &Surface| {
            let props = combine(a, b, None, &Laws::default()).unwrap();
            let FrictionProps::Bristle { stiffness, damping, .. } = props.friction else {
                panic!("not a bristle")
            };
            (damping / stiffness.sqrt(), damping_of(&props) / props.stiffness.sqrt())
        };
        for (k_a, c_a, k_b, c_b) in
            [(4e4, 40.0, 1e6, 200.0), (3e5, 900.0, 1e5, 100.0), (1e5, 70.0, f64::INFINITY, 0.0)]
        {
            let (tangential, normal) = ratios(&rough(k_a, c_a), &rough(k_b, c_b));
            assert!((tangential / normal - 1.0).abs() < 1e-14, "{tangential} {normal}");
        }
    }

    /// A rigid surface that gives nothing, or only μ, leaves the damping of the other surface unchanged.
    #[test]
    fn a_rigid_surface_changes_no_damping_of_friction() {
        let soft = Surface { friction: bristle(0.3, None, None), ..surface(1e5, 60.0) };
        let rigid = |normal, friction| Surface { normal, friction, ..surface(f64::INFINITY, 0.0) };
        let damped = NormalLaw::Linear { damping: 60.0, ramp: 0.0 };
        for other in [
            rigid(NormalLaw::Inherited, FrictionLaw::Inherited),
            rigid(NormalLaw::Inherited, bristle(0.3, None, None)),
            rigid(damped, bristle(0.3, None, None)),
        ] {
            for (a, b) in [(&soft, &other), (&other, &soft)] {
                let found = bristle_damping(a, b, None).unwrap() / (60.0 * (2.0_f64 / 3.0).sqrt());
                assert!((found - 1.0).abs() < 1e-15, "{found}");
            }
        }
    }

    fn bristle_damping(a: &Surface, b: &Surface, entry: Option<&PairOverride>) -> Result<f64, CombineError> {
        match combine(a, b, entry, &Laws::default())?.friction {
            FrictionProps::Bristle { damping, .. } => Ok(damping),
            _ => panic!("not a bristle"),
        }
    }

    /// Precedence: the entry's values, then the two surfaces' bristles, then the normal law of the pair.
    #[test]
    fn an_entry_that_gives_no_damping_keeps_the_damping_ratio() {
        let entry = |stiffness, normal, k_t| PairOverride {
            stiffness,
            normal,
            friction: Some(bristle(0.1, k_t, None)),
            ..PairOverride::default()
        };
        let linear = |damping| Some(NormalLaw::Linear { damping, ramp: 0.0 });
        let hunt = Some(NormalLaw::HuntCrossley { dissipation: 0.1, exponent: Exponent::One });
        let rough = |k, c_t| Surface { friction: bristle(0.3, None, c_t), ..surface(k, 60.0) };
        // In series, k_t = 5e4 and c_t = 300·(3/4)² + 90·(1/4)², from k_t of ⅔ of 1e5 and of 3e5.
        let (a, b) = (rough(3e5, Some(90.0)), rough(1e5, Some(300.0)));
        let series = 300.0 * 0.5625 + 90.0 * 0.0625;
        let third = 2.0_f64 / 3.0;
        let plain = surface(1e5, 60.0);
        // The plain surface with itself: k = 5e4, c = 30.
        for (a, b, entry, expected) in [
            (&a, &b, entry(None, None, None), series),
            (&a, &b, entry(None, None, Some(2e5)), series * 2.0),
            (&a, &b, entry(Some(3e5), None, None), series * 2.0),
            (&a, &b, entry(Some(6e4), linear(50.0), None), 50.0 * third.sqrt()),
            (&a, &b, entry(None, linear(50.0), Some(7.5e4)), 50.0),
            (&a, &b, entry(None, hunt, None), 0.0),
            (&plain, &plain, entry(None, None, None), 30.0 * third.sqrt()),
            (&plain, &plain, entry(None, None, Some(5e4)), 30.0),
            (&rough(1e5, Some(0.0)), &rough(1e5, Some(0.0)), entry(None, None, None), 0.0),
        ] {
            let found = bristle_damping(a, b, Some(&entry)).unwrap();
            assert!((found - expected).abs() <= 1e-14 * expected, "{entry:?}: {found} {expected}");
        }
        let beyond = entry(Some(1e-100), linear(1e100), Some(1e100));
        let error = bristle_damping(&a, &b, Some(&beyond)).unwrap_err();
        assert!(
            error.cause.contains("damping of 1e200 N·s/m") && error.cure.contains("damping"),
            "{error:?}"
        );
    }

    #[test]
    fn one_surface_without_friction_leaves_none() {
        let coulomb = |mu| FrictionLaw::Coulomb { mu, slip_speed: 1e-3 };
        let with = |friction| Surface { friction, ..surface(1e5, 0.0) };
        for (a, b, expected) in [(0.0, 0.5, 0.0), (0.5, 0.0, 0.0), (0.0, 0.0, 0.0), (0.2, 0.6, 0.3)] {
            let props = combine(&with(coulomb(a)), &with(coulomb(b)), None, &Laws::default()).unwrap();
            let FrictionProps::Coulomb { mu, slip_speed } = props.friction else { panic!("not Coulomb's") };
            assert!((mu - expected).abs() < 1e-15 && slip_speed == 1e-3, "{mu}");
        }
        let props = combine(&with(coulomb(0.5)), &surface(1e5, 0.0), None, &Laws::default()).unwrap();
        assert!(matches!(props.friction, FrictionProps::None));
    }

    /// A difference in values that must be equal is refused, and the error names the pair.
    #[test]
    fn what_must_be_alike_and_is_not_is_refused_by_name() {
        let custom = |name: &str| NormalLaw::Custom { name: name.to_owned(), parameters: vec![] };
        let custom_friction = |name: &str| FrictionLaw::Custom { name: name.to_owned(), parameters: vec![] };
        let hunt_crossley = |exponent| NormalLaw::HuntCrossley { dissipation: 0.1, exponent };
        let power_law = |exponent, q| NormalLaw::PowerLaw { damping: 1.0, exponent, damping_exponent: q };
        let normal = |normal| Surface { normal, ..surface(1e5, 0.0) };
        let friction = |friction| Surface { friction, ..surface(1e5, 0.0) };
        let coulomb = |slip_speed| FrictionLaw::Coulomb { mu: 0.5, slip_speed };
        let bristle = FrictionLaw::Bristle {
            mu: 0.5,
            static_excess: 0.0,
            stiffness: None,
            damping: None,
            rolling: 0.0,
            spinning: 0.0,
        };
        for (a, b, what) in [
            (normal(custom("x")), normal(custom("y")), "their normal force law"),
            (normal(custom("x")), surface(1e5, 0.0), "their normal force law"),
            (normal(hunt_crossley(Exponent::One)), normal(hunt_crossley(Exponent::ThreeHalves)), "exponent"),
            (
                normal(power_law(Exponent::One, 0.5)),
                normal(power_law(Exponent::ThreeHalves, 0.5)),
                "the exponent of their force law: 1 and 1.5",
            ),
            (
                normal(power_law(Exponent::One, 0.5)),
                normal(power_law(Exponent::One, 0.25)),
                "the exponent of their damping: 0.5 and 0.25",
            ),
            (normal(power_law(Exponent::One, 0.0)), surface(1e5, 0.0), "PowerLaw and Linear"),
            (friction(custom_friction("x")), friction(custom_friction("y")), "their friction law"),
            (friction(coulomb(1e-3)), friction(coulomb(2e-3)), "slip speed"),
            (friction(coulomb(1e-3)), friction(bristle), "their friction law"),
        ] {
            let error = combine(&a, &b, None, &Laws::default()).unwrap_err();
            assert!(error.cause.contains(what) && error.cure.contains("pairs"), "{error:?}");
        }
    }

    #[test]
    fn different_laws_need_an_entry_for_the_pair() {
        let ramped = Surface { normal: NormalLaw::Linear { damping: 1.0, ramp: 1e-3 }, ..surface(1e5, 1.0) };
        let plain = surface(1e5, 1.0);
        assert!(combine(&ramped, &plain, None, &Laws::default()).is_err());
        let entry = PairOverride {
            normal: Some(NormalLaw::Linear { damping: 3.0, ramp: 0.0 }),
            ..PairOverride::default()
        };
        let props = combine(&ramped, &plain, Some(&entry), &Laws::default()).unwrap();
        assert_eq!(damping_of(&props), 3.0);
    }

    /// A rigid surface that names no law behaves like a rigid surface with the law, exponent, ramp and
    /// friction of the other surface.
    #[test]
    fn a_rigid_surface_takes_what_it_does_not_say_from_the_other() {
        let silent = Surface {
            normal: NormalLaw::Inherited,
            friction: FrictionLaw::Inherited,
            ..surface(f64::INFINITY, 0.0)
        };
        let normals = [
            NormalLaw::Linear { damping: 30.0, ramp: 1e-4 },
            NormalLaw::HuntCrossley { dissipation: 0.4, exponent: Exponent::One },
            NormalLaw::HuntCrossley { dissipation: 0.4, exponent: Exponent::ThreeHalves },
            NormalLaw::PowerLaw { damping: 7.0, exponent: Exponent::ThreeHalves, damping_exponent: 1.0 },
        ];
        let frictions = [
            FrictionLaw::None,
            FrictionLaw::Bristle {
                mu: 0.3,
                static_excess: 0.2,
                stiffness: Some(7e3),
                damping: Some(5.0),
                rolling: 0.0,
                spinning: 0.0,
            },
            FrictionLaw::Bristle {
                mu: 0.3,
                static_excess: 0.0,
                stiffness: None,
                damping: None,
                rolling: 0.0,
                spinning: 0.0,
            },
            FrictionLaw::Coulomb { mu: 0.3, slip_speed: 1e-3 },
        ];
        let text = |a: &Surface, b: &Surface| format!("{:?}", combine(a, b, None, &Laws::default()).unwrap());
        for normal in &normals {
            for friction in &frictions {
                let soft =
                    Surface { normal: normal.clone(), friction: friction.clone(), ..surface(1e5, 0.0) };
                // The law of the other surface; its numbers have no effect, because a rigid surface does not
                // yield.
                let mut telling = Surface { stiffness: f64::INFINITY, ..soft.clone() };
                if let FrictionLaw::Bristle { stiffness, .. } = &mut telling.friction {
                    *stiffness = None;
                }
                assert_eq!(text(&silent, &soft), text(&telling, &soft));
                assert_eq!(text(&soft, &silent), text(&soft, &telling));
                let props = combine(&silent, &soft, None, &Laws::default()).unwrap();
                assert_eq!((props.share_a, props.stiffness), (0.0, 1e5));
                if let (NormalProps::Linear { damping, ramp }, NormalLaw::Linear { .. }) =
                    (&props.normal, normal)
                {
                    assert_eq!((*damping, *ramp), (30.0, 1e-4));
                }
                if let (
                    FrictionProps::Bristle { stiffness, .. },
                    FrictionLaw::Bristle { stiffness: told, .. },
                ) = (&props.friction, friction)
                {
                    assert_eq!(*stiffness, told.unwrap_or(2.0 / 3.0 * 1e5));
                }
            }
        }
    }

    /// Values that a rigid surface does give are used: a different law needs an entry as usual. Only a
    /// missing ramp is taken from the other surface.
    #[test]
    fn what_a_rigid_surface_says_holds() {
        let rigid = surface(f64::INFINITY, 0.0);
        let ramp = |ramp| NormalLaw::Linear { damping: 30.0, ramp };
        let ramped = Surface { normal: ramp(1e-4), ..surface(1e5, 0.0) };
        let props = combine(&rigid, &ramped, None, &Laws::default()).unwrap();
        assert!(matches!(props.normal, NormalProps::Linear { damping: 30.0, ramp: 1e-4 }));
        let other_ramp = Surface { normal: ramp(2e-4), ..rigid.clone() };
        let error = combine(&other_ramp, &ramped, None, &Laws::default()).unwrap_err();
        assert!(error.cause.contains("0.0002 m and 0.0001 m"), "{error:?}");
        let hunt = NormalLaw::HuntCrossley { dissipation: 0.1, exponent: Exponent::One };
        let error =
            combine(&rigid, &Surface { normal: hunt, ..ramped.clone() }, None, &Laws::default()).unwrap_err();
        assert!(error.cause.contains("normal force law: Linear and HuntCrossley"), "{error:?}");
        // Only a rigid surface may leave out its laws.
        let soft = Surface { normal: NormalLaw::Inherited, ..surface(1e4, 0.0) };
        assert!(combine(&soft, &ramped, None, &Laws::default()).is_err());
    }
}
