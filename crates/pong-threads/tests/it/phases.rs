//! Every block runs once, for any number of workers and whatever else happens to the pool.

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::SeqCst};
use std::time::Duration;

use crate::common::{Count, patient, start, wait_until};
use pong_threads::{Grant, Job, Outcome, Settings, ThreadWork};

#[test]
fn every_block_runs_once() {
    for workers in [0, 1, 2, 3, 8, 16] {
        let count = Count::new(1000);
        let mut pool = start(&count, &patient(workers));
        assert_eq!(pool.workers(), workers);
        for blocks in [0, 1, 2, 3, 4, 17, 1000].into_iter().cycle().take(700) {
            assert_eq!(pool.run(blocks), Outcome::Complete);
            let expected: Vec<u32> = (0..1000).map(|block| u32::from(block < blocks)).collect();
            assert_eq!(count.take(), expected, "{blocks} blocks, {workers} workers");
            assert_eq!(pool.work().map(|thread| thread.blocks).sum::<u32>(), blocks);
            assert!(pool.is_quiet());
        }
    }
}

#[test]
fn prewake_and_quiesce_at_any_time_change_no_phase() {
    let count = Count::new(5);
    let mut pool = start(&count, &patient(3));
    for turn in 0..600 {
        match turn % 6 {
            0 | 3 => pool.prewake(Duration::from_micros(turn)),
            1 => pool.quiesce(),
            4 => std::thread::sleep(Duration::from_micros(turn)),
            _ => {}
        }
        assert_eq!(pool.run(5), Outcome::Complete);
        assert_eq!(count.take(), [1; 5]);
    }
}

/// Job whose blocks end when as many blocks have begun as there are threads, so each thread must get one.
struct All {
    threads: u32,
    begun: AtomicU32,
}

impl Job for All {
    fn run(&self, _block: u32, _lane: usize) {
        self.begun.fetch_add(1, SeqCst);
        wait_until("all threads have a block", || self.begun.load(SeqCst) >= self.threads);
    }
}

#[test]
fn sleeping_workers_are_woken_as_many_as_there_are_blocks() {
    for workers in [1, 2, 3, 8, 16] {
        let all = Arc::new(All { threads: workers + 1, begun: AtomicU32::new(0) });
        let mut pool = start(&all, &patient(workers as usize));
        for _ in 0..5 {
            pool.quiesce();
            std::thread::sleep(Duration::from_millis(5));
            assert_eq!(pool.run(workers + 1), Outcome::Complete);
            assert!(pool.work().all(|thread| thread.blocks == 1));
            all.begun.store(0, SeqCst);
        }
    }
}

/// Job with blocks long enough for any awake worker to claim one.
struct Slow;

impl Job for Slow {
    fn run(&self, _block: u32, _lane: usize) {
        std::thread::sleep(Duration::from_micros(50));
    }
}

/// A phase for some of the workers is not touched by the others, awake or asleep, and the next phase is for
/// all again.
#[test]
fn a_phase_is_shared_with_no_more_workers_than_it_is_opened_to() {
    let mut pool = start(&Arc::new(Slow), &patient(5));
    for invited in (0..=6).cycle().take(70) {
        pool.prewake(Duration::from_secs(1));
        std::thread::sleep(Duration::from_micros(300));
        let own = &mut |blocks: Range<u32>| blocks.for_each(|block| Slow.run(block, 0));
        assert_eq!(pool.run_beside(24, invited, own), Outcome::Complete);
        let by_lane: Vec<u32> = pool.work().map(|thread| thread.blocks).collect();
        assert_eq!(by_lane.iter().sum::<u32>(), 24, "{invited} of {by_lane:?}");
        assert!(by_lane.iter().skip(1 + invited).all(|&blocks| blocks == 0), "{invited} of {by_lane:?}");
        assert!(pool.is_quiet());
    }
    let all = Arc::new(All { threads: 3, begun: AtomicU32::new(0) });
    let mut pool = start(&all, &patient(5));
    for _ in 0..5 {
        pool.quiesce();
        std::thread::sleep(Duration::from_millis(2));
        let own = &mut |blocks: Range<u32>| blocks.for_each(|block| all.run(block, 0));
        assert_eq!(pool.run_beside(3, 2, own), Outcome::Complete);
        let by_lane: Vec<u32> = pool.work().map(|thread| thread.blocks).collect();
        assert_eq!(by_lane, [1, 1, 1, 0, 0, 0], "the first two of five that sleep are woken");
        all.begun.store(0, SeqCst);
    }
}

#[test]
fn a_pool_of_the_size_of_the_mask_leaves_a_core_to_the_caller() {
    let cores = core_affinity::get_core_ids().unwrap().len();
    let pool = start(&Count::new(0), &Settings { workers: 1000, ..Settings::default() });
    assert_eq!(pool.workers(), (cores - 1).min(pong_threads::MAX_WORKERS));
}

#[test]
fn pinned_workers_tell_their_cores() {
    let count = Count::new(50);
    let mut pool = start(&count, &Settings { pin: true, ..patient(2) });
    for report in pool.start_report() {
        println!("{report}");
    }
    assert_eq!(pool.start_report().iter().map(|worker| worker.thread).collect::<Vec<_>>(), [1, 2]);
    assert!(pool.start_report().iter().all(|worker| worker.core != Grant::NotAsked));
    assert_eq!(pool.run(50), Outcome::Complete);
    assert_eq!(count.take(), [1; 50]);
}

#[test]
fn a_core_that_does_not_exist_is_a_report_and_no_error() {
    let count = Count::new(50);
    let settings = Settings { pin: true, cores: vec![1000], ..patient(1) };
    let mut pool = start(&count, &settings);
    assert!(matches!(pool.start_report()[0].core, Grant::Refused { asked: 1000, .. }));
    assert_eq!(pool.run(50), Outcome::Complete);
    assert_eq!(count.take(), [1; 50]);
}

#[test]
fn busy_time_is_told_by_the_clock_of_the_host() {
    fn one_more() -> u64 {
        static TIME_NS: AtomicU64 = AtomicU64::new(0);
        TIME_NS.fetch_add(1, SeqCst)
    }
    let mut pool = start(&Count::new(40), &Settings { clock: Some(one_more), ..patient(2) });
    assert_eq!(pool.run(40), Outcome::Complete);
    let work: Vec<ThreadWork> = pool.work().collect();
    assert_eq!(work.len(), 3);
    assert!(work.iter().all(|thread| (thread.busy_ns > 0) == (thread.blocks > 0)), "{work:?}");
}

#[test]
#[should_panic(expected = "at most 65535")]
fn too_many_blocks_are_refused() {
    let _ = start(&Count::new(0), &patient(1)).run(pong_threads::MAX_BLOCKS + 1);
}
