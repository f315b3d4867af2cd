//! Batches: every run is that of a fresh scene, whatever ran before it and on whatever thread.

use crate::common;
use pong_executive::{Pose, Twist, Vec3};
use pong_fit::{Batch, Case, Outcome};
use pong_testkit::random::Random;

const FREE: [&str; 6] = [
    "surface.cube.acrylic.stiffness",
    "surface.cube.acrylic.friction.mu",
    "body.cube.inertia_factor",
    "body.cube.mass",
    "ground.position.z",
    "gravity.z",
];

fn names(names: &[&str]) -> Vec<String> {
    names.iter().map(ToString::to_string).collect()
}

fn times(count: usize, interval: f64) -> Vec<f64> {
    (0..count).map(|k| k as f64 * interval).collect()
}

fn cases(count: u64) -> Vec<Case> {
    let case = |number: u64| {
        let mut random = Random::new(7, 1, number);
        let pose = Pose::new(Vec3::new(0.0, 0.0, random.between(0.09, 0.12)), [0.9, 0.3, 0.3, 0.1]);
        let linear = Vec3::new(random.between(-1.0, 1.0), random.between(-1.0, 1.0), -0.5);
        let values = vec![
            random.log_between(5e3, 2e4),
            random.between(0.1, 0.5),
            random.between(0.8, 1.5),
            random.between(0.3, 0.5),
            random.between(-2e-3, 2e-3),
            -9.81,
        ];
        let twist = Twist { linear, angular: Vec3::new(3.0, random.between(-5.0, 5.0), 0.0) };
        Case { values, starts: vec![Some((pose, twist))], times: times(20, 1.0 / 148.0) }
    };
    (0..count).map(case).collect()
}

fn run(batch: &mut Batch, cases: &[Case]) -> Vec<Outcome> {
    batch.run(cases).into_iter().map(Result::unwrap).collect()
}

#[test]
fn threads_and_earlier_runs_change_no_bit() {
    let scene = common::tossed("threads");
    let cases = cases(40);
    let mut single = Batch::new(&scene, &names(&FREE), 1).unwrap();
    let reference = run(&mut single, &cases);
    assert!(reference.iter().all(|outcome| outcome.peak_force[0] > 1.0), "every cube touches the ground");
    for threads in [2, 3] {
        assert_eq!(run(&mut Batch::new(&scene, &names(&FREE), threads).unwrap(), &cases), reference);
    }
    let backwards: Vec<Case> = cases.iter().rev().cloned().collect();
    let mut again = run(&mut single, &backwards);
    again.reverse();
    assert_eq!(again, reference);
    for (case, expected) in cases.iter().zip(&reference).step_by(13) {
        let mut fresh = Batch::new(&scene, &names(&FREE), 1).unwrap();
        assert_eq!(&run(&mut fresh, std::slice::from_ref(case))[0], expected);
    }
}

#[test]
fn a_batch_gives_the_bits_of_a_simulation() {
    let scene = common::sliding("simulation");
    let mut batch = Batch::new(&scene, &[], 2).unwrap();
    let case = Case { times: times(21, 5e-4 * 8.0), ..Case::default() };
    let cases = [case.clone(), case.clone(), case];
    for outcome in run(&mut batch, &cases) {
        let mut built = scene.build().unwrap();
        let (id, _) = built.simulation.bodies().next().unwrap();
        for row in 0..21 {
            let sample = outcome.samples[2 * row];
            assert_eq!(sample.pose, built.simulation.pose(id), "row {row}");
            assert_eq!(sample.twist, built.simulation.twist(id), "row {row}");
            for _ in 0..8 {
                built.simulation.step().unwrap();
            }
        }
    }
}

#[test]
fn wrenches_on_their_way_end_with_their_run() {
    let mut batch = Batch::new(&common::held("held"), &[], 1).unwrap();
    let case = Case { times: times(40, 5e-4), ..Case::default() };
    let first = run(&mut batch, std::slice::from_ref(&case));
    assert!(first[0].peak_force[0] > 1.0, "the run ends in contact");
    assert_eq!(run(&mut batch, &[case]), first);
}

