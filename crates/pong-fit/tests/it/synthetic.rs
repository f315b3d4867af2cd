//! Measurements made by closed forms, or by the engine at known values, with Gaussian noise.

use pong_executive::{Pose, Quat, Twist, Vec3};
use pong_fit::{Batch, Case, Data, Record, Row};
use pong_testkit::random::Random;

/// Noise of position (m), orientation (rad), velocity (m/s) and angular velocity (rad/s).
pub const NOISE: [f64; 4] = [2e-4, 2e-3, 5e-3, 5e-2];

pub fn noise() -> [Option<f64>; 6] {
    [Some(NOISE[0]), Some(NOISE[1]), Some(NOISE[2]), Some(NOISE[3]), None, None]
}

/// A number of the normal distribution (Box and Muller).
pub fn normal(random: &mut Random) -> f64 {
    let radius = (-2.0 * libm::log(1.0 - random.unit())).sqrt();
    radius * libm::cos(std::f64::consts::TAU * random.unit())
}

fn vector(random: &mut Random, deviation: f64) -> Vec3 {
    Vec3::new(normal(random), normal(random), normal(random)) * deviation
}

/// Measurement of a state.
pub fn measured(body: &str, time: usize, pose: &Pose, twist: &Twist, random: &mut Random) -> Row {
    let turn = Quat::from_scaled_axis(vector(random, NOISE[1]));
    Row {
        time,
        body: body.to_owned(),
        position: Some(pose.position + vector(random, NOISE[0])),
        orientation: Some(turn * pose.orientation),
        velocity: Some(twist.linear + vector(random, NOISE[2])),
        angular_velocity: Some(twist.angular + vector(random, NOISE[3])),
        force: None,
        moment: None,
    }
}

/// Records of the first body at known values, from these starts.
pub fn records(
    batch: &mut Batch,
    values: &[f64],
    starts: &[(Pose, Twist)],
    times: &[f64],
    seed: u64,
) -> Data {
    let case = |start: &(Pose, Twist)| Case {
        values: values.to_vec(),
        starts: vec![Some(*start)],
        times: times.to_vec(),
    };
    let cases: Vec<Case> = starts.iter().map(case).collect();
    let body = batch.bodies()[0].clone();
    let width = batch.bodies().len();
    let mut data = Data { noise: noise(), ..Data::default() };
    for (number, outcome) in batch.run(&cases).into_iter().enumerate() {
        let outcome = outcome.unwrap();
        let mut random = Random::new(seed, 5, number as u64);
        let row = |time: usize| {
            let sample = &outcome.samples[width * time];
            measured(&body, time, &sample.pose, &sample.twist, &mut random)
        };
        let rows = (0..times.len()).map(row).collect();
        data.records.push(Record { name: format!("{number}"), times: times.to_vec(), rows });
    }
    data
}

pub fn times(count: usize, interval: f64) -> Vec<f64> {
    (0..count).map(|k| k as f64 * interval).collect()
}

/// Random starts of a cube in the air.
pub fn tosses(count: u64, seed: u64) -> Vec<(Pose, Twist)> {
    let toss = |number| {
        let mut random = Random::new(seed, 6, number);
        let mut between = |low, high| random.between(low, high);
        let orientation = [between(0.2, 1.0), between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)];
        let pose = Pose::new(Vec3::new(0.0, 0.0, between(0.1, 0.12)), orientation);
        let linear = Vec3::new(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, -0.3));
        (
            pose,
            Twist { linear, angular: Vec3::new(between(-6.0, 6.0), between(-6.0, 6.0), between(-6.0, 6.0)) },
        )
    };
    (0..count).map(toss).collect()
}
