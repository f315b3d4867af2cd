//! The engine on a scene of Objects.

use crate::peer::Peer;
use core_affinity::CoreId;
use pong_engine::{
    Config, EngineError, InterfaceId, PairId, SealReport, State, WorkerSettings, World, WorldBuilder,
};
use pong_model::{Fnv, Model};
use std::sync::{Arc, OnceLock};

/// Objects, paired and sealed.
pub struct Rig {
    /// The world.
    pub world: World,
    /// Report of sealing.
    pub report: SealReport,
    /// Pairs, in the order of naming.
    pub pairs: Vec<PairId>,
    states: Vec<(InterfaceId, State)>,
    wrenches: Vec<f64>,
}

/// Objects, paired and not yet sealed.
pub struct Unsealed {
    builder: WorldBuilder,
    pairs: Vec<PairId>,
    states: Vec<(InterfaceId, State)>,
}

impl Rig {
    /// A world of one Object per model, with some of them paired.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn new(models: &[Arc<Model>], pairs: &[(usize, usize)], threads: usize) -> Result<Self, EngineError> {
        Self::in_world(WorldBuilder::new(config(threads)), models, pairs)
    }

    /// As [`new`](Self::new), in the world of `builder`.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn in_world(
        builder: WorldBuilder,
        models: &[Arc<Model>],
        pairs: &[(usize, usize)],
    ) -> Result<Self, EngineError> {
        Unsealed::new(builder, models, pairs)?.seal()
    }

    /// Runs one whole frame: sets states (of all movable groups of all Objects, or of the first ones),
    /// computes forces and friction, commits, and returns the wrenches of the movable groups whose states
    /// were set.
    ///
    /// # Panics
    /// If the engine refuses the states.
    #[inline]
    pub fn step(&mut self, states: &[State]) -> &[f64] {
        self.set(states);
        self.world.step().expect("a sealed world steps");
        self.read(states.len())
    }

    /// Sets states.
    ///
    /// # Panics
    /// If the engine refuses them.
    #[inline]
    pub fn set(&mut self, states: &[State]) {
        let known = &mut self.states[..states.len()];
        known.iter_mut().zip(states).for_each(|((_, known), state)| *known = *state);
        self.world.set_states(known).expect("finite states");
    }

    /// Returns the wrenches of the first `groups` movable groups.
    ///
    /// # Panics
    /// If no frame has run.
    #[inline]
    pub fn read(&mut self, groups: usize) -> &[f64] {
        let wrenches = &mut self.wrenches[..6 * groups];
        for (out, (interface, _)) in wrenches.chunks_exact_mut(6).zip(&self.states) {
            let found = self.world.wrench(*interface).expect("a frame has run");
            out[..3].copy_from_slice(found.force.as_slice());
            out[3..].copy_from_slice(found.moment.as_slice());
        }
        wrenches
    }
}

impl Unsealed {
    /// Objects in a world, one per model, with some of them paired.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn new(
        mut builder: WorldBuilder,
        models: &[Arc<Model>],
        pairs: &[(usize, usize)],
    ) -> Result<Self, EngineError> {
        let (mut objects, mut known) = (Vec::new(), Vec::new());
        for (number, model) in models.iter().enumerate() {
            let same = models[..number].iter().position(|earlier| Arc::ptr_eq(earlier, model));
            let id = match same {
                Some(earlier) => known[earlier],
                None => builder.add_model(Arc::clone(model)),
            };
            known.push(id);
            objects.push(builder.create_object(id, &format!("object_{number}"))?);
        }
        let pairs = pairs.iter().map(|&(a, b)| builder.pair(objects[a], objects[b]));
        let pairs = pairs.collect::<Result<Vec<_>, _>>()?;
        let mut states = Vec::new();
        for object in objects {
            for interface in builder.scene().interfaces(object)? {
                states.push((interface, State::identity()));
            }
        }
        Ok(Self { builder, pairs, states })
    }

    /// Ends set-up.
    ///
    /// # Errors
    /// Any error of the engine.
    pub fn seal(self) -> Result<Rig, EngineError> {
        let Self { builder, pairs, states } = self;
        let (world, report) = builder.seal()?;
        let wrenches = vec![0.0; 6 * states.len()];
        Ok(Rig { world, report, pairs, states, wrenches })
    }
}

impl Peer for Rig {
    fn frame(&mut self, states: &[State]) -> usize {
        std::hint::black_box(self.step(states));
        self.world.report().contacts as usize
    }

    fn deepest(&self) -> Option<f64> {
        self.world.contacts_iter().map(|contact| contact.depth).max_by(f64::total_cmp)
    }
}

/// Settings of a world on this many threads, including the caller's. More workers than cores are allowed;
/// otherwise workers are bound to separate cores, as [`bind_caller`] binds the caller.
pub fn config(threads: usize) -> Config {
    let cores = cores();
    let workers = (threads > 1).then(|| WorkerSettings {
        workers: threads - 1,
        oversubscribe: true,
        pin: threads <= cores.len(),
        cores: cores.iter().skip(1).copied().collect(),
        ..WorkerSettings::default()
    });
    Config { workers, ..Config::default() }
}

/// 1, 2, 4 … threads, no more than `most`.
pub fn thread_counts(most: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(1), |count| Some(2 * count)).take_while(move |&count| count <= most)
}

/// Binds the calling thread to the first core of its mask; the workers of [`config`] use the others.
pub fn bind_caller() {
    if let Some(&id) = cores().first() {
        core_affinity::set_for_current(CoreId { id });
    }
}

/// The cores that this process was allowed to use when it began.
fn cores() -> &'static [usize] {
    static CORES: OnceLock<Vec<usize>> = OnceLock::new();
    CORES.get_or_init(|| {
        let cores = core_affinity::get_core_ids().unwrap_or_default();
        cores.into_iter().map(|core| core.id).collect()
    })
}

/// A hash over the bits of numbers: equal hashes mean equal results.
#[derive(Default)]
pub struct Fingerprint(Fnv);

impl Fingerprint {
    /// Adds numbers to the hash.
    pub fn add(&mut self, numbers: &[f64]) {
        self.0.numbers(numbers.iter().copied());
    }
}

impl std::fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0.value())
    }
}
