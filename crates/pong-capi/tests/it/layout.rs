//! Sizes, alignments, offsets and numbers of `pong.h` in a C compiler and a C++ compiler.

use crate::support::{include_dir, out_dir, run};
use pong::layout::LAYOUTS;
use pong::status::pong_status_name;
use std::ffi::CStr;
use std::fmt::Write;
use std::process::Command;

/// A program that prints every layout, one line each.
fn probe() -> String {
    let mut lines = String::new();
    for layout in LAYOUTS {
        let name = layout.name;
        writeln!(lines, "struct {name}_align {{ char c; {name} t; }};").unwrap();
    }
    lines.push_str("int main(void) {\n");
    for layout in LAYOUTS {
        let name = layout.name;
        let align = format!("offsetof(struct {name}_align, t)");
        writeln!(lines, "printf(\"{name} %d %d\\n\", (int)sizeof({name}), (int){align});").unwrap();
        for (field, _) in layout.fields {
            writeln!(lines, "printf(\"{name}.{field} %d\\n\", (int)offsetof({name}, {field}));").unwrap();
        }
    }
    for status in statuses() {
        writeln!(lines, "printf(\"{status} %d\\n\", (int){status});").unwrap();
    }
    lines.push_str("printf(\"status %d\\n\", (int)sizeof(pong_status));\nreturn 0; }\n");
    format!("#include <pong.h>\n#include <stdio.h>\n{lines}")
}

fn expected() -> String {
    let mut lines = String::new();
    for layout in LAYOUTS {
        writeln!(lines, "{} {} {}", layout.name, layout.size, layout.align).unwrap();
        for (field, offset) in layout.fields {
            writeln!(lines, "{}.{field} {offset}", layout.name).unwrap();
        }
    }
    for (number, status) in statuses().iter().enumerate() {
        writeln!(lines, "{status} {number}").unwrap();
    }
    lines + "status 4\n"
}

/// Names of the statuses in the order of their numbers, which begin at 0 and have no gap.
fn statuses() -> Vec<String> {
    let name = |number| {
        // SAFETY: the name ends with a zero byte and lives as long as the library.
        unsafe { CStr::from_ptr(pong_status_name(number)) }.to_str().unwrap().to_owned()
    };
    (0..).map(name).take_while(|name| name != "unknown status").collect()
}

fn layout_seen_by(compiler: &str, standard: &str, extension: &str) -> String {
    let source = out_dir("layout").join(format!("probe.{extension}"));
    let program = source.with_extension(format!("{extension}.out"));
    std::fs::write(&source, probe()).unwrap();
    run(Command::new(compiler)
        .args([standard, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-o"])
        .arg(&program)
        .arg("-I")
        .arg(include_dir())
        .arg(&source));
    run(&mut Command::new(&program))
}

#[test]
fn c_sees_the_layout_of_the_library() {
    assert_eq!(layout_seen_by("cc", "-std=c99", "c"), expected());
}

#[test]
fn cpp_sees_the_layout_of_the_library() {
    // The quick tests need a C compiler only.
    if !pong_testkit::samples::is_full() && Command::new("c++").arg("--version").output().is_err() {
        return eprintln!("left out: no C++ compiler (`c++`); `PONG_TESTS=full` needs one");
    }
    assert_eq!(layout_seen_by("c++", "-std=c++17", "cpp"), expected());
}
