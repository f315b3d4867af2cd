//! Distance of two convex solids, and their nearest points (docs/theory.md, 2.10).
//!
//! Both solids must be given in one frame. The distance from a plane has a closed form ([`Solid::to_plane`]).
//! All other pairs use [`Solid::to`], the algorithm of Gilbert, Johnson and Keerthi.

mod search;
mod simplex;
mod solid;

pub use search::Distance;
pub use solid::Solid;

use crate::primitive::Plane;

impl Solid<'_> {
    /// Returns the distance of this solid from another.
    pub fn to(&self, other: &Solid<'_>) -> Distance {
        // The search gives `None` only for a distance above the limit. The limit is infinite, so the default
        // below is not used.
        self.to_within(other, f64::INFINITY).unwrap_or(Distance {
            distance: f64::INFINITY,
            points_b: [self.member(), other.member()],
            gap: f64::INFINITY,
        })
    }

    /// Returns the same as [`to`](Self::to), but `None` as soon as a lower bound of the distance exceeds
    /// `limit`, m.
    pub fn to_within(&self, other: &Solid<'_>, limit: f64) -> Option<Distance> {
        search::search(self, other, limit)
    }

    /// Returns the distance of this solid from the half space of a plane: the height of the solid's lowest
    /// point, or 0 if that is negative.
    pub fn to_plane(&self, plane: &Plane) -> Distance {
        let core = self.core_support(&-plane.normal);
        let height = plane.height(&core);
        let points_b = [core - plane.normal * self.margin(), core - plane.normal * height];
        Distance { distance: (height - self.margin()).max(0.0), points_b, gap: 0.0 }
    }
}
