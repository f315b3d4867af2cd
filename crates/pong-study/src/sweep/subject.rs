//! Subject of a study: a scene, whose motion follows from its wrenches, or a log, whose motion is given.

use crate::Result;
use crate::sweep::level::Level;
use crate::sweep::open_loop::LoggedRun;
use crate::sweep::run::{self, Ended, Frames};
use pong_executive::scene::Scene;

/// A scene or a log.
pub(crate) enum Subject {
    Scene(Box<Scene>),
    Log(Box<LoggedRun>),
}

impl Subject {
    /// Runs a level and records it.
    pub fn record(&mut self, level: &Level, frames: &Frames) -> Result<Ended> {
        match self {
            Self::Scene(scene) => run::record(scene, level, frames),
            Self::Log(log) => log.record(level, frames).map(Ended::Whole),
        }
    }

    /// Runs a level that is known to reach the end; returns the time of every frame, ns.
    pub fn time(&mut self, level: &Level, frames: &Frames) -> Result<Vec<u64>> {
        match self {
            Self::Scene(scene) => run::time(scene, level, frames),
            Self::Log(log) => log.time(level, frames),
        }
    }

    pub fn name(&self) -> &str {
        match self {
            Self::Scene(scene) => scene.name(),
            Self::Log(log) => log.name(),
        }
    }

    pub fn alternatives(&self) -> Vec<String> {
        match self {
            Self::Scene(scene) => scene.alternatives().map(str::to_owned).collect(),
            Self::Log(log) => log.alternatives(),
        }
    }
}
