//! The motions of a run, kept: some frames that follow each other, again and again over the run, each time with what the
//! engine knew before the first of them. So every proposal is asked for the same frames, in the midst of the run.

use crate::runs::answer::{Answer, Reader};
use pong_engine::{EngineError, InterfaceId, State, World};
use pong_model::Surface;

/// Frames in a row.
const ROW: u64 = 16;

/// What is kept of a run.
pub(crate) struct Motions {
    /// The answer of every frame of the run.
    pub answers: Vec<Answer>,
    /// The rows, in the order of the run.
    pub windows: Vec<Window>,
    /// Frames in which a limit was hit.
    pub limited: u64,
}

/// Some frames in a row.
pub(crate) struct Window {
    /// Number of the first in the run, from 0.
    pub first: u64,
    pub before: Snapshot,
    pub frames: Vec<Given>,
}

/// What a host gave for a frame.
pub(crate) struct Given {
    /// States of movable groups, by their place among all of the world.
    pub states: Vec<(usize, State)>,
    pub commit: Commit,
}

/// What a host did after a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Commit {
    Nothing,
    All,
    /// Only these pairs, by index.
    Pairs(Vec<usize>),
}

/// What a world knows between frames.
pub(crate) struct Snapshot {
    block: Vec<u8>,
    enabled: Vec<bool>,
    /// Of each model.
    surfaces: Vec<Vec<Surface>>,
}

impl Snapshot {
    pub fn take(world: &World, reader: &mut Reader) -> Result<Self, EngineError> {
        let block = reader.block(world).to_vec();
        let pairs = world.scene().pairs().map(|(pair, _)| world.pair_enabled(pair));
        let surfaces = world.scene().models().map(|(model, _)| Ok(world.surfaces(model)?.to_vec()));
        Ok(Self {
            block,
            enabled: pairs.collect::<Result<_, _>>()?,
            surfaces: surfaces.collect::<Result<_, EngineError>>()?,
        })
    }

    /// Gives a world of the same calls what is known here.
    pub fn restore(&self, world: &mut World) -> Result<(), EngineError> {
        let pairs: Vec<_> = world.scene().pairs().map(|(pair, _)| pair).collect();
        for (pair, enabled) in pairs.into_iter().zip(&self.enabled) {
            if world.pair_enabled(pair)? != *enabled {
                world.set_pair_enabled(pair, *enabled)?;
            }
        }
        let models: Vec<_> = world.scene().models().map(|(model, _)| model).collect();
        for (model, surfaces) in models.into_iter().zip(&self.surfaces) {
            for surface in surfaces {
                if world.surface(model, &surface.name)? != surface {
                    world.set_surface(model, surface)?;
                }
            }
        }
        world.restore_state(&self.block)
    }
}

/// Which frames of a run are kept, from and to: rows spread evenly, at most so many frames together, and none that
/// something else than states belongs to (`events`, in order).
pub(crate) fn rows(frames: u64, wanted: u64, events: &[u64]) -> Vec<(u64, u64)> {
    let count = wanted.div_ceil(ROW).min(frames.div_ceil(ROW)).max(1);
    let all = (0..count).map(|row| {
        // Whole rows fit side by side if all frames are wanted.
        let first = if wanted >= frames { row * ROW } else { row * (frames - ROW) / (count - 1).max(1) };
        (first, (first + ROW).min(frames))
    });
    let mut kept: Vec<(u64, u64)> = Vec::new();
    for (first, end) in all {
        let first = first.max(kept.last().map_or(0, |last| last.1));
        let mut from = first;
        let within = events.iter().filter(|event| (first..end).contains(event)).map(|event| event + 1);
        // The longest part that no event cuts.
        let mut best = (first, first);
        for next in within.chain([end + 1]) {
            if next - 1 - from > best.1 - best.0 {
                best = (from, next - 1);
            }
            from = next;
        }
        if best.1 > best.0 {
            kept.push(best);
        }
    }
    kept
}

/// Takes in a run, frame after frame.
pub(crate) struct Gatherer {
    rows: std::vec::IntoIter<(u64, u64)>,
    row: Option<(u64, u64)>,
    reader: Reader,
    motions: Motions,
}

impl Gatherer {
    pub fn new(rows: Vec<(u64, u64)>) -> Self {
        let mut rows = rows.into_iter();
        let motions = Motions { answers: Vec::new(), windows: Vec::new(), limited: 0 };
        Self { row: rows.next(), rows, reader: Reader::default(), motions }
    }

    /// Before the next frame.
    pub fn before(&mut self, world: &World) -> Result<(), EngineError> {
        let next = self.motions.answers.len() as u64;
        if self.row.is_some_and(|(first, _)| first == next) {
            let before = Snapshot::take(world, &mut self.reader)?;
            self.motions.windows.push(Window { first: next, before, frames: Vec::new() });
        }
        Ok(())
    }

    /// After a frame and its commit.
    pub fn after(
        &mut self,
        world: &World,
        bodies: &[InterfaceId],
        commit: Commit,
    ) -> Result<(), EngineError> {
        let frame = self.motions.answers.len() as u64;
        self.motions.answers.push(self.reader.read(world, bodies, true)?);
        self.motions.limited += u64::from(world.report().status.leaves_contacts_out());
        let Some((first, end)) = self.row.filter(|(first, _)| frame >= *first) else { return Ok(()) };
        if let Some(window) = self.motions.windows.last_mut().filter(|window| window.first == first) {
            let mut states = Vec::new();
            for (place, body) in bodies.iter().enumerate() {
                states.extend(world.state_as_set(*body)?.map(|state| (place, *state)));
            }
            window.frames.push(Given { states, commit });
        }
        if frame + 1 == end {
            self.row = self.rows.next();
        }
        Ok(())
    }

    /// All that was taken in.
    pub fn finish(mut self) -> Motions {
        self.motions.windows.retain(|window| !window.frames.is_empty());
        self.motions
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_spread_over_the_run_and_avoid_events() {
        assert_eq!(rows(40, 1000, &[]), [(0, 16), (16, 32), (32, 40)]);
        assert_eq!(rows(5, 1000, &[]), [(0, 5)]);
        assert_eq!(rows(1000, 32, &[]), [(0, 16), (984, 1000)]);
        assert_eq!(rows(1000, 48, &[]), [(0, 16), (492, 508), (984, 1000)]);
        // The frame of an event is in no row; the longer part stays.
        assert_eq!(rows(1000, 32, &[0, 986]), [(1, 16), (987, 1000)]);
        assert_eq!(rows(3, 100, &[0, 1, 2]), []);
        let many = rows(100, 96, &[]);
        assert!(many.windows(2).all(|pair| pair[0].1 <= pair[1].0), "{many:?}");
        assert!(many.iter().map(|(first, end)| end - first).sum::<u64>() >= 90);
    }
}
