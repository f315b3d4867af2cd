//! Fixed bodies of several objects whose flat faces lie in one plane: a body that touches two of them is
//! pushed by both.

use super::setting::Setting;
use crate::body::{Motion, RigidBody};
use pong_model::flush::{PlacedGroup, flush_pairs};
use std::collections::BTreeMap;

/// Warnings, one for each two flush objects that a third may touch.
pub(super) fn warnings(setting: &Setting<'_>, bodies: &[RigidBody]) -> Vec<String> {
    let (mut placed, mut object_of) = (Vec::new(), Vec::new());
    for (index, (object, model)) in setting.objects.iter().zip(&setting.models).enumerate() {
        let (Some(object), Some(model)) = (object, model) else { continue };
        let interfaces = setting.world.scene().interfaces(*object).unwrap_or_default();
        for (group, interface) in model.bodies.iter().zip(interfaces) {
            let body = bodies.iter().find(|body| body.interface == Some(interface));
            if let Some(body) = body.filter(|body| matches!(body.motion, Motion::Fixed)) {
                placed.push(PlacedGroup { group, pose: body.pose });
                object_of.push(index);
            }
        }
    }
    if placed.len() < 2 {
        return Vec::new();
    }
    // One pair of primitives is enough for two objects, an overlap before a seam.
    let mut found = BTreeMap::new();
    for pair in flush_pairs(&placed) {
        let [one, other] = pair.primitives.map(|(group, _)| object_of[group]);
        if one != other && have_a_common_partner(setting, one, other) {
            let paths =
                pair.primitives.map(|(group, primitive)| &placed[group].group.primitives[primitive].path);
            let told = found.entry((one, other)).or_insert((pair.overlap, paths));
            if pair.overlap && !told.0 {
                *told = (true, paths);
            }
        }
    }
    let name = |index: usize| &setting.document.objects[index].name;
    let line = |((one, other), (overlap, [path, path_of_other])): ((usize, usize), (bool, [&String; 2]))| {
        let what = match overlap {
            true => {
                "lie in one plane and overlap: what touches both there is pushed twice; make them one model with `pong join`, or leave one of them out of `pairs`"
            }
            false => {
                "are flush: what rolls or slides over their seam is pushed by both, up to twice, and hops; make them one model with `pong join`"
            }
        };
        format!("objects `{}` and `{}`: `{path}` and `{path_of_other}` {what}", name(one), name(other))
    };
    found.into_iter().map(line).collect()
}

/// True if some object is paired with both.
fn have_a_common_partner(setting: &Setting<'_>, one: usize, other: usize) -> bool {
    let pairs = setting.document.pairs();
    let partners = |index: usize| {
        let name = &setting.document.objects[index].name;
        pairs.iter().filter_map(move |(a, b)| if a == name { Some(b) } else { (b == name).then_some(a) })
    };
    partners(one).any(|partner| partners(other).any(|third| third == partner))
}
