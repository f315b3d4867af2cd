//! Known parameters found again: from closed forms, and from the engine's own motion with noise.

use crate::common;
use crate::synthetic::{self, measured, noise, records, times, tosses};
use pong_executive::scene::Scene;
use pong_executive::{Pose, Twist, Vec3};
use pong_fit::{Batch, Data, Fit, Free, Record, Settings, Starts, fit};
use pong_testkit::random::Random;
use std::ops::ControlFlow;

fn free(name: &str, low: f64, high: f64) -> Free {
    Free { name: name.to_owned(), bounds: Some((low, high)) }
}

fn run(scene: &Scene, data: &Data, settings: &Settings) -> Fit {
    fit(scene, data, settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn near(fit: &Fit, place: usize, truth: f64, relative: f64) {
    let one = &fit.parameters[place];
    assert!(
        (one.value / truth - 1.0).abs() < relative,
        "{}: {} beside {truth}: {fit:#?}",
        one.name,
        one.value
    );
}

/// Height and velocity of a ball of 1 kg and 0.1 m above a spring-damper, by the closed form of each phase.
fn bounce(times: &[f64], k: f64, c: f64) -> Vec<(f64, f64)> {
    const G: f64 = 9.81;
    let (mut from, mut z, mut v, mut touching) = (0.0, 0.15, 0.0, false);
    let state = |touching: bool, z: f64, v: f64, t: f64| {
        if !touching {
            return (z + v * t - 0.5 * G * t * t, v - G * t);
        }
        // δ = 0.1 − z: δ'' = g − k·δ − c·δ', about its rest g/k.
        let (damping, delta, rate) = (0.5 * c, 0.1 - z - G / k, -v);
        let omega = (k - damping * damping).sqrt();
        let b = (rate + damping * delta) / omega;
        let (decay, cosine, sine) = (libm::exp(-damping * t), libm::cos(omega * t), libm::sin(omega * t));
        let now = decay * (delta * cosine + b * sine);
        let speed = decay * ((b * omega - damping * delta) * cosine - (delta * omega + damping * b) * sine);
        (0.1 - (now + G / k), -speed)
    };
    // Negative before the end of a phase. In contact the force is positive; in flight there is a gap, or, after
    // the damper has let go, a depth without force.
    let end = |touching: bool, (z, v): (f64, f64)| {
        let (depth, force) = (0.1 - z, k * (0.1 - z) - c * v);
        if touching {
            -force
        } else if depth < 0.0 {
            depth
        } else {
            force
        }
    };
    let mut result = Vec::new();
    for time in times {
        loop {
            let mut step = 1e-5;
            while from + step < *time && end(touching, state(touching, z, v, step)) < 0.0 {
                step += 1e-5;
            }
            if from + step >= *time {
                break;
            }
            let (mut low, mut high) = (step - 1e-5, step);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if end(touching, state(touching, z, v, middle)) < 0.0 { low = middle } else { high = middle }
            }
            (z, v) = state(touching, z, v, high);
            from += high;
            touching = !touching;
        }
        result.push(state(touching, z, v, time - from));
    }
    result
}

#[test]
fn stiffness_and_damping_of_a_bouncing_ball_are_found_from_its_closed_form() {
    let scene = common::bouncing("bouncing");
    let times = times(120, 2e-3);
    let (k, c) = (1.4e4, 31.0);
    let mut data = Data { noise: noise(), ..Data::default() };
    for number in 0..4 {
        let mut random = Random::new(11, 0, number);
        let row = |(time, (z, v)): (usize, (f64, f64))| {
            let pose = Pose { position: Vec3::new(0.0, 0.0, z), ..Pose::identity() };
            measured(
                "ball",
                time,
                &pose,
                &Twist { linear: Vec3::new(0.0, 0.0, v), angular: Vec3::zeros() },
                &mut random,
            )
        };
        let rows = bounce(&times, k, c).into_iter().enumerate().map(row).collect();
        data.records.push(Record { name: format!("{number}"), times: times.clone(), rows });
    }
    let settings = Settings {
        free: vec![
            free("surface.ball.rubber.stiffness", 1e3, 1e5),
            free("surface.ball.rubber.normal.damping", 1.0, 300.0),
        ],
        test: 0.25,
        tries: 6,
        ..Settings::default()
    };
    let fit = run(&scene, &data, &settings);
    near(&fit, 0, k, 0.01);
    near(&fit, 1, c, 0.01);
    // Steps resolve the jump of the damping at the touch to c·v·h: an error of the model of up to 1 %, which the
    // intervals, from the noise alone, do not cover.
    for one in &fit.parameters {
        let (low, high) = one.profile.unwrap();
        assert!(low < one.value && one.value < high && high / low < 1.02, "{fit:#?}");
    }
    assert!((0.9..1.3).contains(&fit.test[1].weighted), "{:?}", fit.test);
    assert!(fit.test[0].weighted > 3.0 * fit.test[1].weighted, "the scene's own values are worse: {fit:#?}");
    let only = "exclude another reading of its orientations";
    assert!(fit.converged && fit.notes.iter().all(|note| note.contains(only)), "{:?}", fit.notes);
}

#[test]
fn friction_of_a_sliding_block_is_found_from_its_closed_form() {
    let scene = common::sliding("slides");
    let (mu, speed, times) = (0.23, 1.0, times(60, 5e-3));
    let mut random = Random::new(12, 0, 0);
    let row = |(number, time): (usize, &f64)| {
        let stop = speed / (mu * 9.81);
        let t = time.min(stop);
        let pose = Pose {
            position: Vec3::new(speed * t - 0.5 * mu * 9.81 * t * t, 0.0, 0.0499019),
            ..Pose::identity()
        };
        let twist = Twist { linear: Vec3::new(speed - mu * 9.81 * t, 0.0, 0.0), angular: Vec3::zeros() };
        measured("cube", number, &pose, &twist, &mut random)
    };
    let rows = times.iter().enumerate().map(row).collect();
    let record = Record { name: "slide".to_owned(), times: times.clone(), rows };
    let data = Data { records: vec![record], noise: noise(), ..Data::default() };
    let settings = Settings {
        free: vec![free("surface.cube.acrylic.friction.mu", 0.02, 1.0)],
        tries: 4,
        ..Settings::default()
    };
    let fit = run(&scene, &data, &settings);
    near(&fit, 0, mu, 0.01);
    assert!(fit.split_in_time && fit.test[1].records == 1, "one record is split in time");
    assert!(fit.parameters[0].bootstrap.is_none(), "one record cannot be drawn from");
    assert!(fit.to_paste[0].contains("friction: Bristle(mu: 0.2"), "{:?}", fit.to_paste);
}

const CUBE: [(&str, f64, f64, f64); 4] = [
    ("surface.cube.acrylic.stiffness", 1.3e4, 2e3, 1e5),
    ("surface.cube.acrylic.normal.damping", 24.0, 2.0, 300.0),
    ("surface.cube.acrylic.friction.mu", 0.21, 0.02, 1.0),
    ("body.cube.inertia_factor", 1.4, 0.7, 2.0),
];

fn tossed(scene: &Scene, count: u64) -> (Data, Settings) {
    let names: Vec<String> = CUBE.iter().map(|(name, ..)| (*name).to_owned()).collect();
    let mut batch = Batch::new(scene, &names, 2).unwrap();
    let truth = CUBE.map(|(_, truth, ..)| truth);
    let data = records(&mut batch, &truth, &tosses(count, 3), &times(16, 1.0 / 148.0), 8);
    let free = CUBE.iter().map(|(name, _, low, high)| free(name, *low, *high)).collect();
    (data, Settings { free, tries: 4, starts: Starts::Fitted, ..Settings::default() })
}

#[test]
fn law_and_inertia_of_a_tossed_cube_are_found_and_threads_change_no_bit() {
    let scene = common::tossed("cube");
    let (data, settings) = tossed(&scene, 10);
    let two = run(&scene, &data, &Settings { threads: 2, ..settings.clone() });
    for (place, (_, truth, ..)) in CUBE.iter().enumerate() {
        let one = &two.parameters[place];
        let (low, high) = one.profile.unwrap();
        let slack = 0.5 * (high - low);
        assert!(
            low - slack < *truth && *truth < high + slack,
            "{}: {low} to {high} beside {truth}",
            one.name
        );
        assert!(high / low < 1.6, "{}: {low} to {high}", one.name);
    }
    assert!((0.85..1.15).contains(&two.test[1].weighted), "{:?}", two.test);
    let short = Settings { profiles: false, tries: 1, iterations: 3, horizon: Some(0.06), ..settings };
    let once = run(&scene, &data, &Settings { threads: 1, ..short.clone() });
    for threads in [2, 3] {
        assert_eq!(run(&scene, &data, &Settings { threads, ..short.clone() }), once);
    }
}

/// Counts of synthetic logs in whose 95 % intervals the true values of damping and friction lie.
#[derive(Debug, Default)]
struct Covered {
    profile: [u64; 2],
    curvature: [u64; 2],
    bootstrap: [u64; 2],
}

/// Numbers of the logs for coverages: COUNT or FIRST..END in `PONG_FIT_LOGS`; each number is the seed of its log.
fn logs() -> std::ops::Range<u64> {
    let text = std::env::var("PONG_FIT_LOGS").unwrap_or_else(|_| "1000".to_owned());
    let (first, end) = text.split_once("..").unwrap_or(("0", &text));
    let number = |text: &str| text.parse().expect("PONG_FIT_LOGS is COUNT or FIRST..END");
    number(first)..number(end)
}

/// Synthetic logs of a ball.
struct Logs {
    name: &'static str,
    /// Number of records of a log.
    records: u64,
    /// Relative standard deviation of damping and friction from record to record.
    scatter: f64,
    /// Known starts, or starts that are measured as all else and fitted.
    starts: Starts,
    profiles: bool,
}

/// Fits the logs, and counts those whose intervals have the true values.
fn covered(logs_of: &Logs) -> Covered {
    let scene = common::ramped(logs_of.name);
    let names = ["surface.ball.rubber.normal.damping", "surface.ball.rubber.friction.mu"];
    let truth = [25.0, 0.3];
    let names: Vec<String> = names.iter().map(ToString::to_string).collect();
    let mut batch = Batch::new(&scene, &names, 2).unwrap();
    let mut covered = Covered::default();
    for log in logs() {
        let start = |number: u64| {
            let mut random = Random::new(log, 9, number);
            let pose = Pose { position: Vec3::new(0.0, 0.0, 0.105), ..Pose::identity() };
            let linear = Vec3::new(random.between(1.0, 2.0), 0.0, random.between(-1.5, -0.5));
            (pose, Twist { linear, angular: Vec3::new(0.0, random.between(-10.0, 10.0), 0.0) })
        };
        let mut data = Data { noise: noise(), ..Data::default() };
        for number in 0..logs_of.records {
            let mut random = Random::new(log, 10, number);
            let values = truth.map(|truth| truth * (1.0 + logs_of.scatter * synthetic::normal(&mut random)));
            let (start, seed) = (start(number), 1000 * log + number);
            let mut record =
                records(&mut batch, &values, &[start], &synthetic::times(10, 4e-3), seed).records.remove(0);
            record.name = format!("{number}");
            if logs_of.starts == Starts::Measured {
                let (pose, twist) = start;
                let row = &mut record.rows[0];
                (row.position, row.orientation) = (Some(pose.position), Some(pose.orientation));
                (row.velocity, row.angular_velocity) = (Some(twist.linear), Some(twist.angular));
            }
            data.records.push(record);
        }
        let free = vec![free(&names[0], 2.0, 200.0), free(&names[1], 0.05, 1.0)];
        let (starts, profiles) = (logs_of.starts, logs_of.profiles);
        let settings =
            Settings { free, tries: 1, test: 0.0, threads: 2, starts, profiles, ..Settings::default() };
        let fit = run(&scene, &data, &settings);
        for (place, truth) in truth.iter().enumerate() {
            let holds = |(low, high): (f64, f64)| low <= *truth && *truth <= high;
            let one = &fit.parameters[place];
            covered.profile[place] += u64::from(one.profile.is_some_and(holds));
            covered.curvature[place] += u64::from(holds(one.linear));
            covered.bootstrap[place] += u64::from(one.bootstrap.is_some_and(holds));
        }
        if log % 50 == 49 {
            eprintln!("{} logs: {covered:?}", log + 1);
        }
    }
    covered
}

/// True if a count of logs is 93 to 97 % of all.
fn honest(count: u64) -> bool {
    (0.93..=0.97).contains(&(count as f64 / logs().count() as f64))
}

#[test]
#[ignore = "takes many minutes; run it once after a change of the intervals"]
fn intervals_cover_the_truth_in_95_of_100_logs() {
    let logs = Logs { name: "coverage", records: 4, scatter: 0.0, starts: Starts::Fitted, profiles: true };
    let found = covered(&logs);
    assert!(found.profile.into_iter().all(honest), "{found:?}");
}

#[test]
#[ignore = "takes minutes; run it once after a change of the intervals"]
fn bootstrap_intervals_cover_the_truth_in_95_of_100_logs() {
    let logs =
        Logs { name: "coverage_noise", records: 12, scatter: 0.0, starts: Starts::Measured, profiles: false };
    let found = covered(&logs);
    assert!(found.bootstrap.into_iter().all(honest), "{found:?}");
}

/// The true values are those about which the values of the records scatter.
#[test]
#[ignore = "takes minutes; run it once after a change of the intervals"]
fn bootstrap_intervals_cover_where_records_differ() {
    let logs = Logs {
        name: "coverage_scatter",
        records: 12,
        scatter: 0.1,
        starts: Starts::Measured,
        profiles: false,
    };
    let found = covered(&logs);
    assert!(found.bootstrap.into_iter().all(honest), "{found:?}");
}
