//! A world that plays kept motions, to compare and count, or to time.

use crate::runs::answer::Reader;
use crate::runs::counts::Counts;
use crate::runs::motions::{Commit, Given, Motions, Window};
use pong_engine::{EngineError, InterfaceId, PairId, State, World};
use pong_executive::scene::BuiltScene;
use std::time::Instant;

/// Storage of a world.
pub(crate) enum Held {
    Scene(Box<BuiltScene>),
    World(Box<World>),
}

/// A world and its movable groups.
pub(crate) struct Player {
    held: Held,
    bodies: Vec<InterfaceId>,
    pairs: Vec<PairId>,
    states: Vec<(InterfaceId, State)>,
}

/// Result of a comparison.
pub(crate) enum Compared {
    /// Equal bits in every frame, with the counts.
    Same(Counts),
    /// The first frame that differs, and the quantity.
    Differs(String),
}

impl Held {
    pub fn world(&self) -> &World {
        match self {
            Self::Scene(built) => built.simulation.world(),
            Self::World(world) => world,
        }
    }

    fn world_mut(&mut self) -> &mut World {
        match self {
            Self::Scene(built) => built.simulation.world_mut(),
            Self::World(world) => world,
        }
    }
}

/// All movable groups of a world.
pub(crate) fn bodies(world: &World) -> Result<Vec<InterfaceId>, EngineError> {
    let mut bodies = Vec::new();
    for object in world.scene().objects() {
        bodies.extend(world.scene().interfaces(object)?);
    }
    Ok(bodies)
}

impl Player {
    pub fn new(held: Held) -> Result<Self, EngineError> {
        let bodies = bodies(held.world())?;
        let pairs = held.world().scene().pairs().map(|(pair, _)| pair).collect();
        Ok(Self { held, bodies, pairs, states: Vec::new() })
    }

    /// Plays every `stride`-th window, counts, and compares every answer with the run's own.
    pub fn compare(&mut self, motions: &Motions, stride: usize) -> Result<Compared, EngineError> {
        let mut counts = Counts::default();
        let mut reader = Reader::default();
        for window in motions.windows.iter().step_by(stride) {
            window.before.restore(self.held.world_mut())?;
            for (place, given) in window.frames.iter().enumerate() {
                self.hand_in(given);
                self.frame(given)?;
                let (world, number) = (self.held.world(), window.first as usize + place);
                counts.add(&world.counts());
                let is_last = place + 1 == window.frames.len();
                let answer = reader.read(world, &self.bodies, is_last)?;
                if let Some(what) = answer.difference(&motions.answers[number]) {
                    return Ok(Compared::Differs(format!("{what} of frame {number}")));
                }
            }
        }
        Ok(Compared::Same(counts))
    }

    /// Plays every `stride`-th window and keeps the shorter time of each frame, ns.
    pub fn time(
        &mut self,
        motions: &Motions,
        stride: usize,
        times: &mut Vec<u64>,
    ) -> Result<(), EngineError> {
        let rows = || motions.windows.iter().step_by(stride);
        times.resize(rows().map(|window: &Window| window.frames.len()).sum(), u64::MAX);
        let mut kept = times.iter_mut();
        for window in rows() {
            window.before.restore(self.held.world_mut())?;
            for given in &window.frames {
                self.hand_in(given);
                let begin = Instant::now();
                self.frame(given)?;
                let took = begin.elapsed().as_nanos() as u64;
                kept.next().into_iter().for_each(|kept| *kept = took.min(*kept));
            }
        }
        Ok(())
    }

    fn hand_in(&mut self, given: &Given) {
        self.states.clear();
        self.states.extend(given.states.iter().map(|(place, state)| (self.bodies[*place], *state)));
    }

    /// Sets states, evaluates and commits.
    fn frame(&mut self, given: &Given) -> Result<(), EngineError> {
        let world = self.held.world_mut();
        world.set_states(&self.states)?;
        world.evaluate()?;
        match &given.commit {
            Commit::All => world.commit(),
            Commit::Nothing => Ok(()),
            Commit::Pairs(pairs) => {
                let pairs: Vec<PairId> =
                    pairs.iter().filter_map(|pair| self.pairs.get(*pair)).copied().collect();
                world.commit_pairs(&pairs)
            }
        }
    }
}
