//! Names valid in model files: not empty, no `/`, unique among siblings.

use crate::findings::Findings;
use std::collections::{BTreeMap, BTreeSet};

/// Names taken by the children of one group.
#[derive(Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    /// Next number to try for each name, so that many equal names do not take quadratic time.
    next: BTreeMap<String, u64>,
}

impl Names {
    /// Returns the name itself, or with a number appended if it is taken.
    pub(super) fn take(&mut self, wanted: &str, path: &str, findings: &mut Findings) -> String {
        let clean = match wanted.trim() {
            "" => "unnamed".to_owned(),
            name => name.replace('/', "_"),
        };
        let mut name = clean.clone();
        if self.taken.contains(&name) {
            let next = self.next.entry(clean.clone()).or_insert(2);
            while self.taken.contains(&name) {
                name = format!("{clean}_{next}");
                *next += 1;
            }
        }
        if name != wanted {
            findings.note(path, "renamed", format!("it is called `{name}` in the model"), "");
        }
        self.taken.insert(name.clone());
        name
    }
}

/// `bolt` for a single one, else `bolt_0`, `bolt_1`, …, as the toolkit numbers them.
pub(super) fn numbered(name: &str, index: usize, count: usize) -> String {
    if count == 1 { name.to_owned() } else { format!("{name}_{index}") }
}

/// Sort key: foot_2 before foot_10, ignoring letter case; different names have different keys.
pub(super) fn natural(name: &str) -> (Vec<(bool, u64, String)>, String) {
    let mut parts = vec![(true, 0, String::new())];
    for c in name.to_lowercase().chars() {
        let last = parts.len() - 1;
        match (c.to_digit(10), parts[last].0) {
            (Some(digit), true) => parts.push((false, u64::from(digit), String::new())),
            (Some(digit), false) => {
                parts[last].1 = parts[last].1.saturating_mul(10).saturating_add(u64::from(digit))
            }
            (None, true) => parts[last].2.push(c),
            (None, false) => parts.push((true, 0, c.to_string())),
        }
    }
    (parts, name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_count_as_numbers() {
        let mut names = vec!["foot_10", "Foot_2", "foot", "2", "foot_2", "10"];
        names.sort_by_key(|name| natural(name));
        assert_eq!(names, ["2", "10", "foot", "Foot_2", "foot_2", "foot_10"]);
    }
}
