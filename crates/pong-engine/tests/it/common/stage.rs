//! Scenes that run along fixed paths, and hashes of everything that a frame reports. The paths use no
//! platform mathematics, so they are bit-identical everywhere.

use pong_engine::{
    Config, Contact, ContactSide, InterfaceId, ObjectId, PairId, State, StatusBits, WorkerSettings, World,
    WorldBuilder, WrenchCoupling,
};
use pong_geometry::{Vec3, Wrench};
use std::sync::Arc;
use std::time::Duration;

/// Duration of a frame, s.
const STEP_S: f64 = 1e-3;

/// A smooth oscillation about a position: one sine per axis, and one per axis of the rotation.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    pub center: [f64; 3],
    /// Amplitudes, m.
    pub swing: [f64; 3],
    /// Periods, frames.
    pub period: [f64; 3],
    /// Amplitudes of the vector part of a quaternion with the scalar part 1.
    pub turn: [f64; 3],
    /// Period of the rotation, frames.
    pub turn_period: f64,
}

impl Path {
    /// A path at rest.
    pub const fn still(center: [f64; 3]) -> Self {
        Self { center, swing: [0.0; 3], period: [100.0; 3], turn: [0.0; 3], turn_period: 100.0 }
    }

    pub fn at(&self, frame: usize) -> State {
        let position = |frame: f64, axis: usize| {
            self.center[axis] + self.swing[axis] * sine(frame / self.period[axis] + 0.1 * axis as f64)
        };
        let turn =
            |frame: f64, axis: usize| self.turn[axis] * sine(frame / self.turn_period + 0.3 * axis as f64);
        let now = frame as f64;
        let rate = |of: &dyn Fn(f64, usize) -> f64, axis: usize| {
            (of(now + 0.5, axis) - of(now - 0.5, axis)) / STEP_S
        };
        let [x, y, z] = [0, 1, 2].map(|axis| turn(now, axis));
        let norm = (1.0 + x * x + y * y + z * z).sqrt();
        State {
            position: [0, 1, 2].map(|axis| position(now, axis)),
            orientation: [1.0 / norm, x / norm, y / norm, z / norm],
            linear_velocity: [0, 1, 2].map(|axis| rate(&position, axis)),
            angular_velocity: [0, 1, 2].map(|axis| 2.0 * rate(&turn, axis)),
        }
    }
}

fn sine(turns: f64) -> f64 {
    libm::sin(std::f64::consts::TAU * turns)
}

/// Scene to be run.
pub struct Scene {
    pub name: &'static str,
    pub frames: usize,
    pub contact_capacity: Option<usize>,
    pub ledger: bool,
    pub accounts: Option<WrenchCoupling>,
    /// True to use the primitives, volumes and laws of `own_kinds.rs`.
    pub own_kinds: bool,
    pub models: Vec<String>,
    /// Model of every Object.
    pub objects: Vec<usize>,
    pub pairs: Vec<(usize, usize)>,
    /// One per movable group, by Object.
    pub paths: Vec<Path>,
    /// Returns true if a pair is on in a frame.
    pub is_on: fn(frame: usize, pair: usize) -> bool,
    /// Object whose history is cleared before a frame.
    pub forgets: fn(frame: usize) -> Option<usize>,
    /// Stiffness of the first model's surface `s` in a frame, if it changes, N/m.
    pub stiffness: fn(frame: usize) -> Option<f64>,
}

impl Scene {
    /// A scene without switched pairs, cleared history and changing surfaces.
    pub fn new(name: &'static str, frames: usize, models: Vec<String>) -> Self {
        Self {
            name,
            frames,
            contact_capacity: None,
            ledger: true,
            accounts: None,
            own_kinds: false,
            models,
            objects: vec![0, 1],
            pairs: vec![(0, 1)],
            paths: Vec::new(),
            is_on: |_, _| true,
            forgets: |_| None,
            stiffness: |_| None,
        }
    }

