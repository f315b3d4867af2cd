//! A log goes through the engine again, and what comes out is compared with what was recorded.

mod compare;
mod rebuild;
mod rerun;

pub use compare::Difference;
pub use rerun::{RerunFrame, RerunOptions, rerun, world_of_log};

use crate::error::LogError;
use crate::event::{Event, LoggedEvent};
use crate::read::{Frame, Log};
use crate::run::is_inside;
use crate::table::{FrameRow, StateRow};
use crate::write::Capture;
use compare::Comparison;
use pong_engine::{InterfaceId, Laws, ModelId, ObjectId, PairId, State, WorkerSettings, World};
use pong_geometry::extension::Extensions;
use pong_model::FrictionLaw;

/// How a log is replayed.
#[derive(Default)]
pub struct ReplayOptions {
    /// Workers of the world; the results are the same bits.
    pub workers: Option<WorkerSettings>,
    /// How far numbers may be apart, relative to the largest of their kind in the frame. `None` for the same bits.
    /// With a tolerance a log that cannot be replayed exactly is replayed nevertheless.
    pub tolerance: Option<f64>,
    /// The force laws that the host of the log had registered.
    pub laws: Laws,
    /// The kinds of primitives that it knew.
    pub extensions: Extensions,
}

/// What a replay found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReplayReport {
    /// Frames of the log.
    pub frames: u64,
    /// Frames that were replayed and compared, the one that differs included.
    pub compared: u64,
    /// Contacts of these frames.
    pub contacts: u64,
    /// What differs in the first frame that does: of wrenches and of contacts, the first each.
    pub differences: Vec<Difference>,
    /// Why the log cannot be replayed exactly from some frame on, if so.
    pub obstacle: Option<Obstacle>,
}

impl ReplayReport {
    /// Whether every frame of the log was compared and none differs.
    pub fn agrees(&self) -> bool {
        self.differences.is_empty() && self.compared == self.frames
    }
}

/// Why a log cannot be replayed exactly from a frame on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// Frames were lost.
    FramesLost {
        /// The first frame after them.
        frame: u64,
        /// How many.
        count: u64,
    },
    /// Commits belong to no frame of the log.
    CommitsMissed {
        /// The frame before which they were made.
        frame: u64,
        /// How many.
        count: u32,
    },
    /// Events were lost, or are of a kind that this program does not know.
    EventUnknown {
        /// The frame before which they came.
        frame: u64,
    },
}

impl Obstacle {
    /// The first frame that cannot be replayed exactly.
    pub fn frame(&self) -> u64 {
        match self {
            Self::FramesLost { frame, .. }
            | Self::CommitsMissed { frame, .. }
            | Self::EventUnknown { frame } => *frame,
        }
    }
}

impl std::fmt::Display for Obstacle {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let s = |count: u64| if count == 1 { "" } else { "s" };
        match self {
            Self::FramesLost { frame, count } => write!(
                f,
                "{count} frame{} before frame {frame} were lost while the log was written; give it a larger buffer or a \
                 faster disk, or let the writer wait",
                s(*count)
            ),
            Self::CommitsMissed { frame, count } => write!(
                f,
                "{count} commit{} before frame {frame} belong to no frame of the log, and friction remembers every one; \
                 record every commit (`pong run --every-step`; in a host, log the frame after each commit)",
                s((*count).into())
            ),
            Self::EventUnknown { frame } => write!(
                f,
                "an event before frame {frame} was lost or is of a kind that this program does not know; record again with \
                 a larger buffer, or use the program that wrote the log"
            ),
        }
    }
}

/// Replays a log, and stops at the first frame that differs. `progress` is called with the number of frames done.
///
/// # Errors
/// A log that cannot be read, or whose world cannot be built again: a model that was changed, a law of the host's.
pub fn replay(
    log: &mut Log,
    options: &ReplayOptions,
    progress: &mut dyn FnMut(u64),
) -> Result<ReplayReport, LogError> {
    let mut replay = Replay::new(log, options)?;
    let mut report = ReplayReport { frames: log.frame_count(), ..ReplayReport::default() };
    let mut frame = Frame::default();
    for index in 0..report.frames {
        log.read(index, &mut frame)?;
        let obstacle = replay.obstacle(&frame.row);
        report.obstacle = report.obstacle.or(obstacle);
        if report.obstacle.is_some() && options.tolerance.is_none() {
            break;
        }
        replay.run(log, &frame)?;
        report.compared += 1;
        report.contacts += frame.contacts.len() as u64;
        report.differences = replay.comparison.differences(log.run(), &replay.world, &frame)?;
        if !report.differences.is_empty() {
            break;
        }
        replay.accept(&frame.row)?;
        progress(index + 1);
    }
    Ok(report)
}

/// A world in the midst of a replay.
struct Replay {
    world: World,
    models: Vec<ModelId>,
    objects: Vec<ObjectId>,
    pairs: Vec<PairId>,
    bodies: Vec<InterfaceId>,
    events: Vec<LoggedEvent>,
    next_event: usize,
    next_frame: u64,
    states: Vec<(InterfaceId, State)>,
    /// The pairs of a frame that was committed for some.
    accepted: Vec<PairId>,
    comparison: Comparison,
}

