//! The test for ThreadSanitizer.

fn main() {}
