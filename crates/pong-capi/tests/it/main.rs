//! Tests of the C interface as C and C++ programs see it.

mod c_programs;
mod header_is_current;
mod layout;
mod support;
