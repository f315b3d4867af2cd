//! End disc of a cylinder or a cone (A) – polyhedron and triangle (B) (docs/theory.md, 2.8).
//!
//! A disc touches as an ellipsoid does that is all but flat ([`Frustum::flat_ellipsoid`]): the tests of ellipsoids find
//! the feature that pushes, with pieces of a body and seams of a surface. Depth and deepest point are then those of the
//! disc without thickness, along the same normal.

use super::ellipsoid_triangle::ellipsoid_triangle;
use super::triangle_features::{Standing, TriangleContact, TriangleEdges, TriangleView};
use super::{Feature, Interference};
use crate::Vec3;
use crate::primitive::{Frustum, TriangleSet};

/// One end of a cylinder or a cone.
#[derive(Clone, Copy, Debug)]
pub struct EndDisc<'a> {
    /// The body.
    pub frustum: &'a Frustum,
    /// Index of its end.
    pub end: usize,
}

impl EndDisc<'_> {
    fn radius(&self) -> f64 {
        self.frustum.radii[self.end]
    }

    /// Returns the vector from the centre to the lowest point of the rim, opposite to `normal`, m. If the disc stands on
    /// the normal up to rounding, the direction is a fixed one across it.
    fn lowest(&self, normal: &Vec3) -> Vec3 {
        /// Sine of an angle between two unit vectors that can come from rounding alone.
        const UPRIGHT: f64 = 16.0 * f64::EPSILON;
        let level = normal.cross(&self.frustum.axis);
        let sine = level.norm();
        let down = if sine > UPRIGHT {
            (level / sine.max(f64::MIN_POSITIVE)).cross(&self.frustum.axis).normalize()
        } else {
            crate::any_perpendicular(&self.frustum.axis)
        };
        down * self.radius()
    }

    /// Returns the contact of the disc along the normal of the contact of its ellipsoid; `None` if it does not reach.
    pub fn exact(&self, contact: &Interference) -> Option<Interference> {
        let Interference { depth, normal_b, feature, .. } = *contact;
        let half_width = self.frustum.flat_ellipsoid(self.end).half_width(&normal_b);
        let of_rim = self.radius() * normal_b.cross(&self.frustum.axis).norm();
        let lowest = self.lowest(&normal_b);
        // An edge or a corner may lie under the flat of the disc, away from the rim.
        let place = if feature.is_face() { lowest } else { lowest * (of_rim / half_width) };
        let deepest_b = self.frustum.ends[self.end] + place;
        let depth = depth - (half_width - of_rim);
        (depth > 0.0).then_some(Interference { depth, deepest_b, ..*contact })
    }

    /// Returns the contact with a face, `lowest`, where the rim's lowest place hangs over the outline of the face, `rims`:
    /// at the lowest place of the same diameter that does not.
    pub fn held_by(&self, lowest: &Interference, rims: impl Iterator<Item = (Vec3, Vec3)>) -> Interference {
        let across = self.lowest(&lowest.normal_b) * 2.0;
        let foot = lowest.deepest_b + lowest.normal_b * lowest.depth;
        let mut share = 0.0_f64;
        for (outward, anchor) in rims {
            let (over, by) = (outward.dot(&(foot - anchor)), outward.dot(&across));
            if over > 0.0 && by > 0.0 {
                share = share.max(over / by);
            }
        }
        let moved = across * share.min(1.0);
        Interference {
            depth: lowest.depth + lowest.normal_b.dot(&moved),
            deepest_b: lowest.deepest_b - moved,
            ..*lowest
        }
    }

    /// Returns the contact of the highest point of the rim along the normal of the lowest one's contact; `None` if it
    /// is above the plane there, and for an apex.
    pub fn highest(&self, lowest: &Interference) -> Option<Interference> {
        let across = self.lowest(&lowest.normal_b) * 2.0;
        let depth = lowest.depth + lowest.normal_b.dot(&across);
        let deepest_b = lowest.deepest_b - across;
        (depth > 0.0 && self.radius() > 0.0).then_some(Interference { depth, deepest_b, ..*lowest })
    }

    /// Emits the contacts of the disc with the features of a triangle; `thickness` as in [`ellipsoid_triangle`].
    pub fn on_triangle(
        &self,
        set: &TriangleSet,
        triangle: u32,
        thickness: f64,
        emit: &mut dyn FnMut(TriangleContact),
    ) {
        let flat = self.frustum.flat_ellipsoid(self.end);
        ellipsoid_triangle(&flat, set, triangle, thickness, &mut |contact| {
            if let Some(interference) = self.exact(&contact.interference) {
                emit(TriangleContact { interference, ..contact });
            }
        });
    }

    /// Returns the contact of the highest point of the rim with a triangle below whose plane it lies. The centre is then
    /// behind the triangle too, by less than `thickness`, m.
    pub fn highest_on_triangle(
        &self,
        set: &TriangleSet,
        triangle: u32,
        thickness: f64,
    ) -> Option<TriangleContact> {
        let view = TriangleView::new(set, triangle);
        let center = &self.frustum.ends[self.end];
        let height = view.height(center);
        if height >= 0.0 || height <= -thickness {
            return None;
        }
        let to_lowest = self.lowest(&view.normal);
        let depth = -height - view.normal.dot(&to_lowest);
        let highest = self.highest(&Interference {
            depth,
            normal_b: view.normal,
            deepest_b: center + to_lowest,
            feature: Feature::face(triangle as usize),
        })?;
        let foot = highest.deepest_b + view.normal * highest.depth;
        let edges = TriangleEdges::new(set, &view);
        let is_over = !(0..3).any(|k| edges.is_beyond(k, &foot));
        is_over.then_some(TriangleContact { interference: highest, standing: Standing::Behind })
    }
}
