//! A level: one setting of every lever.

use pong_executive::Integrator;
use pong_geometry::bounding::BoundKind;
use std::fmt::Write as _;
use strum::VariantArray;

/// Source of the bodies' motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// An integrator, driven by the wrenches.
    Integrated(Integrator),
    /// A log, with this number of its frames in one of the study.
    Logged(u32),
}

/// One setting of every lever. `None` or 0 leaves the setting of the scene and its models.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Steps in a frame: the step is frame / steps. For a log the number of its frames that the engine sees.
    pub steps_per_frame: u32,
    /// The integrator, or a log.
    pub motion: Motion,
    /// True if friction is left out of every surface.
    pub frictionless: bool,
    /// The scene's alternative whose models are taken.
    pub alternative: Option<String>,
    /// Kind of every bounding volume.
    pub bounds: Option<BoundKind>,
    /// Most elements of a leaf; the trees are rebuilt.
    pub leaf: Option<usize>,
    /// Workers beside the calling thread.
    pub workers: usize,
}

/// Setting that a study varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum Lever {
    /// The length of a step; for a log, the number of frames over which a wrench is held.
    Step,
    /// The integrator, including the hold of the wrench over a step and its substeps.
    Integrator,
    /// Friction as in the models, or none.
    Friction,
    /// Alternative models that the scene names.
    Alternatives,
    /// The kind of every bounding volume.
    Bounds,
    /// The number of elements in a leaf.
    Leaves,
    /// Workers.
    Workers,
    /// Long frames, whose contacts follow copies of the bodies, at every step; only on request.
    LongFrame,
}

impl Lever {
    /// All levers.
    pub const ALL: &'static [Self] = Self::VARIANTS;

    /// Levers of a study that names none: all but the one that is run on request.
    pub fn usual() -> Vec<Self> {
        Self::ALL.iter().copied().filter(|lever| *lever != Self::LongFrame).collect()
    }

    /// Its name in tables and on the command line.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// True if it may change the answer; the others change only the time, which is checked.
    pub fn changes_answers(self) -> bool {
        !matches!(self, Self::Bounds | Self::Leaves | Self::Workers)
    }
}

impl Level {
    /// The scene's models and one thread, with this number of steps in a frame.
    pub fn plain(motion: Motion, steps_per_frame: u32) -> Self {
        Self {
            steps_per_frame,
            motion,
            frictionless: false,
            alternative: None,
            bounds: None,
            leaf: None,
            workers: 0,
        }
    }

    /// Number of engine calls in a step; of a long frame, the least.
    pub fn calls_per_step(&self) -> u32 {
        match self.motion {
            Motion::Integrated(Integrator::RungeKutta4) => 4,
            // Eight substeps, the start, and the implicit step.
            Motion::Integrated(Integrator::LongFrame { .. }) => 12,
            Motion::Integrated(_) | Motion::Logged(_) => 1,
        }
    }

    /// Number of engine calls in a frame.
    pub fn calls_per_frame(&self) -> u64 {
        u64::from(self.calls_per_step()) * u64::from(self.steps_per_frame)
    }

    /// Settings other than step and integrator.
    pub fn settings(&self) -> Vec<(Lever, String)> {
        let mut settings = Vec::new();
        if self.frictionless {
            settings.push((Lever::Friction, "no friction".to_owned()));
        }
        settings.extend(self.alternative.clone().map(|name| (Lever::Alternatives, format!("`{name}`"))));
        settings.extend(self.bounds.as_ref().map(|kind| (Lever::Bounds, format!("{} bounds", kind.name()))));
        settings.extend(self.leaf.map(|most| (Lever::Leaves, format!("leaves of {most}"))));
        if self.workers > 0 {
            let workers = if self.workers == 1 { "1 worker" } else { &format!("{} workers", self.workers) };
            settings.push((Lever::Workers, workers.to_owned()));
        }
        settings
    }

    /// Its step in words.
    pub fn step_name(&self, frame_s: f64) -> String {
        match self.motion {
            Motion::Integrated(_) => seconds(frame_s / f64::from(self.steps_per_frame)),
            Motion::Logged(frames) => match frames / self.steps_per_frame {
                1 => "every frame".to_owned(),
                every => format!("1 frame of {every}"),
            },
        }
    }

    /// A name that is unique in a study.
    pub fn name(&self, frame_s: f64) -> String {
        let mut name = match self.motion {
            Motion::Integrated(integrator) => {
                format!("{}, {}", integrator_name(integrator), self.step_name(frame_s))
            }
            Motion::Logged(_) => self.step_name(frame_s),
        };
        self.settings().iter().for_each(|(_, setting)| {
            let _ = write!(name, ", {setting}");
        });
        name
    }
}

/// Short name of the source of motion.
pub fn motion_name(motion: Motion) -> String {
    match motion {
        Motion::Integrated(integrator) => integrator_name(integrator),
        Motion::Logged(_) => "log".to_owned(),
    }
}

/// Short name of an integrator, as in the scene format where that is short.
fn integrator_name(integrator: Integrator) -> String {
    match integrator {
        Integrator::SemiImplicitEuler => "Euler".to_owned(),
        Integrator::RungeKutta4 => "RK4".to_owned(),
        Integrator::ZeroOrderHold { substeps, delay_frames: 0 } => format!("hold/{substeps}"),
        Integrator::ZeroOrderHold { substeps, delay_frames } => {
            format!("hold/{substeps} late {delay_frames}")
        }
        Integrator::LongFrame { delay_frames: 0, .. } => "long".to_owned(),
        Integrator::LongFrame { delay_frames, .. } => format!("long late {delay_frames}"),
    }
}

/// A time in s, ms or µs, with as many digits as it has, six at most.
pub fn seconds(time_s: f64) -> String {
    let (value, unit) = match time_s.abs() {
        t if t >= 1.0 => (time_s, "s"),
        t if t >= 1e-3 => (time_s * 1e3, "ms"),
        _ => (time_s * 1e6, "µs"),
    };
    let text = format!("{value:.6}");
    let digits = 7 + usize::from(text.starts_with('-'));
    let short = if text.find('.').unwrap_or(0) >= digits { &text } else { &text[..digits.min(text.len())] };
    format!("{} {unit}", short.trim_end_matches('0').trim_end_matches('.'))
}
