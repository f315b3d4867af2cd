//! Table of groups that never touch each other.

use super::reader::Reader;
use super::suggest;
use crate::draft::BodyDraft;
use crate::filters::resolved;
use crate::ron_tree::{Node, Value};

/// Reads the `filters` table: full paths of the groups.
pub(super) fn filters(reader: &mut Reader<'_>, node: &Node, bodies: &[BodyDraft]) -> Vec<[String; 2]> {
    let Some(items) = reader.list(node, "filters") else { return Vec::new() };
    let groups = group_paths(bodies);
    let mut filters: Vec<[String; 2]> = Vec::new();
    for (index, item) in items.iter().enumerate() {
        let path = format!("filters[{index}]");
        let Some(pair) = filter(reader, item, &path, &groups) else { continue };
        if filters.iter().any(|other| *other == pair || [&other[1], &other[0]] == [&pair[0], &pair[1]]) {
            let cause = format!("the groups \"{}\" and \"{}\" are listed twice", pair[0], pair[1]);
            reader.fault(item.at, &path, "repeated-filter", cause, "keep one entry");
        }
        if !can_meet(bodies, &pair) {
            let cause =
                format!("\"{}\" and \"{}\" are parts of one rigid body, which never touch", pair[0], pair[1]);
            reader.fault(
                item.at,
                &path,
                "idle-filter",
                cause,
                "remove the entry, or mark a group as `movable`",
            );
        }
        filters.push(pair);
    }
    filters
}

/// Paths of all authored groups, the root's first.
pub(crate) fn group_paths(bodies: &[BodyDraft]) -> Vec<String> {
    let groups = bodies.iter().flat_map(|draft| &draft.groups);
    groups.map(|group| group.path.to_string()).collect()
}

fn filter(reader: &mut Reader<'_>, node: &Node, path: &str, groups: &[String]) -> Option<[String; 2]> {
    let written = "write (\"arm\", \"tip\")";
    let items = match &node.value {
        Value::Tuple(None, items) if items.len() == 2 => items,
        other => {
            let cause = format!("expected two names of groups, found {}", other.describe());
            return reader.refuse(node.at, path, "wrong-type", cause, written);
        }
    };
    let mut side = |node: &Node| {
        let name = reader.text(node, path)?;
        let found = resolved(groups, &name).map(str::to_owned);
        found.or_else(|| {
            let root = groups.first().map_or(0, |root| root.len() + 1);
            let below: Vec<&str> = groups.iter().skip(1).map(|group| &group[root..]).collect();
            let cause = format!("there is no group \"{name}\", or several of this name");
            reader.refuse(node.at, path, "unknown-group", cause, suggest::cure(&name, &below))
        })
    };
    Some([side(&items[0])?, side(&items[1])?])
}

/// Returns `true` if the two groups have parts in different rigid bodies.
fn can_meet(bodies: &[BodyDraft], pair: &[String; 2]) -> bool {
    let is_in = |group: &str, path: &str| path == group || path.starts_with(&format!("{group}/"));
    let bodies_of = |group: &String| -> Vec<usize> {
        let has_part = |draft: &BodyDraft| draft.groups.iter().any(|part| is_in(group, &part.path));
        (0..bodies.len()).filter(|&body| has_part(&bodies[body])).collect()
    };
    let (of_first, of_second) = (bodies_of(&pair[0]), bodies_of(&pair[1]));
    of_first.iter().any(|a| of_second.iter().any(|b| a != b))
}
