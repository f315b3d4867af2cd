//! Tangent of a frame (docs/theory.md, 7): against central differences of the wrenches.

use crate::base::Base;
use crate::judge::Verdict;
use crate::play::{Answer, Stage};
use crate::random::Random;
use crate::scene::Scene;
use pong_engine::{EngineError, PairTangent, State};
use pong_geometry::{Pose, Quat, Twist, Vec3};

/// Largest difference, relative to the largest entry.
const TOLERANCE: f64 = 1e-6;

/// Columns: translation and rotation, or velocity and angular velocity, of both groups.
const COLUMNS: usize = 12;

/// Part of the difference of the two widths that the extrapolated derivative may be off.
const OF_WIDTHS: f64 = 0.1;

/// Derivatives of both wrenches, by row (force and moment over the size, of A and of B) and column (a translation,
/// or a rotation times the size).
type Table = [[f64; COLUMNS]; 12];

/// Checks the tangents of all frames whose wrenches are smooth around their states.
pub fn of_differences(base: &mut Base, _: &mut Random) -> Verdict {
    over_frames(base, |stage, scene, states, answer| {
        let tangents = match stage.world.tangents() {
            Err(EngineError::BadValue { .. }) => return Ok(false),
            tangents => tangents.map_err(|error| (1.0, error.to_string()))?,
        };
        let mut compared = false;
        for (is_twist, what) in [(false, "stiffness"), (true, "damping")] {
            let exact = table_of(&tangents, (is_twist, stage), scene.size);
            let Some(differences) = by_differences(stage, scene, states, (is_twist, answer)) else {
                continue;
            };
            compared = true;
            // Entries that are zero up to rounding.
            let least =
                1e-9 * if is_twist { scene.damping() } else { scene.stiffness() } + 1e-15 * scene.stiffness();
            compare(&exact, &differences, (what, least)).map_or(Ok(()), Err)?;
        }
        Ok(compared)
    })
}

/// Plays a scene and checks each frame before its commit. `check` gets the stage, the scene, the states and the answer of
/// the frame; it returns true if it compared, and the relative difference with a text if the frame differs.
pub(super) fn over_frames(
    base: &mut Base,
    mut check: impl FnMut(&mut Stage, &Scene, &[State; 2], &Answer) -> Result<bool, (f64, String)>,
) -> Verdict {
    let scene = base.scene.clone();
    if base.stage.forget().is_err() {
        return Verdict::DoesNotApply;
    }
    let mut compared = false;
    for (frame, states) in scene.frames.iter().enumerate() {
        if base.stage.move_surfaces(frame).is_err() {
            return Verdict::DoesNotApply;
        }
        let Ok(answer) = base.stage.evaluate(states) else { return Verdict::DoesNotApply };
        match check(&mut base.stage, &scene, states, &answer) {
            Ok(did) => compared |= did,
            Err((relative, says)) => return Verdict::differs(frame, relative, says),
        }
        if base.stage.step(states).is_err() {
            return Verdict::DoesNotApply;
        }
    }
    if compared { Verdict::Agrees } else { Verdict::DoesNotApply }
}

fn table_of(tangents: &[PairTangent], (is_twist, stage): (bool, &Stage), size: f64) -> Table {
    let mut table = [[0.0; COLUMNS]; 12];
    for tangent in tangents {
        let blocks = if is_twist { &tangent.damping } else { &tangent.stiffness };
        let side = |index: usize| usize::from(tangent.groups[1] == stage.groups[index / 6]);
        for (row, out) in table.iter_mut().enumerate() {
            for (column, out) in out.iter_mut().enumerate() {
                let unit = scale(row, size) * scale(column, size);
                *out += blocks[side(row)][side(column)][(row % 6, column % 6)] * unit;
            }
        }
    }
    table
}

/// Factor of a moment or a rotation: one over the size.
pub(super) fn scale(index: usize, size: f64) -> f64 {
    if index % 6 < 3 { 1.0 } else { 1.0 / size }
}

