//! Where the time of a frame goes: by stage, by part of the contacts' work, by lane. The clock of these tests ticks once
//! whenever it is asked.

use crate::common::scenes::all;
use crate::common::stage;
use pong_engine::{Stage as Part, Work, WorkTimes, WorkerSettings};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

fn ticks() -> u64 {
    static TICKS: AtomicU64 = AtomicU64::new(0);
    TICKS.fetch_add(1, Ordering::Relaxed)
}

/// A clock of its own for a test that compares frames.
fn other_ticks() -> u64 {
    static TICKS: AtomicU64 = AtomicU64::new(0);
    TICKS.fetch_add(1, Ordering::Relaxed)
}

/// So many worlds at most are stepped until workers have had a part in a frame. On a busy machine they come too late for the
/// first frames of many a world, and its trials then find frames quicker alone.
const WORLDS: usize = 200;

/// Everything is told, and it adds up.
fn must_add_up(scene: &stage::Scene, workers: Option<WorkerSettings>) {
    let lanes = workers.as_ref().map_or(1, |settings| settings.workers + 1);
    let mut whole = WorkTimes::default();
    let (mut on_workers, mut in_parts, mut in_stage) = (0, 0, 0);
    'worlds: for _ in 0..WORLDS {
        let mut stage = scene.set_up(workers.clone());
        stage.world.set_clock(ticks);
        // Not every frame has contacts.
        for frame in 0..scene.frames {
            stage.step(frame);
            let times = stage.world.stage_times();
            let by_lane: Vec<_> = stage.world.lane_times().collect();
            assert_eq!(by_lane.len(), lanes);
            for work in Work::ALL {
                let sum: u64 = by_lane.iter().map(|lane| lane.of(work)).sum();
                assert_eq!(sum, times.work.of(work), "{}, {}, frame {frame}", scene.name, work.name());
            }
            whole = if times.work.of(Work::Forces) > whole.of(Work::Forces) { times.work } else { whole };
            on_workers += by_lane[1..].iter().map(WorkTimes::sum).sum::<u64>();
            (in_parts, in_stage) = (in_parts + times.work.sum(), in_stage + times.of(Part::Contacts));
            let all_told = Part::ALL.iter().all(|part| times.of(*part) > 0);
            assert!(all_told, "{}, frame {frame}: {times:?}", scene.name);
            if frame >= 20 && whole.of(Work::Forces) > 0 && (lanes == 1 || on_workers > 0) {
                break 'worlds;
            }
        }
    }
    assert!(Work::ALL.iter().all(|work| whole.of(*work) > 0), "{}: {whole:?}", scene.name);
    match lanes {
        // What is in no part: a tick where each block begins.
        1 => {
            assert!(in_parts <= in_stage && 2 * in_parts > in_stage, "{}: {in_parts} {in_stage}", scene.name)
        }
        _ => assert!(on_workers > 0, "{}: nothing was shared", scene.name),
    }
}

#[test]
fn parts_of_the_work_add_up_over_lanes() {
    // WaitLimit without end: on a busy machine no frame may be done alone for want of it.
    let worker_timeout = Duration::from_secs(60);
    let settings = WorkerSettings {
        workers: 2,
        oversubscribe: true,
        worker_timeout,
        spin: worker_timeout,
        ..WorkerSettings::default()
    };
    for scene in all().iter().filter(|scene| ["stations", "crowd"].contains(&scene.name)) {
        must_add_up(scene, None);
        must_add_up(scene, Some(settings.clone()));
    }
}

/// The same frame asks the clock as often, whatever was measured before.
#[test]
fn every_frame_begins_at_nothing() {
    let scene = all().into_iter().find(|scene| scene.name == "stations").unwrap();
    let mut stage = scene.set_up(None);
    stage.world.set_clock(other_ticks);
    stage.place(0);
    let told: Vec<_> = (0..3)
        .map(|_| {
            stage.world.evaluate().unwrap();
            stage.world.stage_times()
        })
        .collect();
    assert_eq!(told[0].work, told[1].work);
    assert_eq!(told[1], told[2]);
}
