//! Errors of a study against errors computed independently.

use crate::common::{GRAVITY, RADIUS, STIFFNESS, ball_scene, row, run, settings};
use pong_study::sweep::{Lever, Quantity, Settings};

/// Depth less the depth at rest, and its rate.
type State = [f64; 2];

/// One step of a method.
type Method = fn(State, f64) -> State;

/// ω² of a ball of 1 kg.
const SQUARE: f64 = STIFFNESS;
/// Depth at rest.
const REST: f64 = GRAVITY / STIFFNESS;
/// Amplitude at which the ball never leaves the ground, even though a held wrench makes it swing wider.
const AMPLITUDE: f64 = 0.1 * REST;

fn euler([y, v]: State, h: f64) -> State {
    let v = v - h * SQUARE * y;
    [y + h * v, v]
}

/// exp(hM) to the fourth order, M = (0 1; −ω² 0).
fn runge_kutta([y, v]: State, h: f64) -> State {
    let z = SQUARE * h * h;
    let (even, odd) = (1.0 - z / 2.0 + z * z / 24.0, h * (1.0 - z / 6.0));
    [even * y + odd * v, even * v - SQUARE * odd * y]
}

fn held([y, v]: State, h: f64) -> State {
    [y + h * v - 0.5 * SQUARE * h * h * y, v - SQUARE * h * y]
}

/// Errors of a method on the oscillator: wrench, peak, pose.
fn expected(method: Method, h: f64, steps: usize) -> [f64; 3] {
    let omega = SQUARE.sqrt();
    let (mut state, mut squares, mut peak) = ([AMPLITUDE, 0.0], 0.0, AMPLITUDE);
    for step in 1..=steps {
        state = method(state, h);
        let exact = AMPLITUDE * (omega * h * step as f64).cos();
        squares += (STIFFNESS * (state[0] - exact)).powi(2);
        peak = state[0].max(peak);
    }
    let exact = AMPLITUDE * (omega * h * steps as f64).cos();
    let load = STIFFNESS * (REST + AMPLITUDE);
    let travel = 2.0 * AMPLITUDE;
    [
        (squares / steps as f64).sqrt() / load,
        STIFFNESS * (peak - AMPLITUDE) / load,
        (state[0] - exact).abs() / travel,
    ]
}

/// A ball swings on the ground without leaving it: a linear oscillator, on which every method is a known
/// matrix.
#[test]
fn errors_on_an_oscillator_are_those_of_each_method() {
    let scene = ball_scene("oscillator", (RADIUS - REST - AMPLITUDE, 0.0), (1e-4, 0.0512), "");
    let study = run(&scene, &Settings { within: 0.01, ..settings(4e-4, 3) });
    assert!(study.converged, "{:?}", study.reference);
    let methods: [(&str, Method); 3] = [("Euler", euler), ("RK4", runge_kutta), ("hold/1", held)];
    for (name, method) in methods {
        for (step, h) in [("400 µs", 4e-4), ("200 µs", 2e-4), ("100 µs", 1e-4), ("50 µs", 5e-5)] {
            let steps = (0.0512_f64 / h).round() as usize;
            let row = row(&study, &format!("{name}, {step}"));
            let found = row.answer.errors().unwrap();
            let quantities = [Quantity::Wrench, Quantity::Peak, Quantity::Pose];
            for (quantity, known) in quantities.into_iter().zip(expected(method, h, steps)) {
                let off = (found.of(quantity) - known).abs();
                let allowed =
                    2e-3 * known + 2.0 * study.reference.as_ref().unwrap().of(quantity).error + 1e-9;
                assert!(off <= allowed, "{name} {step} {quantity:?}: {} is not {known}", found.of(quantity));
            }
        }
        let order = order(&study, name);
        let wanted = if name == "RK4" { 4.0 } else { 1.0 };
        assert!((order - wanted).abs() < 0.15, "{name}: order {order}");
    }
    let order = study.reference.as_ref().unwrap().of(Quantity::Wrench).order.unwrap();
    assert!((order - 4.0).abs() < 0.1, "the reference sees order {order}");
}

/// Order of convergence from the two shortest steps.
fn order(study: &pong_study::sweep::Study, name: &str) -> f64 {
    let error =
        |step: &str| row(study, &format!("{name}, {step}")).answer.errors().unwrap().of(Quantity::Wrench);
    (error("100 µs") / error("50 µs")).log2()
}

