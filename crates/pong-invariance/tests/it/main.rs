//! Tests of the invariances themselves.

mod invariances;
