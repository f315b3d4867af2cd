//! Drops of masses on springs, over four decades of the step and every use of a wrench: the normal force
//! never pulls, the accounts balance to the integrator's order, and every mass that rises above its initial
//! height is reported.

use crate::common::drop::{Drop, G, Landed};
use pong_engine::WrenchCoupling;
use pong_testkit::Random;
use std::f64::consts::PI;

const USES: [WrenchCoupling; 5] = [
    WrenchCoupling::Stages,
    WrenchCoupling::SemiImplicit,
    WrenchCoupling::ZeroOrderHold { delay_frames: 0 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 1 },
    WrenchCoupling::ZeroOrderHold { delay_frames: 2 },
];

/// Random number, uniform in its logarithm.
fn decade(random: &mut Random, low: f64, high: f64) -> f64 {
    10_f64.powf(random.between(low, high))
}

/// A drop with a step of 10 µs to 10 ms, ω·dt from 0.005 to 1, and any damping that the step allows; none in
/// every fifth.
fn random_drop(random: &mut Random, coupling: WrenchCoupling) -> Drop {
    let step = decade(random, -5.0, -2.0);
    let omega = decade(random, -2.3, 0.0) / step;
    let mass = decade(random, -2.0, 5.0);
    let critical = 2.0 * mass * omega;
    let stable = match coupling {
        WrenchCoupling::ZeroOrderHold { .. } => 0.5 * 2.0 * mass / step,
        _ => mass / step,
    };
    let share = decade(random, -3.0, 0.3);
    let damping = if random.unit() < 0.2 { 0.0 } else { (share * critical).min(stable) };
    // Fast enough to leave the plane against its weight.
    let speed = decade(random, 0.3, 2.0) * G / omega;
    let start = [random.unit() * speed * step, -speed];
    Drop { mass, stiffness: mass * omega * omega, damping, gravity: G, start, step, coupling }
}

#[derive(Debug, Default)]
struct Tally {
    drops: u32,
    /// Drops that rose above the initial height; of those, certain and undecided.
    above: u32,
    told: u32,
    left_open: u32,
    /// Reported as gained, without rising above the initial height.
    falsely: u32,
    /// Still bouncing or resting at the end.
    stayed: u32,
    worst_error: f64,
    least_normal_force: f64,
}

/// Rounding, relative to the energy.
const ROUNDING: f64 = 1e-9;

impl Tally {
    fn note(&mut self, drop: &Drop, landed: &Landed) {
        let account = &landed.account;
        let energy = landed.before + drop.mass * G * G / (drop.stiffness / drop.mass);
        // The mass's energy gain is the work of the contact, and the account must agree.
        let error = ((landed.after - landed.before) - account.total.net_work()).abs() / energy;
        let closes = account.total.imbalance().abs() < 1e-10 * energy;
        assert!(closes, "{drop:?}: {:?}", account.total);
        let doubt =
            (account.total.resolution + account.total.hold_error.abs() + account.total.damping_loss.abs())
                / energy;
        match drop.coupling {
            WrenchCoupling::Stages => assert!(error <= doubt + ROUNDING, "{drop:?}: {error} {doubt}"),
            // A force that still acts has done only half of its work.
            WrenchCoupling::SemiImplicit if !landed.left => {}
            _ => assert!(error < ROUNDING, "{drop:?}: {error}"),
        }
        assert!(landed.least_normal_force >= 0.0, "{drop:?}: {}", landed.least_normal_force);
        self.least_normal_force = self.least_normal_force.min(landed.least_normal_force);
        self.drops += 1;
        self.worst_error = self.worst_error.max(error);
        self.stayed += u32::from(!landed.left);
        let above = landed.left && landed.after > landed.before * (1.0 + ROUNDING);
        if above {
            self.above += 1;
            self.told += u32::from(account.gains_energy());
            self.left_open += u32::from(!account.gains_energy() && account.episodes_unresolved > 0);
            assert!(account.gains_energy() || account.episodes_unresolved > 0, "{drop:?}: {landed:?}");
            assert!(
                account.gains_energy() || drop.coupling == WrenchCoupling::Stages,
                "{drop:?}: not told for certain: {landed:?}"
            );
        } else if landed.left && account.episodes == 1 {
            self.falsely += account.episodes_gained as u32;
            assert_eq!(account.episodes_gained, 0, "{drop:?}: {landed:?}");
        }
    }
}

fn drops(count: u32, seed: u64) {
    let mut random = Random(seed);
    for coupling in USES {
        let mut tally = Tally { least_normal_force: f64::INFINITY, ..Tally::default() };
        for _ in 0..count / USES.len() as u32 {
            let drop = random_drop(&mut random, coupling);
            tally.note(&drop, &drop.run(4000));
        }
        println!(
            "{coupling:?}: {} drops, {} above the drop height: {} told, {} left open; {} told falsely, {} did not leave; \
             account against mass: worst {:.1e} of the energy; least normal force {:.1e} N",
            tally.drops,
            tally.above,
            tally.told,
            tally.left_open,
            tally.falsely,
            tally.stayed,
            tally.worst_error,
            tally.least_normal_force,
        );
        assert!(tally.above > 0 && tally.stayed < tally.drops / 4, "{tally:?}");
    }
}

/// Largest error of the accounts against the mass's energy over 16 phases of touch, J per J.
fn worst_error(coupling: WrenchCoupling, omega_step: f64, zeta: f64) -> f64 {
    let drop = |phase: u32| {
        let (mass, omega, step) = (2.0, 300.0, omega_step / 300.0);
        let start = [step * (f64::from(phase) + 0.5) / 16.0, -1.0];
        let (stiffness, damping) = (mass * omega * omega, 2.0 * zeta * mass * omega);
        Drop { mass, stiffness, damping, gravity: G, start, step, coupling }
    };
    let error = |landed: Landed| (landed.after - landed.before - landed.account.total.net_work()).abs();
    (0..16).map(|phase| error(drop(phase).run(20_000))).fold(0.0, f64::max)
}

/// At stages, the accounts balance to the order of Runge-Kutta over such a contact: second order for the kink
/// of the force, first order for its jump with damping. With the other couplings they are exact.
#[test]
fn the_accounts_close_at_the_order_of_the_integrator() {
    for (zeta, order) in [(0.0, 2.0), (0.2, 1.0)] {
        for coupling in USES {
            // Half a contact duration is an odd number of half steps, so that the errors at its beginning and
            // end do not cancel.
            let steps = [31.5, 63.5, 127.5, 255.5, 511.5].map(|count| PI / count);
            let errors = steps.map(|omega_step| worst_error(coupling, omega_step, zeta));
            let slope = (errors[0] / errors[4]).log2() / 4.0;
            let errors = errors.map(|error| format!("{error:.1e}")).join(" ");
            println!("{coupling:?}, ζ = {zeta}: ω·dt π/31.5 to π/511.5: {errors} J of 1 J, order {slope:.2}");
            match coupling {
                WrenchCoupling::Stages => assert!((slope - order).abs() < 0.25, "{slope}"),
                _ => assert!(worst_error(coupling, 0.1, zeta) < 1e-12),
            }
        }
    }
}

#[test]
fn no_drop_rises_above_its_height_untold() {
    drops(500, 1);
}

/// All drops: `cargo test --release -p pong-engine --test it drops:: -- --ignored --nocapture`.
#[test]
#[ignore = "10,000 drops take a while without optimisation"]
fn ten_thousand_drops() {
    drops(10_000, 2);
}