    /// Sealed world of the scene.
    pub fn set_up(&self, workers: Option<WorkerSettings>) -> Stage<'_> {
        self.set_up_beside(&[], workers)
    }

    /// Sealed world of the scene with additional Objects at these positions in its list, far away and paired with all.
    pub fn set_up_beside(&self, newcomers: &[usize], workers: Option<WorkerSettings>) -> Stage<'_> {
        let Self { contact_capacity, ledger, accounts, .. } = *self;
        let config = Config { contact_capacity, ledger, accounts, workers, ..Config::default() };
        let mut builder = match self.own_kinds {
            true => WorldBuilder::with_extensions(
                config,
                super::own_kinds::extensions(),
                super::own_kinds::laws(),
            ),
            false => WorldBuilder::new(config),
        };
        let add = |text: &String| {
            let model = pong_model::parse(text, "scene.ron", None, builder.scene().extensions());
            let model = model.unwrap_or_else(|errors| panic!("{}: {errors}", self.name));
            builder.add_model(Arc::new(model))
        };
        let models: Vec<_> = self.models.iter().map(add).collect();
        let (mut objects, mut strange) = (Vec::new(), Vec::new());
        for place in 0..=self.objects.len() {
            if newcomers.contains(&place) {
                strange.push(newcomer(&mut builder, place));
            }
            let model = self.objects.get(place).map(|model| models[*model]);
            objects
                .extend(model.map(|model| builder.create_object(model, &format!("object_{place}")).unwrap()));
        }
        for newcomer in &strange {
            objects.iter().for_each(|object| _ = builder.pair(*object, *newcomer).unwrap());
        }
        let pairs = self.pairs.iter().map(|&(a, b)| builder.pair(objects[a], objects[b]).unwrap()).collect();
        let (world, _) = builder.seal().unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let groups: Vec<_> =
            objects.iter().flat_map(|object| world.scene().interfaces(*object).unwrap()).collect();
        assert_eq!(groups.len(), self.paths.len(), "{}: one path per movable group", self.name);
        Stage { scene: self, world, models, objects, pairs, groups }
    }
}

/// Adds an Object of several kinds of primitives, 1 km away.
fn newcomer(builder: &mut WorldBuilder, place: usize) -> ObjectId {
    let parts = "Point(name: \"p\", position: (0,0,0)), Sphere(name: \"b\", center: (1,0,0), radius: 0.1), \
                 Capsule(name: \"c\", ends: ((0,1,0), (1,1,0)), radius: 0.1)";
    let text = pong_testkit::ron::model("newcomer", "\"s\": (stiffness: inf)", parts);
    let model = pong_model::parse(&text, "newcomer.ron", None, builder.scene().extensions()).unwrap();
    let model = builder.add_model(Arc::new(model));
    let object = builder.create_object(model, &format!("newcomer_{place}")).unwrap();
    let interface = builder.scene().interface(object, "").unwrap();
    // Clear of infinite posts, and above oscillating planes.
    let position = [1e2, 2e1 * place as f64, 1e3];
    builder.set_states(&[(interface, State { position, ..State::identity() })]).unwrap();
    object
}

/// Settings for this many workers, even on a busy machine.
pub fn workers(count: usize) -> Option<WorkerSettings> {
    // Practically no worker timeout: on a busy machine no frame may fall back to the caller alone.
    let worker_timeout = Duration::from_secs(60);
    Some(WorkerSettings { workers: count, oversubscribe: true, worker_timeout, ..WorkerSettings::default() })
}

/// A running scene.
pub struct Stage<'s> {
    pub scene: &'s Scene,
    pub world: World,
    models: Vec<pong_engine::ModelId>,
    pub objects: Vec<ObjectId>,
    pub pairs: Vec<PairId>,
    pub groups: Vec<InterfaceId>,
}

