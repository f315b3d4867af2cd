//! What a contact adds to the wrenches.

use super::contact::FrameContact;
use pong_geometry::Vec3;

/// What a contact adds to the wrenches, in B's frame, on a cache line of its own: the sums read no more of what another core
/// has written.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Term {
    /// On A, N.
    pub force_b: Vec3,
    /// Contact point c, m.
    pub point_b: Vec3,
    /// Of its forces, N, and what is stored in it, J, all together: no less than any of them, which may cancel each other.
    pub size: f64,
}

impl Term {
    /// Something to fill memory with.
    pub fn nothing() -> Self {
        Self { force_b: Vec3::zeros(), point_b: Vec3::zeros(), size: 0.0 }
    }

    /// What a contact that is whole adds.
    #[inline(always)]
    pub fn of(contact: &FrameContact) -> Self {
        let size = contact.normal_force + contact.friction_force_b.abs().sum() + contact.stored.abs();
        Self { force_b: contact.force(), point_b: contact.point_b, size }
    }
}
