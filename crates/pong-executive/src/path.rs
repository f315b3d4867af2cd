//! Prescribed motion: pose and twist for every time.

use crate::math::{body_rate_of_rotation_vector, first_not_rising, inverse_body_rate, rotation};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Quat, Twist, Vec3};
use std::sync::Arc;

/// Pose and twist as a function of time (s).
pub type PathFunction = Arc<dyn Fn(f64) -> (Pose, Twist) + Send + Sync>;

/// Path of a prescribed body.
#[derive(Clone)]
pub enum Path {
    /// Constant velocities along the common axes from a pose at t = 0.
    ConstantTwist {
        /// Pose at t = 0.
        pose: Pose,
        /// The constant twist.
        twist: Twist,
    },
    /// Constant velocities from a pose at a given time: for a body that the host moves itself
    /// ([`Simulation::lead`](crate::Simulation::lead)).
    Led {
        /// The time of the pose, s.
        since: f64,
        /// Pose at that time.
        pose: Pose,
        /// The twist from then on.
        twist: Twist,
    },
    /// Interpolation of given poses.
    Table(PathTable),
    /// Harmonic motion.
    Oscillation(Oscillation),
    /// The caller's own function; the twist must be the derivative of the pose.
    Function(PathFunction),
}

/// Harmonic motion along or about an axis: s(t) = amplitude·sin(2π·frequency·t + phase).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Oscillation {
    /// Pose at s = 0.
    pub pose: Pose,
    /// Unit axis, in the common frame; a rotation is about it, through the group's origin.
    pub axis: Vec3,
    /// Amplitude along the axis, m.
    pub travel: f64,
    /// Amplitude about the axis, rad.
    pub angle: f64,
    /// Frequency, Hz.
    pub frequency: f64,
    /// Phase at t = 0, rad.
    pub phase: f64,
}

/// One pose of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathRow {
    /// Time, s.
    pub time: f64,
    /// Pose at that time.
    pub pose: Pose,
}

/// Poses at rising times, joined smoothly: position and rotation vector (counted from the row before) are cubic
/// Hermite curves, with the velocities at the rows from their neighbours. Velocities are continuous between the
/// first and the last row; before and after them the body stands still.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTable {
    rows: Vec<Knot>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    time: f64,
    pose: Pose,
    velocity: Vec3,
    /// Angular velocity along the axes of the body at this row.
    spin_b: Vec3,
}

impl Path {
    /// Pose and twist at a time.
    pub fn at(&self, time: f64) -> (Pose, Twist) {
        match self {
            Self::ConstantTwist { pose, twist } => (along(pose, twist, time), *twist),
            // At its own time the pose exactly as given: a product with the identity could round.
            Self::Led { since, pose, twist } if *since == time => (*pose, *twist),
            Self::Led { since, pose, twist } => (along(pose, twist, time - since), *twist),
            Self::Table(table) => table.at(time),
            Self::Oscillation(oscillation) => oscillation.at(time),
            Self::Function(function) => function(time),
        }
    }
}

/// Returns a pose moved with constant velocities for a time.
fn along(pose: &Pose, twist: &Twist, time: f64) -> Pose {
    let position = pose.position + twist.linear * time;
    let orientation = rotation(&(twist.angular * time)) * pose.orientation;
    Pose { position, orientation }
}

impl std::fmt::Debug for Path {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::ConstantTwist { pose, twist } => {
                f.debug_struct("ConstantTwist").field("pose", pose).field("twist", twist).finish()
            }
            Self::Led { since, pose, twist } => {
                let mut text = f.debug_struct("Led");
                text.field("since", since).field("pose", pose).field("twist", twist).finish()
            }
            Self::Table(table) => table.fmt(f),
            Self::Oscillation(oscillation) => oscillation.fmt(f),
            Self::Function(_) => f.write_str("Function"),
        }
    }
}

impl Oscillation {
    fn at(&self, time: f64) -> (Pose, Twist) {
        let rate = 2.0 * std::f64::consts::PI * self.frequency;
        let (sine, cosine) = libm::sincos(rate * time + self.phase);
        let turn = rotation(&(self.axis * (self.angle * sine)));
        let pose = Pose {
            position: self.pose.position + self.axis * (self.travel * sine),
            orientation: turn * self.pose.orientation,
        };
        let twist = Twist {
            linear: self.axis * (self.travel * rate * cosine),
            angular: self.axis * (self.angle * rate * cosine),
        };
        (pose, twist)
    }
}

