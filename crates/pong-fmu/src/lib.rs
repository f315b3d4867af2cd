//! Functional Mock-up Units of scenes, FMI 2.0 and 3.0, Model Exchange and Co-Simulation in one file.
//!
//! The crate is two things. As a Rust library it makes FMUs ([`package`]); the program `pong` uses it. As the shared library
//! `libpong_fmu.so` it is what an FMU holds and what an importer loads. `docs/fmu.md` is the manual.
//!
//! | file | is |
//! |---|---|
//! | `package.rs`, `zip.rs`, `library.rs` | scene, models and shared library → FMU |
//! | `contents.rs` | what `resources/` holds, with hashes: the token |
//! | `description/` | `modelDescription.xml` |
//! | `variables.rs`, `names.rs`, `surfaces.rs` | the variables of a scene |
//! | `unit.rs`, `load.rs` | a scene in an FMU: made from files, loaded from `resources/` |
//! | `instance.rs`, `states.rs` | what an importer instantiates, whatever the version of the standard; its state as bytes |
//! | `c/` | the C functions of both versions: the only place where pointers are touched |
//!
//! What is written of an FMU and what is loaded from it go through the same `Unit`, so that names, value
//! references and start values cannot differ.

mod c;
mod contents;
mod description;
mod instance;
mod library;
mod load;
mod names;
mod package;
mod refusal;
mod states;
mod surfaces;
mod unit;
mod variables;
mod version;
mod zip;

pub use library::{LIBRARY_FILE, check_library};
pub use package::{Options, Package, package};
pub use version::Fmi;
