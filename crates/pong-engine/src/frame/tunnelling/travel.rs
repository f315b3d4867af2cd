//! Tunnelling test by distance: the travel of a body since the last commit against the thinnest element.

use super::solids::width_m;
use super::swept;
use crate::frame::input::motion::Motion;
use crate::sealed::Plan;
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Transform, Vec3};
use pong_model::{Batch, MovableGroup};

/// Half the thickness of the thinnest element of B that A can pass through, m; a shorter path passes no wall.
/// Infinite if there is no such element.
pub(crate) fn least_travel_m(
    a: &MovableGroup,
    b: &MovableGroup,
    tests: impl Fn(PrimitiveKind, PrimitiveKind) -> bool,
) -> f64 {
    let kinds = PrimitiveKind::ALL;
    let touched = |kind_b: PrimitiveKind| kinds.iter().any(|&kind_a| tests(kind_a, kind_b));
    let mut thinnest = f64::INFINITY;
    if touched(PrimitiveKind::Polyhedron) {
        thinnest = b.polyhedra.iter().map(width_m).fold(thinnest, f64::min);
    }
    if touched(PrimitiveKind::Triangle) {
        let of_balls = a.spheres.iter().map(|sphere| sphere.radius);
        let of_ellipsoids = a.ellipsoids.iter().map(|ellipsoid| ellipsoid.semi_axes.min());
        let of_capsules = a.capsules.iter().map(|capsule| capsule.radius);
        let smallest = of_balls.chain(of_ellipsoids).chain(of_capsules).fold(f64::INFINITY, f64::min);
        let meshes = b.primitives.iter().filter(|info| info.kind == PrimitiveKind::Triangle);
        thinnest = meshes.map(|info| info.thickness.unwrap_or(smallest)).fold(thinnest, f64::min);
        thinnest = a.rays.iter().map(|ray| ray.length).fold(thinnest, f64::min);
    }
    if touched(PrimitiveKind::Sphere) {
        thinnest = b.spheres.iter().map(|sphere| 2.0 * sphere.radius).fold(thinnest, f64::min);
    }
    if touched(PrimitiveKind::Ellipsoid) {
        let least = b.ellipsoids.iter().map(|ellipsoid| 2.0 * ellipsoid.semi_axes.min());
        thinnest = least.fold(thinnest, f64::min);
    }
    let round = [PrimitiveKind::Capsule, PrimitiveKind::Cylinder, PrimitiveKind::Cone];
    for info in b.primitives.iter().filter(|info| round.contains(&info.kind) && touched(info.kind)) {
        let solids = info.elements.clone().filter_map(|element| swept::round(b, info.kind, element));
        thinnest = solids.map(|solid| solid.width_m()).fold(thinnest, f64::min);
    }
    if touched(PrimitiveKind::Bore) {
        thinnest = b.bores.iter().map(|bore| bore.thickness).fold(thinnest, f64::min);
    }
    0.5 * thinnest
}

/// Returns true if a point of A's body may have moved farther than that.
#[inline]
pub(super) fn may_go_through(plan: &Plan, motion: &Motion) -> bool {
    let Some(since) = &motion.since_commit else { return false };
    // Nothing that can be passed.
    if plan.least_travel_m == f64::INFINITY {
        return false;
    }
    let shift_square = (motion.x_ba.translation - since.x_ba.translation).norm_squared();
    // The Frobenius norm bounds the displacement of any point at a distance of 1 m.
    let turn_square = (motion.x_ba.rotation - since.x_ba.rotation).norm_squared();
    let (reach, least) = (plan.reach_a_m, plan.least_travel_m);
    // Cheap test without roots: (a + b)² ≤ 2·(a² + b²); the factor 4 adds a margin for rounding.
    4.0 * (shift_square + turn_square * (reach * reach)) > least * least
        && shift_square.sqrt() + turn_square.sqrt() * reach > least
}

/// Greatest distance of a followed point of A from the origin of its movable group, m.
pub(crate) fn reach_m(a: &MovableGroup) -> f64 {
    let points = a.points.iter().map(|point| point.position);
    let ends = a.segments.iter().flat_map(|segment| segment.ends);
    let rays = a.rays.iter().map(|ray| ray.origin);
    let balls = a.spheres.iter().map(|sphere| sphere.center);
    let ellipsoids = a.ellipsoids.iter().map(|ellipsoid| ellipsoid.center);
    let round = a.capsules.iter().flat_map(|capsule| capsule.ends);
    let round = round.chain(a.frusta.iter().flat_map(|frustum| frustum.ends));
    let all = points.chain(ends).chain(rays).chain(balls).chain(ellipsoids).chain(round);
    all.map(|place| place.norm()).fold(0.0, f64::max)
}

/// Returns true if the region swept by a batch of A since the last commit may overlap a batch of B.
pub(super) fn sweeps(motion: &Motion, a: &Batch, b: &Batch) -> bool {
    let Some(since) = &motion.since_commit else { return false };
    let (low, high) = a.boxes.widened(&a.boxes.around);
    if !low.iter().chain(high.iter()).all(|x| x.is_finite()) {
        return true;
    }
    let (from, to) = (carried(&low, &high, &since.x_ba), carried(&low, &high, &motion.x_ba));
    let query = b.boxes.narrowed(&from.0.inf(&to.0), &from.1.sup(&to.1));
    query.meets(&b.boxes.around)
}

/// Box in B's frame around a box of A.
fn carried(low: &Vec3, high: &Vec3, x_ba: &Transform) -> (Vec3, Vec3) {
    let center = x_ba.point(&(0.5 * (low + high)));
    let half = x_ba.rotation.abs() * (0.5 * (high - low));
    (center - half, center + half)
}
