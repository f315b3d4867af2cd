//! Tests of the cases with known answers and of the extremes.

mod all_cases;
mod all_extremes;
mod scenes;
