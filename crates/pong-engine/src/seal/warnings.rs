//! Warnings and notes about a valid scene.

use super::filters::{apart, is_paired, representatives};
use super::leaf_filter::ObjectFilters;
use super::plans::{can_be_tested, kind_name};
use super::solids::solids_touch;
use crate::frame::narrow_phase::pair_table::has_tester;
use crate::scene::{GroupFilter, ObjectPair, Scene};
use pong_geometry::primitive::PrimitiveKind;
use pong_model::{Filters, MovableGroup, PrimitiveInfo};
use std::collections::{BTreeMap, BTreeSet};

/// Aspect of a scene that the author may not have intended.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SetupWarning {
    /// Primitives of two kinds without a tester meet in Objects of two models and are ignored.
    IgnoredPair {
        /// Names of the two models.
        models: [String; 2],
        /// Names of the two kinds.
        kinds: [String; 2],
        /// Pairs of Objects in which they meet.
        met: MetIn,
    },
    /// Paired Objects of two models in which nothing can touch.
    NothingToTest {
        /// Names of the two models.
        models: [String; 2],
        /// Pairs of Objects.
        met: MetIn,
        /// Each kind of the two models, with the built-in kinds that have a tester with it.
        testable: Vec<(String, Vec<String>)>,
    },
}

/// Reason why two built-in kinds, in alphabetical order, do not touch, with what to take instead (docs/theory.md, 2).
/// `None` for kinds of a host.
fn why_apart(kinds: [&str; 2]) -> Option<&'static str> {
    const THIN: [&str; 3] = ["LineSegment", "Point", "Ray"];
    const SURFACES: [&str; 3] = ["Plane", "Polyhedron", "Triangle"];
    let are = |of: [&str; 3]| kinds.iter().all(|kind| of.contains(kind));
    match kinds {
        ["Bore", "Bore"] => Some("both push inwards"),
        ["Bore", _] => Some(
            "a Bore holds Point, LineSegment, Ray, Sphere, Capsule and Cylinder; make the other of these, or both of them solids",
        ),
        ["LineSegment" | "Point", "Triangle"] => Some(
            "a triangle has no inside, so no depth can be defined; give the other a radius: Sphere or Capsule",
        ),
        ["Ellipsoid", "LineSegment"] | ["LineSegment", "Sphere"] => {
            Some("a LineSegment has no radius here; take a Capsule")
        }
        _ if are(THIN) => Some("neither has an inside; take a Sphere or a Capsule"),
        _ if are(SURFACES) => {
            Some("both are surfaces; declare them solids (`contact: Solid`), or give one points")
        }
        _ => None,
    }
}

impl std::fmt::Display for SetupWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::IgnoredPair { models: [a, b], kinds: [kind_a, kind_b], met } => {
                write!(
                    f,
                    "models `{a}` and `{b}`: {kind_a} and {kind_b} have no tester and ignore each other ({met})"
                )?;
                why_apart([kind_a, kind_b]).map_or(Ok(()), |why| write!(f, ": {why}"))
            }
            Self::NothingToTest { models: [a, b], met, testable } => {
                write!(
                    f,
                    "models `{a}` and `{b}` are paired but nothing of one can touch anything of the other ({met}): they pass \
                     through each other; give one of them what the other can touch"
                )?;
                testable.iter().try_for_each(|(kind, others)| match others.is_empty() {
                    true => write!(f, "; nothing built in touches {kind}"),
                    false => write!(f, "; {kind} can touch {}", others.join(", ")),
                })
            }
        }
    }
}

/// Pairs of Objects of the same two models; the first represents all.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct MetIn {
    /// Names of the two Objects of the first pair.
    pub objects: [String; 2],
    /// Number of further pairs.
    pub more: usize,
}

impl std::fmt::Display for MetIn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [a, b] = &self.objects;
        if a == b {
            write!(f, "`{a}` with itself")?;
        } else {
            write!(f, "`{a}` and `{b}`")?;
        }
        match self.more {
            0 => Ok(()),
            1 => write!(f, " and 1 more pair"),
            more => write!(f, " and {more} more pairs"),
        }
    }
}

/// Possible problem without proof that it will occur; no reason to change a scene that runs well.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SetupNote {
    /// Only one of two surfaces that can meet has friction, so there is none between them, and `pairs` has no
    /// entry for them.
    NoFriction {
        /// `model/surface` that has friction.
        rough: String,
        /// Its friction law.
        law: String,
        /// `model/surface` that has none.
        smooth: String,
    },
    /// Primitives of two models can meet in poses for which the contact model has a known limit.
    KnownLimit {
        /// Names of the two models.
        models: [String; 2],
        /// Names of the kinds on both sides, in the order of the models.
        kinds: Vec<[&'static str; 2]>,
        /// Effect, size and cure.
        limit: &'static str,
    },
    /// A filter between Objects that are not paired.
    IdleFilter {
        /// `object/group` of the two groups.
        groups: [String; 2],
    },
}

impl std::fmt::Display for SetupNote {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::NoFriction { rough, law, smooth } => write!(
                f,
                "surfaces `{rough}` and `{smooth}`: no friction between them, for `{smooth}` has none though `{rough}` has \
                 {law}; if that is not meant give `{smooth}` friction too, or the pair an entry in `pairs`"
            ),
            Self::KnownLimit { models: [a, b], kinds, limit } => {
                let kinds: Vec<String> = kinds.iter().map(|[a, b]| format!("{a} on {b}")).collect();
                write!(f, "models `{a}` and `{b}`, {}: {limit} (docs/theory.md, 6)", kinds.join(", "))
            }
            Self::IdleFilter { groups: [a, b] } => write!(
                f,
                "filter of `{a}` and `{b}`: their Objects are not paired, so nothing of them touches; pair them or remove the \
                 filter"
            ),
        }
    }
}

