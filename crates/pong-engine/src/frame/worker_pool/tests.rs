//! Tests of workers that need private access: frames with and without a worker, and a worker that starts too
//! late.

use super::*;
use crate::frame::{EvaluationBuffers, FrameContact};
use crate::runtime::Runtime;
use crate::scene::Config;
use crate::{InterfaceId, State, World, WorldBuilder};
use std::time::Duration;

/// A grid of points in a plane on a floor, with optional rays down to it; below is a gate that moves on its
/// own.
fn brush(config: Config, rays: usize) -> Brush {
    let mut builder = WorldBuilder::new(config);
    let at = |i: usize| ((i % 50) as f64, (i / 50) as f64);
    let points = (0..2000).map(|i| {
        let (x, y) = at(i);
        format!("Point(name: \"p{i}\", position: ({x:?}, {y:?}, 0.0))")
    });
    let rays = (0..rays).map(|i| {
        let (x, y) = at(i);
        format!("Ray(name: \"r{i}\", origin: ({x:?}, {y:?}, 0.5), direction: (0, 0, -1), length: 1.0)")
    });
    let primitives = points.chain(rays).collect::<Vec<_>>().join(",");
    let plane = |name: &str| format!("primitives: [Plane(name: \"{name}\", normal: (0, 0, 1), offset: 0.0)]");
    let floor = format!(
        "groups: [(name: \"floor\", {}), (name: \"gate\", movable: true, {})]",
        plane("f"),
        plane("g")
    );
    let roots = [format!("primitives: [{primitives}]"), floor];
    let objects = roots.map(|root| {
        let text = format!(
            "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{\"s\": (stiffness: 1e4, \
             normal: Linear(damping: 10.0), friction: Bristle(mu: 0.3))}}, \
             root: (name: \"root\", surface: \"s\", {root}))"
        );
        let model = pong_model::parse(&text, "m", None, builder.scene().extensions()).unwrap();
        let model = builder.add_model(Arc::new(model));
        builder.create_object(model, &format!("o{}", root.len())).unwrap()
    });
    builder.pair(objects[0], objects[1]).unwrap();
    let (world, _) = builder.seal().unwrap();
    let [brush, floor] = objects.map(|object| world.scene().interface(object, "").unwrap());
    let gate = world.scene().interface(objects[1], "gate").unwrap();
    let mut brush = Brush { world, brush };
    brush.world.set_state(floor, &State::identity()).unwrap();
    brush.world.set_state(gate, &State { position: [0.0, 0.0, -0.01], ..State::identity() }).unwrap();
    brush.put([0.0, 0.0, -1e-3], 0.0);
    brush
}

fn config(workers: Option<Settings>) -> Config {
    Config { workers, contact_capacity: Some(4096), ..Config::default() }
}

struct Brush {
    world: World,
    brush: InterfaceId,
}

impl Brush {
    /// Places the brush, tilted about y by a small angle, rad.
    fn put(&mut self, position: [f64; 3], tilt: f64) {
        let half = 0.5 * tilt;
        let orientation = [(1.0 - half * half).sqrt(), 0.0, half, 0.0];
        self.world.set_state(self.brush, &State { position, orientation, ..State::identity() }).unwrap();
    }
}

fn one_worker() -> Settings {
    let worker_timeout = Duration::from_millis(1);
    Settings { workers: 1, oversubscribe: true, worker_timeout, ..Settings::default() }
}

/// Shares the blocks of the last round again, and abandons the round after the worker has claimed blocks and
/// before it has started them. Returns true if the round was abandoned.
fn leave_a_worker_behind(pool: &mut WorkerPool) -> bool {
    let shared = Arc::clone(&pool.shared);
    let held = shared.lent.write().unwrap_or_else(PoisonError::into_inner);
    pool.pool.prewake(Duration::from_millis(100));
    // Give the worker time to claim blocks while the caller waits.
    let wait = &mut |_| std::thread::sleep(Duration::from_micros(200));
    let outcome = pool.pool.run_beside(held.input.blocks.len() as u32, 1, wait);
    drop(held);
    outcome == Outcome::Abandoned
}

#[test]
fn blocks_of_a_round_that_was_given_up_are_not_run_in_the_next() {
    let mut world = brush(config(Some(one_worker())), 0).world;
    let mut expected = 0;
    while world.runtime_mut().pool.as_ref().unwrap().shared.lent.read().unwrap().input.blocks.is_empty() {
        world.prewake(Duration::from_millis(100));
        expected = world.step().unwrap().contacts as usize;
    }
    let Runtime { pool, frame, memory, .. } = world.runtime_mut();
    let (pool, input, caller) = (pool.as_mut().unwrap(), &mut frame.input, &mut frame.caller);
    // Repeat the shared round.
    input.blocks.clone_from(&pool.shared.lent.read().unwrap().input.blocks);
    let mut behind = 0;
    for round in 0..40 {
        behind += usize::from(leave_a_worker_behind(pool));
        input.phase += 1;
        caller.out.begin(input.phase);
        if pool.run_parallel(memory, (input, 1), caller, &mut []) {
            assert_eq!(caller.out.contacts.len(), expected, "round {round}");
        }
    }
    assert!(behind > 0, "the worker never came too late");
}

