//! Workers in trouble: too many of them, stalls, panics, the end of a world. The answers are always the same,
//! and every frame returns.
//!
//! A program of its own: beside the threads of other tests its workers may never come in time.

#[allow(dead_code, unused_imports, reason = "these tests use some of it")]
#[path = "it/common/mod.rs"]
mod common;

use common::own_kinds::on_a_worker;
use common::stage::Hash;
use common::{at, load, model, surface};
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use pong_model::Extensions;
use pong_testkit::Random;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, mpsc};
use std::time::{Duration, Instant};

/// Behaviour of the test law on workers.
#[derive(Debug, Default)]
struct Trap {
    /// While set, a worker that enters the law stays there.
    holds: AtomicBool,
    /// Number of workers held now.
    held: AtomicU32,
    /// Maximum number of workers held at once; 0 means no limit.
    at_most: AtomicU32,
    panics_on_workers: AtomicBool,
    panics_on_caller: AtomicBool,
    /// The caller waits in its first contact until a worker has computed one.
    caller_waits: AtomicBool,
    pressed_by_workers: AtomicU32,
}

impl Trap {
    fn visit(&self) {
        if on_a_worker() { self.visit_of_worker() } else { self.visit_of_caller() }
    }

    fn visit_of_worker(&self) {
        self.pressed_by_workers.fetch_add(1, Ordering::SeqCst);
        assert!(!self.panics_on_workers.load(Ordering::SeqCst), "the law fails on a worker");
        if !self.holds.load(Ordering::SeqCst) {
            return;
        }
        let most = self.at_most.load(Ordering::SeqCst);
        if self.held.fetch_add(1, Ordering::SeqCst) < most || most == 0 {
            while self.holds.load(Ordering::SeqCst) {
                std::thread::sleep(Duration::from_micros(200));
            }
        }
        self.held.fetch_sub(1, Ordering::SeqCst);
    }

    fn visit_of_caller(&self) {
        assert!(!self.panics_on_caller.load(Ordering::SeqCst), "the law fails on the caller");
        // The wait is limited: in a frame that is not shared, for example because all workers sleep, no
        // worker computes a contact. The tests then try the next frame, and fail if no worker comes in many.
        let started = Instant::now();
        while self.caller_waits.load(Ordering::SeqCst)
            && self.pressed_by_workers.load(Ordering::SeqCst) == 0
            && started.elapsed() < Duration::from_millis(500)
        {
            std::thread::sleep(Duration::from_micros(50));
        }
        self.caller_waits.store(false, Ordering::SeqCst);
    }

    /// Makes the caller wait for a worker in the next frame, so that one takes part.
    fn wait_for_a_worker(&self) {
        self.pressed_by_workers.store(0, Ordering::SeqCst);
        self.caller_waits.store(true, Ordering::SeqCst);
    }
}

#[derive(Debug)]
struct Trapped(Arc<Trap>);

impl NormalForce for Trapped {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        self.0.visit();
        1e4 * input.depth
    }

    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        5e3 * input.depth * input.depth
    }
}

/// A brush of many points on a plane, with a trap as its law.
struct Brush {
    world: World,
    model: ModelId,
    brush: InterfaceId,
    trap: Arc<Trap>,
    report: SealReport,
}

/// A part that the brush does not touch.
const POST: &str =
    "(name: \"post\", bound: Sphere, primitives: [Sphere(name: \"top\", center: (9,9,9), radius: 0.1)])";

impl Brush {
    fn new(workers: Option<WorkerSettings>) -> Self {
        let trap = Arc::new(Trap::default());
        let mut laws = Laws::default();
        laws.add_normal("trapped", Arc::new(Trapped(Arc::clone(&trap))));
        let config = Config { contact_capacity: Some(3000), ledger: true, workers, ..Config::default() };
        let mut builder = WorldBuilder::with_extensions(config, Extensions::new(), laws);
        let rest = "normal: Custom(name: \"trapped\", parameters: []), friction: Bristle(mu: 0.5)";
        let own = surface(1e4, rest);
        let mut random = Random(21);
        let points: Vec<_> = (0..2400)
            .map(|index| {
                let p = random.vector(0.5);
                format!("Point(name: \"p{index}\", position: ({:?},{:?},{:?}))", p.x, p.y, 0.01 * p.z)
            })
            .collect();
        let plane = "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)";
        // In groups below the root, whose volumes are tested for every block.
        let floor = model("floor", &own, plane).replace(
            &format!("primitives: [ {plane} ]"),
            &format!("groups: [{POST}, (name: \"slab\", primitives: [{plane}])]"),
        );
        let models =
            [load(&mut builder, &model("brush", &own, &points.join(","))), load(&mut builder, &floor)];
        let objects = [(models[0], "brush"), (models[1], "floor")];
        let [brush, floor] = objects.map(|(model, name)| builder.create_object(model, name).unwrap());
        builder.pair(brush, floor).unwrap();
        let (mut world, report) = builder.seal().unwrap();
        let [brush, floor] = [brush, floor].map(|object| world.scene().interface(object, "").unwrap());
        world.set_state(floor, &State::identity()).unwrap();
        Self { world, model: models[0], brush, trap, report }
    }

