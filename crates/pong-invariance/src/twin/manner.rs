//! Twins that are the same scene, played in another way.

use super::Twin;
use super::playing::Manner;
use crate::random::Random;
use crate::scene::Scene;

/// Evaluations between that are thrown away.
pub fn thrown_away(scene: &Scene, random: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::ThrownAway(random.bits())))
}

/// Saved and restored on the way.
pub fn restored(scene: &Scene, _: &mut Random) -> Option<Twin> {
    (scene.frames.len() > 1).then(|| Twin::played(scene, Manner::Restored))
}

/// Played again after all was forgotten.
pub fn forgotten(scene: &Scene, _: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::Forgotten))
}

/// With workers.
pub fn workers(scene: &Scene, random: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::Workers(1 + random.below(3))))
}
