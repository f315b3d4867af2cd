//! W18: bounces of a point mass with the power law.

use super::bounce::{mean, restitutions_of};
use crate::case::{Case, Failure, Outcome};
use crate::row::Row;
use crate::scene::Duo;
use pong_executive::Integrator;
use pong_model::restitution::{Impact, power_law_damping};
use pong_model::{Exponent, NormalLaw, Surface};

pub const W18: Case = Case {
    id: "W18",
    title: "Bounces with the power law",
    set_up: "40 g at 2 m/s onto 1e5 N/m, or 1e7 N/m^1.5, k·δ^p + c·δ^q·δ', Runge-Kutta at a 200th of depth over speed, 8 \
             phases of touch; then a tenth and ten times the speed, and the mass.",
    source: "the restitution asked for comes out; with r = (q + 1)/(p + 1) it depends on r and on \
             c·k^(−r)·m^(r − 1)·v^(2r − 1) alone, and 1 − e goes with that group where it is small; slopes at e = 0.58 by \
             an integration of y\" = −y^a − Γ·y' in time (scipy, eighth order)",
    rows,
};

/// Mass, kg, and speed, m/s, for which a restitution is specified.
const NOMINAL: (f64, f64) = (0.04, 2.0);

fn stiffness(exponent: Exponent) -> f64 {
    match exponent {
        Exponent::One => 1e5,
        Exponent::ThreeHalves => 1e7,
    }
}

/// Sets the law of exponents p and q with a given restitution at the nominal mass and speed.
fn set_law(surface: &mut Surface, (exponent, damping_exponent): (Exponent, f64), e: f64) {
    let (mass, speed) = NOMINAL;
    surface.stiffness = stiffness(exponent);
    let p = exponent.value();
    let damping = power_law_damping(surface.stiffness, p, damping_exponent, &Impact { e, speed, mass });
    surface.normal = NormalLaw::PowerLaw { damping, exponent, damping_exponent };
}

/// Mean restitution over the phases of touch.
fn bounced(
    duo: impl Fn() -> Result<Duo, Failure>,
    exponent: Exponent,
    (mass, speed): (f64, f64),
) -> Result<f64, Failure> {
    let depth = libm::pow(mass * speed * speed / stiffness(exponent), 1.0 / (exponent.value() + 1.0));
    let method = (Integrator::RungeKutta4, 0.005 * depth / speed);
    Ok(mean(&restitutions_of(duo, (mass, speed), method, 8)?))
}

/// Mean slope of a function of e over the logarithms of speed and of mass, between `1/factor` and `factor`
/// times the nominal values.
fn slopes(law: (Exponent, f64), e: f64, factor: f64, of: impl Fn(f64) -> f64) -> Result<(f64, f64), Failure> {
    let duo = || Duo::with_laws("point_power_law", "ground_rigid", |s| set_law(s, law, e));
    let at = |by_mass: f64, by_speed: f64| {
        let (mass, speed) = NOMINAL;
        bounced(duo, law.0, (mass * by_mass, speed * by_speed)).map(&of)
    };
    let width = 2.0 * libm::log(factor);
    let by_speed = (at(1.0, factor)? - at(1.0, 1.0 / factor)?) / width;
    let by_mass = (at(factor, 1.0)? - at(1.0 / factor, 1.0)?) / width;
    Ok((by_speed, by_mass))
}

fn rows() -> Outcome {
    let mut rows = Vec::new();
    let from_file = bounced(|| Duo::new("point_power_law", "ground_rigid"), Exponent::ThreeHalves, NOMINAL)?;
    rows.push(Row::absolute("p = 1.5, q = 1, of the model file: e, mean", "", 0.6, from_file, 1e-4));
    for law in [
        (Exponent::One, 0.0),
        (Exponent::One, 0.6),
        (Exponent::ThreeHalves, 0.0),
        (Exponent::ThreeHalves, 0.25),
        (Exponent::ThreeHalves, 0.5),
        (Exponent::ThreeHalves, 1.5),
    ] {
        let duo = || Duo::with_laws("point_power_law", "ground_rigid", |s| set_law(s, law, 0.6));
        let got = bounced(duo, law.0, NOMINAL)?;
        rows.push(Row::absolute(format!("{}: e, mean", named(law)), "", 0.6, got, 1e-4));
    }
    for law in [(Exponent::ThreeHalves, 1.0), (Exponent::ThreeHalves, 0.5), (Exponent::One, 0.6)] {
        let r = (law.1 + 1.0) / (law.0.value() + 1.0);
        let (by_speed, by_mass) = slopes(law, 0.999, 10.0, |e| libm::log(1.0 - e))?;
        let name = |what: &str| format!("{}: exponent of 1 − e in {what}, two decades", named(law));
        rows.push(Row::absolute(name("speed"), "", 2.0 * r - 1.0, by_speed, 2e-3));
        rows.push(Row::absolute(name("mass"), "", r - 1.0, by_mass, 2e-3));
    }
    let law = (Exponent::ThreeHalves, 1.0);
    let (by_speed, by_mass) = slopes(law, 0.58, 1.02, libm::log)?;
    let name = |what: &str| format!("{}, e = 0.58: slope of ln e in ln {what}", named(law));
    rows.push(Row::absolute(name("v"), "", -0.28243, by_speed, 1e-3));
    rows.push(Row::absolute(name("m"), "", 0.09414, by_mass, 1e-3));
    Ok(rows)
}

fn named((exponent, damping_exponent): (Exponent, f64)) -> String {
    format!("p = {}, q = {damping_exponent}", exponent.value())
}
