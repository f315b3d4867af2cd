//! `pong verify` from the terminal.

use std::process::{Command, Output};

fn pong(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pong")).args(arguments).output().unwrap()
}

#[test]
fn lists_every_case() {
    let output = pong(&["verify", "--list"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(text.lines().count(), pong_verify::cases().len());
    assert!(text.starts_with("V1   Static rest\n"), "{text}");
}

#[test]
fn runs_the_cases_asked_for() {
    let output = pong(&["verify", "--only", "v1", "--only", "W3"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{text}");
    assert!(text.contains("2 of 2 cases pass"), "{text}");
}

#[test]
fn an_unknown_case_is_wrong_usage() {
    let output = pong(&["verify", "--only", "V99"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("V99"));
}
