//! World whose interface is computed: a scene at a state, or a frame of a log.

use super::arguments::Arguments;
use crate::modes::state;
use crate::terminal::Failure;
use crate::text::{count, number};
use pong_engine::{InterfaceId, World};
use pong_executive::scene::{BuiltScene, Scene};
use pong_record::{Log, Obstacle, ReplayOptions, world_at};

/// A world in the state of the interface.
pub(super) enum State {
    /// A scene that was run, with a description of its state.
    Scene(Box<BuiltScene>, String),
    /// A frame of a log, with name, time (s), and the reason why its contact state is not exact.
    Log(Box<World>, String, f64, Option<Obstacle>),
}

/// A set of movable groups.
pub(super) struct Groups {
    pub ids: Vec<InterfaceId>,
    pub names: Vec<String>,
}

impl State {
    /// The world, evaluated and not committed.
    pub fn world(&mut self) -> Result<&mut World, Failure> {
        let world = match self {
            Self::Scene(built, _) => built.simulation.world_mut(),
            Self::Log(world, ..) => world,
        };
        world.evaluate()?;
        Ok(world)
    }

    /// Name and state.
    pub fn description(&self) -> String {
        match self {
            Self::Scene(built, state) => format!("{}, {state}", built.name),
            Self::Log(_, name, time, _) => format!("{name}, at t = {} s", number(*time)),
        }
    }

    /// Statements about the state and about springs between two sets.
    pub fn notes(&self, sets: [&[String]; 2]) -> Vec<String> {
        match self {
            Self::Log(_, _, _, obstacle) => {
                obstacle.iter().map(|obstacle| format!("friction is not exact: {obstacle}")).collect()
            }
            Self::Scene(built, _) => {
                let name_of = |end: &pong_executive::SpringEnd| {
                    let mut bodies = built.simulation.bodies();
                    bodies.find(|(body, _)| end.body == Some(*body)).map(|(_, body)| &body.name)
                };
                let is_between = |spring: &&pong_executive::Spring| {
                    let ends = [name_of(&spring.first), name_of(&spring.second)];
                    let is_in =
                        |end: usize, set: usize| ends[end].is_some_and(|name| sets[set].contains(name));
                    (is_in(0, 0) && is_in(1, 1)) || (is_in(0, 1) && is_in(1, 0))
                };
                let springs = built.simulation.springs().iter().filter(is_between).count();
                let text = || {
                    format!(
                        "{} of the scene between the sets: not in the interface, which is of contacts",
                        count(springs, "spring", "springs")
                    )
                };
                (springs > 0).then(text).into_iter().collect()
            }
        }
    }
}

/// Reads the scene or the log and goes to the state.
pub(super) fn read(arguments: &Arguments) -> Result<State, Failure> {
    if !arguments.source.is_dir() {
        let scene = Scene::load(&arguments.source)?;
        let mut built = scene.with_extensions(arguments.allowed.extensions()).build()?;
        let description = state::reach(&arguments.state, &mut built)?;
        return Ok(State::Scene(Box::new(built), description));
    }
    if arguments.state.settle {
        return Err("--settle: a log does not move; give --at, or nothing for its last frame".into());
    }
    let mut log = Log::open(&arguments.source)?;
    let rows = log.frame_rows(0, log.frame_count())?;
    let from = arguments.state.at.unwrap_or(f64::INFINITY);
    let index = rows.iter().position(|row| row.time >= from).unwrap_or(rows.len().saturating_sub(1));
    let time = rows.get(index).map_or(0.0, |row| row.time);
    let options = ReplayOptions { extensions: arguments.allowed.extensions(), ..ReplayOptions::default() };
    let (world, obstacle) = world_at(&mut log, options, index as u64)?;
    Ok(State::Log(Box::new(world), log.run().name.clone(), time, obstacle))
}

/// Movable groups by their names in scenes and logs, in the order of the names.
pub(super) fn groups(world: &World, names: &[String], option: &str) -> Result<Groups, Failure> {
    let scene = world.scene();
    let mut known = Vec::new();
    for object in scene.objects() {
        for group in scene.interfaces(object)? {
            known.push((group, scene.group_name(group)?));
        }
    }
    let mut found = Groups { ids: Vec::new(), names: Vec::new() };
    for name in names {
        let is_named = |known: &str| match name.strip_suffix('*') {
            Some(beginning) => known.starts_with(beginning),
            None => known == name,
        };
        let before = found.ids.len();
        for (group, name) in known
            .iter()
            .filter(|(group, known)| is_named(known) && !found.ids.contains(group))
            .cloned()
            .collect::<Vec<_>>()
        {
            found.ids.push(group);
            found.names.push(name);
        }
        if found.ids.len() == before {
            let known: Vec<&str> = known.iter().map(|(_, name)| name.as_str()).collect();
            return Err(
                format!("{option}: there is no other body `{name}`; there are {}", known.join(", ")).into()
            );
        }
    }
    Ok(found)
}
