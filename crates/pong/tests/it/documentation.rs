//! The texts of READMEs are those of the examples, and every public name has an example.

use std::path::Path;

fn read(path: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

/// Program of the first example, without its head.
fn program() -> String {
    let text = read("examples/minimal.rs");
    text.split_once("\n\n").unwrap().1.to_owned()
}

#[test]
fn readme_of_the_crate_holds_the_minimal_example() {
    assert!(read("README.md").contains(&format!("```no_run\n{}```", program())));
}

/// Program and models of the repository's README are the files of the example.
#[test]
fn readme_of_the_repository_holds_the_minimal_example_and_its_models() {
    let readme = read("../../README.md");
    assert!(readme.contains(&format!("```rust\n{}```", program())));
    for model in ["ball", "ground"] {
        let text = read(&format!("examples/{model}.ron"));
        assert!(readme.contains(&format!("```ron\n{text}```")), "{model}.ron");
    }
}

/// A `pub use` of a name of another crate carries a code block.
#[test]
fn every_reexported_name_has_an_example() {
    let mut names = 0;
    for file in ["lib", "diagnostics", "energy", "law", "monitor"] {
        let text = read(&format!("src/{file}.rs"));
        let mut fences = 0;
        for line in text.lines() {
            if line.starts_with("/// ```") {
                fences += 1;
            }
            if line.starts_with("pub use pong_") {
                assert_eq!(fences, 2, "{file}.rs: {line}");
                names += 1;
                fences = 0;
            }
        }
    }
    assert!(names > 50, "{names}");
}
