//! Drops at many steps, including steps that are too long.

use super::extreme::{Answer, Extreme, Length};
use super::rig::{Rig, model};
use crate::case::{Failure, Outcome};
use crate::measure::order;
use crate::row::Row;
use crate::scene::at;
use pong_engine::Config;
use pong_executive::{BodyId, Integrator, MassProperties, RigidBody, Simulation, Vec3, longest_stable_step};
use pong_testkit::Random;

pub const DROPS: Extreme = Extreme {
    id: "E17",
    asked: "10,000 drops at steps of 1e-5 to 1e-2 s: normal force never negative, the ledger closes at the integrator's \
            order, no rebound above the drop height.",
    set_up: "A point mass of 1 g to 1 t falls from rest for 5 to 50 steps onto a spring with ω·dt of 0.01 to 0.3 and \
             damping ratios ζ of 0 to 1, Runge-Kutta and semi-implicit Euler, until it is up again or at rest. \
             Allowed error, relative to the energy of the impact: rounding with Runge-Kutta, whose ledger takes the \
             wrenches of the stages; (1 + 2ζ)·ω·dt with Euler, of which 2ζ·ω·dt is for damping that begins at once. \
             Allowed rebound with Runge-Kutta: (ω·dt)² + 2ζ·ω·dt. The order is that of Hunt-Crossley damping, which \
             begins with the depth.",
    answer: Answer::Safe,
    limit: "damping without a ramp jumps when contact begins, which costs the ledger an order",
    also: "cases V3, V4, V6, W11, W12",
    rows: drops,
};

pub const HELD: Extreme = Extreme {
    id: "E18",
    asked: "A wrench that is held over a frame adds energy: never without a warning before the first frame.",
    set_up: "1,000 undamped drops as in E17 with the wrench held over the step, and 1,000 with a damping that makes the step \
             stable.",
    answer: Answer::Told,
    limit: "k·T/2 < c < 2m/T: without damping no step is stable",
    also: "cases V28, W13",
    rows: held,
};

pub const STEP: Extreme = Extreme {
    id: "E9",
    asked: "A step too long for stiffness and mass: a warning before the first frame, with the longest stable step.",
    set_up: "1,000 random masses, stiffnesses and damping ratios with each of three integrators, at 0.99 and 1.01 times the \
             longest stable step.",
    answer: Answer::Told,
    limit: "linear; several contacts at once, and lever arms, need shorter steps: a note gives the step that is \
            surely stable",
    also: "case W13, `crates/pong-executive/tests/it/step_sums.rs`",
    rows: steps,
};

const GRAVITY: f64 = 9.81;

/// One drop.
struct Drop {
    mass: f64,
    stiffness: f64,
    damping: f64,
    /// Dissipation of the Hunt-Crossley law, s/m; 0 for the linear law.
    dissipation: f64,
    step: f64,
    /// Duration of the free fall in steps, not whole: any phase of touch.
    fall: f64,
}

impl Drop {
    fn new(random: &mut Random, longest_wave: f64) -> Self {
        let power = |low: f64, high: f64, at: f64| low * libm::pow(high / low, at);
        let step = power(1e-5, 1e-2, random.unit());
        let wave = power(0.01, longest_wave, random.unit());
        let mass = power(1e-3, 1e3, random.unit());
        let stiffness = mass * (wave / step) * (wave / step);
        let ratio = if random.unit() < 0.25 { 0.0 } else { random.unit() };
        let damping = 2.0 * ratio * (stiffness * mass).sqrt();
        Self { mass, stiffness, damping, dissipation: 0.0, step, fall: random.between(5.0, 50.0) }
    }

    fn wave(&self) -> f64 {
        (self.stiffness / self.mass).sqrt() * self.step
    }

    fn height(&self) -> f64 {
        let time = self.fall * self.step;
        0.5 * GRAVITY * time * time
    }

