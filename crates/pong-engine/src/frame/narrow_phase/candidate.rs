//! Contact candidates, as the contact testers find them.

pub(crate) use crate::frame::load_sharing::status::CandidateStatus;
use crate::state::{ContactKey, ContactRole, NO_FACE, RecordRange};
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;
use pong_geometry::primitive::PrimitiveKind;

/// Summation order: by key, then by primitive, element and feature of B.
pub(crate) type ContactOrder = (ContactKey, u32, u32, Feature);

/// Contact candidate that a contact tester has found. Vectors are in the frame of B's movable group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactCandidate {
    pub key: ContactKey,
    pub primitive_b: u32,
    pub element_a: u32,
    pub element_b: u32,
    pub feature: Feature,
    /// Current face of entry in the polyhedron of B; [`NO_FACE`] if there is none.
    pub entry_face: u32,
    /// Committed records of the key, if the tester has looked them up.
    pub remembered: Option<RecordRange>,
    pub kind_b: PrimitiveKind,
    /// Index of A's element in its chunk.
    pub lane: u8,
    /// True for half a spring, as at each end of a segment or capsule.
    pub half: bool,
    /// True if the contacts of the key share one spring.
    pub shares: bool,
    pub status: CandidateStatus,
    pub role: ContactRole,
    /// Depth, m; positive. The vectors below are in B's frame.
    pub depth: f64,
    /// Unit vector from B to A.
    pub normal_b: Vec3,
    /// Deepest point of A, m.
    pub deepest_b: Vec3,
    /// Distance from the origin of a ray to the hit, m; infinite for other kinds.
    pub ray_distance: f64,
    /// Weight w of docs/theory.md, 2.2; 1 for a single contact.
    pub weight: f64,
}

impl ContactCandidate {
    /// Placeholder to fill memory, with the defaults of most candidates: whole spring, in front, unshared.
    pub const NOTHING: Self = Self {
        key: ContactKey { group_pair: 0, flipped: 0, primitive_a: 0, shell_b: 0, end: 0 },
        primitive_b: 0,
        element_a: 0,
        element_b: 0,
        feature: Feature::WHOLE,
        entry_face: NO_FACE,
        remembered: None,
        kind_b: PrimitiveKind::Plane,
        lane: 0,
        half: false,
        shares: false,
        status: CandidateStatus::Front,
        role: ContactRole::Active,
        depth: 0.0,
        normal_b: Vec3::new(0.0, 0.0, 0.0),
        deepest_b: Vec3::new(0.0, 0.0, 0.0),
        ray_distance: f64::INFINITY,
        weight: 1.0,
    };

    /// Marks the candidate as one that shares a spring with the others of its key; `half` for half a spring.
    pub fn share(&mut self, half: bool) {
        (self.shares, self.half) = (true, half);
    }

    /// Position in the summation order.
    pub fn order(&self) -> ContactOrder {
        (self.key, self.primitive_b, self.element_b, self.feature)
    }

    /// Returns true if the candidate takes part in load sharing.
    pub fn takes_part(&self) -> bool {
        self.status != CandidateStatus::Culled && self.role == ContactRole::Active
    }

    /// Factor h: one half for half a spring, otherwise one.
    pub fn half_or_whole(&self) -> f64 {
        if self.half { 0.5 } else { 1.0 }
    }

    /// Weight including the factor h.
    pub fn full_weight(&self) -> f64 {
        self.half_or_whole() * self.weight
    }
}
