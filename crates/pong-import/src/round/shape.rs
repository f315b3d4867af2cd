//! What is recognised.

use nalgebra::Vector3;

/// What a part is.
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

/// A primitive and how far the mesh is from it at most, m.
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
