//! Combines pairs of surfaces, once when a scene is sealed or a surface is changed.

use super::filters::{apart, representatives};
use super::leaf_filter::ObjectFilters;
use super::plans::{can_be_tested, kind_name, solid_pairs};
use super::solids::{Partner, SolidPair, entry_per_area, field_shares, per_area, unfit};
use super::warnings::SetupNote;
use super::{GroupPair, SurfaceTable};
use crate::law::{FrictionProps, PairProps, combine, friction_name};
use crate::scene::Scene;
use pong_model::{
    Filters, FrictionLaw, Model, MovableGroup, PairOverride, PrimitiveInfo, Surface, pair_entries,
};
use std::collections::{BTreeMap, BTreeSet};

/// Combines every pair of surfaces that can meet; on failure, reports all that cannot be combined.
pub(crate) fn surface_tables(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
    group_pairs: &[GroupPair],
    filters: &ObjectFilters,
) -> Result<Vec<SurfaceTable>, Vec<String>> {
    let mut tables: Vec<SurfaceTable> = Vec::new();
    let (mut of_models, mut filled) = (BTreeMap::new(), BTreeSet::new());
    let mut problems = BTreeSet::new();
    for pair in group_pairs {
        for (a, b) in [(pair.first, pair.second), (pair.second, pair.first)] {
            let groups = [a, b].map(|body| scene.group_of_model(body));
            let apart = filters.between(scene.bodies[a].object, scene.bodies[b].object);
            // One pair of movable groups represents all pairs of the same models and filters.
            if !filled.insert((groups, apart)) {
                continue;
            }
            let [(model_a, _), (model_b, _)] = groups;
            let index = *of_models.entry((model_a, model_b)).or_insert_with(|| {
                tables.push(SurfaceTable::empty(model_a, model_b, surfaces));
                tables.len() - 1
            });
            let bodies = [a, b].map(|body| scene.body(body));
            fill_table(scene, surfaces, &mut tables[index], bodies, apart, &mut problems);
            let of_models = groups.map(|(_, group)| group);
            fill_foundations(scene, surfaces, &mut tables[index], (bodies, of_models), apart, &mut problems);
        }
    }
    if problems.is_empty() { Ok(tables) } else { Err(problems.into_iter().collect()) }
}

/// Combines the surfaces of a table that can meet in two movable groups.
fn fill_table(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
    table: &mut SurfaceTable,
    [body_a, body_b]: [&MovableGroup; 2],
    filters: Option<&Filters>,
    problems: &mut BTreeSet<String>,
) {
    // One primitive per kind and surface is enough: meshes of a thousand parts share a few surfaces.
    let distinct = |side: usize, body| {
        let kind = |info: &PrimitiveInfo| (kind_name(body, info).to_owned(), info.surface);
        representatives(filters, side, body, kind).collect::<Vec<_>>()
    };
    let (in_a, in_b) = (distinct(0, body_a), distinct(1, body_b));
    for &info_a in &in_a {
        for &info_b in in_b.iter().filter(|info_b| !apart(filters, info_a, info_b)) {
            let slot = info_a.surface as usize * table.columns + info_b.surface as usize;
            let met = can_be_tested(&scene.extensions, (body_a, info_a), (body_b, info_b));
            if !met || table.props[slot].is_some() {
                continue;
            }
            let model_a = &scene.models[table.model_a];
            let model_b = &scene.models[table.model_b];
            let a = &surfaces[table.model_a][info_a.surface as usize];
            let b = &surfaces[table.model_b][info_b.surface as usize];
            match combined(scene, (model_a, a), (model_b, b)) {
                Ok(props) => {
                    table.has_resistance |= props.has_resistance();
                    table.props[slot] = Some(props);
                }
                Err(problem) => _ = problems.insert(problem),
            }
        }
    }
}

