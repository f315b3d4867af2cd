//! What the fuzz targets do with the bytes they are handed.
//!
//! Each module has a `run(data)` that any bytes may be given to: it must come back, in time, without a panic, and what
//! the engine accepted must give finite numbers. `targets/` hands them to libFuzzer, `docs/fuzzing.md` tells how.

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
pub mod scene;
pub mod stl;
pub mod text;
