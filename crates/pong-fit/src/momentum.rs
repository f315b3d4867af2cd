//! Inertia of a free body from the momentum of its touches, without a law of contact (docs/fit.md).
//!
//! A touch at one point between two free flights changes the velocity by Δv and the angular velocity by Δω. Its
//! impulse m·Δv acts at the point r from the mass centre, so that I·Δω = r × m·Δv, whatever forces made it. Both
//! sides have errors of measurement, which bias a slope. The slope with an instrument is not biased. The
//! instrument is the moment of a vertical impulse as large as the speed of approach. It follows from the flight
//! before the touch alone.

use crate::data::{Data, Record, check};
use crate::error::{FitError, Result};
use crate::paste::{mass_text, number};
use crate::probe::Probe;
use crate::random::Random;
use pong_executive::scene::Scene;
use pong_executive::{BodyId, MassProperties, Mat3, Pose, Quat, Simulation, Vec3};
use pong_geometry::pose::rotation_vector;
use std::fmt::Write as _;
use std::ops::RangeInclusive;

/// Relative difference of principal moments up to which a free flight is taken as an even rotation.
const UNLIKE: f64 = 0.1;

/// Least number of touches for an interval.
const ENOUGH: usize = 10;

/// Number of draws of the bootstrap.
const DRAWS: usize = 4000;

/// Depth at which a point of contact is taken, in the distance `near`.
const GRAZING: f64 = 1e-3;

/// Least size of the sum that the slope divides by, relative to the root of the sum of its squares.
const TURNED: f64 = 1e-6;

/// Settings of [`inertia_from_momentum`].
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumSettings {
    /// Name of the body; not needed if one body is free.
    pub body: Option<String>,
    /// Number of poses of the flights before and after a touch.
    pub flight: usize,
    /// Number of poses between a touch and each flight.
    pub clear: usize,
    /// Largest number of poses in a touch.
    pub longest: usize,
    /// Distance from the other bodies below which a point may touch, m.
    pub near: f64,
    /// Distance that all other points of the body keep in a touch, m.
    pub apart: f64,
    /// Relative number of cases in which the interval must contain the true value.
    pub confidence: f64,
    /// Seed of the bootstrap.
    pub seed: u64,
}

impl Default for MomentumSettings {
    fn default() -> Self {
        Self {
            body: None,
            flight: 5,
            clear: 1,
            longest: 4,
            near: 1e-3,
            apart: 15e-3,
            confidence: 0.95,
            seed: 0,
        }
    }
}

impl MomentumSettings {
    /// # Errors
    /// Settings out of range, all of them at once.
    fn check(&self) -> Result<()> {
        let Self { flight, longest, near, apart, confidence, .. } = self;
        let faults: Vec<String> = [
            (*flight < 2, format!("flight: it has {flight} poses; give at least 2")),
            (*longest == 0, "longest touch: it has no pose; give at least 1".to_owned()),
            (
                !(*near > 0.0 && near < apart && apart.is_finite()),
                format!("near and apart: they are {near} m and {apart} m; give two distances above zero, the smaller as near"),
            ),
            (
                !(0.5..=0.9999).contains(confidence),
                format!("confidence: it is {confidence}; give a share from 0.5 to 0.9999"),
            ),
        ]
        .into_iter()
        .filter_map(|(wrong, text)| wrong.then_some(text))
        .collect();
        if faults.is_empty() { Ok(()) } else { Err(FitError(faults.join("\n"))) }
    }
}

/// Inertia of a body from the momentum of its touches.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentumInertia {
    /// Name of the body.
    pub body: String,
    /// Mean of the principal moments of inertia, kg·m².
    pub inertia: f64,
    /// Interval of `inertia` by bootstrap over the touches, kg·m².
    pub interval: (f64, f64),
    /// Ratio to the inertia in the scene, as `body.BODY.inertia_factor` has it.
    pub factor: f64,
    /// The two ordinary slopes, which errors of measurement bias to low and to high values, kg·m².
    pub slopes: (f64, f64),
    /// Number of touches.
    pub touches: usize,
    /// Number of records.
    pub records: usize,
    /// Mass properties to paste into the body of the scene.
    pub to_paste: String,
    /// Notes of the checks of the data, each with thing, cause and cure.
    pub notes: Vec<String>,
}

