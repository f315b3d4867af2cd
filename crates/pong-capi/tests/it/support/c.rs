//! The programs of `c_examples`, built with a compiler alone: what belongs to each is read from the Makefile.

use super::{include_dir, lib_dir, root, run};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The words that the Makefile gives a variable, none if it has no such variable.
fn words(variable: &str) -> Vec<String> {
    let makefile = std::fs::read_to_string(root().join("c_examples/Makefile")).unwrap();
    let line = makefile.lines().find_map(|line| line.strip_prefix(&format!("{variable} = ")));
    line.unwrap_or_default().split_whitespace().map(str::to_owned).collect()
}

/// Arguments with which a program is run.
pub fn arguments(program: &str) -> Vec<String> {
    words(&format!("ARGS_{program}"))
}

/// `NAME.c` and every `NAME_*.c`, here or in `testing/`, and what the program takes from others.
fn sources(program: &str) -> Vec<PathBuf> {
    let examples = root().join("c_examples");
    let is_part = |path: &Path| {
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let is_c = path.extension().is_some_and(|extension| extension == "c");
        is_c && stem.strip_prefix(program).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let mut found: Vec<PathBuf> = [examples.clone(), examples.join("testing")]
        .iter()
        .flat_map(|folder| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()))
        .filter(|path| is_part(path))
        .collect();
    found.extend(words(&format!("MORE_{program}")).iter().map(|file| examples.join(file)));
    found
}

/// Builds a program against the shared library; none if it is in C++ and there is no compiler for that.
pub fn build(program: &str, out: &Path) -> Option<PathBuf> {
    let soname = format!("libpong.so.{}", pong::version::PONG_ABI_VERSION);
    for name in [soname.as_str(), "libpong.so"] {
        let _ = std::fs::remove_file(out.join(name));
        std::os::unix::fs::symlink(lib_dir().join("libpong.so"), out.join(name)).unwrap();
    }
    let cpp = root().join("c_examples").join(program).with_extension("cpp");
    let is_cpp = cpp.exists();
    let mut compiler = if is_cpp {
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O1"]).arg(cpp);
        if Command::new("c++").arg("--version").output().is_err() {
            return None;
        }
        compiler
    } else {
        let mut compiler = Command::new("cc");
        compiler.args(["-std=c99", "-O1"]).args(sources(program));
        compiler
    };
    let built = out.join(program);
    compiler.args(words("WARNINGS")).arg("-I").arg(include_dir()).arg("-I").arg(root().join("c_examples"));
    run(compiler.arg("-L").arg(out).args(["-lpong", "-lm", "-lpthread", "-o"]).arg(&built));
    Some(built)
}

/// A built program with the library that it was built with.
pub fn command(built: &Path, out: &Path) -> Command {
    let mut command = Command::new(built);
    command.env("LD_LIBRARY_PATH", out);
    command
}
