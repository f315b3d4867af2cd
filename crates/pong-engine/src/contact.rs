//! Results of a frame: contacts and energies. Counts and times are in `report.rs`.

use crate::ids::{InterfaceId, ObjectId, PairId};
use pong_geometry::Vec3;
use pong_geometry::interference::Feature;

/// One contact of the last frame, in the form that a host gets. The C structure, the rows of a log and
/// NumPy's rows are layouts of it.
///
/// Forces are those on A; B receives the opposite at the same point. Vectors are in common axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// The pair of Objects.
    pub pair: PairId,
    /// Side A: the primitive whose kind the tester names first.
    pub a: ContactSide,
    /// Side B.
    pub b: ContactSide,
    /// Face, edge or vertex of B that pushes. Of pieces that form a convex solid together (docs/theory.md, 2.8), a capsule
    /// or a line segment touches this solid: side B names the first piece, and the number is one of the solid.
    pub feature: Feature,
    /// Location on a segment or a round part with two ends: 0 and 1 at its ends, 2 between them (of a capsule on
    /// triangles 2 and 3, the lower and the upper end of what a feature carries), above 2 other points of a
    /// cylinder's or cone's rims (docs/theory.md, 2.8). 0 for all other kinds. The bit 30
    /// marks the two forces of a couple that resists rolling and spinning (docs/theory.md, 4).
    pub end: u32,
    /// Contact point c, where the force acts, m, in the common frame.
    pub point: Vec3,
    /// Unit normal from B to A.
    pub normal: Vec3,
    /// Depth δ, m.
    pub depth: f64,
    /// Depth rate δ', m/s, positive while closing.
    pub depth_rate: f64,
    /// Weight w of the contact, 0…1.
    pub weight: f64,
    /// Normal force, N, never negative.
    pub normal_force: f64,
    /// Friction force on A, N.
    pub friction_force: Vec3,
    /// Total force on A, N.
    pub force: Vec3,
    /// Tangential velocity of A relative to B, m/s.
    pub slip_velocity: Vec3,
    /// True if friction sticks.
    pub sticks: bool,
    /// Energy stored in the normal spring and the bristle, J.
    pub stored: f64,
    /// Work done on the two bodies since the contact began, J; 0 without a ledger.
    pub work: f64,
    /// Energy dissipated since the contact began, J: −work − stored; 0 without a ledger.
    pub dissipated: f64,
}

/// One side of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSide {
    /// The Object.
    pub object: ObjectId,
    /// The movable group.
    pub interface: InterfaceId,
    /// Index of the primitive in its movable group's list (see
    /// [`Scene::primitive_path`](crate::Scene::primitive_path)).
    pub primitive: u32,
    /// Index of the element within the primitive: a mesh's triangle, from 0; 0 for all other kinds.
    pub element: u32,
    /// Vector from the origin of the movable group to the contact point, m, in common axes.
    pub arm: Vec3,
}

/// Energies of all contacts. Work and dissipation are zero unless the world keeps the ledger
/// ([`Config::ledger`](crate::Config)).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Energy stored in normal springs and bristles at the last commit, J.
    pub stored: f64,
    /// Work done on the bodies since the world began, by the trapezoidal rule between commits, J.
    pub work: f64,
    /// Energy dissipated since the world began, J: −work − stored, plus the work of the drives of moving surfaces
    /// ([`driven`](Self::driven)). Cleared history counts as dissipated. Energy that the host inserted, by placing
    /// bodies in contact or by a preload, counts negative.
    pub dissipated: f64,
}

impl Ledger {
    /// Work of the drives of surfaces that move along themselves since the world began, J. It is zero to rounding
    /// where no surface moves.
    pub fn driven(&self) -> f64 {
        self.work + self.stored + self.dissipated
    }
}
