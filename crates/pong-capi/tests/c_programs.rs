//! The C and C++ programs of `c_examples`, built with warnings as errors against both libraries, and run.

mod support;

use std::process::Command;
use support::{lib_dir, out_dir, root, run};

#[test]
fn the_programs_build_and_run() {
    let printed = run(Command::new("make")
        .arg("-C")
        .arg(root().join("c_examples"))
        .arg("check")
        .arg(format!("LIB_DIR={}", lib_dir().display()))
        .arg(format!("OUT={}", out_dir("c_programs").display()))
        .arg(format!("PROGRAMS={}", PROGRAMS.join(" "))));
    for (variant, program) in ["shared", "static"].iter().flat_map(|v| PROGRAMS.map(|p| (v, p))) {
        assert!(
            printed.contains(&format!("{variant}/{program}: ")),
            "{variant}/{program} did not run:\n{printed}"
        );
    }
}

const PROGRAMS: [&str; 5] = ["minimal", "misuse", "laws", "calls", "cpp_smoke"];

#[test]
fn the_shared_library_has_a_soname_and_exports_nothing_else() {
    let library = lib_dir().join("libpong.so");
    let dynamic = run(Command::new("objdump").arg("-p").arg(&library));
    let soname = format!("libpong.so.{}", pong::version::PONG_ABI_VERSION);
    assert!(dynamic.lines().any(|line| line.trim().starts_with("SONAME") && line.trim().ends_with(&soname)));
    let symbols = run(Command::new("nm").args(["-D", "--defined-only"]).arg(&library));
    let foreign: Vec<&str> = symbols.lines().filter(|line| !line.contains(" pong_")).collect();
    assert!(foreign.is_empty(), "{foreign:?}");
}

#[test]
fn every_call_of_the_header_is_exported() {
    let header = std::fs::read_to_string(root().join("include/pong.h")).unwrap();
    let symbols = run(Command::new("nm").args(["-D", "--defined-only"]).arg(lib_dir().join("libpong.so")));
    let exported: Vec<&str> = symbols.lines().filter_map(|line| line.split(' ').nth(2)).collect();
    let code = header.lines().filter(|line| !line.trim_start().starts_with("//") && !line.starts_with('#'));
    let text: String = code.collect::<Vec<_>>().join("\n");
    let called = text.split("pong_").skip(1).filter_map(|rest| rest.split_once('(').map(|(name, _)| name));
    let names: Vec<String> = called
        .filter(|name| name.chars().all(|c| c.is_ascii_lowercase() || c == '_'))
        .map(|name| format!("pong_{name}"))
        .collect();
    assert!(names.len() > 50, "{}", names.len());
    let missing: Vec<&String> = names.iter().filter(|name| !exported.contains(&name.as_str())).collect();
    assert!(missing.is_empty(), "{missing:?}");
    assert_eq!(names.len(), exported.len(), "exported but not in the header");
}
