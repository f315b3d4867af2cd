//! Tests of the C interface with C and C++ programs.

mod c_programs;
mod header_is_current;
mod layout;
mod support;
