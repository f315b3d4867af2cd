//! Rejects tunnelling by distance: if A has moved by less than half the thickness of the thinnest element of
//! B, it has passed through nothing.

use crate::frame::input::motion::{Motion, SinceCommit};
use crate::seal::{Partner, Plan, SolidPair};
use pong_geometry::primitive::{Primitive, PrimitiveKind};
use pong_geometry::{Transform, Vec3};
use pong_model::{Batch, MovableGroup, PrimitiveInfo, Solid, SolidBox};

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

/// Least distance that solids of A must move to pass through solids of B, and the greatest distance of a vertex
/// of these solids of A from the origin of its movable group, m. Infinite and 0 without such pairs.
pub(crate) fn travel_of_solids_m([a, b]: [&MovableGroup; 2], pairs: &[SolidPair]) -> (f64, f64) {
    let mut travel = (f64::INFINITY, 0.0_f64);
    for pair in pairs {
        let Partner::Solid(index_b) = pair.b else { continue };
        let (solid_a, solid_b) = (&a.solids[pair.a as usize], &b.solids[index_b as usize]);
        travel.0 = travel.0.min(0.5 * solid_a.thinnest_m()).min(0.5 * solid_b.thinnest_m());
        travel.1 = travel.1.max(reach_of(solid_a));
    }
    travel
}

fn reach_of(solid: &Solid) -> f64 {
    let vertices = solid.parts.iter().flat_map(|part| part.surface.vertices());
    vertices.map(|vertex| vertex.norm()).fold(0.0, f64::max)
}

/// Returns true if a point of A, seen from B, may have moved farther than `least_travel_m` since the last
/// commit.
#[inline]
pub(super) fn may_go_through(plan: &Plan, motion: &Motion) -> bool {
    has_moved(motion, plan.reach_a_m, plan.least_travel_m)
}

/// Returns true if a solid of A, seen from B, may have moved far enough since the last commit to pass through a
/// solid of B.
#[inline]
pub(super) fn solids_may_go_through(plan: &Plan, motion: &Motion) -> bool {
    has_moved(motion, plan.reach_of_solids_a_m, plan.least_travel_of_solids_m)
}

/// Returns true if a point of A within `reach` (m) of its origin, seen from B, may have moved farther than
/// `least` (m) since the last commit.
#[inline]
fn has_moved(motion: &Motion, reach: f64, least: f64) -> bool {
    let Some(since) = &motion.since_commit else { return false };
    // B has nothing that A can pass through.
    if least == f64::INFINITY {
        return false;
    }
    let shift_square = (motion.x_ba.translation - since.x_ba.translation).norm_squared();
    // The Frobenius norm bounds the displacement of any point at a distance of 1 m.
    let turn_square = (motion.x_ba.rotation - since.x_ba.rotation).norm_squared();
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

/// Returns true if the region that a box of A has swept since the last commit may overlap a box of B.
pub(super) fn sweeps_box([a, b]: [&SolidBox; 2], since: &SinceCommit, motion: &Motion) -> bool {
    let (low, high) = (a.center - a.half, a.center + a.half);
    let (from, to) = (carried(&low, &high, &since.x_ba), carried(&low, &high, &motion.x_ba));
    let (low, high) = (from.0.inf(&to.0), from.1.sup(&to.1));
    (0..3).all(|k| low[k] <= b.center[k] + b.half[k] && high[k] >= b.center[k] - b.half[k])
}

/// Box in B's frame around a box of A.
fn carried(low: &Vec3, high: &Vec3, x_ba: &Transform) -> (Vec3, Vec3) {
    let center = x_ba.point(&(0.5 * (low + high)));
    let half = x_ba.rotation.abs() * (0.5 * (high - low));
    (center - half, center + half)
}
