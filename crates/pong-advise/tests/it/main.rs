//! Tests of the step check and of advice, on scenes with closed forms.

mod interface;
mod solids;
mod step_advice;
mod told;
mod yielding_ends;
