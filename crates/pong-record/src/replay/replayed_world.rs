//! A world during a replay.

use super::compare::Comparison;
use super::options::ReplayOptions;
use super::rebuild;
use super::report::Obstacle;
use crate::error::LogError;
use crate::event::{Event, LoggedEvent};
use crate::read::{Frame, Log};
use crate::run::is_inside;
use crate::table::{FrameRow, StateRow};
use crate::write::Capture;
use pong_engine::{InterfaceId, ModelId, ObjectId, PairId, State, SurfaceMotion, World};
use pong_model::FrictionLaw;

/// A world during a replay.
pub(super) struct Replay {
    pub(super) world: World,
    models: Vec<ModelId>,
    objects: Vec<ObjectId>,
    pairs: Vec<PairId>,
    pub(super) bodies: Vec<InterfaceId>,
    events: Vec<LoggedEvent>,
    next_event: usize,
    next_frame: u64,
    states: Vec<(InterfaceId, State)>,
    /// The pairs of a frame of which only some were committed.
    accepted: Vec<PairId>,
    pub(super) comparison: Comparison,
}

impl Replay {
    pub(super) fn new(log: &Log, options: &ReplayOptions<'_>) -> Result<Self, LogError> {
        let (world, models) = rebuild::world(log, options)?;
        let objects: Vec<ObjectId> = world.scene().objects().collect();
        let mut bodies = Vec::new();
        for object in &objects {
            bodies.extend(world.scene().interfaces(*object)?);
        }
        let mut events = log.events().to_vec();
        // The note of lost events is written later than the events would have been.
        events.sort_by_key(|event| event.frame);
        Ok(Self {
            comparison: Comparison::new(Capture::new(&world, false)?, bodies.clone(), options.tolerance),
            pairs: world.scene().pairs().map(|(pair, _)| pair).collect(),
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

    /// Obstacle to the exact replay of this frame and all after it.
    pub(super) fn obstacle(&mut self, row: &FrameRow) -> Option<Obstacle> {
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

    /// Applies everything up to the frame's evaluation.
    pub(super) fn run(&mut self, log: &Log, frame: &Frame) -> Result<(), LogError> {
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
            Event::SurfaceMotion { body, velocity, travel } => {
                let [linear_velocity, angular_velocity, belt_velocity] = *velocity;
                let [linear_travel, angular_travel, belt_travel] = *travel;
                let motion = SurfaceMotion {
                    linear_velocity,
                    angular_velocity,
                    belt_velocity,
                    linear_travel,
                    angular_travel,
                    belt_travel,
                };
                self.world.set_surface_motion(find(&self.bodies, *body, "movable group")?, &motion)?;
            }
            Event::Restore { file } => {
                let path = log.folder().join(file);
                if !is_inside(file) {
                    return Err(LogError::damaged(&path, "it leads out of the folder of the log"));
                }
                let block =
                    pong_model::files::read(&path).map_err(|reason| LogError::unreadable(&path, &reason))?;
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

    pub(super) fn accept(&mut self, row: &FrameRow) -> Result<(), LogError> {
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
