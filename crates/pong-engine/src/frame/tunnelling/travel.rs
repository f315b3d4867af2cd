//! Rejects tunnelling by distance: if A has moved by less than half the thickness of the thinnest element of
//! B, it has passed through nothing.

use crate::frame::input::motion::Motion;
use crate::seal::Plan;
use pong_geometry::primitive::{Primitive, PrimitiveKind};
use pong_geometry::{Transform, Vec3};
use pong_model::{Batch, MovableGroup, PrimitiveInfo};

/// Some primitives of a movable group.
#[derive(Clone, Copy)]
pub(crate) struct PrimitivesOf<'a> {
    pub body: &'a MovableGroup,
    pub infos: &'a [&'a PrimitiveInfo],
}

/// Least distance that A must move to pass through one of the given primitives of B, m: half the thickness of
/// the thinnest one. Infinite if A can pass through none of them.
///
/// A triangle counts with the thickness up to which it pushes the smallest element of A. A ray against
/// triangles counts with its length, if that is less.
pub(crate) fn least_travel_m(
    a: PrimitivesOf<'_>,
    b: PrimitivesOf<'_>,
    tests: impl Fn(PrimitiveKind, PrimitiveKind) -> bool,
) -> f64 {
    let kinds = PrimitiveKind::ALL;
    let touched = |kind_b: PrimitiveKind| kinds.iter().any(|&kind_a| tests(kind_a, kind_b));
    let passable = b.infos.iter().copied().filter(|info| touched(info.kind));
    let widths = facts(b.body, passable).map(|facts| facts.least_width_m());
    let mut thinnest = widths.fold(f64::INFINITY, f64::min);
    if touched(PrimitiveKind::Triangle) {
        let radii = facts(a.body, a.infos.iter().copied()).filter_map(|facts| facts.smallest_radius_m());
        let smallest = radii.fold(f64::INFINITY, f64::min);
        let meshes = b.infos.iter().filter(|info| info.kind == PrimitiveKind::Triangle);
        thinnest = meshes.map(|info| info.thickness.unwrap_or(smallest)).fold(thinnest, f64::min);
        let rays = a.infos.iter().filter(|info| info.kind == PrimitiveKind::Ray);
        let lengths = rays.map(|info| a.body.rays[info.elements.start as usize].length);
        thinnest = lengths.fold(thinnest, f64::min);
    }
    0.5 * thinnest
}

/// Elements of the given primitives as [`Primitive`]; triangles and custom primitives are left out.
fn facts<'a>(
    body: &'a MovableGroup,
    infos: impl Iterator<Item = &'a PrimitiveInfo>,
) -> impl Iterator<Item = &'a dyn Primitive> {
    let elements = infos.flat_map(|info| info.elements.clone().map(|element| (info.kind, element)));
    elements.filter_map(|(kind, element)| body.element(kind, element).facts())
}

/// Returns true if a point of A, seen from B, may have moved farther than `least_travel_m` since the last
/// commit.
#[inline]
pub(super) fn may_go_through(plan: &Plan, motion: &Motion) -> bool {
    let Some(since) = &motion.since_commit else { return false };
    // B has nothing that A can pass through.
    if plan.least_travel_m == f64::INFINITY {
        return false;
    }
    let shift_square = (motion.x_ba.translation - since.x_ba.translation).norm_squared();
    // The Frobenius norm bounds the displacement of any point at a distance of 1 m.
    let turn_square = (motion.x_ba.rotation - since.x_ba.rotation).norm_squared();
    let (reach, least) = (plan.reach_a_m, plan.least_travel_m);
    // The first comparison needs no roots and decides most cases: (a + b)² ≤ 2·(a² + b²), and the factor 4
    // adds a margin for rounding.
    4.0 * (shift_square + turn_square * (reach * reach)) > least * least
        && shift_square.sqrt() + turn_square.sqrt() * reach > least
}

/// Greatest distance of a followed point of the given primitives of A from the origin of its movable group, m.
pub(crate) fn reach_m(a: PrimitivesOf<'_>) -> f64 {
    let places = facts(a.body, a.infos.iter().copied()).flat_map(|facts| facts.followed()).flatten();
    places.map(|place| place.norm()).fold(0.0, f64::max)
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