impl MomentumInertia {
    /// The page, in Markdown.
    pub fn markdown(&self) -> String {
        let Self { body, interval: (low, high), slopes: (least, most), .. } = self;
        let mut page = format!("# Inertia of `{body}` from momentum\n\n");
        let _ = writeln!(
            page,
            "{} touches of one point between two flights, in {} records. Laws of contact take no part.\n\n\
             | inertia, kg·m² | interval | times that of the scene | ordinary slopes, biased low and high |\n\
             |---|---|---|---|\n| {} | {} to {} | {} | {}, {} |\n\n## To paste\n\n```ron\n// body {body}\n{}\n```",
            self.touches,
            self.records,
            number(self.inertia),
            number(*low),
            number(*high),
            number(self.factor),
            number(*least),
            number(*most),
            self.to_paste
        );
        if !self.notes.is_empty() {
            page += "\n## Notes\n\n";
            self.notes.iter().for_each(|note| page += &format!("* {note}\n"));
        }
        page
    }
}

/// Finds the inertia of a free body from touches at a single point between two flights, without a law of contact.
///
/// Mass, mass centre, gravity, geometry and the ratios of the principal moments are those of the scene. Stiffness, damping
/// and friction have no effect. The other bodies stay where the scene has them.
///
/// # Errors
/// Settings, names and data that cannot be used; unlike principal moments; too few touches, or touches that do
/// not turn the body.
pub fn inertia_from_momentum(
    scene: &Scene,
    data: &Data,
    settings: &MomentumSettings,
) -> Result<MomentumInertia> {
    settings.check()?;
    let mut finder = Finder::new(scene, settings)?;
    let checked = check(data, scene)?;
    if !checked.faults.is_empty() {
        return Err(FitError(checked.faults.join("\n")));
    }
    let mut touches = Vec::new();
    let paths: Vec<Path> = data.records.iter().filter_map(|record| Path::of(record, &finder.name)).collect();
    for path in &paths {
        let near: Vec<bool> = path.poses.iter().map(|pose| finder.touches(pose)).collect::<Result<_>>()?;
        for touch in touches_between_flights(&near, settings) {
            touches.extend(finder.products(path, touch)?);
        }
    }
    let thing = || format!("inertia of `{}`", finder.name);
    if touches.len() < ENOUGH {
        let cause = format!(
            "there are {} touches of one point between two flights of {} poses in {} records",
            touches.len(),
            settings.flight,
            paths.len()
        );
        let cure = format!("give at least {ENOUGH}, longer records or shorter flights");
        return Err(FitError::new(thing(), cause, cure));
    }
    let total = sum(&touches);
    let turned = touches.iter().map(|one| one.instrument_turning * one.instrument_turning).sum::<f64>();
    // False for a value that is no number, too.
    let turns = total.instrument_turning.abs() > TURNED * turned.sqrt();
    if !turns {
        let cause = "impulses along the vertical turn it in no touch";
        return Err(FitError::new(thing(), cause, "its points of contact must lie beside its mass centre"));
    }
    let (mass, scale) = (finder.mass, finder.moment());
    let factor = total.instrument_moment / total.instrument_turning;
    let (low, high) = interval(&touches, settings);
    Ok(MomentumInertia {
        inertia: scale * factor,
        interval: (scale * low, scale * high),
        factor,
        slopes: (
            scale * total.turning_moment / total.turning_turning,
            scale * total.moment_moment / total.turning_moment,
        ),
        touches: touches.len(),
        records: paths.len(),
        to_paste: mass_text(&MassProperties { inertia: mass.inertia * factor, ..mass }),
        notes: checked.notes,
        body: finder.name,
    })
}

/// Inner products of the vectors of a touch: instrument, moment r × m·Δv, and turning I·Δω with the inertia I of
/// the scene.
#[derive(Clone, Copy, Debug, Default)]
struct Products {
    instrument_moment: f64,
    instrument_turning: f64,
    turning_moment: f64,
    turning_turning: f64,
    moment_moment: f64,
}

fn sum<'a>(touches: impl IntoIterator<Item = &'a Products>) -> Products {
    touches.into_iter().fold(Products::default(), |sum, one| Products {
        instrument_moment: sum.instrument_moment + one.instrument_moment,
        instrument_turning: sum.instrument_turning + one.instrument_turning,
        turning_moment: sum.turning_moment + one.turning_moment,
        turning_turning: sum.turning_turning + one.turning_turning,
        moment_moment: sum.moment_moment + one.moment_moment,
    })
}

/// Interval of the slope with the instrument, by bootstrap over the touches.
fn interval(touches: &[Products], settings: &MomentumSettings) -> (f64, f64) {
    let mut random = Random::new(settings.seed, 7);
    let draw = |_| {
        let drawn = sum((0..touches.len()).map(|_| &touches[random.below(touches.len())]));
        drawn.instrument_moment / drawn.instrument_turning
    };
    let mut slopes: Vec<f64> = (0..DRAWS).map(draw).collect();
    slopes.sort_by(f64::total_cmp);
    let tail = 0.5 * (1.0 - settings.confidence) * (DRAWS - 1) as f64;
    (slopes[tail as usize], slopes[DRAWS - 1 - tail as usize])
}

