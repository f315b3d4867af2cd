//! The C functions of both versions of the standard.
//!
//! # Safety of all functions
//!
//! A pointer is NULL or points to what its type says, for as long as the call runs; an instance or a state is one that this
//! library gave out and that was not freed; text ends with a zero byte; an array has as many elements as the importer says; an
//! instance is called from one thread at a time. Everything else is checked.

mod component;
mod fmi2;
mod fmi3;
mod logger;
mod pointers;
