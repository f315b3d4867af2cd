//! Choice of the levels to run.

use crate::sweep::level::{Level, Lever, Motion};
use crate::sweep::open_loop::LoggedRun;
use crate::sweep::run::Frames;
use crate::{Result, StudyError};
use pong_executive::Integrator;
use pong_executive::scene::Scene;
use pong_geometry::bounding::BoundKind;

/// Most rows of a record's grid, over all bodies: 40 MiB.
const GRID_ROWS: u64 = 400_000;

/// Most steps of a frame.
const STEPS_MAX: f64 = 1e6;

/// Long frames as a level.
const LONG_FRAME: Integrator = Integrator::LongFrame { substeps_max: 20_000, delay_frames: 0 };

/// The plan of a study.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The frames.
    pub frames: Frames,
    /// The levels of step and integrator: every step with every integrator.
    pub grid: Vec<Level>,
    /// Index of the level that is the scene as written, or nearest to it.
    pub base: usize,
    /// Most steps of a frame in the grid.
    pub finest: u32,
}

/// Settings of a plan.
#[derive(Clone, Debug)]
pub struct PlanSettings {
    /// Length of a frame, s; `None` for 16 steps of the scene, less if the scene is short.
    pub frame_s: Option<f64>,
    /// Number of halvings of the frame for the shortest step; `None` down to half the scene's own step.
    pub halvings: Option<u32>,
    /// Duration, s; `None` for the scene's.
    pub duration_s: Option<f64>,
    /// Levers to vary.
    pub levers: Vec<Lever>,
    /// Leaf sizes to try, in elements.
    pub leaves: Vec<usize>,
    /// Numbers of workers to try.
    pub workers: Vec<usize>,
}

impl Default for PlanSettings {
    fn default() -> Self {
        Self {
            frame_s: None,
            halvings: None,
            duration_s: None,
            levers: Lever::usual(),
            leaves: vec![8, 32, 128],
            workers: vec![1],
        }
    }
}

impl Plan {
    /// The plan for a scene with this number of bodies.
    ///
    /// # Errors
    ///
    /// `--duration` or `--frame` that is no finite time above zero, no frame in the duration, or too many
    /// steps in a frame.
    pub fn new(scene: &Scene, bodies: usize, settings: &PlanSettings) -> Result<Self> {
        let duration = settings.duration_s.unwrap_or(scene.duration());
        check("--duration", duration)?;
        let frame_s = settings.frame_s.unwrap_or_else(|| frame(scene.step(), duration));
        check("--frame", frame_s)?;
        let count = libm::round(duration / frame_s);
        if count < 1.0 {
            let line = format!("{duration} s hold no frame of {frame_s} s; give a shorter --frame");
            return Err(StudyError::new("frame", line));
        }
        // Power of two of steps in a frame nearest to the scene's own step.
        let own = libm::exp2(libm::round(libm::log2(frame_s / scene.step())).max(0.0));
        let finest = settings.halvings.map_or(2.0 * own, |halvings| libm::exp2(f64::from(halvings)));
        if finest > STEPS_MAX {
            let line = format!(
                "{finest:e} steps in a frame of {frame_s} s; give a shorter --frame or fewer --halvings"
            );
            return Err(StudyError::new("steps", line));
        }
        let finest = finest as u32;
        let pulls = |lever| settings.levers.contains(&lever);
        let steps = if pulls(Lever::Step) { halvings(finest) } else { vec![(own as u32).min(finest)] };
        let mut integrators = integrators(scene.integrator(), pulls(Lever::Integrator));
        if pulls(Lever::LongFrame) && !integrators.contains(&LONG_FRAME) {
            integrators.push(LONG_FRAME);
        }
        let grid: Vec<Level> = integrators
            .iter()
            .flat_map(|integrator| {
                steps.iter().map(|steps| Level::plain(Motion::Integrated(*integrator), *steps))
            })
            .collect();
        let base = Level::plain(Motion::Integrated(scene.integrator()), (own as u32).min(finest));
        let base = grid.iter().position(|level| *level == base).unwrap_or(0);
        let instants = instants(count as u64, bodies, finest);
        let frames = Frames { frame_s, count: count as u64, instants };
        Ok(Self { frames, grid, base, finest })
    }

