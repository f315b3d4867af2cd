//! Springs and dampers of bristles, including defaults, and undamped bristles.

use super::named::Named;
use crate::text::number;
use pong_engine::{FrictionProps, Laws, combine_surfaces};
use pong_model::{
    FrictionLaw, Model, MovableGroup, NormalLaw, PairOverride, Surface, pair_entries, printable,
};
use std::collections::BTreeSet;

/// k_t and c_t of a surface; empty for a rigid one, whose bristle does not yield.
pub(super) fn springs(surface: &Surface) -> String {
    let Some((k_t, c_t)) = surface.bristle().filter(|(k_t, _)| k_t.is_finite()) else { return String::new() };
    let left_out = matches!(surface.friction, FrictionLaw::Bristle { damping: None, .. });
    let origin = if left_out && c_t > 0.0 { " from the normal law" } else { "" };
    format!(", k_t {} N/m, c_t {} N·s/m{origin}", number(k_t), number(c_t))
}

/// A note for each surface and each entry of `pairs` whose bristle is undamped.
pub(super) fn notes(model: &Model) -> Vec<String> {
    let of_surfaces = model.surfaces.iter().filter_map(|surface| {
        let undamped = surface.bristle().is_some_and(|(k_t, c_t)| k_t.is_finite() && c_t == 0.0);
        let named = format!("surface `{}`", surface.name);
        undamped.then(|| note(&named, &surface.friction, &surface.normal)).flatten()
    });
    let of_pairs = model.pair_overrides.iter().filter_map(|entry| match &entry.friction {
        Some(friction @ FrictionLaw::Bristle { damping: Some(0.0), .. }) => {
            note(&pair(&entry.surfaces), friction, &NormalLaw::Inherited)
        }
        _ => None,
    });
    of_surfaces.chain(of_pairs).collect()
}

/// Springs of the bristles for which an entry of `pairs` gives no damping, for two models that meet; a note
/// if they are undamped.
pub(super) fn of_pairs((a, b): (&Named, &Named), group_pairs: &[(&MovableGroup, &MovableGroup)]) -> String {
    let mut meeting: BTreeSet<(u32, u32)> = BTreeSet::new();
    for (body_a, body_b) in group_pairs {
        let (all_a, all_b) = (surfaces(body_a), surfaces(body_b));
        meeting.extend(all_a.iter().flat_map(|one| all_b.iter().map(|other| (*one, *other))));
    }
    let mut lines = BTreeSet::new();
    for (index_a, index_b) in meeting {
        let (surface_a, surface_b) =
            (&a.model.surfaces[index_a as usize], &b.model.surfaces[index_b as usize]);
        let entries = pair_entries((&a.model, surface_a), (&b.model, surface_b));
        if let Some((_, entry)) = entries.first() {
            lines.extend(of_entry(entry, surface_a, surface_b));
        }
    }
    lines.into_iter().collect()
}

fn of_entry(entry: &PairOverride, a: &Surface, b: &Surface) -> Option<String> {
    let friction @ FrictionLaw::Bristle { damping: None, .. } = entry.friction.as_ref()? else { return None };
    let props = combine_surfaces(a, b, Some(entry), &Laws::default()).ok()?;
    let FrictionProps::Bristle { stiffness, damping, .. } = props.friction else { return None };
    let named = pair(&[a.name.clone(), b.name.clone()]);
    let springs = format!("bristle of {named}: k_t {} N/m, c_t {} N·s/m", number(stiffness), number(damping));
    let normal = entry.normal.as_ref().unwrap_or(&a.normal);
    let note = if damping == 0.0 { note(&named, friction, normal) } else { None };
    let note = note.map_or(String::new(), |note| format!("  note: {}\n", printable(&note)));
    Some(format!("  {}\n{note}", printable(&springs)))
}

fn surfaces(body: &MovableGroup) -> BTreeSet<u32> {
    body.primitives.iter().map(|info| info.surface).collect()
}

fn pair([a, b]: &[String; 2]) -> String {
    format!("the pair `{a}` and `{b}`")
}

/// Cause, effect and cure of an undamped bristle; `None` if it holds nothing.
fn note(named: &str, friction: &FrictionLaw, normal: &NormalLaw) -> Option<String> {
    let FrictionLaw::Bristle { mu, damping, .. } = friction else { return None };
    if *mu == 0.0 {
        return None;
    }
    let effect = "it throws back along the surface what it has stored";
    if damping.is_some() {
        return Some(format!("the bristle of {named} is undamped, as `damping: 0` says: {effect}"));
    }
    let cause = match normal {
        NormalLaw::Linear { .. } => "the normal law has no damping, and no mass is named",
        _ => "no mass is named",
    };
    let cure = "write Bristle(mu: …, mass: …), or `damping: …`, with 0 if this is meant";
    Some(format!("the bristle of {named} is undamped, because {cause}: {effect}; {cure}"))
}
