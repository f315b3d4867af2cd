//! Tests of the crate as a host uses it.

mod documentation;
mod errors;
mod examples;
