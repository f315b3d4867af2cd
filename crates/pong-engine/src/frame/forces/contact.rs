//! A contact with its forces.

use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::state::ContactRecord;
use pong_geometry::Vec3;

/// A contact that counts, with its forces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameContact {
    // testers, sharing
    pub found: ContactCandidate,
    // forces
    /// Contact point c, m. This and the vectors below are in B's frame.
    pub point_b: Vec3,
    /// Depth rate, m/s, positive while closing.
    pub rate: f64,
    /// N; never negative.
    pub normal_force: f64,
    /// On A, N.
    pub friction_force_b: Vec3,
    /// Of A past B in the tangent plane, m/s.
    pub slip_velocity_b: Vec3,
    /// Deflection p of the bristle, m.
    pub bristle_b: Vec3,
    /// In the normal spring and the bristle, J.
    pub stored: f64,
    pub sticks: bool,
    /// Work on the bodies since the last commit, J; 0 unless energy accounts are kept, as the next.
    pub work: f64,
    /// Lost since the last commit, J.
    pub dissipated: f64,
}

impl FrameContact {
    /// Something to fill memory with.
    pub fn blank() -> Self {
        Self {
            found: ContactCandidate::NOTHING,
            point_b: Vec3::zeros(),
            rate: 0.0,
            normal_force: 0.0,
            friction_force_b: Vec3::zeros(),
            slip_velocity_b: Vec3::zeros(),
            bristle_b: Vec3::zeros(),
            stored: 0.0,
            sticks: true,
            work: 0.0,
            dissipated: 0.0,
        }
    }

    /// Force on A, N.
    #[inline]
    pub fn force(&self) -> Vec3 {
        self.found.normal_b * self.normal_force + self.friction_force_b
    }

    /// What a commit remembers of the contact.
    pub fn record(&self) -> ContactRecord {
        let mut record = ContactRecord::blank();
        self.write_record(&mut record);
        record
    }

    /// Writes all of that.
    #[inline(always)]
    pub fn write_record(&self, record: &mut ContactRecord) {
        let found = &self.found;
        // Whoever gives a record one more field is told here.
        let ContactRecord {
            key,
            feature,
            element_b,
            entry_face,
            sticks,
            role,
            normal_b,
            point_b,
            bristle_b,
            force_b,
            stored,
            work,
            dissipated,
        } = record;
        *key = found.key;
        (*feature, *element_b, *entry_face) = (found.feature.0, found.element_b, found.entry_face);
        (*sticks, *role) = (self.sticks, found.role);
        (*normal_b, *point_b) = (found.normal_b, self.point_b);
        (*bristle_b, *force_b) = (self.bristle_b, self.force());
        (*stored, *work, *dissipated) = (self.stored, self.work, self.dissipated);
    }
}
