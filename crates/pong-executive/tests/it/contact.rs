//! Contact of bodies: executive and engine together.

use crate::common::simulation_of_balls;
use pong_engine::Config;
use pong_executive::{
    BodyId, Integrator, MassProperties, Pose, RigidBody, RunStatistics, Simulation, Twist, Vec3,
};
use pong_testkit::worlds::paired_with_first;

const G: f64 = 9.81;

/// A ball (r 0.1 m, 1 kg) on or above a plane z = 0; k 1e5 N/m of the pair.
fn ball_on_plane(damping: f64, height: f64, integrator: Integrator, step: f64) -> (Simulation, BodyId) {
    ball_of(MassProperties::sphere(1.0, 0.1), (damping, "None"), height, integrator, step)
}

/// As [`ball_on_plane`], with other mass properties and friction.
fn ball_of(
    mass: MassProperties,
    (damping, friction): (f64, &str),
    height: f64,
    integrator: Integrator,
    step: f64,
) -> (Simulation, BodyId) {
    let ball = format!(
        r#"(format: "pong-model", version: 1, name: "ball",
            surfaces: {{ "soft": (stiffness: 1e5, normal: Linear(damping: {damping}), friction: {friction}) }},
            root: (name: "ball", surface: "soft", primitives: [
                Sphere(name: "skin", center: (0.0, 0.0, 0.0), radius: 0.1)]))"#
    );
    let ground = format!(
        r#"(format: "pong-model", version: 1, name: "ground",
            surfaces: {{ "rigid": (stiffness: inf, friction: {friction}) }},
            root: (name: "ground", surface: "rigid", primitives: [
                Plane(name: "floor", normal: (0.0, 0.0, 1.0), offset: 0.0)]))"#
    );
    let config = Config { accounts: integrator.wrench_coupling(), ..Config::default() };
    let (world, _, interfaces) = paired_with_first(config, &[&ball, &ground]);
    let mut simulation = Simulation::new(world, integrator, step).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let pose = Pose::new(Vec3::new(0.0, 0.0, 0.1 + height), [1.0, 0.0, 0.0, 0.0]);
    let ball = RigidBody::free("ball", mass).at(pose);
    let ball = simulation.add_body(ball.touching(interfaces[0])).unwrap();
    simulation.add_body(RigidBody::fixed("ground").touching(interfaces[1])).unwrap();
    (simulation, ball)
}

#[test]
fn v1_a_ball_comes_to_rest_at_its_weight_over_its_stiffness() {
    // Critical damping; after 100 time constants nothing moves.
    for integrator in [Integrator::SemiImplicitEuler, Integrator::RungeKutta4] {
        let (mut simulation, ball) = ball_on_plane(632.4, 0.0, integrator, 1e-3);
        simulation.run_for(0.5).unwrap();
        let depth = simulation.world().contacts()[0].depth;
        assert!((depth / (G / 1e5) - 1.0).abs() < 1e-9, "{integrator:?}: {depth}");
        assert!((simulation.contact_wrench(ball).force.z / G - 1.0).abs() < 1e-9);
        assert!(simulation.twist(ball).linear.norm() < 1e-12);
    }
}

#[test]
fn an_elastic_ball_bounces_to_its_height_and_the_ledger_closes() {
    let (mut simulation, ball) = ball_on_plane(0.0, 0.05, Integrator::RungeKutta4, 2e-5);
    let start = simulation.energy();
    let mut deepest = 0.0_f64;
    let mut energy_error = 0.0_f64;
    for _ in 0..12_000 {
        simulation.step().unwrap();
        deepest = deepest.max(0.1 - simulation.pose(ball).position.z);
        energy_error = energy_error.max((simulation.energy().mechanical() - start.mechanical()).abs());
    }
    // ½kδ² = mg(h + δ).
    let expected = (G + (G * G + 2.0 * 1e5 * G * 0.05).sqrt()) / 1e5;
    assert!((deepest / expected - 1.0).abs() < 1e-4, "{deepest} against {expected}");
    assert!(energy_error < 1e-5 * start.mechanical(), "{energy_error} J of {}", start.mechanical());
    assert!((simulation.energy().balance() / start.balance() - 1.0).abs() < 1e-4);
}

