//! Text of a model file without some of its primitives.
//!
//! The rest stays unchanged, byte for byte, including comments. A group that becomes empty is removed too,
//! unless it is movable: a host sets its state.

use crate::grouping::{BOM, Edit, edited, field, fields, within_some};
use crate::ron_tree::{self, Node, Value};
use std::collections::BTreeSet;

/// Text without the primitives at these paths (`root/arm/tip`), and without groups that contain nothing else.
///
/// # Errors
/// Cause and cure, if [`parse`](crate::parse) does not accept the text, if a primitive does not exist, or if
/// the root or a movable group would become empty.
pub fn without(text: &str, dropped: &BTreeSet<String>) -> Result<String, String> {
    let (mark, plain) = text.strip_prefix(BOM).map_or(("", text), |plain| (&text[..BOM.len_utf8()], plain));
    let node =
        ron_tree::parse(plain).map_err(|error| format!("{}; check it with `pong check`", error.cause))?;
    let root = fields(&node).and_then(|top| field(top, "root"));
    let root = root.ok_or("the text is no model; check it with `pong check`")?;
    let mut trimming = Trimming { text: plain, dropped, found: 0, edits: Vec::new() };
    if !trimming.group(&root.value, "", true)? {
        return Err(emptied(&name(&root.value)));
    }
    if trimming.found != dropped.len() {
        return Err(format!(
            "of {} primitives that are to go the text has {}; name those of the file",
            dropped.len(),
            trimming.found
        ));
    }
    Ok(mark.to_owned() + &edited(plain, trimming.edits))
}

struct Trimming<'t> {
    text: &'t str,
    dropped: &'t BTreeSet<String>,
    /// Number of primitives to remove that were found.
    found: usize,
    edits: Vec<Edit>,
}

impl Trimming<'_> {
    /// Removes the given primitives below a group; returns `true` if anything stays.
    fn group(&mut self, node: &Node, above: &str, is_root: bool) -> Result<bool, String> {
        let own = fields(within_some(node)).unwrap_or_default();
        let path = join(above, &name(node));
        let edits_before = self.edits.len();
        let mut stays = false;
        for primitive in list(own, "primitives") {
            let goes = self.dropped.contains(&join(&path, &name(primitive)));
            self.found += usize::from(goes);
            stays |= self.take(primitive, goes)?;
        }
        for group in list(own, "groups") {
            let is_empty = !self.group(group, &path, false)?;
            stays |= self.take(group, is_empty)?;
        }
        let movable = field(own, "movable").map(|field| &within_some(&field.value).value);
        if !stays && !is_root && movable == Some(&Value::Bool(true)) {
            return Err(emptied(&path));
        }
        if !stays {
            // The group is removed as a whole.
            self.edits.truncate(edits_before);
        }
        Ok(stays)
    }

    /// Removes an item from its list, with the comma after it and the rest of its lines; returns `true` if it
    /// stays.
    fn take(&mut self, item: &Node, goes: bool) -> Result<bool, String> {
        if goes {
            let end = ron_tree::end_of_value(self.text, item.at).map_err(|error| error.cause)?;
            self.edits.push(Edit {
                from: start_of_line(self.text, item.at as usize),
                to: behind_comma(self.text, end),
                put: String::new(),
            });
        }
        Ok(!goes)
    }
}

/// Start of the line if only blanks precede the position, else the position.
fn start_of_line(text: &str, at: usize) -> usize {
    let before = text[..at].trim_end_matches([' ', '\t']);
    if before.is_empty() || before.ends_with('\n') { before.len() } else { at }
}

/// Position after the comma that follows a value, and after the line break if nothing else is on the line.
fn behind_comma(text: &str, end: usize) -> usize {
    let rest = &text[end..];
    let Some(rest) = rest.trim_start().strip_prefix(',') else { return end };
    let blanks = rest.trim_start_matches([' ', '\t']);
    let left = blanks.strip_prefix("\r\n").or_else(|| blanks.strip_prefix('\n')).unwrap_or(blanks);
    text.len() - left.len()
}