/// Combines the surfaces of the solids and planes of two movable groups that may meet, per unit area.
/// `groups` are the indices of the groups in their models.
fn fill_foundations(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
    table: &mut SurfaceTable,
    (bodies, groups): ([&MovableGroup; 2], [usize; 2]),
    filters: Option<&Filters>,
    problems: &mut BTreeSet<String>,
) {
    let [body_a, body_b] = bodies;
    let models = [table.model_a, table.model_b].map(|model| &*scene.models[model]);
    for SolidPair { a, b } in solid_pairs(bodies, true, filters) {
        let solid_a = &body_a.solids[a as usize];
        let (solid_b, surface_b) = match b {
            Partner::Solid(index) => {
                let solid = &body_b.solids[index as usize];
                (Some(solid), solid.surface)
            }
            Partner::Plane(index) => (None, body_b.primitives[index as usize].surface),
        };
        let name = |side: usize, primitive: u32| {
            format!("{}/{}", models[side].name, bodies[side].primitives[primitive as usize].path)
        };
        if let Some(solid_b) = solid_b
            && field_shares(solid_a, Some(solid_b), 0.5).is_none()
        {
            let [one, other] = [name(0, solid_a.primitive), name(1, solid_b.primitive)];
            problems.insert(format!(
                "solids `{one}` and `{other}`: neither is convex, and all triangles of both are too thin to push; \
                 divide one with `pong decompose`, or filter the pair"
            ));
            continue;
        }
        // A plane has no area; the area of the solid on it counts for both.
        let areas = [solid_a.reference_area(), solid_b.unwrap_or(solid_a).reference_area()];
        let a_surface = &surfaces[table.model_a][solid_a.surface as usize];
        let b_surface = &surfaces[table.model_b][surface_b as usize];
        match combined_per_area(scene, (models[0], a_surface), (models[1], b_surface), areas) {
            Ok(props) => _ = table.foundations.insert((groups[0], a, groups[1], b), props),
            Err(problem) => _ = problems.insert(problem),
        }
    }
}

/// Combined values per unit area of a pair of surfaces of two models, or the reason why there are none.
fn combined_per_area(
    scene: &Scene,
    (model_a, a): (&Model, &Surface),
    (model_b, b): (&Model, &Surface),
    areas: [f64; 2],
) -> Result<PairProps, String> {
    let own = [a.area.unwrap_or(areas[0]), b.area.unwrap_or(areas[1])];
    let least = own[0].min(own[1]);
    let entry = |entry: &PairOverride| entry_per_area(entry, least);
    let [scaled_a, scaled_b] = [per_area(a, areas[0]), per_area(b, areas[1])];
    let props = combined_by(scene, (model_a, &scaled_a), (model_b, &scaled_b), entry)?;
    match unfit(&props) {
        None => Ok(props),
        Some(cause) => {
            let mut names = [full_name(model_a, a), full_name(model_b, b)];
            names.sort();
            Err(format!("surfaces `{}` and `{}`: {cause}", names[0], names[1]))
        }
    }
}

fn full_name(model: &Model, surface: &Surface) -> String {
    format!("{}/{}", model.name, surface.name)
}

/// Combined values of a pair of surfaces of two models, or the reason why there are none.
fn combined(scene: &Scene, a: (&Model, &Surface), b: (&Model, &Surface)) -> Result<PairProps, String> {
    combined_by(scene, a, b, Clone::clone)
}

/// Combined values with the entry of the pair changed by `of_entry`.
fn combined_by(
    scene: &Scene,
    (model_a, a): (&Model, &Surface),
    (model_b, b): (&Model, &Surface),
    of_entry: impl Fn(&PairOverride) -> PairOverride,
) -> Result<PairProps, String> {
    let full = full_name;
    let made = table_entry((model_a, a), (model_b, b)).and_then(|entry| {
        let entry = entry.map(&of_entry);
        let entry = entry.as_ref();
        combine(a, b, entry, &scene.laws).map_err(|_| {
            // Combined again for the message alone, with names that are unique across models.
            let [a, b] = [(model_a, a), (model_b, b)]
                .map(|(model, surface)| Surface { name: full(model, surface), ..surface.clone() });
            let (a, b) = if a.name <= b.name { (a, b) } else { (b, a) };
            let error = combine(&a, &b, entry, &scene.laws).expect_err("the order decides no fault");
            (error.cause, error.cure)
        })
    });
    made.map_err(|(cause, cure)| {
        let mut names = [full(model_a, a), full(model_b, b)];
        names.sort();
        format!("surfaces `{}` and `{}`: {cause}; {cure}", names[0], names[1])
    })
}

