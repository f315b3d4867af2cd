//! Contact records and their keys.

use crate::seal::Direction;
use pong_geometry::Vec3;

/// Value of [`ContactRecord::entry_face`] if no side of entry is known.
pub(crate) const NO_FACE: u32 = u32::MAX;

/// Key of a contact record. Key order is summation order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct ContactKey {
    /// Index of the pair of movable groups.
    pub group_pair: u32,
    /// 0 if A belongs to the pair's first group, 1 if to its second.
    pub flipped: u32,
    /// Primitive of A.
    pub primitive_a: u32,
    /// Shell of B.
    pub shell_b: u32,
    /// Place on A, if A has two ends: 0 and 1 at the ends, 2 and above elsewhere. For solids, see
    /// [`of_solids`](Self::of_solids); for the contacts of a couple, [`of_couple`](Self::of_couple). 0 for all
    /// other kinds.
    pub end: u32,
}

/// Part of the contact of two solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SolidContactPart {
    /// Cell of B's field: volume nearest to one face of B.
    CellOfB = 0,
    /// Cell of A's field.
    CellOfA = 1,
    /// Two contacts with the friction, 0 and 1 as features.
    Friction = 2,
    /// Sides of entry. The record has the direction in B's frame as its normal, and that in A's frame in
    /// place of a bristle.
    Entry = 3,
}

impl ContactKey {
    /// Bit of `end` that marks contacts of solids.
    const SOLID: u32 = 1 << 31;
    const PART_SHIFT: u32 = 29;

    /// Key with the `end` of a part of the contact of two solids. `unit_a` is the index of the part
    /// of A.
    pub fn of_solids(self, part: SolidContactPart, unit_a: u32) -> Self {
        let unit_a = unit_a & ((1 << Self::PART_SHIFT) - 1);
        Self { end: Self::SOLID | (part as u32) << Self::PART_SHIFT | unit_a, ..self }
    }

    /// Key of another part of the same contact of two solids.
    pub fn with_part(self, part: SolidContactPart) -> Self {
        let unit_a = self.end & ((1 << Self::PART_SHIFT) - 1);
        self.of_solids(part, unit_a)
    }

    /// Returns true if the contact is one of two solids.
    #[inline]
    pub fn is_of_solids(&self) -> bool {
        self.end & Self::SOLID != 0
    }

    /// Bit of `end` that marks the two contacts of a resistance couple, and the bit that tells them apart.
    const COUPLE: u32 = 1 << 30;
    const SECOND: u32 = 1 << 29;

    /// Keys of the two contacts whose forces are the couple that resists rolling and spinning at a contact of
    /// this key.
    pub fn of_couple(self) -> [Self; 2] {
        [Self::COUPLE, Self::COUPLE | Self::SECOND].map(|bits| Self { end: self.end | bits, ..self })
    }

    /// Returns true if the contact is one that a contact tester has found: neither one of two solids nor part
    /// of a resistance couple.
    #[inline]
    pub fn is_tested(&self) -> bool {
        self.end & (Self::SOLID | Self::COUPLE) == 0
    }

    /// Fields packed into two words, which compare faster than five fields.
    #[inline]
    fn rank(&self) -> (u64, u64) {
        (self.head(), self.tail())
    }

    /// Pair of movable groups, and which of them holds A.
    #[inline]
    pub fn direction(&self) -> Direction {
        Direction { group_pair: self.group_pair, flipped: self.flipped }
    }

    /// Direction of all keys with this high word.
    #[inline]
    pub fn direction_of(head: u64) -> Direction {
        Direction { group_pair: (head >> 33) as u32, flipped: (head >> 32) as u32 & 1 }
    }

    /// High word: everything but the shell and the end. Few contacts share it.
    #[inline]
    pub fn head(&self) -> u64 {
        u64::from(self.group_pair) << 33 | u64::from(self.flipped) << 32 | u64::from(self.primitive_a)
    }

    /// Low word.
    #[inline]
    pub fn tail(&self) -> u64 {
        u64::from(self.shell_b) << 32 | u64::from(self.end)
    }
}

impl Ord for ContactKey {
    #[inline]
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.rank().cmp(&other.rank())
    }
}

impl PartialOrd for ContactKey {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// Reason why a contact is remembered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ContactRole {
    /// It pushes.
    Active,
    /// A overlaps B, but A's centre came through the surface from behind, so it is not pushed to the front.
    WrongSide,
    /// The contact has no share of the spring; the next frame needs only its side of entry.
    Tracked,
}

impl ContactRole {
    pub fn to_word(self) -> u32 {
        self as u32
    }

    /// Role with this code, if any.
    pub fn from_word(word: u32) -> Option<Self> {
        [Self::Active, Self::WrongSide, Self::Tracked].into_iter().find(|role| role.to_word() == word)
    }
}

/// Memory of one contact. Vectors are in the frame of B's movable group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ContactRecord {
    pub key: ContactKey,
    /// Feature of B; breaks ties.
    pub feature: u32,
    /// Element of B: a piece or a triangle of the shell, or the primitive itself.
    pub element_b: u32,
    /// Current face of entry in that piece, or [`NO_FACE`].
    pub entry_face: u32,
    /// True if the bristle sticks.
    pub sticks: bool,
    /// Role: pushes, or is only remembered.
    pub role: ContactRole,
    /// Unit vector n from B to A.
    pub normal_b: Vec3,
    /// Contact point c, m.
    pub point_b: Vec3,
    /// Bristle deflection p, m.
    pub bristle_b: Vec3,
    /// Force on A, N, for the ledger's trapezoidal rule.
    pub force_b: Vec3,
    /// Energy stored in the normal spring and in the bristle, J.
    pub stored: f64,
    /// Work done on the two bodies since the contact began, J.
    pub work: f64,
    /// Energy dissipated since the contact began, J.
    pub dissipated: f64,
}

impl ContactRecord {
    /// Placeholder to fill memory.
    pub fn blank() -> Self {
        let zero = Vec3::zeros();
        Self {
            key: ContactKey::default(),
            feature: 0,
            element_b: 0,
            entry_face: NO_FACE,
            sticks: false,
            role: ContactRole::Tracked,
            normal_b: zero,
            point_b: zero,
            bristle_b: zero,
            force_b: zero,
            stored: 0.0,
            work: 0.0,
            dissipated: 0.0,
        }
    }
}
