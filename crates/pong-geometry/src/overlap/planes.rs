//! Cut of a surface by several planes, the nearest one first.

use super::clip::{Cutter, Part, Surface};
use super::half_space::HalfSpace;
use crate::Vec3;

/// Half spaces that may cut a surface, each with the distance of its plane from a point, the *center*.
///
/// The plane of least distance cuts first, since it removes much of the surface. A plane that is farther away
/// than all vertices cuts nothing, so the vertices need not be compared with it.
#[derive(Clone, Debug, Default)]
pub(super) struct Planes {
    center: Vec3,
    listed: Vec<Plane>,
}

/// Listed half space.
#[derive(Clone, Copy, Debug)]
struct Plane {
    /// Half space; its normal need not have unit length.
    half_space: HalfSpace,
    /// Distance of the plane from the center, m; negative if the center lies outside. It is never greater than
    /// the exact distance, in spite of rounding.
    distance: f64,
}

impl Planes {
    /// Bytes that [`with_capacity`](Self::with_capacity) takes per plane.
    pub const BYTES_PER_FACET: usize = size_of::<Plane>();

    /// Creates an empty list with room for `planes` planes.
    pub fn with_capacity(planes: usize) -> Self {
        Self { center: Vec3::zeros(), listed: Vec::with_capacity(planes) }
    }

    /// Removes all planes and chooses the center for new ones.
    pub fn set_center(&mut self, center: &Vec3) {
        self.center = *center;
        self.listed.clear();
    }

    /// Returns the center.
    pub fn center(&self) -> &Vec3 {
        &self.center
    }

    /// Adds a half space. Its normal may have any length but zero.
    pub fn add(&mut self, half_space: &HalfSpace) {
        /// Relative bound of the rounding of a depth.
        const ROUNDING: f64 = 1e-14;
        let depth = half_space.depth(&self.center) - ROUNDING * half_space.offset.abs();
        let distance = depth / half_space.normal_b.norm();
        self.listed.push(Plane { half_space: *half_space, distance });
    }

    /// Cuts a surface by all planes. Its vertices are at most `radius` (m) away from the center. Returns
    /// `false` if nothing of it is left.
    pub fn cut(&mut self, cutter: &mut Cutter, surface: &mut Surface, mut radius: f64) -> bool {
        while let Some(plane) = self.take_nearest(radius) {
            match cutter.cut(surface, |x| plane.depth(x)) {
                Part::Nothing => return false,
                Part::Whole => {}
                Part::Cut => radius = surface.radius_about(&self.center),
            }
        }
        true
    }

    /// Cuts a surface by the planes up to the first that divides it, and stores the part inside in `target`. If
    /// no plane divides the surface, `target` stays as it is.
    pub fn cut_first(
        &mut self,
        cutter: &mut Cutter,
        target: &mut Surface,
        surface: &Surface,
        radius: f64,
    ) -> Part {
        while let Some(plane) = self.take_nearest(radius) {
            let part = cutter.cut_into(target, surface, |x| plane.depth(x));
            if part != Part::Whole {
                return part;
            }
        }
        Part::Whole
    }

    /// Removes the plane of least distance and returns it; `None` if all planes are farther away than `radius`.
    fn take_nearest(&mut self, radius: f64) -> Option<HalfSpace> {
        let (mut at, mut least) = (0, f64::INFINITY);
        for (index, plane) in self.listed.iter().enumerate() {
            if plane.distance < least {
                (at, least) = (index, plane.distance);
            }
        }
        // The room is for rounding, also of the coordinates of vertices far from the origin.
        let reach = radius * (1.0 + 1e-9) + 1e-14 * self.center.amax();
        (least <= reach).then(|| self.listed.swap_remove(at).half_space)
    }
}
