//! Tests of the invariances.

mod invariances;
mod solids;
