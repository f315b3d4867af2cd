//! Tests of what the doctor says about machines.

mod machines;
