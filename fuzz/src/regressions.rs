//! Inputs that failed once, each again: without a sanitizer, but with overflow checks and assertions. `ci/fuzz` runs them with one.

use std::path::Path;

/// Runs every file of `regressions/TARGET`.
fn run_all(target: &str, run: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("regressions").join(target);
    let Ok(files) = std::fs::read_dir(folder) else { return };
    for file in files {
        let path = file.expect("the folder can be read").path();
        println!("{}", path.display());
        run(&std::fs::read(&path).expect("the file can be read"));
    }
}

macro_rules! one_test_each {
    ($($target:ident),*) => {
        $(
            #[test]
            fn $target() {
                run_all(stringify!($target), crate::$target::run);
            }
        )*

        #[test]
        fn every_folder_belongs_to_a_target() {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("regressions");
            for entry in std::fs::read_dir(folder).expect("the folder can be read") {
                let name = entry.expect("the folder can be read").file_name();
                assert!([$(stringify!($target)),*].iter().any(|target| name == *target), "{name:?}");
            }
        }
    };
}

one_test_each!(model, obj, stl, gltf, scene, contact_state, log, c_calls);
