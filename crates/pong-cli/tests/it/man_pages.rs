//! The manual pages agree with `--help`: each command has one, with all its options.

use crate::common;
use crate::common::pong;
use std::path::Path;

/// Commands in a help text: the first word of each line below `Commands:`.
fn commands(help: &str) -> Vec<&str> {
    let listed = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    listed.lines().filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next()).collect()
}

/// The long options of a help text.
fn options(help: &str) -> Vec<&str> {
    let is_name = |c: char| c.is_ascii_alphanumeric() || c == '-';
    let option = |line: &str| line.trim_start().starts_with('-').then(|| line.find("--"))?;
    let lines = help.lines().filter_map(|line| Some(&line[option(line)?..]));
    lines.map(|text| &text[..text.find(|c| !is_name(c)).unwrap_or(text.len())]).collect()
}

/// A page without its escapes.
fn page(folder: &Path, name: &str) -> String {
    let text = std::fs::read_to_string(folder.join(format!("{name}.1"))).unwrap();
    ["\\fB", "\\fI", "\\fR"].iter().fold(text, |text, font| text.replace(font, "")).replace("\\-", "-")
}

#[test]
fn every_command_has_a_page_with_all_its_options() {
    let folder = common::folder("man_pages", &[]);
    assert_eq!(pong(&folder, &["man-pages", "."]).0, 0);
    let (_, help, _) = pong(&folder, &["--help"]);
    let mut pages: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    pages.sort();
    let mut expected = vec!["pong.1".to_owned()];
    expected
        .extend(commands(&help).iter().filter(|name| **name != "help").map(|name| format!("pong-{name}.1")));
    expected.sort();
    assert_eq!(pages, expected);
    assert!(expected.len() > 10, "{expected:?}");

    for name in commands(&help).into_iter().filter(|name| *name != "help") {
        let text = page(&folder, &format!("pong-{name}"));
        assert!(text.contains("EXIT STATUS") && text.contains("pong(1)"), "{name}: {text}");
        let (_, help, _) = pong(&folder, &[name, "--help"]);
        let options = options(&help);
        assert!(options.contains(&"--help"), "{name}: {options:?}");
        for option in options {
            assert!(text.contains(option), "the page of {name} has no {option}");
        }
    }
}

#[test]
fn a_folder_that_is_missing_is_named() {
    let folder = common::folder("man_pages_nowhere", &[]);
    let (code, _, told) = pong(&folder, &["man-pages", "nowhere"]);
    assert_eq!(code, 1);
    assert!(told.contains("nowhere/pong.1: cannot be written: "), "{told}");
}
