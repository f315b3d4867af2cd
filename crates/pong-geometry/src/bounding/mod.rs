//! Bounding volumes: fitting, and the overlap tests.
//!
//! An overlap test returns `true` unless the two volumes are certainly disjoint. Rounding may cause a false
//! overlap, never a missed one; [`RELATIVE_MARGIN`] explains why.
//!
//! One file fits each kind of volume (`aabb`, `sphere`, `obb`), one file tests each pair of kinds
//! (`sphere_sphere`, `sphere_aabb` …), and [`VolumeTests`] selects the test.

mod aabb;
mod aabb_aabb;
mod aabb_obb;
mod bounded;
mod box_box;
mod fit;
mod margin;
mod obb;
mod obb_obb;
mod principal_axes;
mod sphere;
mod sphere_aabb;
mod sphere_obb;
mod sphere_sphere;
mod volume;
mod volume_tests;

pub use aabb::{aabb_of_points, fit_aabb_bounds};
pub use bounded::{CustomBounds, Dilated, PointCloud};
pub(crate) use bounded::{ball_representatives, farthest_of_points, largest, support_of_points};
pub use fit::fit;
pub use margin::RELATIVE_MARGIN;
pub use volume::{BoundKind, Bounded, CustomVolume, FromAToB, Volume};
pub use volume_tests::{CarriedVolume, VolumeTests};