    fn simulate(&self, integrator: Integrator) -> Result<(Simulation, BodyId), Failure> {
        let Self { stiffness, damping, dissipation, .. } = self;
        let law = |damping: f64, dissipation: f64| match self.dissipation {
            0.0 => format!("normal: Linear(damping: {damping:?})"),
            _ => format!("normal: HuntCrossley(dissipation: {dissipation:?}, exponent: 1.0)"),
        };
        let spring = format!("stiffness: {stiffness:?}, {}", law(*damping, *dissipation));
        let rigid = format!("stiffness: inf, {}", law(0.0, 0.0));
        let rig = Rig::with(
            Config { ledger: true, ..Config::default() },
            &model(&spring, "Point(name: \"x\", position: (0,0,0))"),
            &model(&rigid, "Plane(name: \"y\", normal: (0,0,1), offset: 0.0)"),
        )?;
        let mut sim = Simulation::new(rig.world, integrator, self.step)?;
        let start = at(Vec3::z() * self.height());
        let mass = MassProperties::principal(self.mass, [1e9; 3]);
        let body = sim.add_body(RigidBody::free("mass", mass).at(start).touching(rig.sides[0]))?;
        sim.add_body(RigidBody::fixed("ground").touching(rig.sides[1]))?;
        sim.set_gravity(Vec3::new(0.0, 0.0, -GRAVITY));
        sim.commit_initial_states()?;
        Ok((sim, body))
    }

    /// Simulates fall, bounce and rise to the highest point.
    fn run(&self, integrator: Integrator) -> Result<Fallen, Failure> {
        let (mut sim, body) = self.simulate(integrator)?;
        let (height, start) = (self.height(), sim.energy().balance());
        // Energy of the impact: the fall, and the weight's work at rest in the spring.
        let energy = self.mass * GRAVITY * (height + self.mass * GRAVITY / self.stiffness);
        let mut fallen = Fallen { warned: !sim.step_warnings().is_empty(), ..Fallen::default() };
        let half_wave = std::f64::consts::PI / self.wave();
        let steps = (2.2 * self.fall + 3.0 * half_wave) as usize + 10;
        let mut touched = false;
        for _ in 0..steps {
            sim.step()?;
            for contact in sim.world().contacts_iter() {
                fallen.least_force = fallen.least_force.min(contact.normal_force);
                touched = true;
            }
            let energies = sim.energy();
            fallen.worst_balance = fallen.worst_balance.max((energies.balance() - start).abs() / energy);
            if touched {
                // Height that its energy reaches.
                let up = sim.twist(body).linear.z;
                let top = sim.pose(body).position.z + if up > 0.0 { 0.5 * up * up / GRAVITY } else { 0.0 };
                let above = if sim.world().contact_count() == 0 {
                    (top - height) / (energy / (self.mass * GRAVITY))
                } else {
                    0.0
                };
                fallen.above = fallen.above.max(above);
                if up < 0.0 && sim.world().contact_count() == 0 {
                    break;
                }
            }
        }
        Ok(fallen)
    }
}

/// Result of a drop.
#[derive(Default)]
struct Fallen {
    /// Least normal force, N; 0 if none was negative.
    least_force: f64,
    /// Largest error of the energy balance, relative to the energy of the impact.
    worst_balance: f64,
    /// Rise above the drop height, relative to the height of the impact's energy.
    above: f64,
    warned: bool,
}

/// Rounding of a drop's energy balance, relative to the energy of its impact: thousands of steps of 1e-16
/// each, of energies up to a thousand times as large.
const ROUNDED: f64 = 1e-9;

fn drops(length: Length) -> Outcome {
    let count = length.of(400, 10_000);
    let mut rows = Vec::new();
    let methods = [("Runge-Kutta", Integrator::RungeKutta4, 2), ("Euler", Integrator::SemiImplicitEuler, 1)];
    for (name, integrator, power) in methods {
        let mut random = Random(17);
        let (mut negative, mut warned) = (0, 0);
        let (mut open, mut unbalanced, mut above) = (0.0_f64, 0.0_f64, 0.0_f64);
        for _ in 0..count {
            let drop = Drop::new(&mut random, 0.3);
            let fallen = drop.run(integrator)?;
            let ratio = 0.5 * drop.damping / (drop.stiffness * drop.mass).sqrt();
            let allowed = drop.wave().powi(power) + 2.0 * ratio * drop.wave();
            negative += usize::from(fallen.least_force < 0.0);
            warned += usize::from(fallen.warned);
            open = open.max(fallen.worst_balance / allowed);
            unbalanced = unbalanced.max(fallen.worst_balance);
            above = above.max(fallen.above / allowed);
        }
        rows.push(Row::count(format!("{name}, {count} drops: negative normal forces"), 0, negative));
        rows.push(match integrator {
            Integrator::RungeKutta4 => Row::below(
                format!("{name}: error of the ledger over the energy, worst"),
                "",
                unbalanced,
                ROUNDED,
            ),
            _ => Row::below(format!("{name}: error of the ledger over allowed, worst"), "", open, 1.0),
        });
        rows.push(Row::below(
            format!("{name}: rebound above the drop height over allowed, worst"),
            "",
            above,
            1.0,
        ));
        rows.push(Row::count(format!("{name}: warnings of a step that is stable"), 0, warned));
        if integrator == Integrator::SemiImplicitEuler {
            rows.push(observed_order(name, integrator, power)?);
        }
    }
    Ok(rows)
}