/// Thousands of undamped bounces at a step that is too long for them: the run gains or loses energy, and the
/// reported contact loss is the loss of mechanical energy. The trapezoid rule between commits, of first order
/// at every touch, would give another value.
#[test]
fn what_is_lost_in_contacts_is_what_the_mechanical_energy_lost() {
    let (mut simulation, _) = ball_on_plane(0.0, 0.05, Integrator::RungeKutta4, 1e-3);
    simulation.commit_initial_states().unwrap();
    let start = simulation.energy();
    let mut worst = 0.0_f64;
    for _ in 0..200 {
        simulation.run_for(1.0).unwrap();
        worst = worst.max((simulation.energy().balance() - start.balance()).abs());
    }
    let end = simulation.energy();
    let lost = start.mechanical() - end.mechanical();
    let of_commits = simulation.world().ledger().dissipated;
    println!(
        "lost {lost} J, said {} J, drift {worst} J at worst; by commits alone {of_commits} J",
        end.contact_loss
    );
    assert!((end.contact_loss - lost).abs() < 1e-6 && worst < 1e-6, "{} {lost} {worst}", end.contact_loss);
    assert!((of_commits - lost).abs() > 1e-3, "{of_commits}");
}

/// A body of three different moments of inertia bounces, slips and tumbles: the work of the moments is
/// computed from its spin, to the third order of the step.
#[test]
fn the_work_of_moments_is_taken_from_the_spin() {
    let drift = |step: f64| {
        let mass = MassProperties::principal(1.0, [0.004, 0.006, 0.003]);
        let (mut simulation, ball) =
            ball_of(mass, (200.0, "Bristle(mu: 0.3, damping: 50.0)"), 0.01, Integrator::RungeKutta4, step);
        let twist = Twist { linear: Vec3::new(0.3, -0.2, 0.0), angular: Vec3::new(5.0, -20.0, 8.0) };
        let pose = simulation.pose(ball);
        simulation.set_motion(ball, pose, twist).unwrap();
        simulation.commit_initial_states().unwrap();
        let start = simulation.energy();
        simulation.run_for(0.4).unwrap();
        let end = simulation.energy();
        assert!(end.contact_loss > 0.3 * start.kinetic, "{end:?}");
        (end.balance() - start.balance()).abs()
    };
    let [coarse, fine] = [4e-4, 1e-4].map(drift);
    println!("{coarse} {fine}");
    assert!(coarse < 1e-4 && fine < 0.1 * coarse, "{coarse} then {fine}");
}

/// Rebound of an undamped ball at 1 m/s without gravity, averaged over the phase of touch.
fn mean_rebound(omega_t: f64, delay_frames: u32) -> f64 {
    let frame = omega_t / 1e5_f64.sqrt();
    let phases = 32;
    let mut sum = 0.0;
    for phase in 0..phases {
        let height = frame * (3.0 + f64::from(phase) / f64::from(phases));
        let integrator = Integrator::ZeroOrderHold { substeps: 2, delay_frames };
        let (mut simulation, ball) = ball_on_plane(0.0, height, integrator, frame);
        simulation.set_gravity(Vec3::zeros());
        let pose = simulation.pose(ball);
        simulation.set_motion(ball, pose, Twist { linear: -Vec3::z(), angular: Vec3::zeros() }).unwrap();
        simulation.run_for(frame * (3.2 / omega_t + 10.0 + 2.0 * f64::from(delay_frames)).ceil()).unwrap();
        assert_eq!(simulation.world().contact_count(), 0);
        sum += simulation.twist(ball).linear.z;
    }
    sum / f64::from(phases)
}

#[test]
fn v28_a_held_wrench_gains_energy_as_it_must() {
    for (omega_t, tolerance) in [(0.01, 0.01), (0.1, 0.02)] {
        let expected = (std::f64::consts::PI * omega_t / 4.0).exp();
        let measured = mean_rebound(omega_t, 0);
        assert!((measured - expected).abs() < tolerance * (expected - 1.0), "{measured} against {expected}");
    }
    // n frames late: the spring lags by T/2 + nT.
    let late = mean_rebound(0.01, 2);
    assert!((late.ln() / (std::f64::consts::PI * 0.01 * 1.25) - 1.0).abs() < 0.05, "{late}");
}

#[test]
fn the_same_run_gives_the_same_bits() {
    let end = || {
        let (mut simulation, ball) = ball_on_plane(10.0, 0.02, Integrator::RungeKutta4, 1e-3);
        simulation.run_for(0.4).unwrap();
        (simulation.pose(ball), simulation.twist(ball))
    };
    assert_eq!(end(), end());
}

