//! Contact between two models: the testers that run, the pairs of kinds that ignore each other.

use super::bristles;
use super::named::Named;
use super::stiffness;
use crate::text::{count, number};
use pong_engine::{Config, EngineError, SealReport, WorldBuilder, has_tester};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Filters, MovableGroup, printable};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Testers that run between two models (or the movable groups of one), or every reason why they cannot meet.
pub(super) fn description(a: &Named, b: &Named) -> Result<String, Vec<String>> {
    let report = sealed(a, b).map_err(|error| match error {
        EngineError::Seal { problems } => problems,
        other => vec![other.to_string()],
    })?;
    let itself = Arc::ptr_eq(&a.model, &b.model);
    let mut text = match itself {
        true => format!("`{}` with itself: ", a.name),
        false => format!("`{}` and `{}`: ", a.name, b.name),
    };
    text += &format!(
        "{}{}, at most {}, contact state {} bytes\n",
        count(report.group_pairs, "pair of movable groups", "pairs of movable groups"),
        match report.filters {
            0 => String::new(),
            filters => format!(", filtered: {}", count(filters, "pair of groups", "pairs of groups")),
        },
        count(report.contact_capacity, "contact", "contacts"),
        number(report.state_size as f64),
    );
    let filters = if itself { a.model.filters_within() } else { Filters::default() };
    let group_pairs = group_pairs(a, b, itself);
    for (kinds, pairs) in testers(&group_pairs, &filters) {
        text += &format!(
            "  {}–{}: {}\n",
            kinds.0,
            kinds.1,
            count(pairs, "pair of primitives", "pairs of primitives")
        );
    }
    for warning in &report.warnings {
        text += &format!("  warning: {}\n", printable(&warning.to_string()));
    }
    for note in &report.notes {
        text += &format!("  note: {}\n", printable(&note.to_string()));
    }
    text += &bristles::of_pairs((a, b), &group_pairs);
    let mut faces = Vec::new();
    for (body_a, body_b) in group_pairs {
        faces.extend(stiffness::faces_pressed((a, body_a), (b, body_b)));
        faces.extend(stiffness::faces_pressed((b, body_b), (a, body_a)));
    }
    text += &stiffness::lines(faces);
    Ok(text)
}

fn sealed(a: &Named, b: &Named) -> Result<SealReport, EngineError> {
    let mut builder = WorldBuilder::new(Config::default());
    let model = builder.add_model(Arc::clone(&a.model));
    let first = builder.create_object(model, &a.name)?;
    let second = if Arc::ptr_eq(&a.model, &b.model) {
        first
    } else {
        let model = builder.add_model(Arc::clone(&b.model));
        builder.create_object(model, &b.name)?
    };
    builder.pair(first, second)?;
    let (_, report) = builder.seal()?;
    Ok(report)
}

/// The pairs of movable groups that are tested.
fn group_pairs<'m>(a: &'m Named, b: &'m Named, itself: bool) -> Vec<(&'m MovableGroup, &'m MovableGroup)> {
    let mut pairs = Vec::new();
    for (index, body_a) in a.model.bodies.iter().enumerate() {
        let from = if itself { index + 1 } else { 0 };
        pairs.extend(b.model.bodies.iter().skip(from).map(|body_b| (body_a, body_b)));
    }
    pairs
}

/// Pairs of elements by pair of kinds, A's kind first, without those excluded by filters.
fn testers(
    group_pairs: &[(&MovableGroup, &MovableGroup)],
    filters: &Filters,
) -> BTreeMap<(&'static str, &'static str), usize> {
    let mut testers = BTreeMap::new();
    for (body_a, body_b) in group_pairs {
        let (counts_a, counts_b) = (elements(body_a, filters, 0), elements(body_b, filters, 1));
        for ((kind_a, held_a), count_a) in &counts_a {
            for ((kind_b, held_b), count_b) in &counts_b {
                let named = match (has_tester(*kind_a, *kind_b), has_tester(*kind_b, *kind_a)) {
                    (true, _) => (kind_a.name(), kind_b.name()),
                    (_, true) => (kind_b.name(), kind_a.name()),
                    _ => continue,
                };
                if !held_a.iter().any(|filter| held_b.contains(filter)) {
                    *testers.entry(named).or_default() += count_a * count_b;
                }
            }
        }
    }
    testers
}

/// Elements by kind and by the filters that hold them.
fn elements(
    body: &MovableGroup,
    filters: &Filters,
    side: usize,
) -> BTreeMap<(PrimitiveKind, Vec<usize>), usize> {
    let mut counts = BTreeMap::new();
    for item in &body.tree.items {
        let info = &body.primitives[item.primitive as usize];
        *counts.entry((info.kind, filters.that_hold(side, &info.path))).or_default() += 1;
    }
    counts
}
