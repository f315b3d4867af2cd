//! Functional Mock-up Units of scenes, FMI 2.0 and 3.0, Model Exchange and Co-Simulation in one file.
//!
//! The crate has two uses. As a Rust library it makes FMUs ([`package`]), for the program `pong`. As the
//! shared library `libpong_fmu.so` it is part of every FMU, and importers load it. `docs/fmu.md` is the
//! manual.
//!
//! | file | is |
//! |---|---|
//! | `package.rs`, `zip.rs`, `library.rs` | scene, models and shared library → FMU |
//! | `contents.rs` | list of the files in `resources/`, with hashes: the token |
//! | `description/` | `modelDescription.xml` |
//! | `variables.rs`, `names.rs`, `surfaces.rs` | the variables of a scene |
//! | `unit.rs`, `load.rs` | a scene in an FMU: made from files, loaded from `resources/` |
//! | `instance.rs`, `states.rs` | an instance, for any version of the standard; its state as bytes |
//! | `c/` | the C functions of both versions: the only place where pointers are touched |
//!
//! Writing and loading an FMU use the same `Unit`, so that names, value references and start values cannot
//! differ.

mod c;
mod contents;
mod description;
mod flags;
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
