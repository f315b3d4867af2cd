//! Memory between frames.

use crate::chart::Axes;
use nalgebra::Vector6;
use pong_geometry::Pose;
use std::collections::VecDeque;

/// Memory of one body.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct KeptBody {
    pub axes: Axes,
    /// Offset of the copy from the predicted leading pose (`chart::offset`).
    pub offset: Pose,
    /// Impulse that the copy got and the host's body did not.
    pub held_back: Vector6<f64>,
    /// Work of friction, J, that the copy has lost and the host's body has not: the copy slid further.
    pub unspent: f64,
    /// Predicted leading pose, and velocity, at the next call, carried forward by the delay.
    pub predicted: Pose,
    pub predicted_velocity: Vector6<f64>,
    /// Pose and velocity that the host gave at this call.
    pub given: Pose,
    pub given_velocity: Vector6<f64>,
    /// Impulses on their way to the host, the oldest first.
    pub queue: VecDeque<Vector6<f64>>,
}

/// Memory between frames, besides the contact state of the engine.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Memory {
    /// Length of the last frame, s.
    pub length: f64,
    /// Squared largest rate of the contacts of the last frame, 1/s²; 0 if nothing touched.
    pub rate_square: f64,
    /// One entry per movable group; empty before the first frame.
    pub bodies: Vec<KeptBody>,
}

impl Memory {
    /// Memory of a body in this chart; `None` if there is none.
    pub fn of(&self, body: usize, axes: Axes) -> Option<&KeptBody> {
        self.bodies.get(body).filter(|kept| kept.axes == axes)
    }
}
