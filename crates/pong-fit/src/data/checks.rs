//! Checks of measured data by the kinematics that they must obey: gaps, units, order of quaternions, axes of
//! angular velocities.
//!
//! A pose, a velocity and an angular velocity are three measurements of one motion. Integrated over an
//! interval the last two must give the change of the first. Contacts disturb few of the intervals, so the
//! median over all of them judges.

use super::record::{Data, Record, Row};
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

/// Factor between the misses of two readings of a rotation at which the better one is believed.
const CLEARLY: f64 = 3.0;

/// Result of the checks: each line has thing, cause and cure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// Faults: the data cannot be used as they are.
    pub faults: Vec<String>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Checks data of a scene with this gravity, m/s².
pub fn check(data: &Data, gravity: &Vec3) -> Checked {
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
        rotation(body, &pairs, data.along_body, &mut checked);
        falling(body, data, gravity, &mut checked);
    }
    checked
}

/// Two successive measurements of a body, and the time between them, s.
type Interval<'a> = (&'a Row, &'a Row, f64);

fn intervals<'a>(record: &'a Record, body: &'a str) -> impl Iterator<Item = Interval<'a>> {
    let of_body = move || record.rows.iter().filter(move |row| row.body == body);
    of_body().zip(of_body().skip(1)).map(|(a, b)| (a, b, record.times[b.time] - record.times[a.time]))
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn gaps(data: &Data, checked: &mut Checked) {
    let mut noted = 0;
    for record in &data.records {
        let steps: Vec<f64> = record.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let usual = median(steps.clone());
        for (place, step) in steps.iter().enumerate().filter(|(_, step)| **step > GAP * usual) {
            noted += 1;
            if noted <= 5 {
                checked.notes.push(format!(
                    "record `{}`: a gap of {step:.4} s after {:.4} s, where the usual interval is {usual:.4} s; nothing is filled \
                     in, and the run goes on through it",
                    record.name, record.times[place],
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

/// Readings of a measured rotation: the order of the quaternion, and the axes of the angular velocity.
const READINGS: [(bool, bool); 4] = [(false, false), (false, true), (true, false), (true, true)];

/// Quaternion whose components were given in the order x, y, z, w under the names of w, x, y, z.
fn reordered(q: &Quat) -> Quat {
    pong_geometry::Pose::new(Vec3::zeros(), [q.k, q.w, q.i, q.j]).orientation
}

fn rotation(body: &str, pairs: &[Interval<'_>], along_body: bool, checked: &mut Checked) {
    let turning = |(a, b, dt): &&Interval<'_>| {
        let both = a.orientation.is_some() && b.orientation.is_some();
        both && a.angular_velocity.is_some_and(|w| w.norm() * dt > TURNS) && b.angular_velocity.is_some()
    };
    let turning: Vec<&Interval<'_>> = pairs.iter().filter(turning).collect();
    let known = [
        (180.0 / std::f64::consts::PI, "degrees/s"),
        (std::f64::consts::TAU, "turns/s"),
        (60.0 / std::f64::consts::TAU, "turns/min"),
    ];
    let ratio = |(a, b, dt): &&Interval<'_>| {
        let turned = rotation_vector(&(b.orientation? * a.orientation?.inverse())).norm();
        let spun = (a.angular_velocity? + b.angular_velocity?).norm() * 0.5 * dt;
        (turned > 0.0).then(|| spun / turned)
    };
    let ratios: Vec<f64> = turning.iter().filter_map(ratio).collect();
    if ratios.len() < ENOUGH {
        if pairs.iter().any(|(a, ..)| a.orientation.is_some()) {
            checked.notes.push(format!(
                "data of body `{body}`: too few intervals with orientation and angular velocity turn enough to check the order of \
                 the quaternion and the axes of the angular velocity"
            ));
        }
        return;
    }
    let ratio = median(ratios);
    let inverse = unit_of(1.0 / ratio, &known);
    if let Some(words) = unit_of(ratio, &known).or(inverse) {
        checked.faults.push(format!(
            "data of body `{body}`: angular velocities say {ratio:.4} of the rotation that orientations show, as with {words}; \
             give rad/s"
        ));
        return;
    }
    let miss = |reading| median(turning.iter().filter_map(|pair| miss(pair, along_body, reading)).collect());
    let misses = READINGS.map(miss);
    let best = (0..4).min_by(|a, b| misses[*a].total_cmp(&misses[*b])).unwrap_or(0);
    if misses[0] > CLEARLY * misses[best] {
        let (order, axes) = READINGS[best];
        let mut cures = Vec::new();
        if order {
            cures
                .push("the quaternions are in the order x, y, z, w: name the columns qx,qy,qz,qw".to_owned());
        }
        if axes {
            let axes = if along_body { "common" } else { "body" };
            cures.push(format!(
                "the angular velocity is along the other axes: write `# angular_velocity = {axes}`"
            ));
        }
        let degrees = |radians: f64| radians * 180.0 / std::f64::consts::PI;
        checked.faults.push(format!(
            "data of body `{body}`: the angular velocity, integrated over an interval, misses the orientation by {:.3}° (median); \
             read in another way it misses by {:.3}°; {}",
            degrees(misses[0]),
            degrees(misses[best]),
            cures.join("; "),
        ));
    }
}

/// Angle between the measured orientation at the end of an interval and the integrated one, rad.
fn miss((a, b, dt): &Interval<'_>, along_body: bool, (order, axes): (bool, bool)) -> Option<f64> {
    let given = [a.orientation?, b.orientation?];
    let [from, to] = if order { given.map(|q| reordered(&q)) } else { given };
    let spin = |row: &Row, q: &Quat, q_given: &Quat| -> Option<Vec3> {
        let common = row.angular_velocity?;
        // The reader has turned numbers along the axes of the body by the orientation as given.
        let numbers = if along_body { q_given.inverse() * common } else { common };
        Some(if along_body != axes { q * numbers } else { numbers })
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