#[test]
fn samples_between_steps_lie_on_the_motion() {
    let scene = common::bouncing("between");
    let mut batch = Batch::new(&scene, &[], 1).unwrap();
    let times: Vec<f64> = (0..30).map(|k| f64::from(k) * 3.3e-3).collect();
    let outcome = &run(&mut batch, &[Case { times: times.clone(), ..Case::default() }])[0];
    for (row, time) in times.iter().enumerate().filter(|(_, time)| **time < 0.1) {
        let sample = outcome.samples[2 * row];
        let height = 0.15 - 0.5 * 9.81 * time * time;
        assert!((sample.pose.position - Vec3::new(0.3 * time, 0.0, height)).norm() < 1e-12);
        assert!((sample.twist.linear.z + 9.81 * time).abs() < 1e-12);
    }
}

#[test]
fn names_that_lead_nowhere_are_all_told() {
    let scene = common::tossed("names");
    let wrong = [
        ("surface.cube.acrylic.friction.nu", "it has: stiffness, normal.damping"),
        ("surface.cube.steel.stiffness", "begin with one of: surface.cube.acrylic"),
        ("body.cube.weight", "it has: mass, mass_factor"),
        ("body.ball.mass", "name one of: cube, ground"),
        ("body.ground.mass", "is not free"),
        ("gravity.w", "it has: x, y, z"),
        ("spring.0.stiffness.x", "the scene has 0"),
        ("table.position.z", "name one of: cube, ground"),
        ("mass", "it names nothing"),
        ("body.cube.mass", "given twice"),
    ];
    let mut given = names(&wrong.map(|(name, _)| name));
    given.push("body.cube.mass".to_owned());
    let error = Batch::new(&scene, &given, 1).map(|_| ()).unwrap_err().to_string();
    for (name, cure) in wrong {
        let line = error.lines().find(|line| line.contains(&format!("`{name}`")));
        assert!(line.is_some_and(|line| line.contains(cure)), "{name}: {error}");
    }
}

#[test]
fn cases_that_do_not_fit_are_refused_one_by_one() {
    let scene = common::tossed("misfits");
    let mut batch = Batch::new(&scene, &names(&FREE[..2]), 2).unwrap();
    let good = Case { values: vec![1e4, 0.3], times: times(3, 0.01), starts: Vec::new() };
    let cases = [
        good.clone(),
        Case { values: vec![1e4], ..good.clone() },
        Case { times: Vec::new(), ..good.clone() },
        Case { times: vec![0.1, 0.0], ..good.clone() },
        Case { times: vec![0.0, f64::INFINITY], ..good.clone() },
        Case { values: vec![-1.0, 0.3], ..good.clone() },
        Case { starts: vec![None; 3], ..good.clone() },
        good,
    ];
    let results = batch.run(&cases);
    let told: Vec<String> = results
        .iter()
        .map(|result| result.as_ref().map_or_else(ToString::to_string, |_| String::new()))
        .collect();
    assert!(told[0].is_empty() && told[7].is_empty(), "{told:?}");
    for (place, part) in [
        (1, "1 values for 2"),
        (2, "no times"),
        (3, "in order"),
        (4, "far too long"),
        (5, "stiffness"),
        (6, "3 starts"),
    ] {
        assert!(told[place].contains(part), "{told:?}");
    }
    assert_eq!(results[0], results[7], "a refused case leaves nothing behind");
}

#[test]
fn factors_act_after_values_and_axes_are_independent() {
    let scene = common::tossed("factors");
    let all = names(&[
        "body.cube.mass_factor",
        "body.cube.mass",
        "body.cube.inertia.xx",
        "body.cube.inertia_factor",
    ]);
    let mut factors = Batch::new(&scene, &all, 1).unwrap();
    let plain =
        names(&["body.cube.mass", "body.cube.inertia.xx", "body.cube.inertia.yy", "body.cube.inertia.zz"]);
    let mut plain = Batch::new(&scene, &plain, 1).unwrap();
    let case = |values: &[f64]| Case { values: values.to_vec(), times: times(20, 0.01), starts: Vec::new() };
    let one = run(&mut factors, &[case(&[2.0, 0.25, 8e-4, 0.5])]);
    let other = run(&mut plain, &[case(&[0.5, 8e-4, 7e-4, 7e-4])]);
    assert_eq!(one, other);
    assert_eq!(factors.parameters()[1].in_scene, 0.4);
    assert_eq!(factors.parameters()[1].unit, "kg");
}
