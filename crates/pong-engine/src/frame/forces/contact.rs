//! Contacts with their forces.

use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::state::ContactRecord;
use pong_geometry::Vec3;

/// A contact that was not culled, with its forces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameContact {
    // testers, sharing
    pub found: ContactCandidate,
    // forces
    /// Contact point c, m. All vectors below are in B's frame.
    pub point_b: Vec3,
    /// Depth rate, m/s, positive while closing.
    pub rate: f64,
    /// Normal force, N; never negative.
    pub normal_force: f64,
    /// Friction force on A, N.
    pub friction_force_b: Vec3,
    /// Velocity of A's surface relative to B's in the tangent plane, m/s.
    pub slip_velocity_b: Vec3,
    /// Deflection p of the bristle, m.
    pub bristle_b: Vec3,
    /// Energy stored in the normal spring and the bristle, J.
    pub stored: f64,
    pub sticks: bool,
    /// Work done on the two bodies since the contact began, J; 0 unless the ledger is kept.
    pub work: f64,
    /// Energy dissipated since the contact began, J; 0 unless the ledger is kept.
    pub dissipated: f64,
}

impl FrameContact {
    /// Placeholder to fill memory.
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

    /// Number that is at least as large as the magnitude of the force, N, and as that of the stored energy,
    /// J. It is a sum of magnitudes, so that large parts cannot cancel.
    #[inline]
    pub fn size(&self) -> f64 {
        self.normal_force + self.friction_force_b.abs().sum() + self.stored.abs()
    }

    /// Contact record for the next commit.
    pub fn record(&self) -> ContactRecord {
        let mut record = ContactRecord::blank();
        self.write_record(&mut record);
        record
    }

    /// Writes the contact record in place.
    #[inline(always)]
    pub fn write_record(&self, record: &mut ContactRecord) {
        let found = &self.found;
        // No `..`, so that a new field of the record cannot be forgotten here.
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
