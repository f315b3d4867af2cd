//! A world with bodies that arrive, slide and leave, and a folder for its log.

use pong_engine::{Config, InterfaceId, ObjectId, PairId, State, World, WorldBuilder};
use pong_model::Extensions;
use pong_record::{ModelSource, RecordOptions, Recorder};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

pub const CART: &str = r#"(format: "pong-model", version: 1, name: "cart", surfaces: {
    "rubber": (stiffness: 1e4, normal: Linear(damping: 12.3), friction: Bristle(mu: 0.5, damping: 7.0))},
    root: (name: "cart", surface: "rubber", groups: [
        (name: "wheels", primitives: [Sphere(name: "front", center: (0.3, 0, 0), radius: 0.1),
            Sphere(name: "rear", center: (-0.3, 0, 0), radius: 0.1)]),
        (name: "arm", movable: true, primitives: [Sphere(name: "tip", center: (0, 0, -0.1), radius: 0.01)])]))"#;
const GROUND: &str = r#"(format: "pong-model", version: 1, name: "ground", surfaces: {"stone": (stiffness: inf, friction: Bristle(mu: 0.6))},
    root: (name: "ground", surface: "stone", primitives: [TriangleMesh(name: "floor", file: "floor.obj")]))"#;
const FLOOR: &str = "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3\nf 1 3 4\n";

pub struct Scene {
    pub world: World,
    pub bodies: Vec<InterfaceId>,
    pub cart: ObjectId,
    pub pair: PairId,
    pub sources: Vec<ModelSource>,
}

/// An empty folder of the test's own.
pub fn folder(test: &str) -> PathBuf {
    pong_testkit::scratch(env!("CARGO_TARGET_TMPDIR"), test)
}

/// Writes model files to `folder/given`, and makes the world.
pub fn scene(folder: &Path) -> Scene {
    scene_with(folder, CART, &[])
}

/// [`scene`] with groups of a cart kept apart from the ground.
pub fn scene_with(folder: &Path, cart_text: &str, apart: &[&str]) -> Scene {
    let given = folder.join("given");
    std::fs::create_dir_all(&given).unwrap();
    std::fs::write(given.join("ground.ron"), GROUND).unwrap();
    std::fs::write(given.join("floor.obj"), FLOOR).unwrap();
    let ext = Extensions::new();
    let mut builder = WorldBuilder::new(Config { contact_capacity: Some(64), ..Config::default() });
    let cart_model = pong_model::parse(cart_text, "cart", None, &ext).unwrap();
    let cart_model = builder.add_model(Arc::new(cart_model));
    let ground_model = pong_model::load(&given.join("ground.ron"), &ext).unwrap();
    let ground_model = builder.add_model(Arc::new(ground_model));
    let cart = builder.create_object(cart_model, "cart").unwrap();
    let ground = builder.create_object(ground_model, "ground").unwrap();
    let pair = builder.pair(cart, ground).unwrap();
    apart.iter().for_each(|group| builder.filter(cart, group, ground, "").unwrap());
    let (world, _) = builder.seal().unwrap();
    let mut bodies = world.scene().interfaces(cart).unwrap();
    bodies.extend(world.scene().interfaces(ground).unwrap());
    let text = ModelSource::Text { text: cart_text.to_owned(), mesh_dir: None };
    Scene { world, bodies, cart, pair, sources: vec![text, ModelSource::File(given.join("ground.ron"))] }
}

impl Scene {
    /// Sets the states of step `n`: the cart sticks, slips and hops, the arm knocks.
    pub fn place(&mut self, n: u32) {
        let t = f64::from(n) * 0.01;
        let mut cart = State::identity();
        // Not a unit quaternion to the last bit: the log must have the value that was set, not the normalised
        // one.
        cart.orientation = [0.9999, 0.0, 0.0141 * (3.0 * t).sin(), 0.0];
        cart.position = [0.003 * (2.0 * t).sin(), 2e-4 * t, 0.099 + 0.003 * (7.0 * t).sin()];
        cart.linear_velocity = [0.006 * (2.0 * t).cos(), 2e-4, 0.021 * (7.0 * t).cos()];
        cart.angular_velocity = [0.01, 0.2 * t.sin(), 0.3];
        let mut arm = State::identity();
        arm.position = [0.1, 0.2 * (5.0 * t).cos(), 0.1 + 0.01 * (11.0 * t).sin()];
        arm.linear_velocity = [0.0, -(5.0 * t).sin(), 0.11 * (11.0 * t).cos()];
        let states = [cart, arm, State::identity()];
        let states: Vec<_> = self.bodies.iter().copied().zip(states).collect();
        self.world.set_states(&states).unwrap();
    }

    /// A step reported to the recorder.
    pub fn step(&mut self, recorder: &mut Recorder, n: u32) {
        self.place(n);
        self.world.step().unwrap();
        recorder.evaluated();
        recorder.committed();
    }

    /// Records `frames` steps, one frame each, into `folder/log`.
    pub fn record(&mut self, folder: &Path, frames: u32, options: &RecordOptions) -> PathBuf {
        let log = folder.join("log");
        let mut recorder = Recorder::start(&self.world, &log, &self.sources, options).unwrap();
        for n in 0..frames {
            self.step(&mut recorder, n);
            recorder.record(&self.world, f64::from(n) * 0.01, 0, None).unwrap();
        }
        recorder.finish().unwrap();
        log
    }
}

/// A disk that accepts nothing until it is released: the writing thread is kept from starting.
pub struct HeldDisk {
    /// Lock, so that tests with a held disk run one at a time.
    _turn: MutexGuard<'static, ()>,
}

static TURN: Mutex<()> = Mutex::new(());
static IS_HELD: AtomicBool = AtomicBool::new(false);
/// Longer than any machine needs.
const LONGEST_WAIT: Duration = Duration::from_secs(60);

impl HeldDisk {
    pub fn hold() -> Self {
        let turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
        IS_HELD.store(true, Ordering::Release);
        Self { _turn: turn }
    }

    /// Options of a log on this disk, with the smallest buffer.
    pub fn options(&self) -> RecordOptions {
        let wait: fn() = || {
            while IS_HELD.load(Ordering::Acquire) {
                std::thread::sleep(Duration::from_millis(1));
            }
        };
        RecordOptions { buffer_bytes: Some(0), on_thread_start: Some(wait), ..RecordOptions::default() }
    }

    /// Lets the disk accept the buffered data, and waits until it has.
    pub fn release(self, recorder: &Recorder) {
        drop(self);
        let begun = Instant::now();
        while recorder.status().flushed + recorder.status().lost < recorder.status().frames {
            assert!(begun.elapsed() < LONGEST_WAIT, "{:?}", recorder.status());
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}

impl Drop for HeldDisk {
    fn drop(&mut self) {
        IS_HELD.store(false, Ordering::Release);
    }
}
