//! The engine on a scene of two Objects.

use pong_engine::{Config, EngineError, InterfaceId, SealReport, State, World};
use pong_model::Model;
use std::sync::Arc;

/// Two Objects, paired and sealed.
pub struct Rig {
    /// The world.
    pub world: World,
    /// What sealing told.
    pub report: SealReport,
    interfaces: [InterfaceId; 2],
}

impl Rig {
    /// A world of two models.
    ///
    /// # Errors
    /// Whatever the engine refuses.
    pub fn new(models: [Arc<Model>; 2]) -> Result<Self, EngineError> {
        let mut world = World::new(Config::default());
        let [first, second] = models;
        let first = world.add_model(first)?;
        let second = world.add_model(second)?;
        let objects = [world.create_object(first, "first")?, world.create_object(second, "second")?];
        world.pair(objects[0], objects[1])?;
        let interfaces = [world.interface(objects[0], "")?, world.interface(objects[1], "")?];
        let report = world.seal()?;
        Ok(Self { world, report, interfaces })
    }

    /// One whole frame: states in, forces and friction, contact state kept, wrenches out.
    ///
    /// # Panics
    /// If the engine refuses the states.
    pub fn frame(&mut self, states: &[State; 2]) -> [f64; 12] {
        let [first, second] = self.interfaces;
        self.world.set_states(&[(first, states[0]), (second, states[1])]).expect("finite states");
        self.world.step().expect("a sealed world steps");
        let mut out = [0.0; 12];
        for (wrench, interface) in out.chunks_exact_mut(6).zip([first, second]) {
            let found = self.world.wrench(interface).expect("a frame has run");
            wrench[..3].copy_from_slice(found.force.as_slice());
            wrench[3..].copy_from_slice(found.moment.as_slice());
        }
        out
    }
}

/// FNV-1a over the bits of numbers: equal hashes mean equal results.
pub struct Fingerprint(u64);

impl Default for Fingerprint {
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Fingerprint {
    /// Takes numbers in.
    pub fn add(&mut self, numbers: &[f64]) {
        for byte in numbers.iter().flat_map(|x| x.to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }
}

impl std::fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
