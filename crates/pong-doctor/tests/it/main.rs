//! Tests of the doctor's findings on machines.

mod machines;
