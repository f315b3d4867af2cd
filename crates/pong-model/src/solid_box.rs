//! Boxes around solids and their parts.

use pong_geometry::Vec3;

/// Box along the axes of the group frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidBox {
    /// Centre, m.
    pub center: Vec3,
    /// Half extents, m.
    pub half: Vec3,
}

impl SolidBox {
    /// Returns `true` if the box has no point in common with another one, given by its least and greatest
    /// coordinates, m.
    pub fn is_beside(&self, (low, high): &(Vec3, Vec3)) -> bool {
        let (own_low, own_high) = (self.center - self.half, self.center + self.half);
        (0..3).any(|axis| own_high[axis] < low[axis] || high[axis] < own_low[axis])
    }

    /// Returns the box with faces farther out by a distance, m.
    pub(crate) fn wider(self, distance: f64) -> Self {
        Self { half: self.half.add_scalar(distance), ..self }
    }

    /// Box around points; around the origin if there are none.
    pub(crate) fn around<'p>(points: impl IntoIterator<Item = &'p Vec3>) -> Self {
        let mut points = points.into_iter();
        let Some(first) = points.next() else {
            return Self { center: Vec3::zeros(), half: Vec3::zeros() };
        };
        let (low, high) = points.fold((*first, *first), |(low, high), p| (low.inf(p), high.sup(p)));
        Self { center: 0.5 * (low + high), half: 0.5 * (high - low) }
    }
}
