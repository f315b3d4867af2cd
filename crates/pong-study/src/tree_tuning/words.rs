//! Changes, group by group, in words.

use crate::runs::subject::{Grouping, Setting, Shape};
use pong_geometry::bounding::BoundKind;
use pong_model::grouping::Bound;

/// A line for every changed group; groups that change as one, and neighbours with the same change, share one.
pub(crate) fn changes(shape: &Shape, before: &Grouping, after: &Grouping) -> Vec<String> {
    let mut lines: Vec<(Vec<usize>, String)> = Vec::new();
    let mut told = vec![false; shape.groups.len()];
    for group in (0..shape.groups.len()).filter(|group| before[*group] != after[*group]) {
        let above = name_above(shape, group);
        let branch = branch(shape, group);
        let merged = |group: &usize| after[*group].bound == Bound::Above && before[*group] != after[*group];
        let what = if told[group] {
            continue;
        } else if branch.len() > 1 && branch.iter().all(merged) {
            branch.iter().for_each(|group| told[*group] = true);
            format!("with all below no volume of its own, what it holds counts to {above}")
        } else {
            change(&before[group], &after[group], &above)
        };
        match lines.last_mut() {
            Some((groups, words))
                if *words == what && shape.groups[groups[0]].above == shape.groups[group].above =>
            {
                groups.push(group);
            }
            _ => lines.push((vec![group], what)),
        }
    }
    lines.into_iter().map(|(groups, what)| format!("{}: {what}", names(shape, &groups))).collect()
}

/// A group and all groups below it in its body.
fn branch(shape: &Shape, group: usize) -> Vec<usize> {
    let below = shape.below(group).filter(|below| !shape.groups[*below].movable);
    std::iter::once(group).chain(below.flat_map(|below| branch(shape, below))).collect()
}

fn names(shape: &Shape, groups: &[usize]) -> String {
    let path = &shape.groups[groups[0]].path;
    if groups.len() == 1 {
        return path.clone();
    }
    let last = &shape.groups[groups[groups.len() - 1]].path;
    let last = last.rsplit_once('/').map_or(last.as_str(), |(_, name)| name);
    format!("{path} to {last}, {} groups", groups.len())
}

fn name_above(shape: &Shape, group: usize) -> String {
    shape.groups[group].above.map_or(String::new(), |above| shape.groups[above].path.clone())
}

fn change(before: &Setting, after: &Setting, above: &str) -> String {
    let mut parts = Vec::new();
    if before.bound != after.bound {
        let to = match &after.bound {
            Bound::Above => format!("no volume of its own, what it holds counts to {above}"),
            Bound::Around(kind) => volume(kind),
        };
        let from = match &before.bound {
            Bound::Above => "no volume of its own".to_owned(),
            Bound::Around(kind) => volume(kind),
        };
        parts.push(format!("{from} → {to}"));
    }
    if before.leaf_size != after.leaf_size {
        let size = |size: Option<usize>| match size {
            None => "leaves of any size".to_owned(),
            Some(size) => format!("leaves of at most {size} elements"),
        };
        parts.push(match before.leaf_size {
            None => size(after.leaf_size),
            before => format!("{} → {}", size(before), size(after.leaf_size)),
        });
    }
    parts.join("; ")
}

fn volume(kind: &BoundKind) -> String {
    match kind {
        BoundKind::Custom(name) => format!("Custom(\"{name}\")"),
        kind => kind.name().to_owned(),
    }
}