fn list<'n>(fields: &'n [ron_tree::Field], name: &str) -> &'n [Node] {
    match field(fields, name).map(|field| &within_some(&field.value).value) {
        Some(Value::List(items)) => items,
        _ => &[],
    }
}

fn name(node: &Node) -> String {
    match fields(within_some(node))
        .and_then(|own| field(own, "name"))
        .map(|field| &within_some(&field.value).value)
    {
        Some(Value::Text(name)) => name.clone(),
        _ => String::new(),
    }
}

fn join(above: &str, name: &str) -> String {
    if above.is_empty() { name.to_owned() } else { format!("{above}/{name}") }
}

fn emptied(path: &str) -> String {
    format!("nothing would be left of {path}; leave one of its primitives")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1e5) },
    root: (name: \"m\", surface: \"s\", groups: [
        // The feet.
        (name: \"feet\", primitives: [
            Point(name: \"left\", position: (0, 0, 0)),
            Point(name: \"right\", position: (1, 0, 0)), // the longer one
            Point(name: \"back\", position: (0, 1, 0))
        ]),
        (name: \"head\", primitives: [Sphere(name: \"skull\", center: (0, 0, 1), radius: 0.1), Point(name: \"nose\", position: (0, 1, 1))]),
        (name: \"arm\", movable: true, primitives: [Point(name: \"hand\", position: (0, 0, 0))]),
    ]))
";

    fn without_these(paths: &[&str]) -> Result<String, String> {
        without(TEXT, &paths.iter().map(|path| (*path).to_owned()).collect())
    }

    fn paths(text: &str) -> Vec<String> {
        let model = crate::parse(text, "trimmed", None, &Default::default()).unwrap();
        model.bodies.iter().flat_map(|body| body.primitives.iter().map(|p| p.path.clone())).collect()
    }

    #[test]
    fn what_is_named_goes_and_all_else_stays() {
        assert_eq!(without_these(&[]).unwrap(), TEXT);
        for gone in
            [&["m/feet/left"][..], &["m/feet/back"], &["m/feet/right", "m/head/nose"], &["m/head/skull"]]
        {
            let text = without_these(gone).unwrap();
            let expected: Vec<String> =
                paths(TEXT).into_iter().filter(|path| !gone.contains(&path.as_str())).collect();
            assert_eq!(paths(&text), expected);
            // Lines are removed, and none changes except that of `head`, which has two primitives.
            assert!(text.lines().all(|line| line.contains("head") || TEXT.contains(line)), "{text}");
        }
    }

    #[test]
    fn a_group_goes_with_the_last_that_it_holds() {
        let text = without_these(&["m/head/skull", "m/head/nose"]).unwrap();
        assert!(!text.contains("head"), "{text}");
        assert_eq!(paths(&text), ["m/feet/left", "m/feet/right", "m/feet/back", "m/arm/hand"]);
    }

    #[test]
    fn movable_groups_and_what_is_not_there_are_refused() {
        assert_eq!(
            without_these(&["m/arm/hand"]).unwrap_err(),
            "nothing would be left of m/arm; leave one of its primitives"
        );
        assert!(without_these(&["m/arm/foot"]).unwrap_err().starts_with("of 1 primitives"));
        assert!(without("(", &BTreeSet::new()).is_err());
    }

    #[test]
    fn carriage_returns_and_a_byte_order_mark_stay() {
        let text = format!("\u{feff}{}", TEXT.replace('\n', "\r\n"));
        let trimmed = without(&text, &BTreeSet::from(["m/feet/left".to_owned()])).unwrap();
        assert!(trimmed.starts_with('\u{feff}') && !trimmed.replace("\r\n", "").contains('\n'));
        assert_eq!(paths(&trimmed).len(), 5);
    }
}
