//! Normal force of a cell.

use crate::state::SolidContactPart;
use pong_geometry::Vec3;

/// Normal force of a cell, in B's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CellForce {
    pub part: SolidContactPart,
    pub face: u32,
    /// Direction of the force on A.
    pub normal_b: Vec3,
    /// Point where the force acts, m.
    pub point_b: Vec3,
    /// Normal force, N.
    pub force: f64,
    /// Mean depth rate, m/s.
    pub rate: f64,
    /// Effective area times the field's share, m².
    pub area: f64,
    /// Effective depth, m.
    pub depth: f64,
}
