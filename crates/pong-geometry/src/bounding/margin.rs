//! Margin by which every fitted volume is grown.

use super::volume::Volume;
use crate::Vec3;

/// Fraction of (the volume's extent + the distance of its centre from the frame's origin) by which every
/// fitted volume is grown.
///
/// With this margin the pair tests need none for position errors. Let the volumes have the centres `c_A` and
/// `c_B` in their frames and the extents `e_A` and `e_B`, and let the frames be `r` apart. Two errors occur,
/// in units of 1.1e-16:
///
/// * the error of a transformed centre (in the contact test: of the transformed shape), a few units of `r +
///   |c_A| + |c_B|`;
/// * the error of fitting, a few units of `|c| + e`.
///
/// If the volumes touch, `r ≤ |c_A| + e_A + |c_B| + e_B`. So the total error is below about ten units of
/// `|c_A| + e_A + |c_B| + e_B`, while the volumes are grown by 1e-12 of this sum: a thousand times more.
pub const RELATIVE_MARGIN: f64 = 1e-12;

impl Volume {
    /// Returns the volume grown by [`RELATIVE_MARGIN`]. The result of [`fit`](super::fit()) has been grown
    /// already; a volume built by hand should be grown before it is tested. A custom volume is returned
    /// unchanged, because its fitter adds a margin.
    pub fn inflated(self) -> Self {
        let margin = |extent: f64, center: &Vec3| RELATIVE_MARGIN * (extent + center.norm());
        match self {
            Self::Aabb { center, half } => {
                Self::Aabb { center, half: half.add_scalar(margin(half.norm(), &center)) }
            }
            Self::Sphere { center, radius } => {
                Self::Sphere { center, radius: radius + margin(radius, &center) }
            }
            Self::Obb { center, axes, half } => {
                Self::Obb { center, axes, half: half.add_scalar(margin(half.norm(), &center)) }
            }
            other => other,
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        let finite = |v: &Vec3| v.iter().all(|x| x.is_finite());
        match self {
            Self::Unbounded | Self::Custom(_) => true,
            Self::Aabb { center, half } => finite(center) && finite(half),
            Self::Sphere { center, radius } => finite(center) && radius.is_finite(),
            Self::Obb { center, axes, half } => {
                finite(center) && finite(half) && axes.iter().all(|x| x.is_finite())
            }
        }
    }
}