/// Pairs of surfaces of which only one has friction, so that there is none between them. Pairs whose friction
/// is given in `pairs` are left out.
pub(super) fn friction_lost(
    scene: &Scene,
    surfaces: &[Vec<Surface>],
    tables: &[SurfaceTable],
) -> BTreeSet<SetupNote> {
    let mut lost = BTreeSet::new();
    for table in tables {
        let models = [table.model_a, table.model_b].map(|model| &*scene.models[model]);
        for (slot, _) in table.props.iter().enumerate().filter(|(_, props)| props.is_some()) {
            let a = &surfaces[table.model_a][slot / table.columns];
            let b = &surfaces[table.model_b][slot % table.columns];
            let rough =
                [a, b].map(|surface| !matches!(surface.friction, FrictionLaw::None | FrictionLaw::Inherited));
            let smooth = [a, b].map(|surface| surface.friction == FrictionLaw::None);
            let entry = table_entry((models[0], a), (models[1], b)).ok().flatten();
            if entry.is_some_and(|entry| entry.friction.is_some()) {
                continue;
            }
            let full = |side: usize, surface: &Surface| format!("{}/{}", models[side].name, surface.name);
            lost.extend(match (rough, smooth) {
                ([true, _], [_, true]) => Some(note(full(0, a), friction_name(a), full(1, b))),
                ([_, true], [true, _]) => Some(note(full(1, b), friction_name(b), full(0, a))),
                _ => None,
            });
        }
    }
    lost
}

fn note(rough: String, law: String, smooth: String) -> SetupNote {
    SetupNote::NoFriction { rough, law, smooth }
}

/// Entry for a pair of surfaces in the two models' tables; entries must not contradict each other.
fn table_entry<'m>(
    a: (&'m Model, &Surface),
    b: (&'m Model, &Surface),
) -> Result<Option<&'m PairOverride>, (String, String)> {
    let entries = pair_entries(a, b);
    let Some((model, entry)) = entries.first() else { return Ok(None) };
    let values = |entry: &'m PairOverride| (entry.stiffness, &entry.normal, &entry.friction);
    let Some((other_model, other)) = entries.iter().find(|(_, other)| values(other) != values(entry)) else {
        return Ok(Some(entry));
    };
    let written = |entry: &PairOverride| format!("(\"{}\", \"{}\")", entry.surfaces[0], entry.surfaces[1]);
    Err(if std::ptr::eq(*model, *other_model) {
        let (one, two) = (written(entry), written(other));
        (
            format!("the entries {one} and {two} in `pairs` of model `{}` both hold and differ", model.name),
            "make them equal or drop one".to_owned(),
        )
    } else {
        (
            format!("models `{}` and `{}` give different values for this pair", model.name, other_model.name),
            "make the two `pairs` entries equal or drop one".to_owned(),
        )
    })
}

/// Largest number of state values per contact of any registered friction law in the tables.
pub(crate) fn law_state_len(tables: &[SurfaceTable]) -> usize {
    let elements = tables.iter().flat_map(|table| &table.props).flatten();
    let solids = tables.iter().flat_map(|table| table.foundations.values());
    let lens = elements.chain(solids).map(|props| match &props.friction {
        FrictionProps::Custom { law, .. } => law.state_len(),
        _ => 0,
    });
    lens.max().unwrap_or(0)
}
