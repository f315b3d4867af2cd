//! Distance of a point from the surface of a round solid (docs/theory.md, 2.8).

use super::Feature;
use crate::primitive::{Capsule, Frustum};
use crate::{Vec3, any_perpendicular};

/// Surface point of a solid nearest to a given point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Distance of the point from the surface, m; negative inside.
    pub distance: f64,
    /// Unit vector from the solid to the point; if the point is inside, from the point to the surface.
    pub normal_b: Vec3,
    /// Nearest feature of the solid. For a frustum, face 0 is the lateral surface, faces 1 and 2 are the
    /// ends, edges 0 and 1 the rims.
    pub feature: Feature,
}

/// Accumulated rounding of two points, relative to their coordinates.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Returns the surface point of a capsule nearest to `place`: that of a sphere around the nearest point of
/// the axis. At a point on the axis all perpendicular directions are equivalent, and the normal is a fixed
/// one of them.
pub(crate) fn of_capsule(place: &Vec3, capsule: &Capsule) -> Nearest {
    let foot = nearest_on_segment(place, &capsule.ends);
    let arm = place - foot;
    let distance = arm.norm();
    let normal = if distance > ROUNDING * place.amax().max(foot.amax()) {
        // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
        arm / distance.max(f64::MIN_POSITIVE)
    } else {
        any_perpendicular(&(capsule.ends[1] - capsule.ends[0]).normalize())
    };
    Nearest { distance: distance - capsule.radius, normal_b: normal, feature: Feature::WHOLE }
}

/// Returns the point of a segment nearest to a given point.
pub(crate) fn nearest_on_segment(place: &Vec3, [one, other]: &[Vec3; 2]) -> Vec3 {
    let along = other - one;
    let share = (place - one).dot(&along) / along.norm_squared();
    if share <= 0.0 {
        *one
    } else if share >= 1.0 {
        *other
    } else {
        one + along * share
    }
}

/// Coordinates of a point in the half plane through it and the axis of a frustum.
pub(crate) struct Meridian {
    /// Distance from end 0 along the axis, m.
    pub along: f64,
    /// Distance from the axis, m, not negative.
    pub aside: f64,
    /// Unit vector from the axis towards the point.
    pub away_b: Vec3,
}

impl Meridian {
    pub fn new(place: &Vec3, frustum: &Frustum) -> Self {
        Self::of_parts(place, frustum, &parts(place, frustum))
    }

    fn of_parts(place: &Vec3, frustum: &Frustum, &(along, across, aside): &(f64, Vec3, f64)) -> Self {
        let is_beside = aside > ROUNDING * place.amax().max(frustum.ends[0].amax());
        // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
        let away_b = match is_beside {
            true => across / aside.max(f64::MIN_POSITIVE),
            false => any_perpendicular(&frustum.axis),
        };
        Self { along, aside, away_b }
    }
}

/// Returns the distance of a point from end 0 along the axis of a frustum, its arm across the axis, and the length of
/// this arm, m.
#[inline]
fn parts(place: &Vec3, frustum: &Frustum) -> (f64, Vec3, f64) {
    let arm = place - frustum.ends[0];
    let along = frustum.axis.dot(&arm);
    let across = arm - frustum.axis * along;
    (along, across, across.norm())
}

/// Returns the surface point of a frustum nearest to `place`. In the half plane of [`Meridian`] the solid is
/// a trapezoid. For a point outside, the result is the nearest point of the trapezoid. For a point inside, it
/// lies on the side of the trapezoid below which the point is least deep.
pub(crate) fn of_frustum(place: &Vec3, frustum: &Frustum) -> Nearest {
    // Nothing is farther than infinity.
    of_frustum_within(place, frustum, f64::INFINITY).unwrap_or(Nearest {
        distance: f64::INFINITY,
        normal_b: frustum.axis,
        feature: Feature::WHOLE,
    })
}

