//! After the seal, no frame allocates or frees memory, for any contacts, any host calls, and with limits
//! exceeded or not.
//!
//! A program of its own: it counts the calls of the process's allocator.

#[allow(dead_code, unused_imports, reason = "these tests use some of it")]
#[path = "../it/common/mod.rs"]
mod common;
mod heap;
mod pay_for_use;
mod registered;
mod scene;
mod solids;

use heap::{counted, during, helpers, my_turn};
use pong_engine::{Config, NormalForce, NormalInput, WorkerSettings, has_tester};
use pong_geometry::primitive::PrimitiveKind;
use pong_testkit::long_samples;
use registered::Cubic;
use scene::{Bench, Seen};
use std::collections::BTreeSet;
use std::sync::{Arc, Barrier};

const CUSTOM: PrimitiveKind = PrimitiveKind::Custom;

/// Pairs in the tester table, and the pair of kinds registered here.
fn pairs_of_kinds() -> BTreeSet<(usize, usize)> {
    use PrimitiveKind::*;
    let kinds = [Point, LineSegment, Ray, Sphere, Ellipsoid, Triangle, Polyhedron, Plane, CUSTOM];
    let all = kinds.iter().flat_map(|a| kinds.iter().map(move |b| (*a, *b)));
    let tested = all.filter(|(a, b)| has_tester(*a, *b) || (*a, *b) == (Point, CUSTOM));
    tested.map(|(a, b)| (a as usize, b as usize)).collect()
}

/// Checks that every pair of kinds touched in some frames and was apart in others.
fn assert_worth_counting(seen: &Seen) {
    for (a, b) in pairs_of_kinds() {
        let touches = seen.touches[a][b];
        assert!(
            0 < touches && touches < seen.frames,
            "kinds {a} and {b} touched in {touches} of {}",
            seen.frames
        );
    }
    assert!(0 < seen.empty && seen.empty < seen.frames, "{} empty frames", seen.empty);
}

/// Runs this many frames; returns the allocator calls meanwhile.
fn run(config: Config, frames: u32) -> (Bench, Vec<(&'static str, usize)>) {
    let mut bench = Bench::new(config);
    let calls = counted(|| bench.frames(0..frames));
    (bench, calls)
}

/// Frames of one run.
fn frames() -> u32 {
    long_samples(30_000, 100_000) as u32
}

#[test]
fn the_counter_sees_this_thread_and_those_that_evaluate_a_law() {
    let _turn = my_turn();
    let allocate = || drop(std::hint::black_box(Box::new(1)));
    assert_eq!(counted(|| during("step", allocate)), [("step", 2)]);
    // The other thread allocates before and after it evaluates the law.
    let turns = Arc::new(Barrier::new(2));
    let worker = std::thread::spawn({
        let turns = Arc::clone(&turns);
        move || {
            turns.wait();
            allocate();
            Cubic.force(&NormalInput { depth: 1.0, rate: 0.0, stiffness: 1.0, parameters: &[1.0] });
            allocate();
            turns.wait();
            // A thread that ends frees memory; let it end after the count.
            turns.wait();
        }
    });
    let both_turns = || {
        turns.wait();
        turns.wait();
    };
    assert_eq!(counted(both_turns), [("between the calls", 2)]);
    turns.wait();
    worker.join().unwrap();
}

#[test]
fn no_frame_allocates() {
    let _turn = my_turn();
    let (bench, calls) = run(Config::default(), frames());
    assert_eq!(calls, []);
    assert_worth_counting(&bench.seen);
    assert_eq!(bench.seen.limited, 0);
}

#[test]
fn no_frame_with_the_ledger_allocates() {
    let _turn = my_turn();
    let (bench, calls) = run(Config { ledger: true, ..Config::default() }, frames());
    assert_eq!(calls, []);
    assert_worth_counting(&bench.seen);
    assert_ne!(bench.world.ledger().work, 0.0);
}

#[test]
fn no_frame_that_hits_a_limit_allocates() {
    let _turn = my_turn();
    let config = Config { ledger: true, contact_capacity: Some(4), ..Config::default() };
    let (bench, calls) = run(config, frames());
    assert_eq!(calls, []);
    assert_eq!(bench.seen.most_contacts, 4);
    assert!(0 < bench.seen.limited && bench.seen.limited < bench.seen.frames, "{}", bench.seen.limited);
}

/// More workers than this machine may have cores, and a short worker timeout: some workers are late, and some
/// phases are abandoned.
#[test]
fn no_frame_with_workers_allocates() {
    let _turn = my_turn();
    for workers in [1, 3] {
        let worker_timeout = std::time::Duration::from_micros(100);
        // Keeps workers awake between the frames; a worker that has to be woken comes too late for such short
        // frames.
        let spin = std::time::Duration::from_millis(1);
        let settings = WorkerSettings {
            workers,
            oversubscribe: true,
            spin,
            worker_timeout,
            ..WorkerSettings::default()
        };
        let config = Config { ledger: true, workers: Some(settings), ..Config::default() };
        // Fewer have no frame without a contact.
        let (bench, calls) = run(config, (frames() / 10).max(1000));
        assert_eq!(calls, []);
        assert_worth_counting(&bench.seen);
        let helpers = helpers();
        assert!(
            bench.seen.shared > 0 && (1..=workers).contains(&helpers),
            "{helpers} helped, {} shared",
            bench.seen.shared
        );
    }
}

#[test]
#[ignore = "ten times as long"]
fn no_frame_of_a_million_allocates() {
    let _turn = my_turn();
    for contact_capacity in [None, Some(4)] {
        let config = Config { ledger: true, contact_capacity, ..Config::default() };
        let (bench, calls) = run(config, 1_000_000);
        assert_eq!(calls, []);
        assert_eq!(bench.seen.limited > 0, contact_capacity.is_some());
    }
}
