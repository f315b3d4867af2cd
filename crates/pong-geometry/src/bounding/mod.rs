//! Bounding volumes, how they are fitted, and the test of every pair of them.
//!
//! A test answers `true` unless the two volumes are certainly apart: it may err on the side of `true` by
//! rounding, never on the other.
//!
//! One file fits each kind of volume (`aabb`, `sphere`, `obb`), one tests each pair of kinds (`sphere_sphere`,
//! `sphere_aabb` …), and [`VolumeTests`] picks the test. What makes the answers safe is said once, at
//! [`RELATIVE_MARGIN`].

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
pub use fit::fit;
pub use margin::RELATIVE_MARGIN;
pub use volume::{BoundKind, Bounded, CustomVolume, FromAToB, Volume};
pub use volume_tests::{CarriedVolume, VolumeTests};
