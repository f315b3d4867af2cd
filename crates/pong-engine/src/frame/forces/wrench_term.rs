//! Wrench contribution of a contact.

use super::contact::FrameContact;
use pong_geometry::Vec3;

/// Wrench contribution of a contact, in B's frame. One cache line each, so that the sums read as little as
/// possible of another core's data.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct WrenchTerm {
    /// Force on A, N.
    pub force_b: Vec3,
    /// Contact point c, m.
    pub point_b: Vec3,
    /// Sum of the magnitudes of its forces, N, and stored energy, J: a bound on each, immune to cancellation.
    pub size: f64,
}

impl WrenchTerm {
    /// Placeholder to fill memory.
    pub fn nothing() -> Self {
        Self { force_b: Vec3::zeros(), point_b: Vec3::zeros(), size: 0.0 }
    }

    /// Contribution of a complete contact.
    #[inline(always)]
    pub fn of(contact: &FrameContact) -> Self {
        let size = contact.normal_force + contact.friction_force_b.abs().sum() + contact.stored.abs();
        Self { force_b: contact.force(), point_b: contact.point_b, size }
    }
}
