//! Names of variables in the structured convention of FMI: `object.group.position[1]`.

/// The path of a body or a surface, `object/arm/latch`, as a prefix of variable names: its parts are
/// separated by dots, and quoted where they are no identifiers.
pub(crate) fn structured(path: &str) -> String {
    path.split('/').map(part).collect::<Vec<_>>().join(".")
}

fn part(text: &str) -> String {
    let mut characters = text.chars();
    let begins = characters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    if begins && characters.all(|c| c.is_ascii_alphanumeric() || c == '_') {
        return text.to_owned();
    }
    let mut quoted = String::from("'");
    for c in text.chars() {
        match c {
            '\'' | '\\' => quoted.extend(['\\', c]),
            ' '..='~' => quoted.push(c),
            // The convention allows ASCII only.
            _ => quoted.push_str(&format!("{{{:x}}}", u32::from(c))),
        }
    }
    quoted + "'"
}

/// A valid prefix of C function names, made from any name.
pub(crate) fn identifier(name: &str) -> String {
    let mut text: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        text.insert_str(0, "scene_");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_are_no_identifiers_are_quoted() {
        assert_eq!(structured("gripper/arm_2/left"), "gripper.arm_2.left");
        assert_eq!(structured("my ball/2nd"), "'my ball'.'2nd'");
        assert_eq!(structured("it's\\/ä"), r"'it\'s\\'.'{e4}'");
        assert_eq!(structured(""), "''");
    }

    #[test]
    fn identifiers_are_those_of_c() {
        assert_eq!(identifier("drop test-2"), "drop_test_2");
        assert_eq!(identifier("2 balls"), "scene_2_balls");
        assert_eq!(identifier(""), "scene_");
    }
}
