//! Combined values of the two surfaces of a contact.

use super::sealed::Sealed;
use super::solids::Partner;
use super::surface_table::SurfaceTable;
use crate::frame::narrow_phase::candidate::ContactCandidate;
use crate::law::PairProps;
use crate::scene::Scene;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{MovableGroup, Solid};

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
        // Only a solid of several primitives has parts of another primitive than its lowest.
        let is_lowest = |solid: &Solid| solid.primitive == primitive;
        let has = |solid: &Solid| solid.parts.iter().any(|part| part.primitive == primitive);
        let found = body.solids.iter().position(is_lowest).or_else(|| body.solids.iter().position(has));
        found.expect("a contact of solids is one of its solids") as u32
    };
    let partner = match b.primitives[primitive_b].kind {
        PrimitiveKind::Plane => Partner::Plane(found.primitive_b),
        _ => Partner::Solid(solid_of(b, found.primitive_b)),
    };
    let [group_a, group_b] = [body_a, body_b].map(|body| scene.group_of_model(body).1);
    &table.foundations[&(group_a, solid_of(a, found.key.primitive_a), group_b, partner)]
}
