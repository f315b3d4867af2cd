//! Measured data in memory.

use pong_geometry::{Pose, Quat, Twist, Vec3};

/// Measured quantities of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Place of the group's origin, m.
    Position,
    /// Orientation; differences are rotation vectors, rad.
    Rotation,
    /// Velocity of the group's origin, m/s.
    Velocity,
    /// Angular velocity, rad/s.
    AngularVelocity,
    /// Contact force, N.
    Force,
    /// Contact moment about the group's origin, N·m.
    Moment,
}

impl Quantity {
    /// All quantities.
    pub const ALL: [Self; 6] =
        [Self::Position, Self::Rotation, Self::Velocity, Self::AngularVelocity, Self::Force, Self::Moment];

    /// Name, as in the data file.
    pub fn name(self) -> &'static str {
        ["position", "rotation", "velocity", "angular_velocity", "force", "moment"][self as usize]
    }

    /// Unit of values and noise.
    pub fn unit(self) -> &'static str {
        ["m", "rad", "m/s", "rad/s", "N", "N·m"][self as usize]
    }
}

/// Measurement of a body at a time. Quantities that were not measured are `None`.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Index of its time in [`Record::times`].
    pub time: usize,
    /// Body.
    pub body: String,
    /// Place of the group's origin in the common frame, m.
    pub position: Option<Vec3>,
    /// Rotation from the group to the common frame.
    pub orientation: Option<Quat>,
    /// Velocity of the group's origin along the common axes, m/s.
    pub velocity: Option<Vec3>,
    /// Angular velocity along the common axes, rad/s.
    pub angular_velocity: Option<Vec3>,
    /// Contact force along the common axes, N.
    pub force: Option<Vec3>,
    /// Contact moment about the group's origin along the common axes, N·m.
    pub moment: Option<Vec3>,
}

impl Row {
    /// A quantity as a vector; `None` if it was not measured, and for the orientation.
    pub fn vector(&self, quantity: Quantity) -> Option<Vec3> {
        match quantity {
            Quantity::Position => self.position,
            Quantity::Rotation => None,
            Quantity::Velocity => self.velocity,
            Quantity::AngularVelocity => self.angular_velocity,
            Quantity::Force => self.force,
            Quantity::Moment => self.moment,
        }
    }

    /// True if the quantity was measured.
    pub fn has(&self, quantity: Quantity) -> bool {
        match quantity {
            Quantity::Rotation => self.orientation.is_some(),
            other => self.vector(other).is_some(),
        }
    }

    /// Pose and twist, if the whole pose was measured; velocities that were not are zero.
    pub fn start(&self) -> Option<(Pose, Twist)> {
        let pose = Pose { position: self.position?, orientation: self.orientation? };
        let linear = self.velocity.unwrap_or_default();
        Some((pose, Twist { linear, angular: self.angular_velocity.unwrap_or_default() }))
    }
}

/// One experiment: a toss, an impact, a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// Name.
    pub name: String,
    /// Times, s, increasing.
    pub times: Vec<f64>,
    /// Measurements, by time.
    pub rows: Vec<Row>,
}

impl Record {
    /// This record from a time after its start, s, and up to a time after that; `None` if less than two times
    /// are left.
    pub fn window(&self, from: f64, horizon: Option<f64>) -> Option<Self> {
        let begin = self.times.first()? + from;
        let first = self.times.iter().position(|time| *time >= begin - 1e-9)?;
        let end = self.times[first] + horizon.unwrap_or(f64::INFINITY) + 1e-9;
        let last = self.times.iter().rposition(|time| *time <= end)?;
        let within = |row: &&Row| (first..=last).contains(&row.time);
        let rows = self.rows.iter().filter(within).cloned().map(|row| Row { time: row.time - first, ..row });
        let cut = Self {
            name: self.name.clone(),
            times: self.times.get(first..=last)?.to_vec(),
            rows: rows.collect(),
        };
        (cut.times.len() >= 2).then_some(cut)
    }
}

/// Standard deviation of each quantity's noise along an axis, in the unit of the quantity; `None` where it is
/// not known.
pub type Noise = [Option<f64>; 6];

/// Measured data.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Data {
    /// The records, in the order of the file.
    pub records: Vec<Record>,
    /// Noise of the sensors, in the order of [`Quantity::ALL`] and in their units.
    pub noise: Noise,
    /// True if the file gave angular velocities along the axes of the body; they are turned when read.
    pub along_body: bool,
}
