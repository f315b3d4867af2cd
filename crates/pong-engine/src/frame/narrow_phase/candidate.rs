//! A contact as a contact tester finds it, before anything is decided about it.

use crate::state::{ContactKey, ContactRole, NO_FACE, RecordRange};
use pong_geometry::Vec3;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::Item;

/// The order of every sum: by key, then by what of B pushes.
pub(crate) type ContactOrder = (ContactKey, u32, u32, Feature);

/// A contact as a tester finds it. Vectors are in the frame of B's movable group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ContactCandidate {
    pub key: ContactKey,
    pub primitive_b: u32,
    pub element_a: u32,
    pub element_b: u32,
    pub feature: Feature,
    /// Face that memory has reached in the polyhedron of B.
    pub entry_face: u32,
    /// The committed records under its key, if the tester has looked for them.
    pub remembered: Option<RecordRange>,
    pub kind_b: PrimitiveKind,
    /// Which element of its chunk the element of A is.
    pub lane: u8,
    /// Half a spring (the end of a segment) or a whole one.
    pub half: bool,
    /// Whether contacts under the same key share one spring.
    pub shares: bool,
    pub status: CandidateStatus,
    pub role: ContactRole,
    /// m; positive. This and the vectors below are in B's frame.
    pub depth: f64,
    /// Unit vector from B to A.
    pub normal_b: Vec3,
    /// The deepest place of A, m.
    pub deepest_b: Vec3,
    /// Distance along a ray, m; infinite for everything else.
    pub ray_distance: f64,
    /// The weight w of docs/theory.md, 2.2; 1 for a single contact.
    pub weight: f64,
}

/// How a contact stands among those of the same surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum CandidateStatus {
    /// Nothing special.
    Front,
    /// The centre is behind the face.
    BackFace,
    /// Pushes within rounding alone: counts where no other contact has the place.
    Fallback,
    /// The same with the centre behind the face.
    BackFaceFallback,
    /// Stands in for what has lost its foot: counts only where nothing else is as deep. Of a segment: for what leaves a piece
    /// within rounding where a wall ends.
    StandIn,
    /// A point or the endpoint of a segment in a piece, at an inner wall, or an edge in which the wall ends: counts unless a
    /// piece of lower index has it as well. Also a segment's exit beside a wall, which one piece carries.
    AtWall,
    /// A point or endpoint at an inner wall of a piece, but beyond: counts only where rounding leaves it in no piece at all.
    BeyondWall,
    /// Turned out not to count.
    Culled,
}

impl ContactCandidate {
    /// Of no two elements; whole, in front and alone, as most contacts are. Something to fill memory with.
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

    /// A whole contact, as most are, of an element of A and one of B.
    #[inline(always)]
    pub fn new(
        key: ContactKey,
        (item_a, lane): (Item, u8),
        (item_b, kind_b): (Item, PrimitiveKind),
        found: &Interference,
    ) -> Self {
        Self {
            key,
            primitive_b: item_b.primitive,
            element_a: item_a.element,
            element_b: item_b.element,
            feature: found.feature,
            kind_b,
            lane,
            depth: found.depth,
            normal_b: found.normal_b,
            deepest_b: found.deepest_b,
            ..Self::NOTHING
        }
    }

    /// It shares its spring with others under its key; half a spring at the end of an axis.
    pub fn share(&mut self, half: bool) {
        (self.shares, self.half) = (true, half);
    }

    /// Where the contact stands in every sum.
    pub fn order(&self) -> ContactOrder {
        (self.key, self.primitive_b, self.element_b, self.feature)
    }

    /// Whether it takes part in what the contacts of a ball share.
    pub fn takes_part(&self) -> bool {
        self.status != CandidateStatus::Culled && self.role == ContactRole::Active
    }

    /// h: the end of a segment has half of a spring.
    pub fn half_or_whole(&self) -> f64 {
        if self.half { 0.5 } else { 1.0 }
    }

    /// Weight with the half spring of a segment's end taken in.
    pub fn full_weight(&self) -> f64 {
        self.half_or_whole() * self.weight
    }
}