/// Height of an undamped ball at a time after its release from a height.
fn bounce(height: f64, time: f64) -> f64 {
    let fall = (2.0 * (height - RADIUS) / GRAVITY).sqrt();
    let (speed, omega) = (GRAVITY * fall, SQUARE.sqrt());
    // In contact: depth = REST + (speed/ω)·sin − REST·cos.
    let depth = |t: f64| REST + speed / omega * (omega * t).sin() - REST * (omega * t).cos();
    let contact = 2.0 * (std::f64::consts::PI - (speed / (omega * REST)).atan()) / omega;
    match time {
        t if t < fall => height - 0.5 * GRAVITY * t * t,
        t if t < fall + contact => RADIUS - depth(t - fall),
        t => {
            let flight = t - fall - contact;
            RADIUS + speed * flight - 0.5 * GRAVITY * flight * flight
        }
    }
}

/// A ball bounces once. Its final position with semi-implicit Euler is computed here step by step, the true
/// one by formula.
#[test]
fn errors_of_a_bounce_are_those_of_the_closed_form() {
    let (height, duration) = (0.12, 0.1024);
    let scene = ball_scene("bounce", (height, 0.0), (1e-4, duration), "");
    let study = run(&scene, &Settings { within: 0.05, ..settings(8e-4, 3) });
    assert!(study.converged, "{:?}", study.reference);
    let exact = bounce(height, duration);
    for (step, h) in [("800 µs", 8e-4), ("400 µs", 4e-4), ("200 µs", 2e-4), ("100 µs", 1e-4)] {
        let (mut z, mut v) = (height, 0.0);
        for _ in 0..(duration / h).round() as usize {
            v += h * (STIFFNESS * (RADIUS - z).max(0.0) - GRAVITY);
            z += h * v;
        }
        let found = row(&study, &format!("Euler, {step}")).answer.errors().unwrap().position_m;
        let known = (z - exact).abs();
        // Error of the reference in m, for a travel of a few centimetres.
        let reference = 0.05 * study.reference.as_ref().unwrap().of(Quantity::Pose).error;
        assert!(
            (found - known).abs() <= 2.0 * reference + 1e-3 * known,
            "{step}: {found} m is not {known} m"
        );
    }
}

/// A ball on springs half as stiff: the load at rest is the same, and it swings √½ as fast.
#[test]
fn an_alternative_has_the_errors_of_its_model() {
    let more = r#"alternatives: [(name: "soft", models: { "ball": "soft_ball.ron" })],"#;
    let scene = ball_scene("alternative", (RADIUS - REST - AMPLITUDE, 0.0), (1e-4, 0.0512), more);
    let study = run(&scene, &Settings { within: 0.01, ..settings(4e-4, 3) });
    let found = row(&study, "RK4, 100 µs, `soft`").answer.errors().unwrap().of(Quantity::Wrench);
    // The soft ball starts above its rest, and does not leave the ground: y'' = −½ω²·y about a rest twice as
    // deep.
    let (stiff, soft) = (SQUARE.sqrt(), (0.5 * SQUARE).sqrt());
    let start = REST + AMPLITUDE - 2.0 * REST;
    let steps = 512;
    let squares = (1..=steps).map(|step| {
        let t = 1e-4 * f64::from(step);
        let forces = [
            STIFFNESS * (REST + AMPLITUDE * (stiff * t).cos()),
            0.5 * STIFFNESS * (2.0 * REST + start * (soft * t).cos()),
        ];
        (forces[0] - forces[1]).powi(2)
    });
    let known = (squares.sum::<f64>() / f64::from(steps)).sqrt() / (STIFFNESS * (REST + AMPLITUDE));
    assert!((found / known - 1.0).abs() < 1e-3, "{found} is not {known}");
    let rigid = row(&study, "RK4, 100 µs, no friction").answer.errors().unwrap();
    assert_eq!(rigid, row(&study, "RK4, 100 µs").answer.errors().unwrap(), "nothing rubs here");
}

/// A bounce of 10 ms in frames of 20 ms: the impulse of a long frame is right, that of a held wrench is not.
#[test]
fn long_frames_are_levels_on_request() {
    let scene = ball_scene("long_frames", (RADIUS + 0.0125, -0.5), (1e-4, 0.08), "");
    let mut settings = settings(0.02, 2);
    settings.plan.levers = vec![Lever::Step, Lever::Integrator, Lever::LongFrame];
    let study = run(&scene, &settings);
    let error = |name: &str| row(&study, name).answer.errors().map(|errors| errors.of(Quantity::Impulse));
    for step in ["20 ms", "10 ms", "5 ms"] {
        let long = error(&format!("long, {step}")).unwrap();
        assert!(long < 0.1, "{step}: {long}");
    }
    assert!(error("Euler, 20 ms").is_none_or(|error| error > 0.5));
    assert!(!Lever::usual().contains(&Lever::LongFrame));
}
