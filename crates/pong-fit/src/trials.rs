//! Residuals of records: measured minus computed, in standard deviations of the sensor.

use crate::batch::{Batch, Case, Sample};
use crate::data::{Quantity, Record};
use crate::error::{FitError, Result};
use crate::settings::{Scale, Starts};
use crate::solve::{Point, Residuals};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Pose, Quat, Twist, Vec3};

/// Unknowns of the start of a body: position, rotation vector, velocity, angular velocity.
const START_NUMBERS: usize = 12;

/// Scales of the unknowns of a start where the data have no noise for them: m, rad, m/s, rad/s.
const START_SCALES: [f64; 4] = [1e-3, 1e-2, 0.1, 1.0];

/// Difference for derivatives by an unknown of a start, in its scale.
pub(crate) const START_STEP: f64 = 0.2;

/// A record with what a run of it needs.
pub(crate) struct Trial {
    pub record: Record,
    /// Start of each body of the batch, as measured; `None` for that of the scene.
    starts: Vec<Option<(Pose, Twist)>>,
    /// Bodies of the batch whose start is unknown.
    unknown: Vec<usize>,
    /// Body of the batch of each row of the record.
    bodies: Vec<usize>,
    /// First time, by its index, whose rows count.
    pub counts_from: usize,
}

impl Trial {
    /// # Errors
    /// A record that does not say where its bodies start, or names a body that is not there.
    pub fn new(record: Record, batch: &Batch, starts: Starts, counts_from: usize) -> Result<Self> {
        let names = batch.bodies();
        let place = |row: &crate::data::Row| {
            let found = names.iter().position(|known| *known == row.body);
            found.ok_or_else(|| {
                let cause = format!("there is no body `{}`", row.body);
                FitError::new(
                    format!("record `{}`", record.name),
                    cause,
                    format!("name one of: {}", names.join(", ")),
                )
            })
        };
        let bodies: Vec<usize> = record.rows.iter().map(place).collect::<Result<_>>()?;
        let mut trial =
            Self { starts: vec![None; names.len()], unknown: Vec::new(), bodies, record, counts_from };
        for (body, name) in names.iter().enumerate() {
            let rows: Vec<usize> = (0..trial.bodies.len()).filter(|row| trial.bodies[*row] == body).collect();
            if let [first, rest @ ..] = rows.as_slice() {
                trial.start_of(body, name, *first, rest.first().copied(), starts)?;
            }
        }
        Ok(trial)
    }

    fn start_of(
        &mut self,
        body: usize,
        name: &str,
        first: usize,
        second: Option<usize>,
        starts: Starts,
    ) -> Result<()> {
        let thing = || format!("record `{}`, body `{name}`", self.record.name);
        let row = &self.record.rows[first];
        let Some((pose, mut twist)) = row.start().filter(|_| row.time == 0) else {
            let cause = "the first time of the record has no whole pose of the body";
            let cure = "give position and orientation there, or begin the record later (`from`)";
            return Err(FitError::new(thing(), cause, cure));
        };
        if row.velocity.is_none() || row.angular_velocity.is_none() {
            if starts == Starts::Measured {
                let cause = "its velocity or angular velocity at the start is not measured";
                return Err(FitError::new(thing(), cause, "measure them, or let starts be fitted"));
            }
            if let Some(next) = second.map(|second| &self.record.rows[second]) {
                let dt = self.record.times[next.time] - self.record.times[row.time];
                if let (None, Some(p)) = (row.velocity, next.position) {
                    twist.linear = (p - pose.position) / dt;
                }
                if let (None, Some(q)) = (row.angular_velocity, next.orientation) {
                    twist.angular = rotation_vector(&(q * pose.orientation.inverse())) / dt;
                }
            }
        }
        self.starts[body] = Some((pose, twist));
        if starts == Starts::Fitted {
            self.unknown.push(body);
        }
        Ok(())
    }

    /// Number of unknowns of the start.
    pub fn unknowns(&self) -> usize {
        START_NUMBERS * self.unknown.len()
    }

    /// Numbers of the rows that count.
    fn counted(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.record.rows.len()).filter(|row| self.record.rows[*row].time >= self.counts_from)
    }
}

/// Records of one scene.
pub(crate) struct Trials {
    pub batch: Batch,
    pub trials: Vec<Trial>,
    pub scales: Vec<Scale>,
    /// Noise of each quantity, in its unit; `None` for quantities that do not count.
    pub noise: [Option<f64>; 6],
    /// Number of runs for residuals so far.
    pub runs: u64,
}

