//! One of several contacts that share a spring, and how much two of them couple.

use pong_geometry::Vec3;

/// Cosine below which two normals count as more than 90° apart. Rounding lies below it: in a square corner the products
/// of the normals have either sign, and whether such a pair couples changes λ by no more than this part of it.
const APART_COSINE: f64 = -1e-14;

/// One of several contacts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedContact {
    /// Unit normal.
    pub normal_b: Vec3,
    /// Depth δ > 0, m.
    pub depth: f64,
    /// λ, m: filled in by [`share_within`](super::share_within).
    pub lambda: f64,
}

impl SharedContact {
    /// Something to fill memory with.
    pub const NOTHING: Self = Self { normal_b: Vec3::new(0.0, 0.0, 0.0), depth: 0.0, lambda: 0.0 };

    /// A contact whose share is not known yet.
    pub fn new(normal: Vec3, depth: f64) -> Self {
        Self { normal_b: normal, depth, lambda: 0.0 }
    }
}

/// Whether no two normals are more than 90° apart.
pub(super) fn all_couple(contacts: &[SharedContact]) -> bool {
    let couples = |a: &SharedContact, b: &SharedContact| a.normal_b.dot(&b.normal_b) >= APART_COSINE;
    contacts.iter().enumerate().all(|(i, a)| contacts[i + 1..].iter().all(|b| couples(a, b)))
}

/// Index of the deepest; of several the first.
pub(super) fn deepest_of(contacts: &[SharedContact]) -> usize {
    let mut best = 0;
    for (i, contact) in contacts.iter().enumerate() {
        if contact.depth > contacts[best].depth {
            best = i;
        }
    }
    best
}

/// How much two contacts couple. Normals more than 90° apart do not.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coupling {
    /// g = max(0, n₁·n₂), without unit.
    pub cosine: f64,
    /// 1 − g, without unit.
    pub gap: f64,
    /// Whether the normals are near enough to each other for differences to be exact.
    pub is_near: bool,
}

impl Coupling {
    /// Normals within 60° of each other are near: of two numbers at most a factor of two apart the difference is exact.
    const NEAR_COSINE: f64 = 0.5;

    pub fn new(a: &SharedContact, b: &SharedContact) -> Self {
        let cosine = a.normal_b.dot(&b.normal_b);
        if cosine > Self::NEAR_COSINE {
            // The two are of unit length: |n₁ − n₂|² = 2 − 2·n₁·n₂.
            let gap = 0.5 * (a.normal_b - b.normal_b).norm_squared();
            return Self { cosine: 1.0 - gap, gap, is_near: true };
        }
        let cosine = cosine.max(0.0);
        Self { cosine, gap: 1.0 - cosine, is_near: false }
    }

    /// What is left of a depth where another contact is cleared to its own: δ − g·δ'.
    pub fn beyond(&self, depth: f64, other_depth: f64) -> f64 {
        if self.is_near {
            (depth - other_depth) + self.gap * other_depth
        } else {
            depth - self.cosine * other_depth
        }
    }
}
