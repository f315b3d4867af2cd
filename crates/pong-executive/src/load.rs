//! Loads on bodies: constant, tabulated, or the caller's own function of time.

use crate::body::BodyId;
use crate::math::first_not_rising;
use pong_geometry::{Pose, Vec3, Wrench};
use serde::Deserialize;
use std::sync::Arc;

/// Axes along which a load is given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename = "AxesEntry")]
pub enum Axes {
    /// Axes of the common frame.
    #[default]
    Common,
    /// Axes of the body: the load turns with it.
    Body,
}

/// A force at a point of a body, and a moment.
#[derive(Clone, Debug)]
pub struct Load {
    /// The body.
    pub body: BodyId,
    /// Point at which the force acts, in the group frame, m. The moment is about this point.
    pub point: Vec3,
    /// Axes of force and moment.
    pub axes: Axes,
    /// Force and moment over time.
    pub history: LoadHistory,
}

/// A row of a table of loads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadRow {
    /// Time, s.
    pub time: f64,
    /// Force and moment at that time.
    pub wrench: Wrench,
}

/// A load over time.
#[derive(Clone)]
pub enum LoadHistory {
    /// Constant in time.
    Constant(Wrench),
    /// Linear interpolation between rows of rising times; constant before the first and after the last row.
    Table(Vec<LoadRow>),
    /// The caller's own function of time (s).
    Function(Arc<dyn Fn(f64) -> Wrench + Send + Sync>),
}

impl LoadHistory {
    /// Force and moment at a time.
    pub fn at(&self, time: f64) -> Wrench {
        match self {
            Self::Constant(wrench) => *wrench,
            Self::Table(rows) => interpolate(rows, time),
            Self::Function(function) => function(time),
        }
    }

    /// Cause and cure in one line, if the history cannot be used.
    pub fn fault(&self) -> Option<String> {
        let Self::Table(rows) = self else { return None };
        if rows.is_empty() {
            return Some("the table is empty; give at least one row".to_owned());
        }
        let late = first_not_rising(rows.iter().map(|row| row.time));
        late.map(|i| format!("row {i} is not later than the one before; give rising times"))
    }
}

impl std::fmt::Debug for LoadHistory {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Constant(wrench) => f.debug_tuple("Constant").field(wrench).finish(),
            Self::Table(rows) => f.debug_tuple("Table").field(rows).finish(),
            Self::Function(_) => f.write_str("Function"),
        }
    }
}

fn interpolate(rows: &[LoadRow], time: f64) -> Wrench {
    let next = rows.partition_point(|row| row.time <= time);
    if next == 0 {
        return rows[0].wrench;
    }
    let before = &rows[next - 1];
    let Some(after) = rows.get(next) else { return before.wrench };
    let share = (time - before.time) / (after.time - before.time);
    Wrench {
        force: before.wrench.force + (after.wrench.force - before.wrench.force) * share,
        moment: before.wrench.moment + (after.wrench.moment - before.wrench.moment) * share,
    }
}

impl Load {
    /// A constant force at the group's origin along the common axes.
    pub fn force(body: BodyId, force: Vec3) -> Self {
        let wrench = Wrench { force, moment: Vec3::zeros() };
        Self { body, point: Vec3::zeros(), axes: Axes::Common, history: LoadHistory::Constant(wrench) }
    }

    /// A force at the group's origin along the common axes that follows a function of time.
    pub fn force_over_time(body: BodyId, force: impl Fn(f64) -> Vec3 + Send + Sync + 'static) -> Self {
        let wrench = move |time| Wrench { force: force(time), moment: Vec3::zeros() };
        let history = LoadHistory::Function(Arc::new(wrench));
        Self { body, point: Vec3::zeros(), axes: Axes::Common, history }
    }

    /// The wrench about the group's origin along the common axes.
    pub(crate) fn wrench(&self, time: f64, pose: &Pose) -> Wrench {
        let given = self.history.at(time);
        let along_common = |v: Vec3| match self.axes {
            Axes::Common => v,
            Axes::Body => pose.orientation * v,
        };
        let mut wrench = Wrench::of_force_at(along_common(given.force), &(pose.orientation * self.point));
        wrench.moment += along_common(given.moment);
        wrench
    }
}
