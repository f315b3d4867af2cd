//! Solids of one model: numbers, and the foundations that follow from areas.

use crate::text::{count, number};
use pong_model::{Model, MovableGroup, Solid, printable};

/// Lines about the solids of a model; empty without solids.
pub(super) fn description(model: &Model) -> String {
    let mut text: String = model.bodies.iter().filter(|body| !body.solids.is_empty()).map(of_body).collect();
    for index in 0..model.surfaces.len() as u32 {
        text += &foundations(model, index);
    }
    text
}

fn of_body(body: &MovableGroup) -> String {
    let solids = &body.solids;
    let sum = |of: fn(&Solid) -> usize| solids.iter().map(of).sum();
    format!(
        "  solids of {}: {}, {} of them convex, {}, {}\n",
        printable(&body.path),
        solids.len(),
        solids.iter().filter(|solid| solid.is_convex()).count(),
        count(sum(|solid| solid.parts.len()), "part", "parts"),
        count(sum(|solid| solid.fields.len()), "field", "fields"),
    )
}

/// Line about the foundation that a surface without `foundation` and `area` has at its solids, from the least to
/// the greatest; empty if it has no such solid.
fn foundations(model: &Model, index: u32) -> String {
    let surface = &model.surfaces[index as usize];
    let given = surface.foundation.or(surface.area).is_some() || surface.stiffness.is_infinite();
    let solids = model.bodies.iter().flat_map(|body| &body.solids).filter(|solid| solid.surface == index);
    let areas: Vec<f64> = solids.map(Solid::reference_area).collect();
    if given || areas.is_empty() {
        return String::new();
    }
    let (least, greatest) =
        (areas.iter().copied().fold(f64::INFINITY, f64::min), areas.iter().copied().fold(0.0, f64::max));
    let range = |low: f64, high: f64| match number(low) == number(high) {
        true => number(low),
        false => format!("{} … {}", number(low), number(high)),
    };
    format!(
        "  surface `{}` gives no `foundation` and no `area`: area {} m², K {} N/m³ at its solids\n",
        printable(&surface.name),
        range(least, greatest),
        range(surface.stiffness / greatest, surface.stiffness / least),
    )
}

/// A note for each solid that is a mesh and not convex.
pub(super) fn notes(model: &Model) -> Vec<String> {
    let note = |body: &MovableGroup, solid: &Solid| {
        let path = &body.primitives[solid.primitive as usize].path;
        let reach = solid.least_height().map_or("as deep as they go".to_owned(), |least| {
            format!("down to {} m at the shallowest, and not below that", number(least))
        });
        format!(
            "{path} is a solid that is not convex: against others like it, its facets push {reach}; `pong decompose` \
             makes convex pieces of it"
        )
    };
    let mut notes = Vec::new();
    for body in &model.bodies {
        let without_fields = body.solids.iter().filter(|solid| solid.fields.is_empty());
        notes.extend(without_fields.map(|solid| note(body, solid)));
    }
    notes
}
