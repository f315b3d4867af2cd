//! Contact in load sharing, and the coupling of two contacts.

use pong_geometry::Vec3;

/// Cosine below which two normals count as more than 90° apart. It allows for rounding: in a square corner
/// the product of the normals has either sign, and whether the pair couples changes λ by at most this
/// fraction.
const APART_COSINE: f64 = -1e-14;

/// One of several contacts that share a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SharedContact {
    /// Unit normal.
    pub normal_b: Vec3,
    /// Depth δ > 0, m.
    pub depth: f64,
    /// Result λ, m; set by [`share_within`](super::share_within).
    pub lambda: f64,
}

impl SharedContact {
    /// Placeholder to fill memory.
    pub const NOTHING: Self = Self { normal_b: Vec3::new(0.0, 0.0, 0.0), depth: 0.0, lambda: 0.0 };

    /// A contact whose λ is not computed yet.
    pub fn new(normal: Vec3, depth: f64) -> Self {
        Self { normal_b: normal, depth, lambda: 0.0 }
    }
}

/// Returns true if no two normals are more than 90° apart.
pub(super) fn all_couple(contacts: &[SharedContact]) -> bool {
    let couples = |a: &SharedContact, b: &SharedContact| a.normal_b.dot(&b.normal_b) >= APART_COSINE;
    contacts.iter().enumerate().all(|(i, a)| contacts[i + 1..].iter().all(|b| couples(a, b)))
}

/// Index of the deepest contact; the first of several.
pub(super) fn deepest_of(contacts: &[SharedContact]) -> usize {
    let mut best = 0;
    for (i, contact) in contacts.iter().enumerate() {
        if contact.depth > contacts[best].depth {
            best = i;
        }
    }
    best
}

/// Coupling of two contacts. Normals more than 90° apart do not couple.
#[derive(Clone, Copy, Debug)]
pub(super) struct Coupling {
    /// Coupling g = max(0, n₁·n₂), dimensionless.
    pub cosine: f64,
    /// Gap 1 − g, dimensionless.
    pub gap: f64,
    /// True if the normals are less than 60° apart: `beyond` then uses differences.
    pub is_near: bool,
}

impl Coupling {
    /// Cosine of 60°. If two contacts with nearer normals both have load, their depths are within a factor of
    /// two, so the difference of the depths is exact.
    const NEAR_COSINE: f64 = 0.5;

    pub fn new(a: &SharedContact, b: &SharedContact) -> Self {
        let cosine = a.normal_b.dot(&b.normal_b);
        if cosine > Self::NEAR_COSINE {
            // For unit vectors |n₁ − n₂|² = 2 − 2·n₁·n₂.
            let gap = 0.5 * (a.normal_b - b.normal_b).norm_squared();
            return Self { cosine: 1.0 - gap, gap, is_near: true };
        }
        let cosine = cosine.max(0.0);
        Self { cosine, gap: 1.0 - cosine, is_near: false }
    }

    /// Depth δ − g·δ′ that remains, m, once the other contact, of depth δ′, has been cleared.
    pub fn beyond(&self, depth: f64, other_depth: f64) -> f64 {
        if self.is_near {
            (depth - other_depth) + self.gap * other_depth
        } else {
            depth - self.cosine * other_depth
        }
    }
}
