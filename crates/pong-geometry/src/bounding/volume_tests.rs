//! Selection of the overlap test for a pair of bounding volumes.

use super::aabb_aabb::aabb_aabb;
use super::aabb_obb::{aabb_obb, obb_aabb};
use super::obb_obb::obb_obb;
use super::sphere_aabb::{aabb_sphere, sphere_aabb};
use super::sphere_obb::{obb_sphere, sphere_obb};
use super::sphere_sphere::sphere_sphere;
use super::volume::{FromAToB, Volume};
use crate::Vec3;
use crate::extension::{Extensions, VolumeTest};

/// Volume of A with its centre in B's frame, transformed once for tests against several volumes of B.
#[derive(Clone, Copy)]
pub struct CarriedVolume<'a> {
    volume: &'a Volume,
    /// Centre in B's frame, m; the origin for a volume without a centre.
    center_b: Vec3,
    x_ba: &'a FromAToB,
}

impl<'a> CarriedVolume<'a> {
    /// Transforms the centre of a volume in A's frame. `x_ba` transforms from A's frame to B's.
    #[inline]
    pub fn new(volume: &'a Volume, x_ba: &'a FromAToB) -> Self {
        let center_b = match volume {
            Volume::Aabb { center, .. } | Volume::Sphere { center, .. } | Volume::Obb { center, .. } => {
                x_ba.point(center)
            }
            Volume::Custom(_) | Volume::Unbounded => Vec3::zeros(),
        };
        Self { volume, center_b, x_ba }
    }
}

/// Overlap tests of bounding volumes: the built-in ones and those registered by a user.
#[derive(Clone, Default)]
pub struct VolumeTests {
    custom: Vec<CustomTest>,
}

#[derive(Clone)]
struct CustomTest {
    kind_a: String,
    kind_b: String,
    test: VolumeTest,
}

impl VolumeTests {
    /// Creates the set of built-in tests and those registered in `ext`. A test registered for two built-in
    /// kinds is never used.
    pub fn new(ext: &Extensions) -> Self {
        let custom = ext.volume_tests().map(|(kind_a, kind_b, test)| CustomTest {
            kind_a: kind_a.to_owned(),
            kind_b: kind_b.to_owned(),
            test: test.clone(),
        });
        Self { custom: custom.collect() }
    }

    /// Returns `true` if two volumes, each in its own frame, may overlap; `false` means certainly disjoint.
    /// `x_ba` transforms from A's frame to B's. A pair without a test counts as overlapping
    /// ([`Self::supports`] finds such pairs). This function does not allocate.
    #[inline]
    pub fn overlap(&self, a: &Volume, b: &Volume, x_ba: &FromAToB) -> bool {
        self.overlap_carried(&CarriedVolume::new(a, x_ba), b)
    }

    /// Same as [`overlap`](Self::overlap), for a volume that is tested against several volumes of B.
    #[inline]
    pub fn overlap_carried(&self, a: &CarriedVolume<'_>, b: &Volume) -> bool {
        use Volume::{Aabb, Obb, Sphere, Unbounded};
        let CarriedVolume { volume: a, center_b, x_ba } = a;
        match (a, b) {
            (Unbounded, _) | (_, Unbounded) => true,
            (Sphere { radius: r, .. }, Sphere { center: d, radius: s }) => {
                sphere_sphere((center_b, *r), (d, *s))
            }
            (Sphere { radius: r, .. }, Aabb { center: d, half: k }) => sphere_aabb((center_b, *r), (d, k)),
            (Aabb { center: c, half: h }, Sphere { center: d, radius: s }) => {
                aabb_sphere((c, h), (d, *s), x_ba)
            }
            (Sphere { radius: r, .. }, Obb { center: d, axes, half: k }) => {
                sphere_obb((center_b, *r), (d, axes, k))
            }
            (Obb { center: c, axes, half: h }, Sphere { center: d, radius: s }) => {
                obb_sphere((c, axes, h), (d, *s), x_ba)
            }
            (Aabb { half: h, .. }, Aabb { center: d, half: k }) => {
                aabb_aabb((center_b, h), (d, k), &x_ba.rotation)
            }
            (Aabb { half: h, .. }, Obb { center: d, axes, half: k }) => {
                aabb_obb((center_b, h), (d, axes, k), &x_ba.rotation)
            }
            (Obb { axes, half: h, .. }, Aabb { center: d, half: k }) => {
                obb_aabb((center_b, axes, h), (d, k), &x_ba.rotation)
            }
            (Obb { axes: u, half: h, .. }, Obb { center: d, axes: v, half: k }) => {
                obb_obb((center_b, u, h), (d, v, k), &x_ba.rotation)
            }
            (Volume::Custom(_), _) | (_, Volume::Custom(_)) => self.custom_overlap(a, b, x_ba),
        }
    }

    /// Returns `true` if there is a test for two kinds, given by name, in either order.
    pub fn supports(&self, kind_a: &str, kind_b: &str) -> bool {
        let built_in = |kind: &str| matches!(kind, "Aabb" | "Sphere" | "Obb");
        let unbounded = kind_a == "Unbounded" || kind_b == "Unbounded";
        unbounded
            || (built_in(kind_a) && built_in(kind_b))
            || self.custom_test(kind_a, kind_b).is_some()
            || self.custom_test(kind_b, kind_a).is_some()
    }

    #[cold]
    fn custom_overlap(&self, a: &Volume, b: &Volume, x_ba: &FromAToB) -> bool {
        let (kind_a, kind_b) = (a.kind_name(), b.kind_name());
        if let Some(test) = self.custom_test(kind_a, kind_b) {
            return test(a, b, x_ba);
        }
        self.custom_test(kind_b, kind_a).is_none_or(|test| test(b, a, &x_ba.inverse()))
    }

    fn custom_test(&self, kind_a: &str, kind_b: &str) -> Option<&VolumeTest> {
        self.custom
            .iter()
            .find(|entry| entry.kind_a == kind_a && entry.kind_b == kind_b)
            .map(|entry| &entry.test)
    }
}
