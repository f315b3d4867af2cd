//! Solids that may touch: pairs of two solids, and of a solid and a plane, with combined values per area
//! (docs/theory.md, 2.12).

use super::filters::apart;
use super::sealed::Sealed;
use super::surface_table::SurfaceTable;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::law::{NormalProps, PairProps};
use crate::scene::Scene;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Exponent, Filters, MovableGroup, NormalLaw, PairOverride, Solid, Surface};

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

/// Solids of A with solids and planes of B that no filter keeps apart. Two solids are paired only if A's
/// Object was named first (`in_order`), so that no contact is found twice.
pub(super) fn solid_pairs(
    [a, b]: [&MovableGroup; 2],
    in_order: bool,
    filters: Option<&Filters>,
) -> Vec<SolidPair> {
    let mut pairs = Vec::new();
    for (index_a, solid_a) in (0..).zip(&a.solids) {
        let meets = |primitive_b: u32| {
            let info_a = &a.primitives[solid_a.primitive as usize];
            !apart(filters, info_a, &b.primitives[primitive_b as usize])
        };
        let solids = (0..).zip(&b.solids).filter(|_| in_order);
        let solids =
            solids.filter(|(_, solid)| meets(solid.primitive)).map(|(index, _)| Partner::Solid(index));
        let planes = (0..).zip(&b.primitives).filter(|(_, info)| info.kind == PrimitiveKind::Plane);
        let planes = planes.filter(|(index, _)| meets(*index)).map(|(index, _)| Partner::Plane(index));
        pairs.extend(solids.chain(planes).map(|b| SolidPair { a: index_a, b }));
    }
    pairs
}

/// Shares of the two fields in the energy of a pair, A's first. A solid that is not convex leaves its share
/// to a convex partner, whose field then carries both springs in series. `None` if neither has a field.
pub(crate) fn field_shares(a: &Solid, b: Option<&Solid>, share_a: f64) -> Option<[f64; 2]> {
    // A plane is a convex field.
    let convex = [a.is_convex(), b.is_none_or(Solid::is_convex)];
    let has_field = [!a.fields.is_empty(), b.is_none_or(|b| !b.fields.is_empty())];
    match (convex, has_field) {
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
    let modulus = if surface.stiffness.is_finite() {
        surface.foundation.unwrap_or(surface.stiffness / area)
    } else {
        surface.stiffness
    };
    let factor = if surface.stiffness.is_finite() { modulus / surface.stiffness } else { 1.0 / area };
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

/// Combined values of the surfaces of a contact: per unit area for solids.
pub(crate) fn values_of<'t>(
    scene: &Scene,
    sealed: &Sealed,
    tables: &'t [SurfaceTable],
    found: &ContactCandidate,
) -> &'t PairProps {
    let pair = &sealed.group_pairs[found.key.group_pair as usize];
    let table = &tables[pair.tables[found.key.flipped as usize]];
    let (body_a, body_b) = sealed.bodies_of(found.key.direction());
    let (a, b) = (scene.body(body_a), scene.body(body_b));
    let (primitive_a, primitive_b) = (found.key.primitive_a as usize, found.primitive_b as usize);
    if !found.key.is_of_solids() {
        return table.props(a.surfaces[primitive_a], b.surfaces[primitive_b]);
    }
    let solid_of = |body: &MovableGroup, primitive: u32| {
        let has = |solid: &Solid| solid.parts.iter().any(|part| part.primitive == primitive);
        body.solids.iter().position(has).expect("a contact of solids is one of its solids") as u32
    };
    let partner = match b.primitives[primitive_b].kind {
        PrimitiveKind::Plane => Partner::Plane(found.primitive_b),
        _ => Partner::Solid(solid_of(b, found.primitive_b)),
    };
    let [group_a, group_b] = [body_a, body_b].map(|body| scene.group_of_model(body).1);
    &table.foundations[&(group_a, solid_of(a, found.key.primitive_a), group_b, partner)]
}
