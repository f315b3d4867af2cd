//! Fuzz targets as functions of bytes.
//!
//! Each module has a `run(data)` that accepts any bytes: it must return, in time, without a panic, and
//! accepted input must give finite numbers. `targets/` connects them to libFuzzer, see `docs/fuzzing.md`.

pub mod c_calls;
pub mod contact_state;
pub mod count;
pub mod exercise;
pub mod files;
pub mod gltf;
pub mod input;
pub mod log;
pub mod mesh;
pub mod model;
pub mod obj;
#[cfg(test)]
mod regressions;
pub mod scene;
pub mod stl;
pub mod text;
