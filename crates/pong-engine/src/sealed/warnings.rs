//! What sealing tells the author though the scene is valid.

use super::{GroupPair, can_be_tested, kind_name};
use crate::scene::Scene;
use pong_model::Body;
use std::collections::BTreeSet;

/// Something the author may not have intended.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SetupWarning {
    /// Primitives of two kinds without a tester meet in a pair of Objects and are ignored.
    IgnoredPair {
        /// Names of the two Objects.
        objects: [String; 2],
        /// Names of the two kinds.
        kinds: [String; 2],
    },
    /// A pair of Objects in which nothing can touch.
    NothingToTest {
        /// Names of the two Objects.
        objects: [String; 2],
    },
    /// A contact gains energy at the planned step ([`World::plan_step`](crate::World::plan_step)).
    StepTooLong {
        /// The movable groups, the contact and the longest stable step.
        told: String,
    },
    /// A bounce is not followed as exactly as was asked.
    StepTooCoarse {
        /// The movable groups, the error and the longest step without it.
        told: String,
    },
    /// Something that the planned step could not be held against.
    StepNotJudged {
        /// What and why.
        told: String,
    },
}

impl std::fmt::Display for SetupWarning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::IgnoredPair { objects: [a, b], kinds: [kind_a, kind_b] } => {
                write!(f, "`{a}` and `{b}`: {kind_a} and {kind_b} have no tester and ignore each other")
            }
            Self::NothingToTest { objects: [a, b] } => {
                write!(f, "`{a}` and `{b}` are paired but nothing of one can touch anything of the other")
            }
            Self::StepTooLong { told } | Self::StepTooCoarse { told } => f.write_str(told),
            Self::StepNotJudged { told } => write!(f, "step not judged: {told}"),
        }
    }
}

/// What may go wrong, and nothing proves that it will: no reason to change a scene that runs well.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum SetupNote {
    /// If all contacts that can act on one movable group act at once, the planned step may gain energy; one contact
    /// alone does not ([`SetupWarning::StepTooLong`]).
    StepMayBeTooLong {
        /// The movable group, how many contacts, and the longest step that is surely stable.
        told: String,
    },
}

impl std::fmt::Display for SetupNote {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::StepMayBeTooLong { told } => f.write_str(told),
        }
    }
}

/// Everything about a scene that its author may not have intended.
pub(super) fn warnings(scene: &Scene, group_pairs: &[GroupPair]) -> Vec<SetupWarning> {
    let mut found = BTreeSet::new();
    for (index, pair) in scene.pairs.iter().enumerate() {
        let objects = [pair.a, pair.b].map(|object| scene.objects[object].name.clone());
        let mut anything = false;
        for groups in group_pairs.iter().filter(|groups| groups.pair == index) {
            let (first, second) = (scene.body(groups.first), scene.body(groups.second));
            let kinds = |body: &Body| -> BTreeSet<(String, usize)> {
                let mut by_name: std::collections::BTreeMap<String, usize> = Default::default();
                for (i, info) in body.primitives.iter().enumerate() {
                    by_name.entry(kind_name(body, info).to_owned()).or_insert(i);
                }
                by_name.into_iter().collect()
            };
            for (name_a, a) in kinds(first) {
                for (name_b, b) in kinds(second) {
                    let a = (first, &first.primitives[a]);
                    let b = (second, &second.primitives[b]);
                    if can_be_tested(&scene.extensions, a, b) || can_be_tested(&scene.extensions, b, a) {
                        anything = true;
                    } else {
                        let mut kinds = [name_a.clone(), name_b.clone()];
                        kinds.sort();
                        found.insert(SetupWarning::IgnoredPair { objects: objects.clone(), kinds });
                    }
                }
            }
        }
        if !anything {
            found.insert(SetupWarning::NothingToTest { objects });
        }
    }
    found.into_iter().collect()
}
