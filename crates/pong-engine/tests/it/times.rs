//! Times of a frame by stage, by part of the contact stage, and by thread. The clock of these tests advances
//! by one tick with each reading.

use crate::common::scenes::all;
use crate::common::stage;
use pong_engine::{Stage as Part, Work, WorkTimes, WorkerSettings};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

fn ticks() -> u64 {
    static TICKS: AtomicU64 = AtomicU64::new(0);
    TICKS.fetch_add(1, Ordering::Relaxed)
}

/// A separate clock for a test that compares frames.
fn other_ticks() -> u64 {
    static TICKS: AtomicU64 = AtomicU64::new(0);
    TICKS.fetch_add(1, Ordering::Relaxed)
}

/// Maximum number of worlds to step until workers have taken part in a frame. On a busy machine they come too
/// late for the frames of many worlds.
const WORLDS: usize = 200;

/// Checks that all times are reported and add up.
fn must_add_up(scene: &stage::Scene, workers: Option<WorkerSettings>) {
    let threads = workers.as_ref().map_or(1, |settings| settings.workers + 1);
    let mut whole = WorkTimes::default();
    let (mut on_workers, mut in_parts, mut in_stage) = (0, 0, 0);
    'worlds: for _ in 0..WORLDS {
        let mut stage = scene.set_up(workers.clone());
        stage.world.set_clock(ticks);
        // Not every frame has contacts.
        for frame in 0..scene.frames {
            stage.step(frame);
            let times = stage.world.stage_times();
            let by_thread: Vec<_> = stage.world.thread_times().collect();
            assert_eq!(by_thread.len(), threads);
            for work in Work::ALL {
                let sum: u64 = by_thread.iter().map(|thread| thread.of(work)).sum();
                assert_eq!(sum, times.work.of(work), "{}, {}, frame {frame}", scene.name, work.name());
            }
            whole = if times.work.of(Work::Forces) > whole.of(Work::Forces) { times.work } else { whole };
            on_workers += by_thread[1..].iter().map(WorkTimes::sum).sum::<u64>();
            (in_parts, in_stage) = (in_parts + times.work.sum(), in_stage + times.of(Part::Contacts));
            let all_told = Part::ALL.iter().all(|part| times.of(*part) > 0);
            assert!(all_told, "{}, frame {frame}: {times:?}", scene.name);
            if frame >= 20 && whole.of(Work::Forces) > 0 && (threads == 1 || on_workers > 0) {
                break 'worlds;
            }
        }
    }
    assert!(Work::ALL.iter().all(|work| whole.of(*work) > 0), "{}: {whole:?}", scene.name);
    match threads {
        // One tick per block, at its start, belongs to no part.
        1 => {
            assert!(in_parts <= in_stage && 2 * in_parts > in_stage, "{}: {in_parts} {in_stage}", scene.name)
        }
        _ => assert!(on_workers > 0, "{}: nothing was shared", scene.name),
    }
}

#[test]
fn parts_of_the_work_add_up_over_lanes() {
    // Practically no worker timeout: on a busy machine no frame may fall back to the caller alone.
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

/// Equal frames read the clock equally often, whatever was measured before.
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