impl Trials {
    /// Values of the parameters at a point of the search.
    pub fn values(&self, z: &[f64]) -> Vec<f64> {
        z.iter().zip(&self.scales).map(|(z, scale)| scale.to_value(*z)).collect()
    }

    /// The run of a record at a point.
    pub fn case(&self, point: &Point) -> Case {
        let trial = &self.trials[point.record];
        let mut starts = trial.starts.clone();
        for (body, change) in trial.unknown.iter().zip(point.start.chunks(START_NUMBERS)) {
            if let Some((pose, twist)) = &mut starts[*body] {
                let part = |kind: usize| {
                    let scale = self.noise[kind].unwrap_or(START_SCALES[kind]);
                    Vec3::from_column_slice(&change[3 * kind..3 * kind + 3]) * scale
                };
                pose.position += part(0);
                pose.orientation =
                    Quat::new_normalize((Quat::from_scaled_axis(part(1)) * pose.orientation).into_inner());
                twist.linear += part(2);
                twist.angular += part(3);
            }
        }
        Case { values: self.values(&point.z), starts, times: trial.record.times.clone() }
    }

    /// Differences of measured and computed quantities of a record in their units, with the quantity of each.
    pub fn differences(&self, record: usize, samples: &[Sample]) -> Vec<(Quantity, Vec3)> {
        let trial = &self.trials[record];
        let width = self.batch.bodies().len();
        let mut all = Vec::new();
        for number in trial.counted() {
            let row = &trial.record.rows[number];
            let sample = &samples[row.time * width + trial.bodies[number]];
            for quantity in Quantity::ALL {
                if self.noise[quantity as usize].is_some()
                    && let Some(difference) = difference(quantity, row, sample)
                {
                    all.push((quantity, difference));
                }
            }
        }
        all
    }

    /// Largest contact force on any measured body of each point, N; `None` where the run failed.
    pub fn peaks(&mut self, points: &[Point]) -> Vec<Option<f64>> {
        let cases: Vec<Case> = points.iter().map(|point| self.case(point)).collect();
        let measured = |point: &Point| self.trials[point.record].bodies.clone();
        let measured: Vec<Vec<usize>> = points.iter().map(measured).collect();
        let outcomes = self.batch.run(&cases);
        let peak = |(outcome, bodies): (Result<crate::Outcome>, &Vec<usize>)| {
            let outcome = outcome.ok()?;
            Some(bodies.iter().map(|body| outcome.peak_force[*body]).fold(0.0, f64::max))
        };
        outcomes.into_iter().zip(&measured).map(peak).collect()
    }

    /// Reason why the run of a record at a point fails; `None` if it does not fail.
    pub fn failure(&mut self, point: &Point) -> Option<String> {
        let case = self.case(point);
        self.batch.run(&[case]).pop()?.err().map(|error| error.0)
    }
}

impl Residuals for Trials {
    fn of(&mut self, points: &[Point]) -> Vec<Option<Vec<f64>>> {
        let cases: Vec<Case> = points.iter().map(|point| self.case(point)).collect();
        self.runs += cases.len() as u64;
        let outcomes = self.batch.run(&cases);
        let residuals = |(point, outcome): (&Point, Result<crate::Outcome>)| {
            let differences = self.differences(point.record, &outcome.ok()?.samples);
            let weighted = differences.into_iter().flat_map(|(quantity, difference)| {
                let noise = self.noise[quantity as usize].unwrap_or(1.0);
                <[f64; 3]>::from(difference / noise)
            });
            Some(weighted.collect())
        };
        points.iter().zip(outcomes).map(residuals).collect()
    }
}

fn difference(quantity: Quantity, row: &crate::data::Row, sample: &Sample) -> Option<Vec3> {
    let computed = match quantity {
        Quantity::Rotation => {
            return row
                .orientation
                .map(|measured| rotation_vector(&(sample.pose.orientation * measured.inverse())));
        }
        Quantity::Position => sample.pose.position,
        Quantity::Velocity => sample.twist.linear,
        Quantity::AngularVelocity => sample.twist.angular,
        Quantity::Force => sample.wrench.force,
        Quantity::Moment => sample.wrench.moment,
    };
    row.vector(quantity).map(|measured| computed - measured)
}