impl Stage<'_> {
    /// Sets the states of a frame.
    pub fn place(&mut self, frame: usize) {
        let states: Vec<_> =
            self.groups.iter().zip(&self.scene.paths).map(|(group, path)| (*group, path.at(frame))).collect();
        self.world.set_states(&states).unwrap();
    }

    /// Switches the pairs for a frame.
    pub fn switch(&mut self, frame: usize) {
        for (index, pair) in self.pairs.iter().enumerate() {
            self.world.set_pair_enabled(*pair, (self.scene.is_on)(frame, index)).unwrap();
        }
        if let Some(stiffness) = (self.scene.stiffness)(frame) {
            let mut surface = self.world.surface(self.models[0], "s").unwrap().clone();
            if surface.stiffness != stiffness {
                surface.stiffness = stiffness;
                self.world.set_surface(self.models[0], &surface).unwrap();
            }
        }
    }

    /// Everything that the host does before it evaluates a frame.
    pub fn prepare(&mut self, frame: usize) {
        self.switch(frame);
        if let Some(object) = (self.scene.forgets)(frame) {
            self.world.clear_contact_history(self.objects[object]).unwrap();
        }
        self.place(frame);
    }

    /// Runs one frame and hashes everything that it reports.
    pub fn step(&mut self, frame: usize) -> FrameHash {
        self.prepare(frame);
        self.world.evaluate().unwrap();
        self.finish()
    }

    /// Hashes the evaluated frame, and commits it.
    pub fn finish(&mut self) -> FrameHash {
        let mut hash = FrameHash::default();
        self.hash_answers(&mut hash.answers);
        hash.counts = self.hash_of_counts();
        self.world.commit().unwrap();
        hash.answers.ledger(&self.world);
        hash.state.bytes(&self.saved());
        hash
    }

    pub fn saved(&self) -> Vec<u8> {
        let mut block = vec![0; self.world.state_size()];
        self.world.save_state(&mut block).unwrap();
        block
    }

    fn hash_answers(&self, hash: &mut Hash) {
        for group in &self.groups {
            hash.wrench(&self.world.wrench(*group).unwrap());
            hash.wrench(&self.world.wrench_common(*group).unwrap());
        }
        let report = self.world.report();
        // Tunnelling is hashed separately, because earlier versions did not report it.
        hash.word(u64::from(report.status.bits() & !StatusBits::TUNNELLED.bits()));
        hash.word(u64::from(report.contacts));
        hash.word(u64::from(report.contacts_wanted));
        let mut listed = 0;
        for contact in self.world.contacts_iter() {
            hash.contact(&contact);
            listed += 1;
        }
        assert_eq!(listed, report.contacts, "{}: contacts listed and reported", self.scene.name);
    }

    fn hash_of_counts(&self) -> Hash {
        let mut hash = Hash::default();
        let counts = self.world.counts();
        hash.word(counts.leaf_pairs);
        hash.word(counts.boxes_tested);
        hash.word(self.world.tunnelling().map_or(0, |passage| u64::from(passage.count)));
        for (a, b, tally) in counts.volumes() {
            hash.bytes(a.as_bytes());
            hash.bytes(b.as_bytes());
            hash.word(u64::from(tally.tested) << 32 | u64::from(tally.met));
        }
        for (a, b, tally) in counts.testers() {
            hash.word((a as u64) << 32 | b as u64);
            hash.word(u64::from(tally.tested) << 32 | u64::from(tally.met));
        }
        hash
    }
}

/// Hashes of one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FrameHash {
    /// Wrenches, contacts, report, ledger.
    pub answers: Hash,
    /// The contact state block.
    pub state: Hash,
    /// Hash of the test counts: equal for any number of workers, but no part of the answers.
    pub counts: Hash,
}

/// Hash of numbers, bit by bit.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Hash(pub u64);

impl Default for Hash {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl std::fmt::Debug for Hash {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(out, "{:016x}", self.0)
    }
}

impl Hash {
    pub fn word(&mut self, word: u64) {
        let mixed = (self.0 ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ mixed >> 29;
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks::<8>();
        words.iter().for_each(|word| self.word(u64::from_le_bytes(*word)));
        rest.iter().for_each(|byte| self.word(u64::from(*byte)));
        self.word(bytes.len() as u64);
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|number| self.word(number.to_bits()));
    }

    fn vector(&mut self, vector: &Vec3) {
        self.numbers(vector.as_slice());
    }

    pub fn wrench(&mut self, wrench: &Wrench) {
        self.vector(&wrench.force);
        self.vector(&wrench.moment);
    }

    fn side(&mut self, side: &ContactSide) {
        // The upper half of an id identifies the world.
        self.word(side.object.to_bits() & 0xffff_ffff);
        self.word(side.interface.to_bits() & 0xffff_ffff);
        self.word(u64::from(side.primitive) << 32 | u64::from(side.element));
        self.vector(&side.arm);
    }

    pub fn contact(&mut self, contact: &Contact) {
        let Contact { pair, a, b, feature, end, point, normal, depth, depth_rate, weight, .. } = contact;
        self.word(pair.to_bits() & 0xffff_ffff);
        self.side(a);
        self.side(b);
        self.word(u64::from(feature.0) << 32 | u64::from(*end));
        [point, normal].into_iter().for_each(|vector| self.vector(vector));
        self.numbers(&[*depth, *depth_rate, *weight]);
        let Contact { normal_force, friction_force, force, slip_velocity, sticks, .. } = contact;
        self.numbers(&[*normal_force]);
        [friction_force, force, slip_velocity].into_iter().for_each(|vector| self.vector(vector));
        self.word(u64::from(*sticks));
        let Contact { stored, work, dissipated, .. } = contact;
        self.numbers(&[*stored, *work, *dissipated]);
    }

    fn ledger(&mut self, world: &World) {
        let ledger = world.ledger();
        self.numbers(&[ledger.stored, ledger.work, ledger.dissipated]);
    }
}