/// Order of the ledger's error, from root mean squares over phases of touch at a step and at half of it.
fn observed_order(name: &str, integrator: Integrator, power: i32) -> Result<Row, Failure> {
    let error = |step: f64| -> Result<f64, Failure> {
        let mut sum = 0.0;
        for phase in 0..64 {
            let fall = (0.02 / step) + (f64::from(phase) + 0.5) / 64.0;
            let drop = Drop { mass: 1.0, stiffness: 1e4, damping: 0.0, dissipation: 1.0, step, fall };
            let worst = drop.run(integrator)?.worst_balance;
            sum += worst * worst;
        }
        Ok(sum)
    };
    let got = 0.5 * order(error(1e-3)?, error(5e-4)?);
    Ok(Row::absolute(format!("{name}: order of the ledger"), "", f64::from(power), got, 0.3))
}

fn held(_: Length) -> Outcome {
    let hold = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };
    let mut random = Random(18);
    let mut greatest_gain = 0.0_f64;
    let (mut higher, mut unwarned, mut pulled, mut damped_higher, mut damped_warned) = (0, 0, 0, 0, 0);
    for _ in 0..1000 {
        let mut drop = Drop::new(&mut random, 0.3);
        drop.damping = 0.0;
        let fallen = drop.run(hold)?;
        let above = fallen.above > 1e-3;
        higher += usize::from(above);
        // The executive does not warn about shorter steps: a bounce gains exp(π·ω·dt/2) of its energy there,
        // at most 17 % in the mean over the phases of touch.
        unwarned += usize::from(above && !fallen.warned && drop.wave() >= 0.1);
        greatest_gain = greatest_gain.max(if fallen.warned { 0.0 } else { fallen.above });
        pulled += usize::from(fallen.least_force < 0.0);
        // Twice the stable damping.
        drop.damping = drop.stiffness * drop.step;
        let fallen = drop.run(hold)?;
        damped_higher += usize::from(fallen.above > drop.wave());
        damped_warned += usize::from(fallen.warned);
    }
    Ok(vec![
        Row::count(
            format!(
                "undamped, ω·dt ≥ 0.1: above the drop height ({higher} of 1000 at any ω·dt) and not warned"
            ),
            0,
            unwarned,
        ),
        Row::below("undamped, ω·dt < 0.1: largest gain of height without a warning", "", greatest_gain, 0.25),
        Row::count("undamped: negative normal forces", 0, pulled),
        Row::count("damped, stable: above the drop height by more than ω·dt", 0, damped_higher),
        Row::count("damped, stable: warned", 0, damped_warned),
    ])
}

fn steps(_: Length) -> Outcome {
    let hold = Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 };
    let methods = [
        ("semi-implicit Euler", Integrator::SemiImplicitEuler),
        ("Runge-Kutta", Integrator::RungeKutta4),
        ("held wrench", hold),
    ];
    let mut rows = Vec::new();
    for (name, integrator) in methods {
        let mut random = Random(9);
        let (mut missed, mut false_alarms) = (0, 0);
        for _ in 0..1000 {
            let mut drop = Drop::new(&mut random, 0.3);
            drop.damping = drop.damping.max(1e-3 * (drop.stiffness * drop.mass).sqrt());
            let longest = longest_stable_step(integrator, drop.stiffness, drop.damping, drop.mass);
            for (factor, wrong) in [(0.99, &mut false_alarms), (1.01, &mut missed)] {
                drop.step = factor * longest;
                let (sim, _) = drop.simulate(integrator)?;
                let warned = !sim.step_warnings().is_empty();
                *wrong += usize::from(warned != (factor > 1.0));
            }
        }
        rows.push(Row::count(format!("{name}: 1.01 times the longest step, not warned"), 0, missed));
        rows.push(Row::count(format!("{name}: 0.99 times the longest step, warned"), 0, false_alarms));
    }
    Ok(rows)
}
