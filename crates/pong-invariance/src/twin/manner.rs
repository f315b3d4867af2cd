//! Twins with the same scene, played differently.

use super::Twin;
use super::playing::Manner;
use crate::random::Random;
use crate::scene::Scene;

/// Discards additional evaluations between the frames.
pub fn thrown_away(scene: &Scene, random: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::ThrownAway(random.bits())))
}

/// Saves and restores the contact state half-way.
pub fn restored(scene: &Scene, _: &mut Random) -> Option<Twin> {
    (scene.frames.len() > 1).then(|| Twin::played(scene, Manner::Restored))
}

/// Plays again after the contact state is cleared.
pub fn forgotten(scene: &Scene, _: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::Forgotten))
}

/// Plays with workers.
pub fn workers(scene: &Scene, random: &mut Random) -> Option<Twin> {
    Some(Twin::played(scene, Manner::Workers(1 + random.below(3))))
}
