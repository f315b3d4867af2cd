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

/// Returns the unit vector across the axis towards the lowest places of the discs, opposite to `normal`; a fixed one
/// across the axis if the discs stand on the normal up to rounding.
pub(super) fn down(frustum: &Frustum, normal: &Vec3) -> Vec3 {
    let level = normal.cross(&frustum.axis);
    let sine = level.norm();
    if sine > UPRIGHT {
        (level / sine.max(f64::MIN_POSITIVE)).cross(&frustum.axis).normalize()
    } else {
        crate::any_perpendicular(&frustum.axis)
    }
}

/// Sine of an angle between two unit vectors that can come from rounding alone.
pub(super) const UPRIGHT: f64 = 16.0 * f64::EPSILON;

impl EndDisc<'_> {
    fn radius(&self) -> f64 {
        self.frustum.radii[self.end]
    }

    /// Returns `true` if the disc stands on a normal, up to rounding.
    fn stands_on(&self, normal: &Vec3) -> bool {
        normal.cross(&self.frustum.axis).norm() <= UPRIGHT
    }

    /// Returns the vector from the centre to the lowest point of the rim, opposite to `normal`, m. If the disc stands on
    /// the normal up to rounding, the direction is a fixed one across it.
    fn lowest(&self, normal: &Vec3) -> Vec3 {
        down(self.frustum, normal) * self.radius()
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

    /// Returns the contacts of the lowest and of the highest place of the rim with a face, from the contact of the lowest
    /// one. `rims` is its outline: of each edge the outward direction, a place, and `false` where the body goes on as
    /// another piece. A highest place that hangs over the outline is `None`. A disc that stands has the diameter towards
    /// the edge past which it reaches most. If `is_whole`, the outline is that of the body, and where the lowest place
    /// hangs over it, the lowest place of the same diameter counts that does not.
    pub fn on_face(
        &self,
        lowest: &Interference,
        rims: impl Iterator<Item = (Vec3, Vec3, bool)> + Clone,
        is_whole: bool,
    ) -> [Option<Interference>; 2] {
        let center = &self.frustum.ends[self.end];
        let mut lowest = *lowest;
        let mut down = self.lowest(&lowest.normal_b);
        let reach =
            |(outward, anchor, _): &(Vec3, Vec3, bool)| self.radius() + outward.dot(&(center - anchor));
        let edges = rims.clone().filter(|(_, _, is_edge)| *is_edge);
        let farthest = edges.reduce(|a, b| if reach(&b) > reach(&a) { b } else { a });
        let is_level = self.stands_on(&lowest.normal_b);
        if let Some((outward, ..)) = farthest.filter(|rim| is_level && reach(rim) > 0.0) {
            down = outward * self.radius();
            lowest.deepest_b = center + down;
        }
        let foot = lowest.deepest_b + lowest.normal_b * lowest.depth;
        let (mut share, mut is_held) = (0.0_f64, true);
        let across = down * 2.0;
        let highest = Interference {
            depth: lowest.depth + lowest.normal_b.dot(&across),
            deepest_b: lowest.deepest_b - across,
            ..lowest
        };
        let far_foot = highest.deepest_b + highest.normal_b * highest.depth;
        for (outward, anchor, _) in rims {
            let (over, by) = (outward.dot(&(foot - anchor)), outward.dot(&across));
            if is_whole && over > 0.0 && by > 0.0 {
                share = share.max(over / crate::divisor(by));
            }
            is_held &= outward.dot(&(far_foot - anchor)) <= 0.0;
        }
        let moved = across * share.min(1.0);
        let held = Interference {
            depth: lowest.depth + lowest.normal_b.dot(&moved),
            deepest_b: lowest.deepest_b - moved,
            ..lowest
        };
        let pushes = highest.depth > 0.0 && self.radius() > 0.0;
        [Some(held).filter(|held| held.depth > 0.0), Some(highest).filter(|_| is_held && pushes)]
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

    /// Returns the contacts of the highest point of the rim and of the middle of the disc with a triangle below whose plane
    /// all of the rim lies, the middle by less than `thickness`, m. Each has to be over the triangle, the middle but for
    /// little.
    pub fn below_triangle(
        &self,
        set: &TriangleSet,
        triangle: u32,
        thickness: f64,
    ) -> (Option<TriangleContact>, Option<Interference>) {
        /// Distance of the middle over an edge, relative to the radius: in a fold that is flat but for rounding no
        /// triangle is over a place below the line of both.
        const SLACK: f64 = 1e-4;
        let view = TriangleView::new(set, triangle);
        let Some(highest) = self.highest_below(&view, thickness) else { return (None, None) };
        let deepest_b = self.frustum.ends[self.end];
        let middle = Interference { depth: -view.height(&deepest_b), deepest_b, ..highest };
        let is_over = |contact: &Interference, slack: f64| {
            let foot = contact.deepest_b + view.normal * contact.depth;
            is_over(set, &view, (&foot, slack))
        };
        (
            is_over(&highest, 0.0)
                .then_some(TriangleContact { interference: highest, standing: Standing::Behind }),
            is_over(&middle, SLACK * self.radius()).then_some(middle),
        )
    }

    /// Returns the contact of the highest point of the rim with the plane of a triangle below which it lies. The centre is
    /// then below it, too, by less than `thickness`, m.
    fn highest_below(&self, view: &TriangleView, thickness: f64) -> Option<Interference> {
        let center = &self.frustum.ends[self.end];
        let height = view.height(center);
        if height >= 0.0 || height <= -thickness {
            return None;
        }
        let to_lowest = self.lowest(&view.normal);
        let depth = -height - view.normal.dot(&to_lowest);
        self.highest(&Interference {
            depth,
            normal_b: view.normal,
            deepest_b: center + to_lowest,
            feature: Feature::face(view.index as usize),
        })
    }
}

/// Returns `true` if a point is over a triangle, or beyond its edges by no more than `slack`, m.
fn is_over(set: &TriangleSet, view: &TriangleView, (point, slack): (&Vec3, f64)) -> bool {
    let edges = TriangleEdges::new(set, view);
    (0..3).all(|k| !edges.is_beyond(k, point) || edges.beyond(k, point) <= slack)
}
