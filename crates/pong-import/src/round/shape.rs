//! Recognised round primitives.

use nalgebra::Vector3;

/// Kind of a round part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Capsule,
    Cylinder,
    Cone,
    Bore,
}

/// A round primitive, lengths in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    pub kind: Kind,
    pub ends: [Vector3<f64>; 2],
    pub radii: [f64; 2],
}

/// A primitive and the largest distance of the mesh from it, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recognised {
    pub round: Round,
    pub farthest_m: f64,
}

impl Kind {
    pub fn name(self) -> &'static str {
        match self {
            Self::Capsule => "Capsule",
            Self::Cylinder => "Cylinder",
            Self::Cone => "Cone",
            Self::Bore => "Bore",
        }
    }
}
