//! Checks of measured data by the kinematics that they must obey: gaps, units, order and direction of
//! quaternions, axes of angular velocities.
//!
//! A pose, a velocity and an angular velocity are three measurements of one motion. Integrated over an
//! interval the last two must give the change of the first. Contacts disturb few of the intervals, so the
//! median over all of them judges.

use super::interval::{Checked, Interval, intervals, median};
use super::readings::{CLEARLY, Reading, orientations, readings};
use super::record::{Data, Quantity, Record, Row};
use crate::error::Result;
use crate::probe::Probe;
use pong_executive::scene::Scene;
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Quat, Vec3};

/// Interval from which on a gap is noted, in median intervals of its record.
const GAP: f64 = 2.5;

/// Relative distance of a ratio from a ratio of units at which the unit counts as found.
const UNIT_TOLERANCE: f64 = 0.08;

/// Rotation within an interval, rad, above which the interval can tell axes and orders apart.
const TURNS: f64 = 5e-3;

/// Number of intervals that are needed for a judgement.
const ENOUGH: usize = 8;

/// Number of records whose first fall is enough to refuse a unit.
const FALLS: usize = 4;

/// Share of the rotation in an interval from which on a miss that no reading explains is noted.
const MISSES: f64 = 0.5;

/// Checks data of a scene.
///
/// # Errors
/// A scene that cannot be built.
pub fn check(data: &Data, scene: &Scene) -> Result<Checked> {
    let mut simulation = scene.build()?.simulation;
    let gravity = simulation.gravity();
    let mut checked = Checked::default();
    let mut bodies: Vec<&str> =
        data.records.iter().flat_map(|r| &r.rows).map(|row| row.body.as_str()).collect();
    bodies.sort_unstable();
    bodies.dedup();
    gaps(data, &mut checked);
    for body in bodies {
        let pairs: Vec<Interval<'_>> =
            data.records.iter().flat_map(|record| intervals(record, body)).collect();
        velocity(body, &pairs, &mut checked);
        falling(body, data, &gravity, &mut checked);
        let turning: Vec<&Interval<'_>> = pairs.iter().filter(turns).collect();
        let known = simulation.bodies().find(|(_, known)| known.name == body);
        if turning.len() >= ENOUGH {
            rotation(body, &turning, data.along_body, &mut checked);
        } else if let Some((id, mass)) = known.and_then(|(id, body)| Some((id, *body.mass()?)))
            && checked.faults.is_empty()
            && pairs.iter().any(|(a, ..)| a.orientation.is_some())
        {
            let mut probe = Probe::new(&mut simulation, id);
            orientations(body, &data.records, &pairs, &mass, &mut probe, &mut checked)?;
        }
    }
    Ok(checked)
}

/// Tests whether an interval has orientations and angular velocities, and turns enough to tell axes and orders apart.
fn turns((a, b, dt): &&Interval<'_>) -> bool {
    let both = a.orientation.is_some() && b.orientation.is_some();
    both && a.angular_velocity.is_some_and(|w| w.norm() * dt > TURNS) && b.angular_velocity.is_some()
}

/// Rows in which something was measured: a line whose cells are empty is no measurement.
fn measured(record: &Record) -> impl Iterator<Item = &Row> {
    let something = |row: &&Row| Quantity::ALL.into_iter().any(|quantity| row.has(quantity));
    record.rows.iter().filter(something)
}

fn gaps(data: &Data, checked: &mut Checked) {
    let mut noted = 0;
    for record in &data.records {
        let mut times: Vec<f64> = measured(record).map(|row| record.times[row.time]).collect();
        times.dedup();
        let steps: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let usual = median(steps.clone());
        for (time, step) in times.iter().zip(&steps).filter(|(_, step)| **step > GAP * usual) {
            noted += 1;
            if noted <= 5 {
                checked.notes.push(format!(
                    "record `{}`: a gap of {step:.4} s after {time:.4} s, where the usual interval is {usual:.4} s; nothing is filled \
                     in, and the run goes on through it",
                    record.name,
                ));
            }
        }
    }
    if noted > 5 {
        checked.notes.push(format!("data: {} more gaps", noted - 5));
    }
}

