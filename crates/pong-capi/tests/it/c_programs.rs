//! The C and C++ programs of `c_examples`, built with warnings as errors, and run.

use crate::support::c::{build, builder, command};
use crate::support::{lib_dir, out_dir, root, run};
use std::process::Command;

/// Against the shared library; `ci/c_examples` runs some against the static one, too, and under Valgrind.
#[test]
fn the_programs_build_and_run() {
    println!("{}", run(builder(&out_dir("c_programs")).arg("--run").args(PROGRAMS)));
}

const PROGRAMS: [&str; 12] = [
    "minimal",
    "executive",
    "misuse",
    "laws",
    "calls",
    "arrivals",
    "response_log",
    "floating_point",
    "host_process",
    "little_memory",
    "little_stack",
    "cpp_smoke",
];

/// A host limits the vector instructions by the environment, as for a tool that does not support all of them.
#[test]
fn the_environment_limits_the_instructions() {
    let out = out_dir("instructions");
    let built = build("minimal", &out);
    let minimal = |level: &str| command(&built).env("PONG_SIMD", level).output().unwrap();
    let [narrow, wide] = ["portable", "avx512"].map(minimal);
    assert!(narrow.status.success() && wide.status.success());
    assert_eq!(narrow.stdout, wide.stdout, "the same numbers");
    let refused = minimal("sse");
    let message = String::from_utf8(refused.stderr).unwrap();
    assert!(!refused.status.success() && message.contains("PONG_SIMD is `sse`"), "{message}");
}

/// The log of a C host can be replayed with the same bits, with cleared histories, switched pairs, commits of
/// some pairs and frames without a commit.
#[test]
fn the_log_of_a_c_host_can_be_replayed() {
    let out = out_dir("response_log");
    let built = build("response_log", &out);
    let folder = out.join("logs");
    let _ = std::fs::remove_dir_all(&folder);
    run(command(&built).arg(&folder));
    let mut log = pong_record::Log::open(&folder.join("frames")).unwrap();
    let report = pong_record::replay(&mut log, &pong_record::ReplayOptions::default(), &mut |_| {
        std::ops::ControlFlow::Continue(())
    })
    .unwrap();
    assert!(report.agrees() && report.compared == 3000 && report.contacts > 700, "{report:?}");
    let kinds =
        |kind| log.events().iter().filter(|event| std::mem::discriminant(&event.event) == kind).count();
    let cleared = std::mem::discriminant(&pong_record::Event::ClearContactHistory { object: 0 });
    let some = std::mem::discriminant(&pong_record::Event::Commit { pairs: Vec::new() });
    assert_eq!((kinds(cleared), kinds(some)), (6, 1200));
}

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
