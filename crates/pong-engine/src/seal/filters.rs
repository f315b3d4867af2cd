//! Filters between groups: gives models leaves that each lie inside or outside of every filtered group, and
//! drops pairs of movable groups that cannot touch.

use super::GroupPair;
use super::leaf_filter::{LeafFilter, ObjectFilters};
use crate::error::EngineError;
use crate::scene::{GroupFilter, Scene};
use pong_model::{Filters, MovableGroup, PrimitiveInfo};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Gives a finer tree to models of which a leaf has primitives inside and outside of a filtered group.
pub(crate) fn part_groups(scene: &mut Scene) -> Result<(), EngineError> {
    let mut named: BTreeMap<usize, BTreeSet<String>> = BTreeMap::new();
    for GroupFilter { objects, groups } in &scene.filters {
        for (object, group) in objects.iter().zip(groups) {
            named.entry(scene.objects[*object].model).or_default().insert(group.clone());
        }
    }
    for pair in scene.pairs.iter().filter(|pair| pair.a == pair.b) {
        let model = scene.objects[pair.a].model;
        for group in scene.models[model].filters.iter().flatten() {
            named.entry(model).or_default().insert(group.clone());
        }
    }
    for (model, groups) in named {
        let groups: Vec<&str> = groups.iter().map(String::as_str).collect();
        let finer = scene.models[model].with_groups_apart(&groups, &scene.extensions);
        if let Some(finer) = finer.map_err(|problem| EngineError::Seal { problems: vec![problem] })? {
            scene.models[model] = Arc::new(finer);
        }
    }
    Ok(())
}

/// Filters of all pairs of Objects, including the filters of models.
pub(super) fn filters_of_objects(scene: &Scene) -> ObjectFilters {
    let mut of_pairs: BTreeMap<(usize, usize), Vec<[String; 2]>> = BTreeMap::new();
    for pair in scene.pairs.iter().filter(|pair| pair.a == pair.b) {
        let model = &scene.models[scene.objects[pair.a].model];
        if !model.filters.is_empty() {
            of_pairs.insert((pair.a, pair.b), model.filters_within().pairs().to_vec());
        }
    }
    for GroupFilter { objects: [a, b], groups: [of_a, of_b] } in &scene.filters {
        let entries = of_pairs.entry((*a, *b)).or_default();
        entries.push([of_a.clone(), of_b.clone()]);
        if a == b {
            entries.push([of_b.clone(), of_a.clone()]);
        }
    }
    ObjectFilters::new(of_pairs.into_iter().map(|(objects, pairs)| (objects, Filters::new(pairs))))
}

/// Drops pairs of movable groups that the filters keep apart entirely.
pub(super) fn drop_kept_apart(scene: &Scene, filters: &ObjectFilters, group_pairs: &mut Vec<GroupPair>) {
    group_pairs.retain(|pair| {
        let bodies = [pair.first, pair.second];
        let [a, b] = bodies.map(|body| scene.bodies[body].object);
        let filter =
            filters.between(a, b).map(|all| LeafFilter::new(all, bodies.map(|body| scene.body(body))));
        !filter.is_some_and(|filter| filter.keeps_all_apart())
    });
}

/// Number of filters between paired Objects; a model's filter counts once per Object that is paired with
/// itself.
pub(super) fn filter_count(scene: &Scene) -> usize {
    let of_models = scene.pairs.iter().filter(|pair| pair.a == pair.b);
    let of_models = of_models.map(|pair| scene.models[scene.objects[pair.a].model].filters.len());
    of_models.sum::<usize>() + scene.filters.iter().filter(|filter| is_paired(scene, filter)).count()
}

/// Returns true if the Objects of a filter are paired.
pub(super) fn is_paired(scene: &Scene, filter: &GroupFilter) -> bool {
    scene.pairs.iter().any(|pair| [pair.a.min(pair.b), pair.a.max(pair.b)] == filter.objects)
}

/// One primitive of a movable group per value of `kind` and, with filters, per set of entries that contain
/// it.
pub(super) fn representatives<'m, K: Ord>(
    filters: Option<&Filters>,
    side: usize,
    body: &'m MovableGroup,
    kind: impl Fn(&PrimitiveInfo) -> K,
) -> impl Iterator<Item = &'m PrimitiveInfo> {
    let mut seen = BTreeSet::new();
    body.primitives.iter().filter(move |info| {
        let held = filters.map(|filters| filters.that_hold(side, &info.path));
        seen.insert((kind(info), held.unwrap_or_default()))
    })
}

/// Returns true if filters keep two primitives apart.
pub(super) fn apart(filters: Option<&Filters>, a: &PrimitiveInfo, b: &PrimitiveInfo) -> bool {
    filters.is_some_and(|filters| filters.keep_apart(&a.path, &b.path))
}

/// Primitives of `body` that filters do not keep apart from all primitives of `other`; all of them without
/// filters. `side` is the side of the filters, 0 or 1, that stands for `body`.
pub(super) fn primitives_that_meet<'a>(
    filters: Option<&Filters>,
    body: &'a MovableGroup,
    side: usize,
    other: &MovableGroup,
) -> Vec<&'a PrimitiveInfo> {
    let Some(filters) = filters else { return body.primitives.iter().collect() };
    let others: Vec<&PrimitiveInfo> = representatives(Some(filters), 1 - side, other, |_| ()).collect();
    let meets = |info: &&PrimitiveInfo| {
        others.iter().any(|other| match side {
            0 => !filters.keep_apart(&info.path, &other.path),
            _ => !filters.keep_apart(&other.path, &info.path),
        })
    };
    body.primitives.iter().filter(meets).collect()
}
