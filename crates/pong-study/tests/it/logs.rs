//! Studies of a log, open loop.

use crate::common::{RADIUS, STIFFNESS, ball_scene, row, settings};
use pong_executive::scene::Scene;
use pong_record::{ModelSource, RecordOptions, Recorder};
use pong_study::sweep::{LogAlternative, Quantity, Settings, Study, study_log};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

const STEP: f64 = 1e-3;
const FREQUENCY: f64 = 5.0;
const MEAN: f64 = 1e-3;
const SWING: f64 = 5e-4;

/// A ball that is moved up and down in the ground, without leaving it, with every step in a log of 256
/// frames.
fn logged(test: &str) -> PathBuf {
    let scene = ball_scene(test, (RADIUS - MEAN, 0.0), (STEP, 0.255), "");
    let text = std::fs::read_to_string(&scene).unwrap();
    let moved = format!(
        "motion: Prescribed(Sinusoid(axis: (0.0, 0.0, 1.0), travel: {SWING:?}, frequency: {FREQUENCY:?})),"
    );
    let text = text.replace("motion: Free, mass: 1.0, inertia: Diagonal(4e-3, 4e-3, 4e-3),", &moved);
    std::fs::write(&scene, text.replace(", linear_velocity: (0.0, 0.0, 0.0)", "")).unwrap();
    let mut built = Scene::load(&scene).unwrap().build().unwrap();
    let folder = scene.with_file_name("log");
    let models: Vec<_> = built.model_files.iter().cloned().map(ModelSource::File).collect();
    let world = built.simulation.world();
    let mut log = Recorder::start(world, &folder, &models, &RecordOptions::default()).unwrap();
    built.simulation.commit_initial_states().unwrap();
    for done in 0..=built.steps {
        if done > 0 {
            built.simulation.step().unwrap();
        }
        log.evaluated();
        log.committed();
        log.record(built.simulation.world(), built.simulation.time(), 0, None).unwrap();
    }
    log.finish().unwrap();
    folder
}

fn run(log: &Path, alternatives: &[LogAlternative]) -> Study {
    let settings = Settings { within: 0.05, ..settings(1.0, 3) };
    let output = log.with_file_name("out");
    study_log(log, alternatives, &output, &settings, &mut |_| ControlFlow::Continue(())).unwrap()
}

/// Load at a frame of the log.
fn load(frame: usize) -> f64 {
    let phase = 2.0 * std::f64::consts::PI * FREQUENCY * STEP * frame as f64;
    STIFFNESS * (MEAN - SWING * phase.sin())
}

/// The wrench of every n-th frame is held: its error is known without the engine.
#[test]
fn errors_of_a_held_wrench_are_those_of_the_load() {
    let study = run(&logged("held"), &[]);
    assert_eq!(study.apart, Some(0.0), "the engine gives the wrenches of the log");
    let frames = 256;
    let peak = (0..frames).map(load).fold(0.0, f64::max);
    for (every, name) in [(1, "every frame"), (2, "1 frame of 2"), (4, "1 frame of 4"), (8, "1 frame of 8")] {
        let held = |frame: usize| load(frame - frame % every);
        let squares: f64 = (1..frames).map(|frame| (held(frame) - load(frame)).powi(2)).sum();
        let known = (squares / (frames - 1) as f64).sqrt() / peak;
        let impulse: f64 = (1..frames)
            .map(|k| 0.5 * STEP * (held(k) + held(k - 1) - load(k) - load(k - 1)))
            .sum::<f64>()
            .abs();
        let effort: f64 = (1..frames).map(|k| 0.5 * STEP * (load(k) + load(k - 1))).sum();
        let errors = row(&study, name).answer.errors().unwrap();
        let close = |found: f64, known: f64| (found - known).abs() < 1e-9 + 1e-9 * known;
        assert!(close(errors.of(Quantity::Wrench), known), "{name}: {errors:?} is not {known}");
        assert!(close(errors.of(Quantity::Impulse), impulse / effort), "{name}: {errors:?}");
    }
    assert!(study.of.iter().all(|quantity| !matches!(quantity, Quantity::Energy | Quantity::Pose)));
    let judged: Vec<bool> = study.rows.iter().filter_map(|row| study.same_bits(row)).collect();
    assert!(judged.len() >= 7 && judged.iter().all(|same| *same), "{judged:?}");
}

/// A ball half as stiff has half the force at the same depth.
#[test]
fn an_alternative_is_run_through_the_same_motions() {
    let log = logged("log_alternative");
    let soft = log.with_file_name("soft_ball.ron");
    let alternative = LogAlternative { name: "soft".to_owned(), models: vec![("ball".to_owned(), soft)] };
    let study = run(&log, std::slice::from_ref(&alternative));
    let peak = row(&study, "every frame, `soft`").answer.errors().unwrap().of(Quantity::Peak);
    assert!((peak - 0.5).abs() < 1e-9, "{peak}");
    let unknown = LogAlternative { models: vec![("bell".to_owned(), PathBuf::new())], ..alternative };
    let settings = settings(1.0, 3);
    let told =
        study_log(
            &log,
            &[unknown],
            &log.with_file_name("out"),
            &settings,
            &mut |_| ControlFlow::Continue(()),
        );
    assert!(told.unwrap_err().to_string().contains("no model `bell`"));
}