    fn place(&mut self, frame: u32) {
        let x = 1e-3 * f64::from(frame);
        let depth = 2e-3 + 1e-4 * f64::from(frame % 7);
        self.world.set_state(self.brush, &at(Vec3::new(x, 0.5 * x, -depth), Quat::identity())).unwrap();
    }

    /// Steps a frame and hashes its answers.
    fn step(&mut self, frame: u32) -> Hash {
        self.place(frame);
        let report = self.world.step().unwrap();
        assert!(report.contacts > 1000, "{report:?}");
        let mut hash = Hash::default();
        hash.wrench(&self.world.wrench(self.brush).unwrap());
        self.world.contacts_iter().for_each(|contact| hash.contact(&contact));
        let counts = self.world.counts();
        [counts.volumes_tested(), counts.primitives_tested(), counts.leaf_pairs, counts.boxes_tested]
            .into_iter()
            .for_each(|count| hash.word(count));
        let mut block = vec![0; self.world.state_size()];
        self.world.save_state(&mut block).unwrap();
        hash.bytes(&block);
        hash
    }

    /// Number of blocks of the last phase that workers ran.
    fn blocks_of_workers(&self) -> u32 {
        self.world.thread_work().skip(1).map(|thread| thread.blocks).sum()
    }

    /// Steps and compares frames until a worker takes part; returns the index of the next frame.
    fn until_a_worker_takes_part(&mut self, expected: &[Hash], from: usize) -> usize {
        for (frame, expected) in expected.iter().enumerate().skip(from) {
            self.trap.wait_for_a_worker();
            assert_eq!(self.step(frame as u32), *expected, "frame {frame}");
            if self.blocks_of_workers() > 0 {
                return frame + 1;
            }
            std::thread::sleep(Duration::from_millis(2));
        }
        panic!("no worker took part in {} frames", expected.len() - from);
    }
}

fn settings(workers: usize, worker_timeout: Duration) -> Option<WorkerSettings> {
    Some(WorkerSettings { workers, oversubscribe: true, worker_timeout, ..WorkerSettings::default() })
}

const SHORT: Duration = Duration::from_millis(1);
const LONG: Duration = Duration::from_secs(30);

/// Answers of the caller alone.
fn alone(frames: u32) -> Vec<Hash> {
    let mut brush = Brush::new(None);
    (0..frames).map(|frame| brush.step(frame)).collect()
}

/// These tests run one at a time: with a dozen workers of other tests, none may come in time.
fn one_at_a_time() -> MutexGuard<'static, ()> {
    static ONE: Mutex<()> = Mutex::new(());
    ONE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs a test that must not hang; on a timeout it fails and ends the process.
fn within_a_minute(test: impl FnOnce() + Send + 'static) {
    let _one = one_at_a_time();
    let (done, wait) = mpsc::channel();
    let thread = std::thread::spawn(move || {
        test();
        let _ = done.send(());
    });
    match wait.recv_timeout(Duration::from_secs(60)) {
        Ok(()) | Err(mpsc::RecvTimeoutError::Disconnected) => {
            thread.join().unwrap_or_else(|payload| std::panic::resume_unwind(payload));
        }
        Err(mpsc::RecvTimeoutError::Timeout) => panic!("it hangs"),
    }
}

#[test]
fn more_workers_than_cores_change_nothing() {
    within_a_minute(|| {
        let expected = alone(40);
        for count in [4, 16, 64] {
            let mut brush = Brush::new(settings(count, SHORT));
            assert_eq!(brush.world.thread_work().count(), count + 1);
            for (frame, expected) in expected.iter().enumerate() {
                assert_eq!(brush.step(frame as u32), *expected, "{count} workers, frame {frame}");
            }
        }
    });
}