/// Measured poses of the body in one record.
struct Path {
    times: Vec<f64>,
    poses: Vec<Pose>,
}

impl Path {
    /// Whole poses of a body; `None` if the record has none.
    fn of(record: &Record, body: &str) -> Option<Self> {
        let whole = record.rows.iter().filter(|row| row.body == body).filter_map(|row| {
            let (pose, _) = row.start()?;
            Some((record.times[row.time], pose))
        });
        let (times, poses): (Vec<f64>, Vec<Pose>) = whole.unzip();
        (!times.is_empty()).then_some(Self { times, poses })
    }

    /// Measured orientation at a time, along the arc between two poses.
    fn orientation(&self, time: f64) -> Quat {
        let after = self.times.partition_point(|one| *one < time).clamp(1, self.times.len() - 1);
        let [from, to] = [after - 1, after].map(|place| (self.times[place], self.poses[place].orientation));
        let share = (time - from.0) / (to.0 - from.0);
        Quat::from_scaled_axis(rotation_vector(&(to.1 * from.1.inverse())) * share) * from.1
    }
}

/// First and last pose of each touch between two flights.
fn touches_between_flights(near: &[bool], settings: &MomentumSettings) -> Vec<RangeInclusive<usize>> {
    let margin = settings.clear + settings.flight;
    let mut found = Vec::new();
    let mut begin = 0;
    for run in near.chunk_by(|a, b| a == b) {
        let end = begin + run.len() - 1;
        let alone = run[0]
            && run.len() <= settings.longest
            && begin >= margin
            && end + margin < near.len()
            && !near[begin - margin..begin].contains(&true)
            && !near[end + 1..=end + margin].contains(&true);
        if alone {
            found.push(begin..=end);
        }
        begin = end + 1;
    }
    found
}

/// Parabola of the mass centre and even rotation through some poses, at the instant zero.
struct Flight {
    /// Place of the mass centre, m.
    place: Vec3,
    /// Velocity of the mass centre, m/s.
    velocity: Vec3,
    /// Angular velocity along the common axes, rad/s.
    spin: Vec3,
    orientation: Quat,
}

/// Value at time zero and slope of the straight line nearest to some vectors.
fn line(times: &[f64], values: &[Vec3]) -> (Vec3, Vec3) {
    let count = times.len() as f64;
    let (time, value) = (times.iter().sum::<f64>() / count, values.iter().sum::<Vec3>() / count);
    let spread: f64 = times.iter().map(|t| (t - time) * (t - time)).sum();
    let slope = times.iter().zip(values).map(|(t, v)| (v - value) * (t - time)).sum::<Vec3>() / spread;
    (value - slope * time, slope)
}

/// A simulation that lists the contacts of measured poses.
struct Finder<'a> {
    settings: &'a MomentumSettings,
    simulation: Simulation,
    body: BodyId,
    name: String,
    mass: MassProperties,
    up: Vec3,
}

impl<'a> Finder<'a> {
    fn new(scene: &Scene, settings: &'a MomentumSettings) -> Result<Self> {
        let simulation = scene.build()?.simulation;
        let free: Vec<(BodyId, String, MassProperties)> = simulation
            .bodies()
            .filter_map(|(id, body)| Some((id, body.name.clone(), *body.mass()?)))
            .collect();
        let wanted = |name: &str| settings.body.as_ref().map_or(free.len() == 1, |body| body == name);
        let Some((body, name, mass)) = free.iter().find(|(_, name, _)| wanted(name)).cloned() else {
            let cause = match &settings.body {
                Some(body) => format!("there is no free body `{body}`"),
                None => format!("{} bodies are free", free.len()),
            };
            let names: Vec<&str> = free.iter().map(|(_, name, _)| name.as_str()).collect();
            return Err(FitError::new("body", cause, format!("name one of: {}", names.join(", "))));
        };
        let moments = mass.inertia.symmetric_eigenvalues();
        if moments.max() > (1.0 + UNLIKE) * moments.min() {
            let cause = format!(
                "its principal moments {} and {} kg·m² differ, so that a flight is no even rotation",
                number(moments.min()),
                number(moments.max())
            );
            return Err(FitError::new(format!("inertia of `{name}`"), cause, "identify it with `fit`"));
        }
        let up = -simulation.gravity().try_normalize(0.0).unwrap_or(-Vec3::z());
        Ok(Self { settings, simulation, body, name, mass, up })
    }

