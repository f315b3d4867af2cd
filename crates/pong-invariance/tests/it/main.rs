//! Tests of the invariances.

mod invariances;
mod poses;
mod solids;
mod tangents;
