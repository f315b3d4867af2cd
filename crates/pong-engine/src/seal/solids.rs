//! Solids that may touch: pairs of two solids, and of a solid and a plane, with combined values per area
//! (docs/theory.md, 2.12).

use crate::law::{FrictionProps, NormalProps, PairProps};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Exponent, MovableGroup, NormalLaw, PairOverride, PrimitiveInfo, Solid, Surface};

/// Partner of a solid of A.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Partner {
    /// Solid of B (index into [`MovableGroup::solids`]).
    Solid(u32),
    /// Plane of B (index into [`MovableGroup::primitives`]).
    Plane(u32),
}

/// A solid of A and what it may touch in B.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SolidPair {
    /// Index into [`MovableGroup::solids`] of A.
    pub a: u32,
    pub b: Partner,
}

/// Key of the combined values of two solids in a [`SurfaceTable`](super::SurfaceTable): the movable groups of
/// the two models, each with its solid or plane.
pub(crate) type FoundationKey = (usize, u32, usize, Partner);

/// Returns true if the first primitive belongs to a solid, and the second to a solid or is a plane.
pub(crate) fn solids_touch(a: (&MovableGroup, &PrimitiveInfo), b: (&MovableGroup, &PrimitiveInfo)) -> bool {
    a.0.is_solid(a.1) && (b.1.kind == PrimitiveKind::Plane || b.0.is_solid(b.1))
}

/// Shares of the two fields in the energy of a pair, A's first. The field of a plane carries both springs in
/// series: it has no far side, so a soft body cannot sink through it. A solid that is not convex leaves its share
/// to a convex partner. `None` if neither has a field: all facets of both are too thin for one.
pub(crate) fn field_shares(a: &Solid, b: Option<&Solid>, share_a: f64) -> Option<[f64; 2]> {
    let Some(b) = b else { return Some([0.0, 1.0]) };
    let has_field = [a.has_field(), b.has_field()];
    match ([a.is_convex(), b.is_convex()], has_field) {
        ([true, false], _) | (_, [true, false]) => Some([1.0, 0.0]),
        ([false, true], _) | (_, [false, true]) => Some([0.0, 1.0]),
        (_, [true, true]) => Some([share_a, 1.0 - share_a]),
        (_, [false, false]) => None,
    }
}

/// Surface whose numbers are per unit area: its stiffness is the foundation modulus K, N/m³, and its dampings
/// and the stiffness of its bristle change by the same factor. `area` is that of its solid, m².
pub(super) fn per_area(surface: &Surface, area: f64) -> Surface {
    let area = surface.area.unwrap_or(area);
    let modulus = match surface.stiffness.is_finite() {
        true => surface.foundation.unwrap_or(surface.stiffness / area),
        false => f64::INFINITY,
    };
    // Finite operands, because a compiler may divide before it tests them, and ∞/∞ is an invalid operation.
    let scale = modulus.min(f64::MAX) / surface.stiffness.min(f64::MAX);
    let factor = if surface.stiffness.is_finite() { scale } else { 1.0 / area };
    let mut scaled = surface.clone();
    scaled.stiffness = modulus;
    scale_laws(&mut scaled.normal, &mut scaled.friction, factor);
    scaled
}

/// Entry for a pair of surfaces with its numbers per unit area; `area` is the smaller of the two, m².
pub(super) fn entry_per_area(entry: &PairOverride, area: f64) -> PairOverride {
    let mut scaled = entry.clone();
    scaled.stiffness = entry.stiffness.map(|stiffness| stiffness / area);
    if let Some(law) = &mut scaled.normal {
        scale_normal(law, 1.0 / area);
    }
    if let Some(law) = &mut scaled.friction {
        scale_friction(law, 1.0 / area);
    }
    scaled
}

fn scale_laws(normal: &mut NormalLaw, friction: &mut pong_model::FrictionLaw, factor: f64) {
    scale_normal(normal, factor);
    scale_friction(friction, factor);
}

fn scale_normal(law: &mut NormalLaw, factor: f64) {
    match law {
        NormalLaw::Linear { damping, .. } | NormalLaw::PowerLaw { damping, .. } => *damping *= factor,
        NormalLaw::HuntCrossley { .. } | NormalLaw::Custom { .. } | NormalLaw::Inherited => {}
    }
}

fn scale_friction(law: &mut pong_model::FrictionLaw, factor: f64) {
    if let pong_model::FrictionLaw::Bristle { stiffness, damping, .. } = law {
        for number in [stiffness, damping] {
            *number = number.map(|number| number * factor);
        }
    }
}

/// Reason why solids cannot use the combined values, with the cure.
pub(super) fn unfit(props: &PairProps) -> Option<&'static str> {
    if matches!(props.friction, FrictionProps::Custom { .. }) {
        return Some(
            "solids have no law of the host for friction; use `Bristle` or `Coulomb` for them, or mark what touches \
             with `contact: Marked`",
        );
    }
    if props.has_resistance() {
        return Some(
            "the friction of solids has no `rolling` and no `spinning` resistance; give solids surfaces without \
             them, or give the pair its friction in `pairs`, or mark what touches with `contact: Marked`",
        );
    }
    match &props.normal {
        NormalProps::Custom { .. } => Some(
            "solids have no law of the host for the normal force; use `Linear` or `HuntCrossley` for them, or mark \
             what touches with `contact: Marked`",
        ),
        law if law.exponent() != Exponent::One => Some(
            "the normal force of solids is linear in the depth, and the exponent is 3/2; use the exponent 1 for \
             them, or mark what touches with `contact: Marked`",
        ),
        _ => None,
    }
}