/// Filters between Objects that are not paired.
pub(super) fn idle_filters(scene: &Scene) -> Vec<SetupNote> {
    let idle = scene.filters.iter().filter(|filter| !is_paired(scene, filter));
    let name = |object: usize, group: &String| format!("{}/{group}", scene.objects[object].name);
    idle.map(|GroupFilter { objects: [a, b], groups }| SetupNote::IdleFilter {
        groups: [name(*a, &groups[0]), name(*b, &groups[1])],
    })
    .collect()
}

/// Two models in order, true if an Object is paired with itself, and the filters between the two Objects.
type PairedModels<'f> = ([usize; 2], bool, Option<&'f Filters>);

fn paired_models<'f>(
    scene: &Scene,
    pair: &ObjectPair,
    filters: &'f ObjectFilters,
) -> (PairedModels<'f>, [usize; 2]) {
    let model = |object: usize| scene.objects[object].model;
    let in_order = model(pair.a) <= model(pair.b);
    let objects = if in_order { [pair.a, pair.b] } else { [pair.b, pair.a] };
    ((objects.map(model), pair.a == pair.b, filters.between(objects[0], objects[1])), objects)
}

/// Warnings about a scene, once per pair of models however many Objects they have; and, by name, the pairs of
/// Objects in which nothing can touch.
pub(super) fn warnings(scene: &Scene, filters: &ObjectFilters) -> (Vec<SetupWarning>, Vec<[String; 2]>) {
    let mut paired: BTreeMap<PairedModels<'_>, MetIn> = BTreeMap::new();
    for pair in &scene.pairs {
        let (key, [one, other]) = paired_models(scene, pair, filters);
        let objects = || [one, other].map(|object| scene.objects[object].name.clone());
        paired
            .entry(key)
            .and_modify(|met| met.more += 1)
            .or_insert_with(|| MetIn { objects: objects(), more: 0 });
    }
    let (mut found, mut untouchable) = (BTreeSet::new(), BTreeSet::new());
    for ((places @ [first, second], itself, apart), met) in paired {
        let models = [first, second].map(|model| scene.models[model].name.clone());
        let (ignored, anything) = kinds_that_meet(scene, places, itself, apart);
        for kinds in ignored {
            found.insert(SetupWarning::IgnoredPair { models: models.clone(), kinds, met: met.clone() });
        }
        if !anything {
            let testable = testable(scene, places);
            found.insert(SetupWarning::NothingToTest { models, met, testable });
            untouchable.insert((places, itself, apart));
        }
    }
    let is_untouchable = |pair: &&ObjectPair| untouchable.contains(&paired_models(scene, pair, filters).0);
    let names = |pair: &ObjectPair| [pair.a, pair.b].map(|object| scene.objects[object].name.clone());
    (found.into_iter().collect(), scene.pairs.iter().filter(is_untouchable).map(names).collect())
}

/// Every kind of two models, with the built-in kinds that it has a tester with.
fn testable(scene: &Scene, models: [usize; 2]) -> Vec<(String, Vec<String>)> {
    let bodies = models.iter().flat_map(|model| &scene.models[*model].bodies);
    let kinds: BTreeMap<&str, PrimitiveKind> = bodies
        .flat_map(|body| body.primitives.iter().map(|info| (kind_name(body, info), info.kind)))
        .collect();
    let partners = |kind: PrimitiveKind| -> Vec<String> {
        let others = PrimitiveKind::ALL.into_iter();
        others
            .filter(|other| has_tester(kind, *other) || has_tester(*other, kind))
            .map(|k| k.name().to_owned())
            .collect()
    };
    kinds.into_iter().map(|(name, kind)| (name.to_owned(), partners(kind))).collect()
}

/// Pairs of kinds without a tester that meet in the movable groups of two models, and true if at least one
/// pair that meets has a tester.
fn kinds_that_meet<'m>(
    scene: &'m Scene,
    models: [usize; 2],
    itself: bool,
    filters: Option<&Filters>,
) -> (BTreeSet<[String; 2]>, bool) {
    // One primitive of each kind, and with filters one per kind and set of filter entries.
    let groups = |side: usize| {
        let bodies = scene.models[models[side]].bodies.iter();
        let kinds = |body: &'m MovableGroup| {
            let kind = |info: &PrimitiveInfo| (kind_name(body, info).to_owned(), body.is_solid(info));
            (body, representatives(filters, side, body, kind).collect::<Vec<_>>())
        };
        bodies.map(kinds).collect::<Vec<_>>()
    };
    let (first, second) = (groups(0), groups(1));
    let (mut ignored, mut anything) = (BTreeSet::new(), false);
    for (index, (body_a, kinds_a)) in first.iter().enumerate() {
        // A movable group never meets itself.
        for (body_b, kinds_b) in second.iter().skip(if itself { index + 1 } else { 0 }) {
            for &a in kinds_a {
                for &b in kinds_b.iter().filter(|b| !apart(filters, a, b)) {
                    let (a, b) = ((*body_a, a), (*body_b, b));
                    let tested =
                        can_be_tested(&scene.extensions, a, b) || can_be_tested(&scene.extensions, b, a);
                    if tested || solids_touch(a, b) || solids_touch(b, a) {
                        anything = true;
                    } else {
                        let mut kinds = [a, b].map(|(body, info)| kind_name(body, info).to_owned());
                        kinds.sort();
                        ignored.insert(kinds);
                    }
                }
            }
        }
    }
    (ignored, anything)
}
