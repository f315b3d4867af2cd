//! Order and direction of quaternions, where no angular velocity tells them.
//!
//! Two facts tell readings apart. A free flight keeps its angular momentum; that needs unlike principal moments, because
//! an even rotation is an even rotation in any order of the components. And a body does not sink into others.

use super::interval::{Checked, Interval, median};
use super::record::{Record, Row};
use crate::error::Result;
use crate::probe::Probe;
use pong_executive::{MassProperties, Pose};
use pong_geometry::pose::rotation_vector;
use pong_geometry::{Quat, Vec3};

/// Factor between the misses of two readings of a rotation at which the better one is believed.
pub(super) const CLEARLY: f64 = 3.0;

/// Rotation between the orientations from which an angular velocity is taken, rad.
const TURNED: f64 = 0.3;

/// Number of changes of the angular momentum that are needed for a judgement.
const ENOUGH: usize = 8;

/// Relative change of the angular momentum in a free flight, that noise may show.
const CHANGE: f64 = 0.05;

/// Depth that compliance and noise may show, relative to the distance of the points of contact from the origin.
const DEEP: f64 = 0.05;

/// Largest number of records that are looked at for depths, and of poses of each.
const RECORDS: usize = 24;
const POSES: usize = 200;

/// Another reading of a measured rotation than the one that the file states.
#[derive(Clone, Copy)]
pub(super) struct Reading {
    /// True if the components of the quaternion are x, y, z, w under the names of w, x, y, z.
    pub reordered: bool,
    /// True if the quaternion turns the common frame into the group frame.
    pub inverse: bool,
    /// True if the angular velocity is along the other axes.
    pub other_axes: bool,
}

/// All readings; the first is that of the file, and the first four have the axes of the file.
pub(super) fn readings() -> [Reading; 8] {
    std::array::from_fn(|bits| Reading {
        reordered: bits & 1 != 0,
        inverse: bits & 2 != 0,
        other_axes: bits & 4 != 0,
    })
}

impl Reading {
    /// Orientation of the group in the common frame.
    pub fn orientation(self, q: &Quat) -> Quat {
        let [w, x, y, z] = if self.reordered { [q.k, q.w, q.i, q.j] } else { [q.w, q.i, q.j, q.k] };
        let read = Pose::new(Vec3::zeros(), [w, x, y, z]).orientation;
        if self.inverse { read.inverse() } else { read }
    }

    /// Changes of the file that give this reading.
    pub fn cures(self, along_body: bool) -> String {
        let mut cures = Vec::new();
        if self.reordered {
            cures
                .push("the quaternions are in the order x, y, z, w: name the columns qx,qy,qz,qw".to_owned());
        }
        if self.inverse {
            let cure = "the quaternions turn the common frame into that of the group: change the sign of qx, qy and qz";
            cures.push(cure.to_owned());
        }
        if self.other_axes {
            let axes = if along_body { "common" } else { "body" };
            cures.push(format!(
                "the angular velocity is along the other axes: write `# angular_velocity = {axes}`"
            ));
        }
        cures.join("; ")
    }

    /// Angular momentum between two orientations, N·m·s.
    fn momentum(self, a: &Quat, b: &Quat, dt: f64, mass: &MassProperties) -> Vec3 {
        let [from, to] = [a, b].map(|q| self.orientation(q));
        let turn = rotation_vector(&(to * from.inverse()));
        let middle = Quat::from_scaled_axis(turn * 0.5) * from;
        middle * (mass.inertia * (middle.inverse() * (turn / dt)))
    }
}

/// Misses of the four readings with the axes of the file; none where nothing was found.
type Misses = Option<[f64; 4]>;

