//! Poses as a scene file gives them.

use super::document::{Quaternion, Triple};
use super::error::At;
use pong_geometry::Pose;

/// Largest deviation of a quaternion's norm from 1.
const NORM_ERROR_MAX: f64 = 1e-3;

const IDENTITY: Quaternion = [1.0, 0.0, 0.0, 0.0];

/// A checked pose; the identity if it has a fault.
pub(crate) fn pose(position: &Triple, orientation: &Option<Quaternion>, at: &mut At<'_, '_>) -> Pose {
    let orientation = orientation.unwrap_or(IDENTITY);
    let mut good = at.finite("position", position);
    let norm = orientation.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = (norm - 1.0).abs() <= NORM_ERROR_MAX;
    if !unit {
        let cause = format!("`orientation` has norm {norm}");
        at.note(cause, "give a unit quaternion (w, x, y, z)");
        good = false;
    }
    if good { Pose::new((*position).into(), orientation) } else { Pose::identity() }
}