impl PathTable {
    /// A table of at least two rows at rising times.
    ///
    /// # Errors
    /// Cause and cure as one line.
    pub fn new(rows: &[PathRow]) -> Result<Self, String> {
        if rows.len() < 2 {
            return Err(format!("the table has {} row(s); give at least two", rows.len()));
        }
        if let Some(index) = first_not_rising(rows.iter().map(|row| row.time)) {
            return Err(format!("row {index} is not later than the one before; give rising times"));
        }
        let slopes: Vec<Slope> = rows.windows(2).map(|pair| Slope::between(&pair[0], &pair[1])).collect();
        let knot = |(index, row): (usize, &PathRow)| {
            let before = index.checked_sub(1).map(|i| slopes[i]);
            let rate = Slope::at_row(before, slopes.get(index).copied());
            Knot { time: row.time, pose: row.pose, velocity: rate.linear, spin_b: rate.angular }
        };
        Ok(Self { rows: rows.iter().enumerate().map(knot).collect() })
    }

    fn at(&self, time: f64) -> (Pose, Twist) {
        let (first, last) = (&self.rows[0], &self.rows[self.rows.len() - 1]);
        if time < first.time {
            return (first.pose, Twist::zero());
        }
        if time > last.time {
            return (last.pose, Twist::zero());
        }
        let next = self.rows.partition_point(|row| row.time <= time).min(self.rows.len() - 1);
        between(&self.rows[next - 1], &self.rows[next], time)
    }
}

/// Mean velocity over an interval. The angular velocity is a rotation vector per time, whose components are
/// the same along the axes of the body at either end.
#[derive(Clone, Copy)]
struct Slope {
    duration: f64,
    linear: Vec3,
    angular: Vec3,
}

impl Slope {
    fn between(from: &PathRow, to: &PathRow) -> Self {
        let duration = to.time - from.time;
        Self {
            duration,
            linear: (to.pose.position - from.pose.position) / duration,
            angular: turn_between(&from.pose.orientation, &to.pose.orientation) / duration,
        }
    }

    /// Slope of the parabola through three rows; at an end, that of the only interval.
    fn at_row(before: Option<Self>, after: Option<Self>) -> Self {
        match (before, after) {
            (Some(a), Some(b)) => {
                let total = a.duration + b.duration;
                let mean = |x: Vec3, y: Vec3| (x * b.duration + y * a.duration) / total;
                Self {
                    duration: total,
                    linear: mean(a.linear, b.linear),
                    angular: mean(a.angular, b.angular),
                }
            }
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => Self { duration: 1.0, linear: Vec3::zeros(), angular: Vec3::zeros() },
        }
    }
}

/// Rotation vector from one orientation to another, along the axes of the body.
fn turn_between(from: &Quat, to: &Quat) -> Vec3 {
    rotation_vector(&(from.inverse() * to))
}

fn between(a: &Knot, b: &Knot, time: f64) -> (Pose, Twist) {
    let h = b.time - a.time;
    let curve = Hermite::new((time - a.time) / h, h);
    let travel = b.pose.position - a.pose.position;
    let turn = turn_between(&a.pose.orientation, &b.pose.orientation);
    let end_rate = inverse_body_rate(&turn) * b.spin_b;
    let theta = curve.value(&turn, &a.spin_b, &end_rate);
    let theta_rate = curve.rate(&turn, &a.spin_b, &end_rate);
    let orientation = a.pose.orientation * rotation(&theta);
    let pose =
        Pose { position: a.pose.position + curve.value(&travel, &a.velocity, &b.velocity), orientation };
    let twist = Twist {
        linear: curve.rate(&travel, &a.velocity, &b.velocity),
        angular: orientation * (body_rate_of_rotation_vector(&theta) * theta_rate),
    };
    (pose, twist)
}

/// Weights of a cubic that starts at zero.
struct Hermite {
    /// Weights of the end value, the first rate and the last rate.
    values: [f64; 3],
    rates: [f64; 3],
}

impl Hermite {
    fn new(u: f64, h: f64) -> Self {
        let v = 1.0 - u;
        Self {
            values: [u * u * (3.0 - 2.0 * u), h * u * v * v, -h * u * u * v],
            rates: [6.0 * u * v / h, v * (v - 2.0 * u), u * (u - 2.0 * v)],
        }
    }

    fn value(&self, end: &Vec3, rate0: &Vec3, rate1: &Vec3) -> Vec3 {
        end * self.values[0] + rate0 * self.values[1] + rate1 * self.values[2]
    }

    fn rate(&self, end: &Vec3, rate0: &Vec3, rate1: &Vec3) -> Vec3 {
        end * self.rates[0] + rate0 * self.rates[1] + rate1 * self.rates[2]
    }
}