/// The balance of a host that holds wrenches drifts only by the energy of holding them. A warning about an
/// undamped contact names the damping that it needs; with that damping there is no warning.
#[test]
fn a_host_that_holds_wrenches_is_told_what_that_made() {
    let step = 0.1 / 1e5_f64.sqrt();
    for delay_frames in [0, 1] {
        let needed = 1e5 * step * (0.5 + f64::from(delay_frames));
        for (damping, warnings) in [(0.0, 1), (2.0 * needed, 0)] {
            let integrator = Integrator::ZeroOrderHold { substeps: 1, delay_frames };
            let (mut simulation, _) = ball_on_plane(damping, 0.02, integrator, step);
            simulation.commit_initial_states().unwrap();
            let start = simulation.energy();
            simulation.run_for(0.5).unwrap();
            let end = simulation.energy();
            let drift = end.balance() - start.balance();
            assert!((drift - end.contact_made).abs() < 1e-12, "{drift} {}", end.contact_made);
            let told = simulation.energy_warnings();
            assert_eq!(told.len(), warnings, "{told:?}");
            if let Some(warning) = told.first() {
                assert!(drift > 0.0);
                for part in
                    ["`ball` and `ground`", "gained energy", &format!("c must exceed {needed:.3e} N·s/m")]
                {
                    assert!(warning.contains(part), "no `{part}` in: {warning}");
                }
            }
        }
    }
}

/// A ball that is thrown higher from bounce to bounce is stopped at a hundred times its energy; the error has
/// the contact, the time, and a suitable step.
#[test]
fn a_run_whose_contact_makes_energy_stops_at_once() {
    for integrator in [Integrator::SemiImplicitEuler, Integrator::RungeKutta4] {
        // 3,000 N·s/m on 1 kg is stable to 2.7e-3/3 s.
        let (mut simulation, ball) = ball_on_plane(3e3, 1e-3, integrator, 2e-2);
        let error = (0..20_000).find_map(|_| simulation.step().err()).expect("it diverges").to_string();
        let parts =
            ["body `ball`", "a hundred times", "the contact of `ball` and `ground`", "shorten it below"];
        assert!(parts.iter().all(|part| error.contains(part)), "{integrator}: {error}");
        assert!(simulation.pose(ball).position.norm() < 1e6, "{integrator}");
    }
}

/// Violent but correct runs are not stopped: a lossless drop from 1 km, and a start so deep that the ball
/// leaves at a hundred times any speed before.
#[test]
fn violent_runs_go_on() {
    let (mut simulation, ball) = ball_on_plane(0.0, 1e3, Integrator::RungeKutta4, 1e-4);
    simulation.run_for(16.0).unwrap();
    assert!(simulation.twist(ball).linear.z > 100.0);
    let (mut simulation, ball) = ball_on_plane(0.0, -5.0, Integrator::RungeKutta4, 1e-4);
    simulation.run_for(0.5).unwrap();
    assert!(simulation.twist(ball).linear.z > 1e3);
}

/// Energy ½kδ² of a deep start, compared with that of the motion; no note for a ball at rest on its floor, or
/// one that is let in slowly.
#[test]
fn a_deep_start_is_noted_and_a_rest_is_not() {
    let notes = |height: f64, speed: f64| {
        let (mut simulation, ball) = ball_on_plane(0.0, height, Integrator::RungeKutta4, 1e-4);
        let twist = Twist { linear: Vec3::z() * speed, angular: Vec3::zeros() };
        simulation.set_motion(ball, simulation.pose(ball), twist).unwrap();
        simulation.commit_initial_states().unwrap();
        simulation.start_notes()
    };
    let [note] = &notes(-1e-2, 0.5)[..] else { panic!("one note") };
    // ½·1e5·1e-4 J, ½·1·0.25 J, √(2·5/1) m/s.
    let parts = ["1.000e-2 m deep", "5.000e0 J", "1.250e-1 J", "3.162e0 m/s", "ball", "ground"];
    assert!(parts.iter().all(|part| note.contains(part)), "{note}");
    assert!(notes(-9.81e-5, 0.0).is_empty() && notes(-1.2e-4, 0.0).is_empty(), "it rests");
    assert!(notes(-1e-2, 5.0).is_empty() && notes(1.0, 0.0).is_empty());
}

/// Two balls of one model pass through each other in a step: the warning tells which is which.
#[test]
fn the_warning_of_tunnelling_names_the_objects() {
    let mut simulation = simulation_of_balls(
        r#"(format: "pong-scene", version: 1, name: "pass", models: { "ball": "ball.ron" },
        objects: [
            (name: "still", model: "ball", bodies: [(motion: Fixed)]),
            (name: "fast", model: "ball", bodies: [(motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3),
                position: (0.0, 0.0, 0.5), linear_velocity: (0.0, 0.0, -1000.0))])],
        pairs: [("still", "fast")], integrator: RungeKutta4, step: 1e-3, duration: 1e-3)"#,
    );
    simulation.commit_initial_states().unwrap();
    let mut statistics = RunStatistics::new(&simulation);
    simulation.step().unwrap();
    statistics.observe(&simulation);
    let advice: Vec<_> = statistics.advice().collect();
    assert!(
        advice.len() == 1 && advice[0].contains("first `still/ball/b` through `fast/ball` at 0.001 s"),
        "{advice:?}"
    );
}