impl Replay {
    fn new(log: &Log, options: &ReplayOptions) -> Result<Self, LogError> {
        let (world, models) = rebuild::world(log, options, &rebuild::Models::default())?;
        Self::of_world(log, options, world, models)
    }

    fn of_world(
        log: &Log,
        options: &ReplayOptions,
        world: World,
        models: Vec<ModelId>,
    ) -> Result<Self, LogError> {
        let objects: Vec<ObjectId> = world.objects().collect();
        let mut bodies = Vec::new();
        for object in &objects {
            bodies.extend(world.interfaces(*object)?);
        }
        let mut events = log.events().to_vec();
        // Word of events that were lost comes later than they would have.
        events.sort_by_key(|event| event.frame);
        Ok(Self {
            comparison: Comparison::new(Capture::new(&world, false)?, bodies.clone(), options.tolerance),
            pairs: world.pairs().map(|(pair, _)| pair).collect(),
            world,
            models,
            objects,
            bodies,
            events,
            next_event: 0,
            next_frame: 0,
            states: Vec::new(),
            accepted: Vec::new(),
        })
    }

    /// What keeps this frame, and all after it, from being replayed exactly.
    fn obstacle(&mut self, row: &FrameRow) -> Option<Obstacle> {
        let (frame, expected) = (row.frame, self.next_frame);
        self.next_frame = frame + 1;
        let now = self.events[self.next_event..].iter().take_while(|event| event.frame <= frame);
        let unknown = now.into_iter().any(|event| matches!(event.event, Event::Lost { .. } | Event::Unknown));
        if frame > expected && row.commits_missed > 0 {
            Some(Obstacle::FramesLost { frame, count: frame - expected })
        } else if row.commits_missed > 0 {
            Some(Obstacle::CommitsMissed { frame, count: row.commits_missed })
        } else {
            unknown.then_some(Obstacle::EventUnknown { frame })
        }
    }

    /// Everything up to the frame's evaluation.
    fn run(&mut self, log: &Log, frame: &Frame) -> Result<(), LogError> {
        self.accepted.clear();
        while let Some(event) =
            self.events.get(self.next_event).filter(|event| event.frame <= frame.row.frame)
        {
            let event = event.clone();
            self.apply(log, &event, frame.row.frame)?;
            self.next_event += 1;
        }
        self.states.clear();
        let set = self.bodies.iter().zip(&frame.states).filter(|(_, row)| !row.position[0].is_nan());
        self.states.extend(set.map(|(body, row)| (*body, state(row))));
        self.world.set_states(&self.states)?;
        self.world.evaluate()?;
        Ok(())
    }

    fn apply(&mut self, log: &Log, event: &LoggedEvent, frame: u64) -> Result<(), LogError> {
        match &event.event {
            Event::Pair { pair, enabled } => {
                let pair = find(&self.pairs, *pair, "pair")?;
                self.world.set_pair_enabled(pair, *enabled)?;
            }
            Event::ClearContactHistory { object } => {
                self.world.clear_contact_history(find(&self.objects, *object, "object")?)?
            }
            Event::Surface { model, name, values } => {
                let model = find(&self.models, *model, "model")?;
                let mut surface = values.surface(name);
                // Laws never change in a run: where there is none now, a rerun has left it out.
                if self.world.surface(model, name)?.friction == FrictionLaw::None {
                    surface.friction = FrictionLaw::None;
                }
                self.world.set_surface(model, &surface)?;
            }
            Event::Restore { file } => {
                let path = log.folder().join(file);
                if !is_inside(file) {
                    return Err(LogError::damaged(&path, "it leads out of the folder of the log"));
                }
                let block = std::fs::read(&path).map_err(|reason| LogError::unreadable(&path, &reason))?;
                self.world.restore_state(&block)?;
            }
            Event::Commit { pairs } if event.frame == frame => {
                for pair in pairs {
                    self.accepted.push(find(&self.pairs, *pair, "pair")?);
                }
            }
            Event::Commit { .. } | Event::Lost { .. } | Event::Unknown => {}
        }
        Ok(())
    }

    fn accept(&mut self, row: &FrameRow) -> Result<(), LogError> {
        match row.committed {
            FrameRow::EVALUATED => {}
            FrameRow::COMMITTED_SOME => self.world.commit_pairs(&self.accepted)?,
            _ => self.world.commit()?,
        }
        Ok(())
    }
}

fn find<T: Copy>(ids: &[T], index: u32, what: &str) -> Result<T, LogError> {
    let cause = || {
        LogError::refused(
            format!("an event names {what} {index}, of which there are {}", ids.len()),
            "use another copy of the log",
        )
    };
    ids.get(index as usize).copied().ok_or_else(cause)
}

fn state(row: &StateRow) -> State {
    let StateRow { position, orientation, linear_velocity, angular_velocity } = *row;
    State { position, orientation, linear_velocity, angular_velocity }
}