/// Ratio of units that explains a ratio of two measurements, in words.
fn unit_of(ratio: f64, known: &[(f64, &'static str)]) -> Option<&'static str> {
    let near = |factor: f64| (ratio / factor - 1.0).abs() < UNIT_TOLERANCE;
    known.iter().find(|(factor, _)| near(*factor)).map(|(_, words)| *words)
}

fn velocity(body: &str, pairs: &[Interval<'_>], checked: &mut Checked) {
    let ratio = |(a, b, dt): &Interval<'_>| {
        let moved = b.position? - a.position?;
        let travelled = (a.velocity? + b.velocity?) * (0.5 * dt);
        (travelled.norm() > 0.0).then(|| moved.norm() / travelled.norm())
    };
    let ratios: Vec<f64> = pairs.iter().filter_map(ratio).collect();
    if ratios.len() < ENOUGH {
        return;
    }
    let ratio = median(ratios);
    let known = [
        (1e3, "positions in mm, or times in ks"),
        (100.0, "positions in cm"),
        (1.0 / 0.0254, "positions in inches"),
        (1.0 / 0.3048, "positions in feet"),
        (1e-3, "velocities in mm/s, or times in ms"),
        (1e-2, "velocities in cm/s"),
        (1e-6, "times in µs"),
    ];
    if let Some(words) = unit_of(ratio, &known) {
        checked.faults.push(format!(
            "data of body `{body}`: positions move by {ratio:.4} of what velocities and times say, as with {words}; give m, m/s and s"
        ));
    } else if !(0.5..2.0).contains(&ratio) {
        checked.notes.push(format!(
            "data of body `{body}`: positions move by {ratio:.4} of what velocities and times say; look at the units and at the \
             point that is measured, which must be the origin of the group"
        ));
    }
}

fn rotation(body: &str, turning: &[&Interval<'_>], along_body: bool, checked: &mut Checked) {
    let known = [
        (180.0 / std::f64::consts::PI, "degrees/s"),
        (std::f64::consts::TAU, "turns/s"),
        (60.0 / std::f64::consts::TAU, "turns/min"),
    ];
    let ratio = |pair: &&Interval<'_>| {
        let ((a, b, dt), turned) = (pair, turned(pair)?);
        let spun = (a.angular_velocity? + b.angular_velocity?).norm() * 0.5 * dt;
        (turned > 0.0).then(|| spun / turned)
    };
    let ratios: Vec<f64> = turning.iter().filter_map(ratio).collect();
    let ratio = median(ratios);
    let inverse = unit_of(1.0 / ratio, &known);
    if let Some(words) = unit_of(ratio, &known).or(inverse) {
        checked.faults.push(format!(
            "data of body `{body}`: angular velocities say {ratio:.4} of the rotation that orientations show, as with {words}; \
             give rad/s"
        ));
        return;
    }
    let readings = readings();
    let miss = |reading| median(turning.iter().filter_map(|pair| miss(pair, along_body, reading)).collect());
    let misses = readings.map(miss);
    let best = (0..readings.len()).min_by(|a, b| misses[*a].total_cmp(&misses[*b])).unwrap_or(0);
    let turned = median(turning.iter().filter_map(|pair| turned(pair)).collect());
    let degrees = |radians: f64| radians * 180.0 / std::f64::consts::PI;
    if misses[0] > CLEARLY * misses[best] {
        checked.faults.push(format!(
            "data of body `{body}`: the angular velocity, integrated over an interval, misses the orientation by {:.3}° (median); \
             read in another way it misses by {:.3}°; {}",
            degrees(misses[0]),
            degrees(misses[best]),
            readings[best].cures(along_body),
        ));
    } else if misses[0] > MISSES * turned {
        checked.notes.push(format!(
            "data of body `{body}`: the angular velocity, integrated over an interval, misses the orientation by {:.3}° (median), of \
             {:.3}° that the body turns, and no other order or axes fit; look at the times of both sensors and at their axes",
            degrees(misses[0]),
            degrees(turned),
        ));
    }
}

/// Angle by which the body turns in an interval, rad.
fn turned((a, b, _): &Interval<'_>) -> Option<f64> {
    Some(rotation_vector(&(b.orientation? * a.orientation?.inverse())).norm())
}

/// Angle between the measured orientation at the end of an interval and the integrated one, rad.
fn miss((a, b, dt): &Interval<'_>, along_body: bool, reading: Reading) -> Option<f64> {
    let given = [a.orientation?, b.orientation?];
    let [from, to] = given.map(|q| reading.orientation(&q));
    let spin = |row: &Row, q: &Quat, q_given: &Quat| -> Option<Vec3> {
        let common = row.angular_velocity?;
        // The reader has turned numbers along the axes of the body by the orientation as given.
        let numbers = if along_body { q_given.inverse() * common } else { common };
        Some(if along_body != reading.other_axes { q * numbers } else { numbers })
    };
    let spin = (spin(a, &from, &given[0])? + spin(b, &to, &given[1])?) * 0.5;
    let end = Quat::from_scaled_axis(spin * *dt) * from;
    Some(rotation_vector(&(to * end.inverse())).norm())
}

/// Checks the acceleration of a fall against gravity, where the data begin with one.
fn falling(body: &str, data: &Data, gravity: &Vec3, checked: &mut Checked) {
    let g = gravity.norm();
    let mut found = Vec::new();
    for record in &data.records {
        let rows: Vec<(f64, Vec3)> = record
            .rows
            .iter()
            .filter(|row| row.body == body)
            .filter_map(|row| Some((record.times[row.time], row.position?)))
            .take(9)
            .collect();
        if let [(t0, p0), .., (t2, p2)] = rows.as_slice()
            && g > 0.0
            && rows.len() >= 3
        {
            let (t1, p1) = rows[rows.len() / 2];
            let slope = |(t, p): (f64, Vec3), (s, q): (f64, Vec3)| (q - p) / (s - t);
            let bend = (slope((t1, p1), (*t2, *p2)) - slope((*t0, *p0), (t1, p1))) / (0.5 * (t2 - t0));
            found.push(bend.dot(gravity) / (g * g));
        }
    }
    let ratio = median(found.clone());
    let known = [
        (1e3, "positions in mm"),
        (100.0, "positions in cm"),
        (1.0 / 0.0254, "positions in inches"),
        (1.0 / 0.3048, "positions in feet"),
        (1e-6, "times in ms"),
        (-1.0, "an axis that points the other way"),
        (-1e3, "positions in mm along an axis that points the other way"),
    ];
    let Some(words) = unit_of(ratio, &known) else { return };
    let line = format!(
        "data of body `{body}`: records begin with {ratio:.4} of the gravity of the scene, as with {words}; give m and s, along \
         the axes of the scene"
    );
    // A load may accelerate a body as a wrong unit does, but hardly in every record.
    let agree = found.iter().filter(|one| unit_of(**one, &known) == Some(words)).count();
    let sure = found.len() >= FALLS && 2 * agree > found.len();
    if sure { checked.faults.push(line) } else { checked.notes.push(line) }
}