    /// Mean of the principal moments in the scene, kg·m².
    fn moment(&self) -> f64 {
        self.mass.inertia.trace() / 3.0
    }

    /// Contact points in the frame of the body, and depths (m), of a pose that is lower by a distance, m.
    fn contacts(&mut self, pose: &Pose, lower: f64) -> Result<Vec<(Vec3, f64)>> {
        let position = pose.position - self.up * lower;
        Probe::new(&mut self.simulation, self.body).contacts(Pose { position, ..*pose })
    }

    /// Tests whether a point of the body is nearer to other bodies than `near`.
    fn touches(&mut self, pose: &Pose) -> Result<bool> {
        Ok(!self.contacts(pose, self.settings.near)?.is_empty())
    }

    /// Products of a touch; `None` if several points are near.
    fn products(&mut self, path: &Path, touch: RangeInclusive<usize>) -> Result<Option<Products>> {
        let MomentumSettings { flight, clear, near, apart, .. } = *self.settings;
        let (begin, end) = touch.into_inner();
        for pose in &path.poses[begin - 1..=end + 1] {
            if self.contacts(pose, apart)?.len() > 1 {
                return Ok(None);
            }
        }
        let mut deepest: Option<(Pose, f64)> = None;
        for pose in &path.poses[begin..=end] {
            for (_, depth) in self.contacts(pose, near)? {
                if deepest.is_none_or(|(_, most)| depth > most) {
                    deepest = Some((*pose, depth));
                }
            }
        }
        let Some((pose, depth)) = deepest else { return Ok(None) };
        // A point of contact lies deeper in the body the lower the body is, so it is lowered no more than to touch.
        let lower = (near - depth + GRAZING * near).max(0.0);
        let mut found = self.contacts(&pose, lower)?;
        if found.is_empty() {
            found = self.contacts(&pose, near)?;
        }
        let Some((point, _)) = found.first() else { return Ok(None) };
        let arm_in_body = point - self.mass.mass_center;
        let zero = 0.5 * (path.times[begin] + path.times[end]);
        let first = begin - clear - flight;
        let before = self.flight(path, first..=first + flight - 1, zero);
        let after = self.flight(path, end + 1 + clear..=end + clear + flight, zero);
        // Both flights fall alike, so the distance of their places is linear in time.
        let (offset, closing) = (after.place - before.place, after.velocity - before.velocity);
        let latest = 1.5 * (path.times[end + 1] - path.times[begin - 1]) / (end + 2 - begin) as f64;
        let instant = (-offset.dot(&closing) / closing.norm_squared()).clamp(-latest, latest);
        let orientation = path.orientation(zero + instant);
        let turn: Mat3 = orientation.to_rotation_matrix().into_inner();
        let (arm, expected) = (orientation * arm_in_body, before.orientation * arm_in_body);
        let approach = (before.velocity + before.spin.cross(&expected)).dot(&self.up);
        let instrument = expected.cross(&(self.up * -approach));
        let moment = arm.cross(&(closing * self.mass.mass));
        let turning = turn * self.mass.inertia * turn.transpose() * (after.spin - before.spin);
        Ok(Some(Products {
            instrument_moment: instrument.dot(&moment),
            instrument_turning: instrument.dot(&turning),
            turning_moment: turning.dot(&moment),
            turning_turning: turning.norm_squared(),
            moment_moment: moment.norm_squared(),
        }))
    }

    /// Flight through some poses: a parabola with the gravity of the scene, and an even rotation.
    fn flight(&self, path: &Path, poses: RangeInclusive<usize>, zero: f64) -> Flight {
        let gravity = self.simulation.gravity();
        let times: Vec<f64> = path.times[poses.clone()].iter().map(|time| time - zero).collect();
        let poses = &path.poses[poses];
        let centers = poses.iter().map(|pose| pose.position + pose.orientation * self.mass.mass_center);
        let places: Vec<Vec3> =
            centers.zip(&times).map(|(place, t)| place - gravity * (0.5 * t * t)).collect();
        let middle = poses[poses.len() / 2].orientation;
        let turns: Vec<Vec3> =
            poses.iter().map(|pose| rotation_vector(&(pose.orientation * middle.inverse()))).collect();
        let ((place, velocity), (turn, spin)) = (line(&times, &places), line(&times, &turns));
        Flight { place, velocity, spin, orientation: Quat::from_scaled_axis(turn) * middle }
    }
}