/// Minus the derivatives of both wrenches by central differences of two widths, extrapolated, and their errors. `None` if a contact
/// begins, ends or changes its branch within the widths, or the two widths disagree.
fn by_differences(
    stage: &mut Stage,
    scene: &Scene,
    states: &[State; 2],
    (is_twist, answer): (bool, &Answer),
) -> Option<[Table; 2]> {
    let weakest = answer.contacts.iter().map(|touch| touch.normal_force).filter(|force| *force > 0.0);
    // The friction of a contact without load is cut within any width.
    if weakest.fold(f64::INFINITY, f64::min) < 1e-6 * answer.largest {
        return None;
    }
    let least = answer.contacts.iter().map(|touch| touch.depth).fold(f64::INFINITY, f64::min);
    let width = match is_twist {
        false => (1e-5 * least).clamp(1e-9 * scene.size, 1e-4 * scene.size),
        true => (1e-4 * fastest(states, scene.size)).max(1e-6 * scene.size),
    };
    let here = rows(answer, scene.size);
    let mut tables = [[[0.0; COLUMNS]; 12]; 2];
    for column in 0..COLUMNS {
        let mut slopes = |width: f64| {
            let mut side = |sign: f64| {
                let mut beside = *states;
                let state = &mut beside[column / 6];
                *state = moved(state, column % 6, sign * width * scale(column, scene.size), is_twist);
                let found = stage.evaluate(&beside).ok()?;
                (branches(&found) == branches(answer)).then(|| rows(&found, scene.size))
            };
            let (ahead, behind) = (side(1.0)?, side(-1.0)?);
            let bend = |row: usize| (ahead[row] + behind[row] - 2.0 * here[row]).abs() / width;
            let bend = (0..12).map(bend).fold(0.0, f64::max);
            Some((std::array::from_fn::<_, 12, _>(|row| -(ahead[row] - behind[row]) / (2.0 * width)), bend))
        };
        let ((wide, bend), (narrow, less)) = (slopes(width)?, slopes(0.5 * width)?);
        for row in 0..12 {
            tables[0][row][column] = (4.0 * narrow[row] - wide[row]) / 3.0;
            tables[1][row][column] = OF_WIDTHS * (wide[row] - narrow[row]).abs();
        }
        let largest = wide.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        // The two one-sided differences approach each other with the width, except at a kink.
        if less > 0.75 * bend + 1e-7 * largest {
            return None;
        }
        if wide.iter().zip(&narrow).any(|(wide, narrow)| (wide - narrow).abs() > 1e-3 * largest) {
            return None;
        }
    }
    Some(tables)
}

fn fastest(states: &[State; 2], size: f64) -> f64 {
    let norm = |v: &[f64; 3]| Vec3::from(*v).norm();
    states.iter().map(|s| norm(&s.linear_velocity) + size * norm(&s.angular_velocity)).fold(0.0, f64::max)
}

/// A state with one coordinate of its pose or twist changed.
pub(super) fn moved(state: &State, coordinate: usize, by: f64, is_twist: bool) -> State {
    let mut vector = Vec3::zeros();
    vector[coordinate % 3] = by;
    let (mut pose, mut twist): (Pose, Twist) = (state.pose(), state.twist());
    match (is_twist, coordinate < 3) {
        (false, true) => pose.position += vector,
        (false, false) => pose.orientation = Quat::from_scaled_axis(vector) * pose.orientation,
        (true, true) => twist.linear += vector,
        (true, false) => twist.angular += vector,
    }
    State::from_motion(&pose, &twist)
}

/// Contacts with the branches of their laws, in one order.
pub(super) fn branches(answer: &Answer) -> Vec<([u32; 3], u32, u32, bool, bool)> {
    let mut all: Vec<_> = answer
        .contacts
        .iter()
        .map(|touch| (touch.of, touch.feature, touch.end, touch.sticks, touch.normal_force > 0.0))
        .collect();
    all.sort_unstable();
    all
}

fn rows(answer: &Answer, size: f64) -> [f64; 12] {
    std::array::from_fn(|row| {
        let wrench = &answer.wrenches[row / 6];
        let part = if row % 6 < 3 { &wrench.force } else { &wrench.moment };
        part[row % 3] * scale(row, size)
    })
}

fn compare(
    exact: &Table,
    [differences, errors]: &[Table; 2],
    (what, least): (&str, f64),
) -> Option<(f64, String)> {
    let entries = || (0..12).flat_map(|row| (0..COLUMNS).map(move |column| (row, column)));
    let largest =
        entries().map(|(r, c)| exact[r][c].abs().max(differences[r][c].abs())).fold(least, f64::max);
    let apart = |&(row, column): &(usize, usize)| {
        (exact[row][column] - differences[row][column]).abs() - errors[row][column]
    };
    let worst = entries().max_by(|a, b| apart(a).total_cmp(&apart(b)))?;
    let relative = apart(&worst) / largest.max(f64::MIN_POSITIVE);
    (apart(&worst) > TOLERANCE * largest).then(|| {
        let (row, column) = worst;
        let says = format!(
            "{what}, row {row}, column {column}: {:e}, by differences {:e}; largest {largest:e}\nexact {exact:.3?}\ndifferences {differences:.3?}",
            exact[row][column], differences[row][column]
        );
        (relative, says)
    })
}
