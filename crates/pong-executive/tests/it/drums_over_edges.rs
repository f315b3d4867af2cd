//! Cylinders that leave a box over its edge, rolling and standing (docs/theory.md, 2.8): energy, the place where they leave
//! it, and free flight.

use crate::rolling::{Host, on_ground};
use pong_executive::{Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_testkit::ron::box_polyhedron;

const G: f64 = 9.81;
const K: f64 = 1e5;
const MASS: f64 = 10.0;
const RADIUS: f64 = 0.2;
const HALF: f64 = 0.3;
/// Depth at rest on a face, m.
const SAG: f64 = MASS * G / K;
const ROLLS: &str = "Bristle(mu: 50.0, stiffness: 1e5, damping: 500.0)";

const HOSTS: [Host; 4] = [
    (Integrator::RungeKutta4, 2.5e-4),
    (Integrator::RungeKutta4, 1e-3),
    (Integrator::RungeKutta4, 1e-2),
    (Integrator::LongFrame { substeps_max: 4000, delay_frames: 0 }, 5e-2),
];

/// A cylinder around y, or upright, whose middle is at (x, z), on a box with its top at z = 0 and an edge at x = 0.
fn drum(is_upright: bool, (x, z): (f64, f64), speed: f64, friction: &str, host: Host) -> Simulation {
    let end = |at: f64| if is_upright { format!("(0,0,{at:?})") } else { format!("(0,{at:?},0)") };
    let cylinder = format!("Cylinder(name: \"d\", ends: ({},{}), radius: {RADIUS:?})", end(-HALF), end(HALF));
    let across = MASS * (3.0 * RADIUS * RADIUS + 4.0 * HALF * HALF) / 12.0;
    let along = 0.5 * MASS * RADIUS * RADIUS;
    let moments = if is_upright { [across, across, along] } else { [across, along, across] };
    let spin = if friction == "None" { 0.0 } else { speed / RADIUS };
    let body = RigidBody::free("drum", MassProperties::principal(MASS, moments))
        .at(Pose::new(Vec3::new(x, 0.0, z), [1.0, 0.0, 0.0, 0.0]))
        .moving(Twist { linear: Vec3::new(speed, 0.0, 0.0), angular: Vec3::new(0.0, spin, 0.0) });
    let ground = box_polyhedron("b", [-2.0, 0.0, -1.0], [2.0, 1.0, 1.0], "");
    let (mut simulation, _) = on_ground(&cylinder, &ground, K, friction, body, host);
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    simulation.commit_initial_states().unwrap();
    simulation
}

/// Result of a run.
#[derive(Debug)]
struct Run {
    /// Most that the mechanical energy fell below and rose above that of the start, J.
    lost: f64,
    gained: f64,
    /// Angle from the vertical at which the middle has gone around the edge when the last contact ends, rad.
    left_at: f64,
    /// Position and twist at the end.
    position: Vec3,
    twist: Twist,
}

/// Runs a drum for 1.5 s; once it has left the edge it flies: spin and horizontal velocity stay, gravity acts.
fn run(mut simulation: Simulation) -> Run {
    let body = simulation.bodies().next().unwrap().0;
    let (start, step) = (simulation.energy().mechanical(), simulation.step_length());
    let (mut lost, mut gained, mut left_at) = (0.0_f64, 0.0_f64, f64::NAN);
    let mut flown = 0;
    let mut before = simulation.twist(body);
    for _ in 0..(1.5 / step).round() as usize {
        simulation.step().unwrap();
        let (energy, now) = (simulation.energy(), simulation.twist(body));
        lost = lost.max(start - energy.mechanical());
        gained = gained.max(energy.mechanical() - start);
        if simulation.contact_wrench(body).force != Vec3::zeros() {
            let place = simulation.pose(body).position;
            (flown, left_at) = (0, place.x.atan2(place.z));
        } else {
            flown += 1;
        }
        // Of the first frame without contact a part had contact.
        if flown > 2 {
            let by = now.linear - before.linear + Vec3::z() * (G * step);
            assert!(by.norm() < 1e-12 && (now.angular - before.angular).norm() < 1e-12, "{by:?}");
        }
        before = now;
    }
    Run { lost, gained, left_at, position: simulation.pose(body).position, twist: simulation.twist(body) }
}

/// Energy without friction or damping stays but for rounding of second order: at most 300 J/s² times the square of the step,
/// of 20 to 30 J. Steps of 0.25, 1 and 10 ms: 1.3e-8, 4.1e-7 and 5.2e-4 J where the log slides over, 5.6e-7, 2.3e-5 and 0.023 J
/// where the drum topples. With friction it falls, by 0.008 to 0.08 J.
fn energy_is_kept(found: &Run, friction: &str, (integrator, step): Host) {
    // The other integrator holds gravity, too, and so has an energy of first order.
    if integrator == Integrator::RungeKutta4 {
        let most = 300.0 * step * step;
        assert!(found.gained < most && (friction != "None" || found.lost < most), "{step}: {found:?}");
        assert!(found.lost < 0.1, "{step}: {found:?}");
    }
}

/// A log that comes to an edge at the speed v goes around it and leaves at the angle φ at which the edge carries nothing:
/// cos φ = ⅔ + v²/3gR if it slides, 4/7 + 3v²/7gR if it rolls, with the horizontal speed √(gR·cos³φ), rolling with the
/// spin √(g·cos φ/R). Within 2 %: it vibrates on its spring and lies 1 mm deep. In long frames of 20 Hz it leaves with the
/// speeds of 4 kHz to 5e-4.
#[test]
fn a_log_leaves_an_edge_as_a_rigid_one() {
    let start = 0.4_f64;
    let turns = start * start / (G * RADIUS);
    for (friction, cosine) in [("None", (2.0 + turns) / 3.0), (ROLLS, (4.0 + 3.0 * turns) / 7.0)] {
        let speed = (G * RADIUS * cosine.powi(3)).sqrt();
        let spin = if friction == "None" { 0.0 } else { (G * cosine / RADIUS).sqrt() };
        for host in HOSTS {
            let found = run(drum(false, (-0.1, RADIUS - SAG), start, friction, host));
            let Twist { linear, angular } = found.twist;
            println!("{friction:.4} {}: {speed} {spin} {found:?}", host.1);
            energy_is_kept(&found, friction, host);
            // The frames of the other integrator are long.
            let off = found.left_at - cosine.acos();
            assert!(off.abs() < 0.06 || host.0 != Integrator::RungeKutta4, "{}: {off}", host.1);
            assert!((linear.x / speed - 1.0).abs() < 0.02, "{}: {linear:?} {speed}", host.1);
            assert!((angular.y - spin).abs() <= 0.02 * spin + 1e-12, "{}: {angular:?} {spin}", host.1);
        }
    }
}

/// A drum that stands with its middle 0.2·R past the edge topples over it, and the spin and the speed with which it leaves
/// are those of any host: within 3 % of a step of 0.25 ms at 100 Hz, and, held by friction, within 1e-3 at 1 kHz and in long
/// frames of 20 Hz. Without friction a host of 20 Hz is 12 % off.
#[test]
fn a_drum_past_the_middle_topples() {
    for (friction, slowest) in [("None", 0.15), (ROLLS, 1e-3)] {
        let mut exact = None;
        for (host, within) in HOSTS.into_iter().zip([0.0, 1e-3, 0.03, slowest]) {
            let found = run(drum(true, (0.2 * RADIUS, HALF), 0.0, friction, host));
            println!("{friction:.4} {}: {found:?}", host.1);
            energy_is_kept(&found, friction, host);
            let Twist { linear, angular } = found.twist;
            let (speed, spin) = *exact.get_or_insert((linear.x, angular.y));
            assert!((linear.x / speed - 1.0).abs() <= within, "{}: {linear:?} {speed}", host.1);
            assert!((angular.y / spin - 1.0).abs() <= within, "{}: {angular:?} {spin}", host.1);
        }
    }
}

/// A drum whose middle is inside the edge, by 0.2·R and by a hundredth, stays where it stands; pushed to rock, it stands
/// upright again.
#[test]
fn a_drum_that_overhangs_by_less_than_its_middle_stays() {
    for host in HOSTS {
        for inside in [0.2, 0.01] {
            let x = -inside * RADIUS;
            let found = run(drum(true, (x, HALF - SAG), 0.0, ROLLS, host));
            let off = found.position - Vec3::new(x, 0.0, HALF - SAG);
            assert!(off.norm() < 1e-12 && found.twist.angular.norm() < 1e-12, "{}: {found:?}", host.1);
        }
        let found = run(drum(true, (-0.2 * RADIUS, HALF - SAG), 0.03, ROLLS, host));
        println!("{}: {found:?}", host.1);
        energy_is_kept(&found, ROLLS, host);
        let off = found.position - Vec3::new(-0.2 * RADIUS, 0.0, HALF - SAG);
        assert!(off.norm() < 5e-4 && found.twist.angular.norm() < 0.01, "{}: {found:?}", host.1);
    }
}
