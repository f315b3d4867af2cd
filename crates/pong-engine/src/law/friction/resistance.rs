//! Resistance of a contact to rolling and spinning (docs/theory.md, 4): two bristles that are stretched by the
//! angle turned times a lever, one in the contact plane and one along the normal.
//!
//! ```text
//! p = L·θ      F = −cut(K·p + c·L·ω), its length cut to b·F_n/L      M = L·F
//! ```
//!
//! Here θ is the angle that the bristle has taken up, ω the angular velocity of A relative to B, L the lever,
//! and b the length of the resistance.

use super::bristle::{BristleForces, Bristles};
use pong_geometry::Vec3;
use pong_geometry::simd::{LANES, LaneBits, Numbers, Portable, Vectors};

/// Both bristles of a contact, and what it has turned since the last commit. Vectors are in B's frame.
pub(crate) struct Resistance {
    /// Unit normal of the contact.
    pub normal_b: Vec3,
    /// Lever L, m.
    pub lever: f64,
    /// Tangential stiffness K of the contact, N/m, and its damping c, N·s/m.
    pub stiffness: f64,
    pub damping: f64,
    /// Largest moment against rolling and against spinning, N·m.
    pub limits: [f64; 2],
    /// Deflections p at the last commit, carried to the present normal, m: that of rolling in the contact
    /// plane, that of spinning along the normal.
    pub carried_b: Vec3,
    /// Rotation vector of A relative to B since the last commit, rad.
    pub turned_b: Vec3,
    /// Angular velocity of A relative to B, rad/s.
    pub rate_b: Vec3,
    /// True for each bristle that stuck at the last commit: rolling, spinning.
    pub stuck: [bool; 2],
}

/// Moment on A and new state of both bristles.
pub(crate) struct ResistingMoment {
    /// Moment on A, N·m.
    pub moment_b: Vec3,
    /// Deflections p, m: in the contact plane and along the normal.
    pub bristle_b: Vec3,
    /// Energy stored, J.
    pub stored: f64,
    /// True for each bristle that sticks: rolling, spinning.
    pub sticks: [bool; 2],
}

impl Resistance {
    /// Evaluates both bristles. A bristle whose limit is zero has no stiffness, so it stores nothing.
    pub fn evaluate(&self) -> ResistingMoment {
        let Self { normal_b, lever, limits, stuck, .. } = self;
        let if_resists = |value: f64| limits.map(|limit| if limit > 0.0 { value } else { 0.0 });
        let pull = numbers(limits.map(|limit| limit / lever));
        let [carried, slip, slip_velocity] =
            [self.carried_b, self.turned_b * *lever, self.rate_b * *lever].map(|vector| self.parts(&vector));
        let stuck = stuck.map(LaneBits::from);
        // The remaining lanes are zeros that stick.
        let rest = LaneBits::MAX << 2;
        let BristleForces { force, bristle, stored, sticks } = Bristles {
            stiffness: numbers(if_resists(self.stiffness)),
            damping: numbers(if_resists(self.damping)),
            kinetic_limit: pull,
            static_limit: pull,
            normal: Vectors::splat(Portable, normal_b),
            carried,
            slip,
            slip_velocity,
            stuck: stuck[0] | stuck[1] << 1 | rest,
        }
        .evaluate(Portable);
        let sum = |lanes: [[f64; LANES]; 3]| Vec3::from(lanes.map(|lane| lane[0] + lane[1]));
        let stored = stored.store();
        ResistingMoment {
            moment_b: sum(force.store()) * *lever,
            bristle_b: sum(bristle.store()),
            stored: stored[0] + stored[1],
            sticks: [sticks & 1 == 1, sticks >> 1 & 1 == 1],
        }
    }

    /// Parts of a vector in the contact plane and along the normal, in the first two lanes. A bristle whose
    /// limit is zero gets none.
    fn parts(&self, vector: &Vec3) -> Vectors<Portable> {
        let along = self.normal_b * self.normal_b.dot(vector);
        let parts = [vector - along, along];
        let mut lanes = [[0.0; LANES]; 3];
        for lane in (0..2).filter(|&lane| self.limits[lane] > 0.0) {
            (0..3).for_each(|axis| lanes[axis][lane] = parts[lane][axis]);
        }
        Vectors::load(Portable, &lanes)
    }
}

/// Numbers in the first two lanes, zero in the others.
fn numbers([rolling, spinning]: [f64; 2]) -> Numbers<Portable> {
    let mut lanes = [0.0; LANES];
    (lanes[0], lanes[1]) = (rolling, spinning);
    Numbers::load(Portable, &lanes)
}
