//! The list of all invariances, each a claim with its check.

use crate::base::Base;
use crate::judge::{Verdict, compare};
use crate::make;
use crate::properties::{friction, memory, potential, sides, tangent};
use crate::random::Random;
use crate::scene::Scene;
use crate::twin::{Twin, manner, place, shape};

/// One claim about any scene.
#[derive(Clone, Copy)]
pub struct Invariance {
    /// Short name, for `--only`.
    pub name: &'static str,
    /// The claim in words.
    pub says: &'static str,
    /// One scene in this many is checked.
    pub every: u64,
    /// Generator of scenes for this invariance; `None` for the scenes of all testers.
    pub make: Option<fn(&mut Random) -> Scene>,
    /// True if the answers must agree bit for bit.
    pub is_bits: bool,
    /// True if the claim holds for any scene, so that a failing scene may be reduced. Claims about special
    /// scenes (a ball led without slip) are reported with the scene as generated.
    pub is_general: bool,
    /// The check itself.
    pub check: Check,
}

/// Method of a check.
#[derive(Clone, Copy)]
pub enum Check {
    /// Comparison with a twin.
    Twin(fn(&Scene, &mut Random) -> Option<Twin>),
    /// Comparison with a twin that depends on the contacts of the base scene.
    AimedTwin(fn(&Base, &mut Random) -> Option<Twin>),
    /// A property of one scene.
    Property(fn(&mut Base, &mut Random) -> Verdict),
}

impl Invariance {
    /// Checks the claim on a scene.
    pub fn judge(&self, base: &mut Base, random: &mut Random) -> Verdict {
        let twin = match self.check {
            Check::Twin(make) => make(&base.scene, random),
            Check::AimedTwin(make) => make(base, random),
            Check::Property(check) => return check(base, random),
        };
        match twin {
            Some(twin) => compare(base, &twin, self.is_bits, random),
            None => Verdict::DoesNotApply,
        }
    }
}

/// A claim that is checked on every scene, to tolerance.
const fn claim(name: &'static str, says: &'static str, check: Check) -> Invariance {
    Invariance { name, says, every: 1, make: None, is_bits: false, is_general: true, check }
}

const fn twin(
    name: &'static str,
    says: &'static str,
    make: fn(&Scene, &mut Random) -> Option<Twin>,
) -> Invariance {
    claim(name, says, Check::Twin(make))
}

const fn bits(
    name: &'static str,
    says: &'static str,
    every: u64,
    make: fn(&Scene, &mut Random) -> Option<Twin>,
) -> Invariance {
    Invariance { every, is_bits: true, ..twin(name, says, make) }
}

const fn property(
    name: &'static str,
    says: &'static str,
    every: u64,
    make: Option<fn(&mut Random) -> Scene>,
    check: fn(&mut Base, &mut Random) -> Verdict,
) -> Invariance {
    Invariance { every, make, ..claim(name, says, Check::Property(check)) }
}

/// All invariances.
pub const INVARIANCES: &[Invariance] = &[
    twin("turned", "the whole scene turned", place::turned),
    twin("moved", "the whole scene moved by a few sizes, drifting", place::moved),
    twin("far", "the whole scene turned, 6.8e6 or 1e8 m away, drifting at 7.7 km/s", place::far),
    twin("group_frame", "other axes and origins of the groups", place::group_frame),
    twin("scaled", "lengths times 1e-6 to 1e6", place::scaled),
    claim(
        "cut",
        "faces, plates and solids cut into more triangles and pieces, half of them under the foot",
        Check::AimedTwin(shape::cut),
    ),
    claim(
        "declared",
        "solids cut into flush pieces that are declared one surface",
        Check::AimedTwin(shape::declared),
    ),
    twin("driven", "a plane moved along itself instead of its surface", place::driven),
    twin("reordered", "primitives, triangles, faces and corners in another order, renamed", shape::reordered),
    twin("own_axis", "round parts turned about their own axis", place::own_axis),
    twin("exchanged", "the Objects of a pair of solids swapped, without bristles", shape::exchanged),
    bits("swapped", "the Objects of a pair of different kinds swapped", 2, shape::swapped),
    bits("regrouped", "primitives hung into groups of groups", 4, shape::regrouped),
    bits("bounded", "other kinds of bounding volumes, other leaves", 2, shape::bounded),
    bits("negated", "quaternions negated", 4, place::negated),
    bits("thrown_away", "evaluations between, thrown away", 2, manner::thrown_away),
    bits("restored", "contact state saved, and restored into another world", 4, manner::restored),
    bits("forgotten", "played again after all was forgotten", 4, manner::forgotten),
    bits("workers", "one to three workers", 50, manner::workers),
    property(
        "committed_again",
        "the states of a commit, evaluated again, give the same wrench to 1e-12",
        1,
        None,
        friction::committed_again,
    ),
    property(
        "tangent",
        "derivatives of the wrenches are those of central differences, to 1e-6",
        16,
        None,
        tangent::of_differences,
    ),
    property(
        "potential",
        "wrenches of an incremental potential are the slope of its energy, to 1e-6",
        16,
        None,
        potential::of_differences,
    ),
    property(
        "beside",
        "states 1e-12 of the size away give a wrench as near, friction included",
        1,
        Some(friction::sliding),
        friction::beside,
    ),
    Invariance {
        is_general: false,
        ..property(
            "rolling",
            "rolling with spin about the normal asks for no friction: to second order in the step",
            8,
            Some(friction::rolling),
            friction::refined,
        )
    },
    property(
        "set_down",
        "a body set down outside is pushed as one that came from outside",
        2,
        Some(sides::set_down_scene),
        sides::set_down,
    ),
    property(
        "depth_steps",
        "the depth of a point in a solid never grows by more than the point moves",
        2,
        Some(memory::path_in_a_hull),
        memory::depth_steps,
    ),
];

/// The invariance of this name.
pub fn find(name: &str) -> Option<&'static Invariance> {
    INVARIANCES.iter().find(|invariance| invariance.name == name)
}

/// The scene of an index, of one family if named. It is the same for all invariances without a generator of
/// their own.
pub fn scene(invariance: &Invariance, family: Option<&str>, seed: u64, index: u64) -> Scene {
    let mut shared = Random::new(seed, 0, index);
    match (invariance.make, family) {
        (Some(make), _) => make(&mut Random::new(seed, stream(invariance), index)),
        (None, Some(family)) => {
            make::scene_of(&mut shared, family).unwrap_or_else(|| make::scene(&mut shared))
        }
        (None, None) => make::scene(&mut shared),
    }
}

/// Random numbers for the twin of a scene.
pub fn numbers(invariance: &Invariance, seed: u64, index: u64) -> Random {
    Random::new(seed, 1000 + stream(invariance), index)
}

/// Random stream derived from the name, so that it stays when the list grows.
fn stream(invariance: &Invariance) -> u64 {
    invariance.name.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(131).wrapping_add(u64::from(byte))) >> 8
        | 1
}
