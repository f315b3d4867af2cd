//! Recorded hashes of scenes: the answers are the same for any number of workers, any SIMD level and any
//! number of evaluations, after a restore from any frame, with stalling workers, and in every version.
//!
//! A program of its own: `ci/series` builds it with and without optimisation, and it sets the SIMD level and
//! stalls workers for the whole process.

#[allow(dead_code, unused_imports, reason = "these tests use some of it")]
#[path = "it/common/mod.rs"]
mod common;

use common::own_kinds;
use common::scenes::all;
use common::stage::{FrameHash, Scene, Stage, workers};
use pong_engine::{StatusBits, WorkerSettings, has_tester};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::simd::{Level, set_level};
use pong_testkit::{long_samples, samples};
use std::collections::BTreeSet;
use std::sync::OnceLock;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// Hashes of the answers and of the contact state of every scene. They may change only with a change of the
/// physics that the CHANGELOG states.
const KNOWN: [(&str, u64, u64); 9] = [
    ("stations", 0xb1723143342c2d3e, 0xf75f8e5571625ab3),
    ("arms", 0x5827c529e6fd3a14, 0xb7ea8ae0a5fea254),
    ("sheets", 0x4d1bd6ad5ec87e8d, 0xf49dd40082af86b7),
    ("pieces", 0x865925e5af6560ff, 0xa4c533a42923596a),
    ("own_kinds", 0xffb05a545591efcc, 0x80173def935d7baf),
    ("crowd", 0xa6efc9208413bcf4, 0x6900a47b22bdebb9),
    ("bowl", 0x776b53145068c012, 0xf1abfd87a2c723bd),
    ("swarm", 0xd3238414cdd36465, 0x4ab17f5dbf908e74),
    ("round", 0x2ebe1962fd7b863b, 0x83a8d126e46c4d3d),
];

/// A scene run by the caller alone, with the data needed to continue from any frame.
struct Alone {
    scene: Scene,
    series: Vec<FrameHash>,
    /// The contact state after every `SAVED_EVERY`th frame.
    saved: Vec<Vec<u8>>,
}

const SAVED_EVERY: usize = 6;

/// All scenes, each run once.
fn alone() -> &'static [Alone] {
    static ALONE: OnceLock<Vec<Alone>> = OnceLock::new();
    ALONE.get_or_init(|| all().into_iter().map(run_alone).collect())
}

fn run_alone(scene: Scene) -> Alone {
    let mut stage = scene.set_up(None);
    let (mut series, mut saved) = (Vec::new(), Vec::new());
    for frame in 0..scene.frames {
        series.push(stage.step(frame));
        if frame.is_multiple_of(SAVED_EVERY) {
            saved.push(stage.saved());
        }
    }
    drop(stage);
    Alone { scene, series, saved }
}

/// Runs frames and compares each with the caller's own hash.
fn must_repeat(case: &str, alone: &Alone, stage: &mut Stage<'_>, frames: std::ops::Range<usize>) {
    for frame in frames {
        let got = stage.step(frame);
        assert_eq!(got, alone.series[frame], "{case}: {}, frame {frame}", alone.scene.name);
    }
}

/// One hash of a whole series of frames.
fn sum_up(series: &[FrameHash]) -> FrameHash {
    let mut sum = FrameHash::default();
    for frame in series {
        sum.answers.word(frame.answers.0);
        sum.state.word(frame.state.0);
        sum.counts.word(frame.counts.0);
    }
    sum
}

/// Prints the hashes, which `ci/series` compares between builds.
#[test]
fn the_answers_are_those_of_earlier_versions() {
    let mut wrong = Vec::new();
    for (Alone { scene, series, .. }, known) in alone().iter().zip(KNOWN) {
        let sum = sum_up(series);
        println!(
            "series {} answers {:?} state {:?} counts {:?}",
            scene.name, sum.answers, sum.state, sum.counts
        );
        if (scene.name, sum.answers.0, sum.state.0) != known {
            wrong.push(format!("(\"{}\", 0x{:?}, 0x{:?}),", scene.name, sum.answers, sum.state));
        }
    }
    assert!(wrong.is_empty(), "not what earlier versions answered:\n{}", wrong.join("\n"));
}

#[test]
fn any_number_of_workers_gives_the_same_series() {
    for count in [3, 0, 16, 1, 2, 8].into_iter().take(long_samples(3, 6)) {
        for alone in alone() {
            let mut stage = alone.scene.set_up(workers(count));
            let mut shared = 0;
            for frame in 0..alone.scene.frames {
                // Rare and small frames wake no worker, and on a busy machine all frames are rare.
                stage.world.prewake(Duration::from_secs(60));
                must_repeat(&format!("{count} workers"), alone, &mut stage, frame..frame + 1);
                shared += usize::from(stage.world.thread_work().any(|lane| lane.blocks > 0));
            }
            assert_eq!(
                count > 0,
                shared > 0,
                "{count} workers: {}: {shared} frames shared",
                alone.scene.name
            );
        }
    }
}

#[test]
fn any_instructions_give_the_same_series() {
    for level in Level::available() {
        assert_eq!(set_level(level), level);
        for alone in alone() {
            must_repeat(level.name(), alone, &mut alone.scene.set_up(None), 0..alone.scene.frames);
        }
    }
    set_level(Level::Avx512);
}

