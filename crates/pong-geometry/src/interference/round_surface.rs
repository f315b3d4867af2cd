//! How far a place is from the surface of a round solid (docs/theory.md, 2.8).

use super::Feature;
use crate::primitive::{Capsule, Frustum};
use crate::{Vec3, any_perpendicular};

/// The place of a surface that is nearest to a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Nearest {
    /// Distance of the place from the surface, m; negative inside.
    pub distance: f64,
    /// Unit vector from the solid to the place, or the way out of it.
    pub normal_b: Vec3,
    /// What of the solid is nearest: of a frustum face 0 is the wall, faces 1 and 2 the ends, edges 0 and 1 the rims.
    pub feature: Feature,
}

/// Relative to the coordinates: what the last few roundings of two places come to.
pub(crate) const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Nearest to a ball around the nearest place of the axis. On the axis every way across it is as good: the same one is taken.
pub(crate) fn of_capsule(place: &Vec3, capsule: &Capsule) -> Nearest {
    let foot = nearest_on_segment(place, &capsule.ends);
    let arm = place - foot;
    let distance = arm.norm();
    let normal = if distance > ROUNDING * place.amax().max(foot.amax()) {
        (arm / distance).normalize()
    } else {
        any_perpendicular(&(capsule.ends[1] - capsule.ends[0]).normalize())
    };
    Nearest { distance: distance - capsule.radius, normal_b: normal, feature: Feature::WHOLE }
}

/// The place of a segment nearest to a place.
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

/// A place in the half plane through the axis of a frustum in which it lies.
pub(crate) struct Meridian {
    /// From end 0 along the axis, m.
    pub along: f64,
    /// Away from the axis, m, not negative.
    pub aside: f64,
    /// Unit vector from the axis towards the place.
    pub away_b: Vec3,
}

impl Meridian {
    pub fn new(place: &Vec3, frustum: &Frustum) -> Self {
        let arm = place - frustum.ends[0];
        let along = frustum.axis.dot(&arm);
        let across = arm - frustum.axis * along;
        let aside = across.norm();
        let is_beside = aside > ROUNDING * place.amax().max(frustum.ends[0].amax());
        let away_b = if is_beside { (across / aside).normalize() } else { any_perpendicular(&frustum.axis) };
        Self { along, aside, away_b }
    }
}

/// In the half plane the solid is a trapezoid: outside, its nearest place; inside, its least deep side.
pub(crate) fn of_frustum(place: &Vec3, frustum: &Frustum) -> Nearest {
    let at = Meridian::new(place, frustum);
    let [wall_along, wall_aside] = frustum.wall;
    let [first, last] = frustum.radii;
    let in_space = |along: f64, aside: f64| frustum.axis * along + at.away_b * aside;
    let over_wall = at.along * wall_along + (at.aside - first) * wall_aside;
    let heights = [over_wall, -at.along, at.along - frustum.length];
    let normals = [(wall_along, wall_aside), (-1.0, 0.0), (1.0, 0.0)];
    if heights.iter().all(|&height| height <= 0.0) {
        let mut least = 0;
        for side in [1, 2] {
            if heights[side] > heights[least] {
                least = side;
            }
        }
        let (along, aside) = normals[least];
        let normal = in_space(along, aside).normalize();
        return Nearest { distance: heights[least], normal_b: normal, feature: Feature::face(least) };
    }
    let feet = [on_wall(&at, frustum), (0.0, at.aside.min(first)), (frustum.length, at.aside.min(last))];
    let square = |side: usize| {
        let (along, aside) = (at.along - feet[side].0, at.aside - feet[side].1);
        along * along + aside * aside
    };
    let visible = (0..3).filter(|&side| heights[side] > 0.0);
    let nearest =
        visible.reduce(|best, side| if square(side) < square(best) { side } else { best }).unwrap_or(0);
    let (along, aside) = (at.along - feet[nearest].0, at.aside - feet[nearest].1);
    let distance = square(nearest).sqrt();
    let scale = at.along.abs().max(at.aside).max(frustum.length);
    let (along, aside) = if distance > ROUNDING * scale { (along, aside) } else { normals[nearest] };
    let feature = match feet[nearest] {
        (0.0, aside) if aside == first => Feature::edge(0),
        (along, aside) if along == frustum.length && aside == last => Feature::edge(1),
        _ => Feature::face(nearest),
    };
    Nearest { distance, normal_b: in_space(along, aside).normalize(), feature }
}

/// The place of the wall's line nearest to a place of the half plane.
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