    /// The plan for a log: the engine sees every frame, every second, … .
    pub(crate) fn of_log(log: &mut LoggedRun, settings: &PlanSettings) -> Result<Self> {
        let halvings = settings.halvings.unwrap_or(3).min(16);
        let finest = 1_u32 << halvings;
        let frames = log.frames(finest)?;
        let steps =
            if settings.levers.contains(&Lever::Step) { self::halvings(finest) } else { vec![finest] };
        let grid: Vec<Level> =
            steps.iter().rev().map(|steps| Level::plain(Motion::Logged(finest), *steps)).collect();
        Ok(Self { frames, grid, base: 0, finest })
    }

    /// Levels that differ from a level of the grid in one further lever.
    pub fn around(
        &self,
        anchor: &Level,
        alternatives: &[String],
        settings: &PlanSettings,
    ) -> Vec<(Lever, Level)> {
        let mut levels = Vec::new();
        let mut add = |lever: Lever, change: &dyn Fn(&mut Level)| {
            if settings.levers.contains(&lever) {
                let mut level = anchor.clone();
                change(&mut level);
                levels.push((lever, level));
            }
        };
        add(Lever::Friction, &|level| level.frictionless = true);
        for name in alternatives {
            add(Lever::Alternatives, &|level| level.alternative = Some(name.clone()));
        }
        for kind in [BoundKind::Aabb, BoundKind::Sphere, BoundKind::Obb] {
            add(Lever::Bounds, &|level| level.bounds = Some(kind.clone()));
        }
        for most in &settings.leaves {
            add(Lever::Leaves, &|level| level.leaf = Some(*most));
        }
        for workers in settings.workers.iter().filter(|workers| **workers > 0) {
            add(Lever::Workers, &|level| level.workers = *workers);
        }
        levels
    }
}

fn check(name: &str, time_s: f64) -> Result<()> {
    if time_s > 0.0 && time_s.is_finite() {
        return Ok(());
    }
    Err(StudyError::new(name, format!("it is {time_s} s; give a finite time above zero")))
}

/// Length of a frame: sixteen steps, or fewer so that a run has sixty-four frames.
fn frame(step: f64, duration: f64) -> f64 {
    let mut steps = 16.0;
    while steps > 1.0 && duration / (steps * step) < 64.0 {
        steps *= 0.5;
    }
    steps * step
}

/// Powers of two: 1, 2, 4 … up to the finest.
fn halvings(finest: u32) -> Vec<u32> {
    let doubled = |steps: &u32| steps.checked_mul(2);
    std::iter::successors(Some(1_u32), doubled).take_while(|steps| *steps <= finest).collect()
}

fn integrators(own: Integrator, all: bool) -> Vec<Integrator> {
    let mut integrators = vec![own];
    let others = [
        Integrator::RungeKutta4,
        Integrator::SemiImplicitEuler,
        Integrator::ZeroOrderHold { substeps: 1, delay_frames: 0 },
        Integrator::ZeroOrderHold { substeps: 4, delay_frames: 0 },
    ];
    for other in others.into_iter().filter(|other| all && *other != own) {
        integrators.push(other);
    }
    integrators
}

/// Instants in a frame of the finest grid that is not too large to keep.
fn instants(frames: u64, bodies: usize, finest: u32) -> u32 {
    let fits = |instants: &u32| frames * u64::from(*instants) * bodies as u64 <= GRID_ROWS;
    halvings(finest).into_iter().rev().find(fits).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_halved_down_to_the_finest() {
        assert_eq!(halvings(1), [1]);
        assert_eq!(halvings(16), [1, 2, 4, 8, 16]);
        assert_eq!(frame(1e-4, 1.0), 16.0 * 1e-4);
        assert_eq!(frame(1e-3, 0.3), 4.0 * 1e-3);
        assert_eq!(frame(0.1, 0.1), 0.1);
        assert_eq!(instants(1000, 2, 64), 64);
        assert_eq!(instants(100_000, 2, 64), 2);
        assert_eq!(instants(1_000_000, 10, 64), 1);
    }
}
