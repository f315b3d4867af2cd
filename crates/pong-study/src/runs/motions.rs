//! Kept motions of a run: windows of consecutive frames spread over the run, each with the engine's state
//! before its first frame. So every proposal is played on the same frames, in the middle of the run.

use crate::runs::answer::{Answer, Reader};
use pong_engine::{EngineError, InterfaceId, State, World};
use pong_model::Surface;

/// Number of frames in a window.
const ROW: u64 = 16;

/// Kept data of a run.
pub(crate) struct Motions {
    /// The answer of every frame of the run.
    pub answers: Vec<Answer>,
    /// The windows, in the order of the run.
    pub windows: Vec<Window>,
    /// Frames in which a limit was hit.
    pub limited: u64,
}

/// Some consecutive frames.
pub(crate) struct Window {
    /// Index of the first frame in the run, from 0.
    pub first: u64,
    pub before: Snapshot,
    pub frames: Vec<Given>,
}

/// Input of the host for a frame.
pub(crate) struct Given {
    /// States of movable groups, by their index in the world.
    pub states: Vec<(usize, State)>,
    pub commit: Commit,
}

/// Commit of the host after a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Commit {
    Nothing,
    All,
    /// Only these pairs, by index.
    Pairs(Vec<usize>),
}

/// State of a world between frames.
pub(crate) struct Snapshot {
    block: Vec<u8>,
    enabled: Vec<bool>,
    /// Surfaces of each model.
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

    /// Sets this state in a world built by the same calls.
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

/// Ranges of the frames to keep: windows spread evenly, at most `wanted` frames together, without the frames
/// at `events` (sorted), where the host did more than set states.
pub(crate) fn rows(frames: u64, wanted: u64, events: &[u64]) -> Vec<(u64, u64)> {
    let count = wanted.div_ceil(ROW).min(frames.div_ceil(ROW)).max(1);
    let all = (0..count).map(|row| {
        // Whole windows fit side by side if all frames are wanted.
        let first = if wanted >= frames { row * ROW } else { row * (frames - ROW) / (count - 1).max(1) };
        (first, (first + ROW).min(frames))
    });
    let mut kept: Vec<(u64, u64)> = Vec::new();
    for (first, end) in all {
        let first = first.max(kept.last().map_or(0, |last| last.1));
        let mut from = first;
        let within = events.iter().filter(|event| (first..end).contains(event)).map(|event| event + 1);
        // The longest part without an event.
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

/// Records a run, frame by frame.
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

    /// Records the state before the next frame.
    pub fn before(&mut self, world: &World) -> Result<(), EngineError> {
        let next = self.motions.answers.len() as u64;
        if self.row.is_some_and(|(first, _)| first == next) {
            let before = Snapshot::take(world, &mut self.reader)?;
            self.motions.windows.push(Window { first: next, before, frames: Vec::new() });
        }
        Ok(())
    }

    /// Records a frame after its commit.
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

    /// Returns the recorded data.
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
        // The frame of an event is in no window; the longer part stays.
        assert_eq!(rows(1000, 32, &[0, 986]), [(1, 16), (987, 1000)]);
        assert_eq!(rows(3, 100, &[0, 1, 2]), []);
        let many = rows(100, 96, &[]);
        assert!(many.windows(2).all(|pair| pair[0].1 <= pair[1].0), "{many:?}");
        assert!(many.iter().map(|(first, end)| end - first).sum::<u64>() >= 90);
    }
}
