//! Ray (A) – sphere, ellipsoid, capsule, cylinder and cone (B): the point at which the ray's line enters the
//! solid (docs/theory.md, 2.5 and 2.8).
//!
//! Degenerate cases: a line that touches the solid tangentially has no hit. A line through the rim of a
//! cylinder or a cone enters by the lateral surface. The ray's origin may lie inside the solid, less than the
//! ray's `reach` behind the entry, but not beyond the far side.

use super::Feature;
use super::ray_plane::RayHit;
use crate::primitive::{Capsule, Ellipsoid, Frustum, Ray, Sphere};
use crate::{Vec3, any_perpendicular};

/// Returns the hit of a ray on a sphere; `None` if there is none within the ray's range.
pub fn ray_sphere(ray: &Ray, sphere: &Sphere) -> Option<RayHit> {
    let line = Line::near(ray, &sphere.center);
    let inside = line.in_ball(&sphere.center, sphere.radius)?;
    line.hit(ray, &inside, (line.at(inside.from) - sphere.center).normalize(), Feature::WHOLE)
}

/// Returns the hit of a ray on an ellipsoid. In units of the semi-axes the ellipsoid is a sphere of radius 1.
pub fn ray_ellipsoid(ray: &Ray, ellipsoid: &Ellipsoid) -> Option<RayHit> {
    let Ellipsoid { center, axes, semi_axes } = ellipsoid;
    let line = Line::near(ray, center);
    let in_units = |v: &Vec3| axes.tr_mul(v).component_div(semi_axes);
    let along = in_units(&line.direction);
    let rate = along.norm();
    let of_ball = Line { start: in_units(&(line.start - center)), direction: along / rate, ahead: 0.0 };
    let inside = of_ball.in_ball(&Vec3::zeros(), 1.0)?;
    let normal = (axes * of_ball.at(inside.from).component_div(semi_axes)).normalize();
    let inside = Inside { from: inside.from / rate, to: inside.to / rate };
    line.hit(ray, &inside, normal, Feature::WHOLE)
}

/// Returns the hit of a ray on a capsule. The line enters and leaves by the lateral surface where that is between the two
/// ends, and otherwise by the sphere of that end.
pub fn ray_capsule(ray: &Ray, capsule: &Capsule) -> Option<RayHit> {
    let Capsule { ends: [one, other], radius } = *capsule;
    let line = Line::near(ray, &(0.5 * (one + other)));
    let (axis, arm) = (other - one, line.start - one);
    let square = axis.norm_squared();
    // Distances from the axis and heights above end 0, both times the length of the axis.
    let (across, sideways) = (axis.cross(&arm), axis.cross(&line.direction));
    let (height, climb) = (axis.dot(&arm), axis.dot(&line.direction));
    let (a, b) = (sideways.norm_squared(), across.dot(&sideways));
    let c = across.norm_squared() - square * radius * radius;
    let root = b * b - a * c;
    let wall = match a > 0.0 {
        true if root > 0.0 => roots(a, b, c, root),
        false if c < 0.0 => Inside { from: f64::NEG_INFINITY, to: f64::INFINITY },
        _ => return None,
    };
    let height_at = |along: f64| height + climb * along;
    let by_ball = |along: f64| {
        let height = height_at(along);
        let end = if height > square { other } else { one };
        (!(0.0..=square).contains(&height)).then(|| line.in_ball(&end, radius))
    };
    let from = by_ball(wall.from).map_or(Some(wall.from), |ball| Some(ball?.from))?;
    let to = by_ball(wall.to).map_or(Some(wall.to), |ball| Some(ball?.to))?;
    let foot = one + axis * (height_at(from) / square).clamp(0.0, 1.0);
    line.hit(ray, &Inside { from, to }, (line.at(from) - foot).normalize(), Feature::WHOLE)
}

/// Returns the hit of a ray on a cylinder or a cone. Face 0 is the lateral surface, faces 1 and 2 are the
/// ends. A ray through the tip of a cone hits an end.
pub fn ray_frustum(ray: &Ray, frustum: &Frustum) -> Option<RayHit> {
    /// Distance from a tip, relative to the lengths that enter, within which a line goes through it.
    const AT_TIP: f64 = 1e-12;
    let line = Line::near(ray, &(0.5 * (frustum.ends[0] + frustum.ends[1])));
    let (round, between) = (line.in_round(frustum)?, line.between_ends(frustum));
    let inside = round.cut(&between)?;
    let goes_up = line.direction.dot(&frustum.axis) > 0.0;
    // At a tip rounding would choose the side of the wall, so the normal is along the axis.
    let is_tip = frustum.radii[usize::from(!goes_up)] == 0.0;
    let slack = if is_tip { AT_TIP * (line.start.amax() + frustum.length) } else { 0.0 };
    if round.from >= between.from + slack {
        let normal = wall_normal(&line.at(inside.from), frustum);
        return line.hit(ray, &inside, normal, Feature::face(0));
    }
    let (normal, face) = if goes_up { (-frustum.axis, 1) } else { (frustum.axis, 2) };
    line.hit(ray, &inside, normal, Feature::face(face))
}

/// Returns the outward unit normal at a point of the lateral surface.
fn wall_normal(place: &Vec3, frustum: &Frustum) -> Vec3 {
    // Twice: beside a tip rounding leaves a part along the axis that counts.
    let square = |v: &Vec3| v - frustum.axis * frustum.axis.dot(v);
    let across = square(&square(&(place - frustum.ends[0])));
    let aside = across.norm();
    let away =
        if aside > 0.0 { across / aside.max(f64::MIN_POSITIVE) } else { any_perpendicular(&frustum.axis) };
    let [wall_along, wall_aside] = frustum.wall;
    (frustum.axis * wall_along + away * wall_aside).normalize()
}