/// Tells the reading that fits, or those between which nothing decides.
pub(super) fn orientations(
    body: &str,
    records: &[Record],
    pairs: &[Interval<'_>],
    mass: &MassProperties,
    probe: &mut Probe<'_>,
    checked: &mut Checked,
) -> Result<()> {
    let flights = changes(pairs, mass);
    let (depths, size) = if probe.others_are_fixed() { depths(body, records, probe)? } else { (None, 0.0) };
    // Misses, those that noise may show, words, and the unit in which they are given.
    let evidence = [
        (flights, CHANGE, "the angular momentum changes by", (100.0, "%")),
        (depths, DEEP * size, "the body sinks into others by", (1e3, "mm")),
    ];
    let mut open = [false, true, true, true];
    for (misses, allowed, words, (scale, unit)) in evidence {
        let Some(misses) = misses else { continue };
        let number = |miss: f64| format!("{:.2} {unit}", scale * miss);
        let clearly = |more: f64, less: f64| less <= allowed && more > CLEARLY * less + allowed;
        let best = (0..4).min_by(|a, b| misses[*a].total_cmp(&misses[*b])).unwrap_or(0);
        if clearly(misses[0], misses[best]) {
            checked.faults.push(format!(
                "data of body `{body}`: with the orientations as they are read, {words} {} (median); read in another way, by {}; {}",
                number(misses[0]),
                number(misses[best]),
                readings()[best].cures(false),
            ));
            return Ok(());
        }
        (1..4).for_each(|other| open[other] &= !clearly(misses[other], misses[0]));
    }
    let open: Vec<String> =
        (1..4).filter(|other| open[*other]).map(|other| readings()[other].cures(false)).collect();
    if !open.is_empty() {
        checked.notes.push(format!(
            "data of body `{body}`: neither angular velocities nor flights nor contacts exclude another reading of its orientations; \
             compare a known pose with the data, and if it does not fit: {}",
            open.join(", or ")
        ));
    }
    Ok(())
}

/// Median change of the angular momentum from one rotation by [`TURNED`] to the next, relative to its size.
fn changes(pairs: &[Interval<'_>], mass: &MassProperties) -> Misses {
    let mut changes = [const { Vec::new() }; 4];
    let turned = |a: &Quat, b: &Quat| rotation_vector(&(b * a.inverse())).norm();
    for run in pairs.chunk_by(|(_, end, _), (begin, ..)| std::ptr::eq(*end, *begin)) {
        // Orientations that are about equally far apart, with their times, s.
        let mut stations: Vec<(Quat, f64)> = Vec::new();
        let mut time = 0.0;
        for (begin, _, dt) in run {
            if let Some(orientation) = begin.orientation
                && stations.last().is_none_or(|(last, _)| turned(last, &orientation) >= TURNED)
            {
                stations.push((orientation, time));
            }
            time += dt;
        }
        for three in stations.windows(3) {
            for (reading, changes) in readings().into_iter().zip(&mut changes) {
                let [before, after] = [0, 1].map(|place| {
                    let ((a, from), (b, to)) = (&three[place], &three[place + 1]);
                    reading.momentum(a, b, to - from, mass)
                });
                changes.push(2.0 * (after - before).norm() / (before.norm() + after.norm()));
            }
        }
    }
    (changes[0].len() >= ENOUGH).then(|| changes.map(median))
}

/// Median over the records of the greatest depth of the body in others, and the greatest distance of a point of
/// contact from its origin, m.
fn depths(body: &str, records: &[Record], probe: &mut Probe<'_>) -> Result<(Misses, f64)> {
    let (mut depths, mut size) = ([const { Vec::new() }; 4], 0.0_f64);
    for record in records.iter().take(RECORDS) {
        let pose = |row: &Row| Some(row.start()?.0);
        let poses: Vec<Pose> = record.rows.iter().filter(|row| row.body == body).filter_map(pose).collect();
        let mut greatest = [0.0_f64; 4];
        for pose in poses.iter().step_by(poses.len().div_ceil(POSES).max(1)) {
            for (reading, greatest) in readings().into_iter().zip(&mut greatest) {
                let orientation = reading.orientation(&pose.orientation);
                for (point, depth) in probe.contacts(Pose { orientation, ..*pose })? {
                    *greatest = greatest.max(depth);
                    size = size.max(point.norm());
                }
            }
        }
        depths.iter_mut().zip(greatest).for_each(|(depths, one)| depths.push(one));
    }
    Ok(((size > 0.0).then(|| depths.map(median)), size))
}
