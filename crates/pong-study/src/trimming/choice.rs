//! Choice of the primitives to remove from a model.

use pong_model::{Model, MovableGroup, PrimitiveInfo};
use std::collections::BTreeSet;

/// A removed primitive.
#[derive(Clone, Debug, PartialEq)]
pub struct Gone {
    /// Its path in the model.
    pub path: String,
    /// Least distance from any partner, m; infinite if nothing was paired with it.
    pub nearest: f64,
}

/// The primitives of a model that never came nearer than the margin. A movable group that would be left empty
/// keeps the one that came nearest.
pub(crate) fn gone(model: &Model, least: &[Vec<f64>], margin: f64) -> Vec<Gone> {
    let mut gone = Vec::new();
    for (index, body) in model.bodies.iter().enumerate() {
        let least = least.get(index).map_or(&[][..], Vec::as_slice);
        let nearest = |primitive: usize| least.get(primitive).copied().unwrap_or(f64::INFINITY);
        let mut stays: Vec<bool> = (0..body.primitives.len()).map(|p| nearest(p) <= margin).collect();
        let holds_groups = model.bodies.iter().any(|other| other.parent == Some(index as u32));
        if !stays.contains(&true) && !holds_groups {
            let best = (0..stays.len()).min_by(|a, b| nearest(*a).total_cmp(&nearest(*b)));
            best.into_iter().for_each(|best| stays[best] = true);
        }
        keep_shells(body, &mut stays);
        for (primitive, info) in
            body.primitives.iter().enumerate().filter(|(primitive, _)| !stays[*primitive])
        {
            gone.push(Gone { path: info.path.clone(), nearest: nearest(primitive) });
        }
    }
    gone
}

/// Keeps the pieces of one solid together, because they have no faces where they join.
fn keep_shells(body: &MovableGroup, stays: &mut [bool]) {
    let shells: Vec<BTreeSet<u32>> = body.primitives.iter().map(|info| shells(body, info)).collect();
    loop {
        let kept: BTreeSet<u32> = shells
            .iter()
            .zip(&*stays)
            .filter(|(_, stays)| **stays)
            .flat_map(|(shells, _)| shells)
            .copied()
            .collect();
        let joined = |primitive: &usize| !shells[*primitive].is_disjoint(&kept);
        let more: Vec<usize> =
            (0..stays.len()).filter(|primitive| !stays[*primitive]).filter(joined).collect();
        if more.is_empty() {
            return;
        }
        more.into_iter().for_each(|primitive| stays[primitive] = true);
    }
}

fn shells(body: &MovableGroup, info: &PrimitiveInfo) -> BTreeSet<u32> {
    use pong_geometry::primitive::PrimitiveKind;
    if info.kind != PrimitiveKind::Triangle {
        return BTreeSet::from([info.shell]);
    }
    info.elements.clone().map(|element| body.triangles.triangles[element as usize].shell).collect()
}
