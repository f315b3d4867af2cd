//! Laws of the host, one of which counts the threads that compute.

use crate::common::own_kinds::Glue;
use crate::heap::count_this_thread;
use pong_engine::*;
use std::sync::Arc;

/// Cubic law that marks the thread which evaluates it.
#[derive(Debug)]
pub struct Cubic;

impl NormalForce for Cubic {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        count_this_thread();
        input.parameters[0] * input.depth * input.depth * input.depth
    }

    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        0.25 * input.parameters[0] * input.depth * input.depth * input.depth * input.depth
    }
}

pub fn laws() -> Laws {
    let mut laws = Laws::default();
    laws.add_normal("cubic", Arc::new(Cubic));
    laws.add_friction("glue", Arc::new(Glue));
    laws
}