/// Returns the same as [`of_frustum`]; it may return `None` if the point is farther than `reach` from the solid, m.
#[inline]
pub(crate) fn of_frustum_within(place: &Vec3, frustum: &Frustum, reach: f64) -> Option<Nearest> {
    /// Rounding of a distance, relative to the lengths that enter, with a margin.
    const SLACK: f64 = 1e-12;
    let parts = parts(place, frustum);
    let (along, _, aside) = parts;
    let [wall_along, wall_aside] = frustum.wall;
    let [first, last] = frustum.radii;
    let over_wall = along * wall_along + (aside - first) * wall_aside;
    let heights = [over_wall, -along, along - frustum.length];
    // The solid is below the planes of its sides.
    let highest = heights[0].max(heights[1]).max(heights[2]);
    if highest > reach + SLACK * (along.abs() + aside + first + frustum.length) {
        return None;
    }
    let meridian = || Meridian::of_parts(place, frustum, &parts);
    // The normal of a side.
    let normal = |side: usize| match side {
        0 if wall_along == 0.0 => meridian().away_b,
        // Near the axis the two directions are perpendicular only to rounding.
        0 => (frustum.axis * wall_along + meridian().away_b * wall_aside).normalize(),
        1 => -frustum.axis,
        _ => frustum.axis,
    };
    if heights.iter().all(|&height| height <= 0.0) {
        let mut least = 0;
        for side in [1, 2] {
            if heights[side] > heights[least] {
                least = side;
            }
        }
        let (distance, normal_b) = (heights[least], normal(least));
        return Some(Nearest { distance, normal_b, feature: Feature::face(least) });
    }
    let at = meridian();
    let (foot, nearest) = foot(&at, frustum, &heights);
    let (along, aside) = (at.along - foot.0, at.aside - foot.1);
    let distance = (along * along + aside * aside).sqrt();
    let scale = at.along.abs().max(at.aside).max(frustum.length);
    // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
    let size = distance.max(f64::MIN_POSITIVE);
    let normal_b = match (along == 0.0, aside == 0.0) {
        _ if distance <= ROUNDING * scale => normal(nearest),
        (true, _) => at.away_b * (aside / size),
        (_, true) => frustum.axis * (along / size),
        _ => (frustum.axis * along + at.away_b * aside).normalize(),
    };
    let feature = match foot {
        (0.0, aside) if aside == first => Feature::edge(0),
        (along, aside) if along == frustum.length && aside == last => Feature::edge(1),
        _ => Feature::face(nearest),
    };
    Some(Nearest { distance, normal_b, feature })
}

/// Returns the point of the trapezoid nearest to `at` outside, in the coordinates of [`Meridian`], and the side that it is
/// on: 0 the wall, 1 and 2 the ends. `heights` are those of `at` above the sides.
#[inline]
fn foot(at: &Meridian, frustum: &Frustum, heights: &[f64; 3]) -> ((f64, f64), usize) {
    let ([first, last], length) = (frustum.radii, frustum.length);
    if first == last {
        // A rectangle.
        let side = if at.aside > first { 0 } else { 1 + usize::from(at.along > 0.0) };
        return ((at.along.clamp(0.0, length), at.aside.min(first)), side);
    }
    let feet = [on_wall(at, frustum), (0.0, at.aside.min(first)), (length, at.aside.min(last))];
    let square = |side: usize| {
        let (along, aside) = (at.along - feet[side].0, at.aside - feet[side].1);
        along * along + aside * aside
    };
    let visible = (0..3).filter(|&side| heights[side] > 0.0);
    let nearest =
        visible.reduce(|best, side| if square(side) < square(best) { side } else { best }).unwrap_or(0);
    (feet[nearest], nearest)
}

/// Returns the point of the lateral surface nearest to `at`, in the coordinates of [`Meridian`]: distance
/// along the axis and from the axis, m.
fn on_wall(at: &Meridian, frustum: &Frustum) -> (f64, f64) {
    let [first, last] = frustum.radii;
    let (length, widening) = (frustum.length, last - first);
    let square = length * length + widening * widening;
    let travelled = at.along * length + (at.aside - first) * widening;
    if travelled <= 0.0 {
        (0.0, first)
    } else if travelled >= square {
        (length, last)
    } else {
        let share = travelled / square;
        (length * share, first + widening * share)
    }
}
