//! A world with registered extensions that none of its models uses; their cost must not be measurable.

use crate::rig;
use pong_engine::{Laws, NormalForce, NormalInput, WorldBuilder};
use pong_model::Extensions;
use std::sync::Arc;

/// A law that no surface uses.
#[derive(Debug)]
struct Unused;

impl NormalForce for Unused {
    fn force(&self, _: &NormalInput<'_>) -> f64 {
        f64::NAN
    }

    fn stored(&self, _: &NormalInput<'_>) -> f64 {
        f64::NAN
    }
}

/// A world with laws, tests of primitives and tests of volumes for kinds that no model has.
pub fn world_with_unused() -> WorldBuilder {
    let mut extensions = Extensions::new();
    extensions.add_contact_test("Gadget", "Gizmo", Arc::new(|_, _, _| None));
    extensions.add_volume_test("Gadget", "Gizmo", Arc::new(|_, _, _| true));
    let mut laws = Laws::default();
    laws.add_normal("unused", Arc::new(Unused));
    WorldBuilder::with_extensions(rig::config(1), extensions, laws)
}
