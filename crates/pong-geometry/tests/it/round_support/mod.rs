//! Round solids for the tests of round parts.

use pong_geometry::bounding::Bounded;
use pong_geometry::primitive::{Capsule, Frustum};
use pong_geometry::{Transform, Vec3};

/// Capsule, cylinder or cone.
#[derive(Clone, Copy, Debug)]
pub enum Solid {
    /// Capsule: its ends are spheres.
    Capsule(Capsule),
    /// Cylinder or cone: its ends are discs.
    Frustum(Frustum),
}

impl Solid {
    /// Maximum of `direction · x` over the solid.
    pub fn support(&self, direction: &Vec3) -> f64 {
        match self {
            Self::Capsule(capsule) => Bounded::support(capsule, direction),
            Self::Frustum(frustum) => Bounded::support(frustum, direction),
        }
    }

    /// Solid transformed to another frame.
    pub fn carried(&self, x: &Transform) -> Self {
        match self {
            Self::Capsule(capsule) => Self::Capsule(capsule.carried(x)),
            Self::Frustum(frustum) => Self::Frustum(frustum.carried(x)),
        }
    }

    /// Solid scaled about the origin.
    pub fn scaled(&self, factor: f64) -> Self {
        match self {
            Self::Capsule(Capsule { ends, radius }) => {
                Self::Capsule(Capsule { ends: ends.map(|end| end * factor), radius: radius * factor })
            }
            Self::Frustum(Frustum { ends, radii, .. }) => {
                Self::Frustum(Frustum::new(ends.map(|end| end * factor), radii.map(|r| r * factor)))
            }
        }
    }

    /// Solid with its ends exchanged.
    pub fn swapped(&self) -> Self {
        match self {
            Self::Capsule(Capsule { ends: [a, b], radius }) => {
                Self::Capsule(Capsule { ends: [*b, *a], radius: *radius })
            }
            Self::Frustum(Frustum { ends: [a, b], radii: [r, s], .. }) => {
                Self::Frustum(Frustum::new([*b, *a], [*s, *r]))
            }
        }
    }

    /// Ends of the axis.
    pub fn ends(&self) -> [Vec3; 2] {
        let (Self::Capsule(Capsule { ends, .. }) | Self::Frustum(Frustum { ends, .. })) = self;
        *ends
    }
}
