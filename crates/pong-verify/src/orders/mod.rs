//! Convergence orders of contact motions in the step, for each motion and integrator.
//!
//! Each motion is run from several phases of a step if contact begins in it, at a step, half of it and a
//! quarter of it; its error is the largest over the phases against Runge-Kutta with a far smaller step. The
//! expected orders are those of the theory manual (section 4).

mod motions;
mod plot;

use crate::case::Failure;
use crate::row::Row;
use crate::scene::Run;
use motions::{MOTIONS, Motion};
use pong_executive::{Integrator, Vec3};
use std::sync::OnceLock;

pub use plot::svg;

/// Integrators: name in the table, method, and longest step, s.
const METHODS: [(&str, Integrator, f64); 3] = [
    ("Runge-Kutta 4", Integrator::RungeKutta4, 1e-3),
    ("semi-implicit Euler", Integrator::SemiImplicitEuler, 2e-4),
    ("held wrench", Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 }, 2e-4),
];

/// Steps per curve: the longest, half and a quarter of it.
const HALVINGS: usize = 3;

/// Largest accepted shortfall of an observed order: the steps are short, but finite.
const ORDER_TOLERANCE: f64 = 0.2;

/// Largest errors of a motion under an integrator.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name of the motion.
    pub motion: &'static str,
    /// Index of the integrator in the table.
    pub method: usize,
    /// Order promised by the theory manual, without unit.
    pub promised: f64,
    /// Steps, s, and errors, m/s.
    pub points: [(f64, f64); HALVINGS],
}

impl Curve {
    /// Mean order between the longest and the shortest step.
    pub fn order(&self) -> f64 {
        let [(longest, coarse), .., (shortest, fine)] = self.points;
        libm::log2(coarse / fine) / libm::log2(longest / shortest)
    }
}

/// All curves, computed once.
///
/// # Errors
/// A motion that could not be run.
pub fn curves() -> Result<&'static [Curve], Failure> {
    static CURVES: OnceLock<Result<Vec<Curve>, String>> = OnceLock::new();
    let made = CURVES.get_or_init(|| {
        let made: Result<Vec<_>, Failure> = MOTIONS.iter().map(of_motion).collect();
        made.map(|curves| curves.concat()).map_err(|failure| failure.to_string())
    });
    made.as_deref().map_err(|failure| failure.clone().into())
}

/// One row for each motion and integrator.
///
/// # Errors
///
/// A motion that could not be run; the text is the engine's message.
pub fn rows() -> Result<Vec<Row>, Failure> {
    let row = |curve: &Curve| {
        let quantity = format!("{}: {}", METHODS[curve.method].0, curve.motion);
        Row::at_least(quantity, "", curve.promised, curve.order(), ORDER_TOLERANCE)
    };
    Ok(curves()?.iter().map(row).collect())
}

/// Position, velocity and spin at the end.
struct End {
    place: Vec3,
    velocity: Vec3,
    spin: Vec3,
}

impl End {
    fn of(motion: &Motion, phase: f64, method: (Integrator, f64)) -> Result<Self, Failure> {
        let mut run: Run = (motion.start)(phase, method)?;
        run.sim.run_for(motion.duration)?;
        Ok(Self { place: run.position(), velocity: run.velocity(), spin: run.spin() })
    }

    /// Distance as a speed, m/s: positions divided by the duration, spins times the lever of the motion.
    fn from(&self, other: &Self, motion: &Motion) -> f64 {
        let place = (self.place - other.place).norm() / motion.duration;
        place + (self.velocity - other.velocity).norm() + motion.lever * (self.spin - other.spin).norm()
    }
}

fn of_motion(motion: &Motion) -> Result<Vec<Curve>, Failure> {
    let phases = (0..motion.phases).map(|i| f64::from(i) / f64::from(motion.phases));
    let phases: Vec<f64> = phases.collect();
    let exact = |phase: &f64| End::of(motion, *phase, (Integrator::RungeKutta4, motion.reference_step));
    let exact = phases.iter().map(exact).collect::<Result<Vec<_>, _>>()?;
    let mut curves = Vec::new();
    for (method, (_, integrator, longest)) in METHODS.iter().enumerate() {
        let mut points = [(0.0, 0.0); HALVINGS];
        for (halving, point) in points.iter_mut().enumerate() {
            let step = longest / f64::from(1 << halving);
            let mut worst = 0.0_f64;
            for (phase, exact) in phases.iter().zip(&exact) {
                worst = worst.max(End::of(motion, *phase, (*integrator, step))?.from(exact, motion));
            }
            *point = (step, worst);
        }
        let promised = if method == 0 { motion.promised } else { 1.0 };
        curves.push(Curve { motion: motion.name, method, promised, points });
    }
    Ok(curves)
}