/// Interval of a line inside a solid, m along the line.
#[derive(Clone, Copy)]
struct Inside {
    from: f64,
    to: f64,
}

impl Inside {
    /// Returns the intersection of two intervals; `None` unless it has a positive length.
    fn cut(&self, other: &Self) -> Option<Self> {
        let (from, to) = (self.from.max(other.from), self.to.min(other.to));
        (from < to).then_some(Self { from, to })
    }
}

/// Line of a ray. Positions along it are measured from its point nearest to the middle of a solid, because
/// squares of coordinates measured from a distant point would lose precision.
struct Line {
    start: Vec3,
    direction: Vec3,
    /// Distance of the start from the ray's origin, m.
    ahead: f64,
}

impl Line {
    fn near(ray: &Ray, middle: &Vec3) -> Self {
        let ahead = ray.direction.dot(&(middle - ray.origin));
        Self { start: ray.origin + ray.direction * ahead, direction: ray.direction, ahead }
    }

    fn at(&self, along: f64) -> Vec3 {
        self.start + self.direction * along
    }

    fn hit(&self, ray: &Ray, inside: &Inside, normal: Vec3, feature: Feature) -> Option<RayHit> {
        let [distance, leaves] = [inside.from, inside.to].map(|along| along + self.ahead);
        let within = -ray.reach.unwrap_or(0.0) < distance && distance < ray.length && leaves > 0.0;
        let from_front = ray.direction.dot(&normal) < 0.0;
        (within && from_front).then_some(RayHit { distance, normal_b: normal, feature })
    }

    fn in_ball(&self, center: &Vec3, radius: f64) -> Option<Inside> {
        let arm = self.start - center;
        let along = arm.dot(&self.direction);
        let aside = arm - self.direction * along;
        let square = (radius - aside.norm()) * (radius + aside.norm());
        let half = if square > 0.0 { square.max(f64::MIN_POSITIVE).sqrt() } else { return None };
        Some(Inside { from: -along - half, to: half - along })
    }

    /// Returns the interval of the line between the planes of the two ends.
    fn between_ends(&self, frustum: &Frustum) -> Inside {
        let (climb, height) =
            (self.direction.dot(&frustum.axis), (self.start - frustum.ends[0]).dot(&frustum.axis));
        if climb == 0.0 {
            let is_between = 0.0 < height && height < frustum.length;
            let far = if is_between { f64::INFINITY } else { f64::NEG_INFINITY };
            return Inside { from: -far, to: far };
        }
        let [one, other] = [-height / climb, (frustum.length - height) / climb];
        Inside { from: one.min(other), to: one.max(other) }
    }

    /// Returns the interval of the line inside the lateral surface, which is extended beyond the ends up to
    /// the apex. `None` if the line does not enter it. Inside, the squared distance from the axis less the
    /// squared radius, a·t² + 2b·t + c, is negative.
    fn in_round(&self, frustum: &Frustum) -> Option<Inside> {
        let [first, last] = frustum.radii;
        let widening = (last - first) / frustum.length;
        // From the place nearest to a tip: elsewhere the terms of a line close to it cancel.
        let (base, radius) = if last == 0.0 { (1, last) } else { (0, first) };
        let from_start = self.start - frustum.ends[base];
        let ahead = if radius == 0.0 { -self.direction.dot(&from_start) } else { 0.0 };
        let inside = self.in_wall(&(from_start + self.direction * ahead), frustum, radius, widening)?;
        Some(Inside { from: inside.from + ahead, to: inside.to + ahead })
    }

    /// Returns the same interval, measured from the place at `arm` from a point of the axis. `radius` is that of the wall
    /// beside this point, and `widening` its change along the axis.
    fn in_wall(&self, arm: &Vec3, frustum: &Frustum, radius: f64, widening: f64) -> Option<Inside> {
        let (height, climb) = (arm.dot(&frustum.axis), self.direction.dot(&frustum.axis));
        let (across, sideways) = (arm - frustum.axis * height, self.direction - frustum.axis * climb);
        let (radius, opening) = (radius + widening * height, widening * climb);
        let a = sideways.norm_squared() - opening * opening;
        let b = across.dot(&sideways) - radius * opening;
        let c = across.norm_squared() - radius * radius;
        let root = b * b - a * c;
        if a > 0.0 {
            return if root > 0.0 { Some(roots(a, b, c, root)) } else { None };
        }
        // The line is at no larger angle to the axis than the lateral surface. So on the side to which the
        // cone opens, it stays inside once it has entered.
        if opening == 0.0 {
            return (c < 0.0).then_some(Inside { from: f64::NEG_INFINITY, to: f64::INFINITY });
        }
        let far = f64::INFINITY.copysign(opening);
        let at = match a < 0.0 {
            true if opening > 0.0 => roots(a, b, c, root.max(0.0)).to,
            true => roots(a, b, c, root.max(0.0)).from,
            false => -0.5 * c / b,
        };
        Some(Inside { from: at.min(far), to: at.max(far) })
    }
}

/// Returns the roots of a·t² + 2b·t + c without cancellation. `square` is b² − a·c.
fn roots(a: f64, b: f64, c: f64, square: f64) -> Inside {
    let sum = -(b + square.sqrt().copysign(b));
    // Clamped, so that the divisor is not zero even if a compiler divides before the branch.
    let divisor = sum.abs().max(f64::MIN_POSITIVE).copysign(sum);
    let (one, other) = (sum / a, if sum == 0.0 { 0.0 } else { c / divisor });
    Inside { from: one.min(other), to: one.max(other) }
}