#[test]
fn resumed_from_any_frame_the_series_is_the_same() {
    for alone in alone() {
        let frames = alone.scene.frames;
        let resume = |stage: &mut Stage<'_>, saved: usize, until: usize| {
            let after = saved * SAVED_EVERY;
            stage.switch(after);
            stage.world.restore_state(&alone.saved[saved]).unwrap();
            must_repeat(&format!("resumed after {after}"), alone, stage, after + 1..until.min(frames));
        };
        // First in one world, back and forth; then in new worlds, with workers and without.
        let mut stage = alone.scene.set_up(workers(2));
        let count = alone.saved.len();
        for step in 0..samples(count) {
            let saved = step * 7 % count;
            resume(&mut stage, saved, saved * SAVED_EVERY + 4);
        }
        for (saved, crew) in [(0, None), (count / 3, workers(3)), (2 * count / 3, None)] {
            resume(&mut alone.scene.set_up(crew), saved, frames);
        }
    }
}

/// Restores a block while a pair is off: neither the world's earlier frames nor the number of workers affect
/// the result.
#[test]
fn what_a_world_did_before_a_restore_does_not_count() {
    let alone = alone().iter().find(|alone| alone.scene.name == "arms").unwrap();
    let saved = 100 / SAVED_EVERY;
    let resumed = |stage: &mut Stage<'_>| {
        for pair in stage.pairs.clone() {
            stage.world.set_pair_enabled(pair, false).unwrap();
        }
        stage.world.restore_state(&alone.saved[saved]).unwrap();
        stage.place(saved * SAVED_EVERY + 1);
        stage.world.evaluate().unwrap();
        stage.finish()
    };
    let mut fresh = alone.scene.set_up(None);
    let mut used = alone.scene.set_up(None);
    (0..40).for_each(|frame| assert_eq!(used.step(frame), alone.series[frame]));
    assert_eq!(resumed(&mut fresh), resumed(&mut used));
}

/// Trial evaluations at other states, and repeated ones at the same states, do not affect the commit.
#[test]
fn evaluated_four_times_a_frame_the_series_is_the_same() {
    for alone in alone() {
        let mut stage = alone.scene.set_up(workers(1));
        for frame in 0..alone.scene.frames.min(long_samples(40, 100)) {
            stage.prepare(frame);
            for trial in [frame + 1, frame + 7, frame, frame] {
                stage.place(trial);
                stage.world.evaluate().unwrap();
            }
            assert_eq!(stage.finish(), alone.series[frame], "{}, frame {frame}", alone.scene.name);
        }
    }
}

#[test]
fn workers_that_stall_do_not_change_the_series() {
    let alone = alone().iter().find(|alone| alone.scene.own_kinds).unwrap();
    let settings =
        workers(3).map(|settings| WorkerSettings { worker_timeout: Duration::from_millis(1), ..settings });
    let mut stage = alone.scene.set_up(settings);
    let before = own_kinds::CALLS_ON_WORKERS.load(Ordering::Relaxed);
    own_kinds::STALL_EVERY.store(301, Ordering::Relaxed);
    must_repeat("stalls", alone, &mut stage, 0..alone.scene.frames);
    own_kinds::STALL_EVERY.store(0, Ordering::Relaxed);
    let calls = own_kinds::CALLS_ON_WORKERS.load(Ordering::Relaxed) - before;
    println!("{calls} calls on workers, every 301st of which stalled");
}

/// The scenes are worth running: they use every tester and reach every limit.
#[test]
fn the_scenes_use_every_tester_and_every_limit() {
    let mut met = BTreeSet::new();
    let (mut limited, mut unshared, mut only_remembered, mut two_rounds) = (0, 0, 0, 0);
    for scene in all() {
        let mut stage = scene.set_up(None);
        let mut most = 0;
        for frame in 0..scene.frames {
            stage.prepare(frame);
            let report = stage.world.step().unwrap();
            let counts = stage.world.counts();
            let testers = counts.testers().filter(|(_, _, tally)| tally.met > 0);
            met.extend(testers.map(|(a, b, _)| (a as usize, b as usize)));
            limited += u32::from(report.status.contains(StatusBits::CONTACT_LIMIT));
            unshared += u32::from(report.status.contains(StatusBits::LOAD_SHARING_LIMIT));
            two_rounds += u32::from(counts.leaf_pairs > 4096);
            most = most.max(report.contacts as usize);
        }
        let peak = stage.world.memory().contacts_peak;
        only_remembered += u32::from(peak > most);
        println!("{}: at most {most} contacts, {peak} remembered", scene.name);
    }
    println!("{limited} frames limited, {unshared} not shared exactly, {two_rounds} in two rounds");
    assert!(limited > 100 && unshared > 10 && two_rounds > 10, "{limited} {unshared} {two_rounds}");
    assert!(only_remembered > 1, "contacts that are only remembered");
    let kinds = PrimitiveKind::ALL;
    for (a, b) in kinds.into_iter().flat_map(|a| kinds.map(|b| (a, b))).filter(|(a, b)| has_tester(*a, *b)) {
        assert!(met.contains(&(a as usize, b as usize)), "{} never touches {}", a.name(), b.name());
    }
    assert!(met.contains(&(PrimitiveKind::Sphere as usize, PrimitiveKind::Custom as usize)));
}
