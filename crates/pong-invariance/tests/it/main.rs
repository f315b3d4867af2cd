//! Tests of the invariances.

mod invariances;
