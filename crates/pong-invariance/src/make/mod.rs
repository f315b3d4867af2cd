//! Random scenes of every tester: the touched body, the touching body, and a history with contact points on
//! faces, seams, internal faces, edges, corners and junctions of pieces, as well as anywhere.

mod assembly;
pub mod belts;
pub mod meshes;
pub mod path;
pub mod round;
mod round_path;
pub mod solids;
pub mod touched;
mod toucher;
pub mod volumes;

use crate::random::Random;
use crate::scene::Scene;
pub use assembly::rescaled;
use assembly::{family, of_solids};

/// A scene of any family.
pub fn scene(random: &mut Random) -> Scene {
    let (name, make) = touched::FAMILIES[random.below(touched::FAMILIES.len())];
    family(random, name, make, None)
}

/// A scene of the family of this name.
pub fn scene_of(random: &mut Random, name: &str) -> Option<Scene> {
    if let Some((name, make, kinds)) = round::FAMILIES.iter().find(|(known, ..)| *known == name) {
        return Some(family(random, name, *make, Some(kinds)));
    }
    if let Some((name, b, a)) = volumes::FAMILIES.iter().find(|(known, ..)| *known == name) {
        return Some(of_solids(random, name, *b, *a));
    }
    if let Some((name, make)) = belts::FAMILIES.iter().find(|(known, _)| *known == name) {
        return Some(make(random, name));
    }
    let (name, make) = touched::FAMILIES.iter().find(|(known, _)| *known == name)?;
    Some(family(random, name, *make, None))
}

/// Names of all families.
pub fn families() -> impl Iterator<Item = &'static str> {
    let of_round_parts = round::FAMILIES.iter().map(|(name, ..)| *name);
    let of_solids = volumes::FAMILIES.iter().map(|(name, ..)| *name);
    let of_surfaces = belts::FAMILIES.iter().map(|(name, _)| *name);
    touched::FAMILIES.iter().map(|(name, _)| *name).chain(of_round_parts).chain(of_solids).chain(of_surfaces)
}