#[test]
fn a_crew_of_none_is_the_caller_alone() {
    within_a_minute(|| {
        let expected = alone(5);
        let mut brush = Brush::new(settings(0, SHORT));
        assert!(brush.report.workers.is_empty());
        brush.world.prewake(SHORT);
        brush.world.quiesce();
        for (frame, expected) in expected.iter().enumerate() {
            assert_eq!(brush.step(frame as u32), *expected);
        }
        assert_eq!(brush.blocks_of_workers(), 0);
    });
}

/// A worker is held in a block: this frame and the next ones return; once released, the worker works again.
#[test]
fn a_held_worker_stops_no_frame_and_is_used_again() {
    within_a_minute(|| {
        let expected = alone(400);
        for count in [1, 3] {
            let mut brush = Brush::new(settings(count, SHORT));
            brush.trap.at_most.store(1, Ordering::SeqCst);
            brush.trap.holds.store(true, Ordering::SeqCst);
            let mut frame = 0;
            while brush.trap.held.load(Ordering::SeqCst) == 0 {
                brush.trap.wait_for_a_worker();
                assert_eq!(brush.step(frame as u32), expected[frame], "frame {frame}, on the way");
                frame += 1;
            }
            for _ in 0..30 {
                assert_eq!(brush.step(frame as u32), expected[frame], "frame {frame}, held");
                frame += 1;
            }
            assert!(brush.trap.held.load(Ordering::SeqCst) > 0, "the worker is held all the time");
            brush.trap.holds.store(false, Ordering::SeqCst);
            while brush.trap.held.load(Ordering::SeqCst) > 0 {
                std::thread::sleep(Duration::from_micros(200));
            }
            let frame = brush.until_a_worker_takes_part(&expected, frame);
            for (frame, expected) in expected.iter().enumerate().skip(frame).take(20) {
                assert_eq!(brush.step(frame as u32), *expected, "frame {frame}, free again");
            }
        }
    });
}

/// The contact state that a held worker reads is never written, although history is cleared, restored and
/// committed meanwhile.
#[test]
fn contact_state_changes_around_a_held_worker() {
    within_a_minute(|| {
        let mut held = Brush::new(settings(2, SHORT));
        let mut free = Brush::new(None);
        held.trap.holds.store(true, Ordering::SeqCst);
        let mut frame = 0;
        while held.trap.held.load(Ordering::SeqCst) == 0 {
            held.trap.wait_for_a_worker();
            assert_eq!(held.step(frame), free.step(frame));
            frame += 1;
        }
        let mut blocks = [&held.world, &free.world].map(|world| vec![0; world.state_size()]);
        for round in 0..20 {
            for (brush, block) in [&mut held, &mut free].into_iter().zip(&mut blocks) {
                let object = brush.world.scene().object("brush").unwrap();
                match round % 4 {
                    0 => brush.world.save_state(block).unwrap(),
                    1 => brush.world.clear_contact_history(object).unwrap(),
                    2 => brush.world.restore_state(block).unwrap(),
                    _ => {
                        let mut surface = brush.world.surface(brush.model, "s").unwrap().clone();
                        surface.stiffness *= 1.01;
                        brush.world.set_surface(brush.model, &surface).unwrap();
                    }
                }
            }
            assert_eq!(held.step(frame), free.step(frame), "round {round}");
            frame += 1;
        }
        held.trap.holds.store(false, Ordering::SeqCst);
    });
}

#[test]
fn a_panic_on_a_worker_is_the_callers_panic() {
    within_a_minute(|| {
        let expected = alone(60);
        let mut brush = Brush::new(settings(1, LONG));
        let mut frame = brush.until_a_worker_takes_part(&expected, 0);
        brush.trap.panics_on_workers.store(true, Ordering::SeqCst);
        let outcome = loop {
            brush.trap.wait_for_a_worker();
            brush.place(frame as u32);
            match catch_unwind(AssertUnwindSafe(|| brush.world.evaluate())) {
                Ok(report) => {
                    report.unwrap();
                    brush.world.commit().unwrap();
                    frame += 1;
                    assert!(frame < 40, "no worker took part");
                }
                Err(payload) => break payload,
            }
        };
        let message = outcome.downcast_ref::<&str>().map(|text| (*text).to_owned());
        let message = message.or_else(|| outcome.downcast_ref::<String>().cloned()).unwrap();
        assert!(message.contains("fails on a worker"), "{message}");
        // The frame can be repeated, and the series continues.
        brush.trap.panics_on_workers.store(false, Ordering::SeqCst);
        assert_eq!(brush.step(frame as u32), expected[frame]);
        brush.until_a_worker_takes_part(&expected, frame + 1);
    });
}

