//! Common Objects of two sealed scenes, and the check that contacts of the first can continue in the second.

use super::{GroupInstance, Scene};
use crate::error::EngineError;
use crate::seal::Sealed;
use std::collections::BTreeMap;

/// A sealed scene.
type SealedScene<'a> = (&'a Scene, &'a Sealed);

/// Common Objects of two scenes, matched by name, with their movable groups and pairs. All lists except
/// `group_pairs` are indexed by the second scene and hold indices of the first scene.
pub(crate) struct Shared {
    pub objects: Vec<Option<usize>>,
    pub bodies: Vec<Option<usize>>,
    pub pairs: Vec<Option<usize>>,
    /// For each pair of movable groups of the first scene, its index in the second; increasing.
    pub group_pairs: Vec<Option<u32>>,
}

impl Shared {
    /// Matches the Objects, movable groups and pairs of the scene `into` with those of the scene `from`.
    ///
    /// # Errors
    /// [`EngineError::BadValue`] with thing, cause and cure if contacts of common Objects would not continue
    /// unchanged.
    pub fn of(from: SealedScene<'_>, into: SealedScene<'_>) -> Result<Self, EngineError> {
        require_same_settings(from.0, into.0)?;
        let objects = shared_objects(from.0, into.0)?;
        let bodies = shared_bodies(from.0, into.0, &objects);
        let pairs = shared_pairs(from, into, &objects)?;
        let group_pairs = shared_group_pairs(from.1, into.1, &bodies, &pairs);
        Ok(Self { objects, bodies, pairs, group_pairs })
    }
}

/// Returns the error that the object or setting `thing` prevents a continuation from another world.
pub(crate) fn refused<T>(thing: &str, cause: String) -> Result<T, EngineError> {
    Err(EngineError::BadValue { what: format!("continue from another world: {thing}"), cause })
}

fn require_same_settings(from: &Scene, into: &Scene) -> Result<(), EngineError> {
    let kept = |scene: &Scene| (scene.config.ledger, scene.config.accounts);
    if kept(from) != kept(into) {
        let cause = "one world keeps other energies than the other; create both with the same `ledger`, `accounts` and coupling";
        return refused("settings", cause.to_owned());
    }
    match into.laws.first_of_other_state(&from.laws) {
        None => Ok(()),
        Some(name) => refused(
            &format!("law `{name}`"),
            "it remembers another count of numbers of a contact than in the other world; register the same law".to_owned(),
        ),
    }
}

/// For each Object of the second scene, the index of the Object of the same name in the first scene.
fn shared_objects(from: &Scene, into: &Scene) -> Result<Vec<Option<usize>>, EngineError> {
    let names = from.objects.iter().enumerate().map(|(index, object)| (object.name.as_str(), index));
    let by_name: BTreeMap<&str, usize> = names.collect();
    let objects: Vec<Option<usize>> =
        into.objects.iter().map(|object| by_name.get(object.name.as_str()).copied()).collect();
    for (object, earlier) in into.objects.iter().zip(&objects).filter_map(|(o, e)| Some((o, (*e)?))) {
        let (model, other) = (&into.models[object.model], &from.models[from.objects[earlier].model]);
        let same_paths =
            model.bodies.iter().map(|body| &body.path).eq(other.bodies.iter().map(|body| &body.path));
        if model.hash != other.hash || !same_paths {
            let cause = "it has other geometry, surfaces or movable groups than the one of this name in the other world; \
                         create it from the same model, or, if it is another thing, under another name";
            return refused(&format!("object `{}`", object.name), cause.to_owned());
        }
    }
    let order: Vec<usize> = objects.iter().flatten().copied().collect();
    if let Some(turned) = order.windows(2).find(|two| two[0] > two[1]) {
        let [first, second] = [turned[0], turned[1]].map(|index| &from.objects[index].name);
        // Sums follow the order of Objects, and their rounding depends on it.
        let cause = format!(
            "they were created in the other order in the other world; create `{second}` before `{first}`, and new Objects \
             anywhere between"
        );
        return refused(&format!("objects `{first}` and `{second}`"), cause);
    }
    Ok(objects)
}

fn shared_bodies(from: &Scene, into: &Scene, objects: &[Option<usize>]) -> Vec<Option<usize>> {
    let earlier =
        |body: &GroupInstance| objects[body.object].map(|object| from.objects[object].first_body + body.body);
    into.bodies.iter().map(earlier).collect()
}

/// For each pair of Objects of the second scene, the index of the same pair in the first scene. Returns an
/// error if a pair of common Objects is missing, or differs in order or filters.
fn shared_pairs(
    (from, sealed_from): SealedScene<'_>,
    (into, sealed_into): SealedScene<'_>,
    objects: &[Option<usize>],
) -> Result<Vec<Option<usize>>, EngineError> {
    let numbered = from.pairs.iter().enumerate().map(|(index, pair)| ((pair.a, pair.b), index));
    let by_objects: BTreeMap<(usize, usize), usize> = numbered.collect();
    let mut is_there = vec![false; from.pairs.len()];
    let named = |[a, b]: [usize; 2]| format!("pair (`{}`, `{}`)", from.objects[a].name, from.objects[b].name);
    let mut pairs = Vec::with_capacity(into.pairs.len());
    for pair in &into.pairs {
        let (Some(a), Some(b)) = (objects[pair.a], objects[pair.b]) else {
            pairs.push(None);
            continue;
        };
        let earlier = by_objects.get(&(a, b)).copied();
        if earlier.is_none() && by_objects.contains_key(&(b, a)) {
            let cause = "its Objects are named in the other order in the other world, and that decides which is A; pair them \
                         in the same order";
            return refused(&named([a, b]), cause.to_owned());
        }
        if let Some(index) = earlier {
            is_there[index] = true;
            if sealed_from.filters.between(a, b) != sealed_into.filters.between(pair.a, pair.b) {
                let cause =
                    "other groups are kept apart by filters than in the other world; give the same filters";
                return refused(&named([a, b]), cause.to_owned());
            }
        }
        pairs.push(earlier);
    }
    let mut has_counterpart = vec![false; from.objects.len()];
    objects.iter().flatten().for_each(|&object| has_counterpart[object] = true);
    let missing = from
        .pairs
        .iter()
        .zip(is_there)
        .find(|(pair, is_there)| !is_there && has_counterpart[pair.a] && has_counterpart[pair.b]);
    match missing {
        None => Ok(pairs),
        Some((pair, _)) => refused(
            &named([pair.a, pair.b]),
            "both Objects are here, but not their pair; pair them, and switch the pair off if they are to pass through each \
             other"
                .to_owned(),
        ),
    }
}

fn shared_group_pairs(
    from: &Sealed,
    into: &Sealed,
    bodies: &[Option<usize>],
    pairs: &[Option<usize>],
) -> Vec<Option<u32>> {
    let mut found = vec![None; from.group_pairs.len()];
    for (index, pair) in into.group_pairs.iter().enumerate() {
        if pairs[pair.pair].is_none() {
            continue;
        }
        let Some((first, second)) = bodies[pair.first].zip(bodies[pair.second]) else { continue };
        if let Some(earlier) = from.group_pair_of(first, second) {
            found[earlier] = Some(index as u32);
        }
    }
    found
}
