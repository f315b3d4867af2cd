//! Fills [`MovableGroup::solids`] from the primitives in groups with `contact: Solid` (docs/theory.md, 2.11).

mod convex;
mod corners;
mod crossing;
mod divided;
mod facets;
mod joined;
mod meshes;
mod parts;
mod refusal;
mod regions;
mod thickened;

use crate::draft::BodyDraft;
use crate::model::MovableGroup;
use crate::read::Reader;
use crate::surface::Surface;
use crate::weld::WordMap;
use pong_geometry::primitive::PrimitiveKind;
use refusal::Refusal;

/// Fills the solids of a movable group whose shells are numbered, except for their leaves; faults go to the
/// reader.
pub(crate) fn fill(reader: &mut Reader<'_>, draft: &mut BodyDraft, surfaces: &[Surface]) {
    if !draft.is_solid.contains(&true) {
        return;
    }
    let mut refusals = Vec::new();
    let mut solids = joined::solids(draft, surfaces, &mut refusals);
    solids.extend(meshes::solids(draft, surfaces, &mut refusals));
    corners::check(draft, &solids, &mut refusals);
    solids.sort_by_key(|solid| (solid.primitive, solid.shell));
    draft.body.solids = solids;
    for Refusal { primitive, rule, cause, cure } in refusals {
        let path = draft.body.primitives[primitive].path.clone();
        reader.fault(draft.primitive_at[primitive], &path, rule, cause, cure);
    }
}

/// Sets [`Solid::leaf`](crate::Solid::leaf) of all solids of a movable group to the nodes of its present tree.
pub(crate) fn set_leaves(body: &mut MovableGroup) {
    if body.solids.is_empty() {
        return;
    }
    let mut leaves: WordMap<(u32, u32), (u32, u32)> = WordMap::default();
    for (number, node) in body.tree.nodes.iter().enumerate() {
        for item in &body.tree.items[node.items.start as usize..node.items.end as usize] {
            let info = &body.primitives[item.primitive as usize];
            let shell = match info.kind {
                PrimitiveKind::Triangle => body.triangles.triangles[item.element as usize].shell,
                _ => info.shell,
            };
            let lowest = leaves.entry((item.primitive, shell)).or_insert((item.element, number as u32));
            *lowest = (*lowest).min((item.element, number as u32));
        }
    }
    for solid in &mut body.solids {
        if let Some((_, leaf)) = leaves.get(&(solid.primitive, solid.shell)) {
            solid.leaf = *leaf;
        }
    }
}