/// A panic in the law leaves the world as it was before the frame, with workers and without.
#[test]
fn a_panic_on_the_caller_leaves_the_world_usable() {
    within_a_minute(|| {
        let expected = alone(8);
        for workers in [None, settings(2, LONG)] {
            let mut brush = Brush::new(workers);
            for frame in 0..4 {
                assert_eq!(brush.step(frame), expected[frame as usize]);
            }
            let mut block = vec![0; brush.world.state_size()];
            brush.world.save_state(&mut block).unwrap();
            brush.place(4);
            brush.trap.panics_on_caller.store(true, Ordering::SeqCst);
            assert!(catch_unwind(AssertUnwindSafe(|| brush.world.evaluate())).is_err());
            brush.trap.panics_on_caller.store(false, Ordering::SeqCst);
            assert!(!brush.world.is_evaluated());
            // Contact state can still be changed, more than once.
            let object = brush.world.scene().object("brush").unwrap();
            for _ in 0..3 {
                brush.world.clear_contact_history(object).unwrap();
                brush.world.restore_state(&block).unwrap();
            }
            for frame in 4..8 {
                assert_eq!(brush.step(frame), expected[frame as usize], "frame {frame}");
            }
        }
    });
}

#[test]
fn a_world_ends_while_a_worker_is_held() {
    within_a_minute(|| {
        let mut brush = Brush::new(settings(2, SHORT));
        let trap = Arc::clone(&brush.trap);
        trap.holds.store(true, Ordering::SeqCst);
        let mut frame = 0;
        while trap.held.load(Ordering::SeqCst) == 0 {
            trap.wait_for_a_worker();
            brush.step(frame);
            frame += 1;
        }
        drop(brush);
        assert!(trap.held.load(Ordering::SeqCst) > 0, "the world did not wait for the worker");
        // The worker still reads the world's memory, and releases it when it comes back.
        trap.holds.store(false, Ordering::SeqCst);
        let started = Instant::now();
        while Arc::strong_count(&trap) > 1 {
            assert!(started.elapsed() < Duration::from_secs(20), "the world's memory is never given back");
            std::thread::sleep(Duration::from_millis(1));
        }
    });
}

#[test]
fn waking_and_resting_around_frames_change_nothing() {
    within_a_minute(|| {
        let expected = alone(60);
        let mut brush = Brush::new(settings(2, SHORT));
        for (frame, expected) in expected.iter().enumerate() {
            match frame % 5 {
                0 => brush.world.prewake(Duration::from_millis(2)),
                1 => brush.world.quiesce(),
                2 => {
                    brush.world.quiesce();
                    brush.world.prewake(Duration::ZERO);
                }
                3 => std::thread::sleep(Duration::from_micros(300)),
                _ => {}
            }
            assert_eq!(brush.step(frame as u32), *expected, "frame {frame}");
        }
        brush.until_a_worker_takes_part(&alone(200), expected.len());
    });
}

#[test]
fn sealing_tells_how_the_workers_started() {
    within_a_minute(|| {
        assert!(Brush::new(None).report.workers.is_empty());
        let brush = Brush::new(settings(3, SHORT));
        let threads: Vec<_> = brush.report.workers.iter().map(|start| start.thread).collect();
        assert_eq!(threads, [1, 2, 3]);
        for start in &brush.report.workers {
            assert!(start.to_string().contains("not asked for"), "{start}");
        }
        // Whatever this machine grants, pinning and priority are reported, and the answers are the same.
        let wanted = settings(2, SHORT).map(|settings| WorkerSettings {
            pin: true,
            fifo_priority: Some(10),
            ..settings
        });
        let mut brush = Brush::new(wanted);
        assert_eq!(brush.report.workers.len(), 2);
        for start in &brush.report.workers {
            assert!(!start.to_string().contains("not asked for"), "{start}");
        }
        for (frame, expected) in alone(10).into_iter().enumerate() {
            assert_eq!(brush.step(frame as u32), expected);
        }
    });
}
