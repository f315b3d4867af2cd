//! The two phases of a world: calls of C in the wrong one are refused here. In Rust the types exclude them.

use pong_engine::{
    Config, EngineError, FrameReport, InterfaceId, ModelId, PairId, Scene, SealReport, State, SurfaceMotion,
    World, WorldBuilder,
};
use pong_model::Surface;

/// Set-up, then frames.
#[allow(clippy::large_enum_variant)] // One for each world, which lies on the heap itself.
pub(crate) enum Phase {
    SetUp(WorldBuilder),
    Frames(World),
}

impl Phase {
    /// The scene, in either phase.
    pub fn scene(&self) -> &Scene {
        match self {
            Self::SetUp(builder) => builder.scene(),
            Self::Frames(world) => world.scene(),
        }
    }

    /// The builder, for a call that belongs before the seal.
    pub fn set_up(&mut self, call: &'static str) -> Result<&mut WorldBuilder, EngineError> {
        match self {
            Self::SetUp(builder) => Ok(builder),
            Self::Frames(_) => {
                Err(EngineError::WrongPhase { call, cure: "do it before the world is sealed" })
            }
        }
    }

    /// The world, for a call that belongs after the seal.
    pub fn frames(&self, call: &'static str) -> Result<&World, EngineError> {
        self.sealed().ok_or(not_sealed(call))
    }

    /// The world, for a call after the seal that changes it.
    pub fn frames_mut(&mut self, call: &'static str) -> Result<&mut World, EngineError> {
        match self {
            Self::SetUp(_) => Err(not_sealed(call)),
            Self::Frames(world) => Ok(world),
        }
    }

    /// The world, or `None` before the seal.
    pub fn sealed(&self) -> Option<&World> {
        match self {
            Self::SetUp(_) => None,
            Self::Frames(world) => Some(world),
        }
    }

    /// Report of the last frame.
    pub fn report(&self) -> FrameReport {
        self.sealed().map_or_else(FrameReport::default, World::report)
    }

    /// Ends set-up. After a failure set-up goes on, unchanged.
    pub fn seal(&mut self) -> Result<SealReport, EngineError> {
        self.set_up("seal")?;
        // An empty builder stands in during the seal; if that panics, the lock is poisoned and no call sees it.
        let kept = Self::SetUp(WorldBuilder::new(Config::default()));
        let Self::SetUp(builder) = std::mem::replace(self, kept) else { unreachable!("checked above") };
        match builder.seal() {
            Ok((world, report)) => {
                *self = Self::Frames(world);
                Ok(report)
            }
            Err(refused) => {
                let (builder, error) = refused.into_parts();
                *self = Self::SetUp(builder);
                Err(error)
            }
        }
    }

    pub fn set_states(&mut self, states: &[(InterfaceId, State)]) -> Result<(), EngineError> {
        match self {
            Self::SetUp(builder) => builder.set_states(states),
            Self::Frames(world) => world.set_states(states),
        }
    }

    pub fn set_surface_motions(
        &mut self,
        motions: &[(InterfaceId, SurfaceMotion)],
    ) -> Result<(), EngineError> {
        match self {
            Self::SetUp(builder) => builder.set_surface_motions(motions),
            Self::Frames(world) => world.set_surface_motions(motions),
        }
    }

    pub fn surface_motion(&self, interface: InterfaceId) -> Result<&SurfaceMotion, EngineError> {
        match self {
            Self::SetUp(builder) => builder.surface_motion(interface),
            Self::Frames(world) => world.surface_motion(interface),
        }
    }

    pub fn state_as_set(&self, interface: InterfaceId) -> Result<Option<&State>, EngineError> {
        match self {
            Self::SetUp(builder) => builder.state_as_set(interface),
            Self::Frames(world) => world.state_as_set(interface),
        }
    }

    pub fn set_pair_enabled(&mut self, pair: PairId, enabled: bool) -> Result<(), EngineError> {
        match self {
            Self::SetUp(builder) => builder.set_pair_enabled(pair, enabled),
            Self::Frames(world) => world.set_pair_enabled(pair, enabled),
        }
    }

    pub fn surface(&self, model: ModelId, name: &str) -> Result<&Surface, EngineError> {
        match self {
            Self::SetUp(builder) => builder.surface(model, name),
            Self::Frames(world) => world.surface(model, name),
        }
    }

    pub fn set_surface(&mut self, model: ModelId, surface: &Surface) -> Result<(), EngineError> {
        match self {
            Self::SetUp(builder) => builder.set_surface(model, surface),
            Self::Frames(world) => world.set_surface(model, surface),
        }
    }
}

const fn not_sealed(call: &'static str) -> EngineError {
    EngineError::WrongPhase { call, cure: "seal the world first" }
}