/// Costs above the threshold for waking workers, and below it, where workers must be awake.
#[test]
fn as_many_workers_are_asked_as_there_is_work_for() {
    let mut world = brush(config(Some(Settings { workers: 40, ..one_worker() })), 0).world;
    let pool = world.runtime_mut().pool.as_mut().unwrap();
    let much = WORTH_WAKING_NS + WORTH_A_WORKER_NS / 2;
    assert_eq!(pool.worth_asking(0, 100, much), 15);
    assert_eq!(pool.worth_asking(0, 100, 20 * much), 40);
    // Existing contacts add to the cost; a single block cannot be shared.
    assert_eq!(pool.worth_asking(100, 100, much), 20);
    assert_eq!(pool.worth_asking(100, 1, much), 0);
    pool.prewake(Duration::from_secs(60));
    while !pool.pool.has_workers_at_hand() {
        std::thread::yield_now();
    }
    assert_eq!([0, 1, 2, 3].map(|k| pool.worth_asking(0, 100, k * WORTH_A_WORKER_NS)), [0, 0, 2, 3]);
    assert_eq!(pool.worth_asking(0, 100, WORTH_SHARING_NS), 1);
    assert_eq!(pool.worth_asking(0, 100, WORTH_SHARING_NS - 1), 0);
}

/// Sleeping workers are woken before the blocks are laid out, if the last round was worth it.
#[test]
fn a_long_round_wakes_the_workers_of_the_next_before_it_is_laid_out() {
    let spin = Duration::from_nanos(100);
    let mut world = brush(config(Some(Settings { spin, ..one_worker() })), 0).world;
    let pool = world.runtime_mut().pool.as_mut().unwrap();
    for (cost_ns, wakes) in [(WORTH_WAKING_NS - 1, false), (WORTH_WAKING_NS, true)] {
        pool.quiesce();
        while pool.pool.has_awake_workers() {}
        pool.worth_asking(0, 100, cost_ns);
        // The worker may wake up and fall asleep between two looks.
        let woken = (0..200).any(|_| {
            pool.begin_frame();
            (0..20).any(|_| {
                std::thread::sleep(Duration::from_micros(1));
                pool.pool.has_awake_workers()
            })
        });
        assert_eq!(woken, wakes, "{cost_ns} ns");
    }
    // The host's wake-up time is not shortened.
    pool.prewake(Duration::from_secs(60));
    while !pool.pool.has_awake_workers() {}
    pool.begin_frame();
    std::thread::sleep(Duration::from_millis(20));
    assert!(pool.pool.has_awake_workers());
}

/// The brush slides and tilts, so that contacts end and begin, and bristles stretch and slip. Compares frames
/// in which a worker took part with frames of the caller alone.
fn compare(change: impl Fn(Config) -> Config, rays: usize) -> SharedFrames {
    let [mut alone, mut shared] =
        [None, Some(one_worker())].map(|workers| brush(change(config(workers)), rays));
    // Run until a worker has taken part often enough; it may have to wait for a core.
    let (mut frame, mut shared_frames) = (0, SharedFrames::default());
    while shared_frames.by_worker < 50 {
        assert!(frame < 20_000, "a worker had a part in few of {frame} frames: {shared_frames:?}");
        frame += 1;
        let t = f64::from(frame);
        for brush in [&mut alone, &mut shared] {
            brush.put([2e-4 * t, 1e-4 * t, -1e-3], 1e-5 * (t % 30.0 - 15.0));
            brush.world.prewake(Duration::from_millis(100));
            brush.world.step().unwrap();
        }
        let [expected, found] = [&mut alone, &mut shared].map(|brush| brush.world.runtime_mut());
        assert!(found.memory.records == expected.memory.records, "frame {frame}");
        assert_eq!(found.frame.wrenches, expected.frame.wrenches, "frame {frame}");
        let reported = |frame: &EvaluationBuffers| -> Vec<String> {
            let values = |contact: &FrameContact| (contact.point_b, contact.force(), contact.sticks);
            frame.contacts().pushing().map(|contact| format!("{:?}", values(contact))).collect()
        };
        assert!(reported(&found.frame) == reported(&expected.frame), "frame {frame}");
        assert_eq!(found.frame.caller.out.counts, expected.frame.caller.out.counts, "frame {frame}");
        if found.thread_work().nth(1).is_some_and(|thread| thread.blocks > 0) {
            shared_frames.by_worker += 1;
            shared_frames.swapped +=
                u32::from(found.frame.workers.iter().any(|worker| worker.holds_a_phase()));
        }
    }
    shared_frames
}

/// Counts of frames.
#[derive(Debug, Default)]
struct SharedFrames {
    /// A worker ran some of the blocks.
    by_worker: u32,
    /// The worker's buffer was swapped in: the round was not abandoned, and there was room.
    swapped: u32,
}

#[test]
fn frames_with_a_worker_equal_frames_of_the_caller() {
    let shared = compare(|config| config, 0);
    assert!(shared.swapped > 0, "{shared:?}");
}

/// A ray hits the nearer of the floor and the gate below it.
#[test]
fn first_ray_hits_are_the_same_with_a_worker() {
    assert_eq!(compare(|config| config, 400).swapped, 0);
}

/// The capacity is less than half of the contacts.
#[test]
fn the_same_contacts_are_left_out_with_a_worker() {
    let shared = compare(|config| Config { contact_capacity: Some(900), ..config }, 0);
    assert!(shared.swapped < shared.by_worker, "in no frame any was left out");
}

#[test]
fn the_ledger_is_the_same_with_a_worker() {
    let shared = compare(|config| Config { ledger: true, ..config }, 0);
    assert_eq!(shared.swapped, 0);
}
