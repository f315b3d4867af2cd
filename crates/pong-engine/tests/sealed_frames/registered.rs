//! Laws, a primitive and a bounding volume of the user's own.

use crate::heap::count_this_thread;
use pong_engine::*;
use pong_geometry::bounding::{Bounded, CustomVolume, Volume};
use pong_geometry::extension::{Extensions, PrimitiveRef};
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::CustomPrimitive;
use pong_geometry::{Transform, Vec3};
use std::sync::Arc;

/// Marks the thread that evaluates it.
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

/// A spring to the place of first touch.
#[derive(Debug)]
struct Glue;

impl FrictionForce for Glue {
    fn state_len(&self) -> usize {
        3
    }

    fn evaluate(&self, input: &FrictionInput<'_>, state: &mut [f64]) -> FrictionOutput {
        let stretch = Vec3::new(state[0], state[1], state[2]) + input.slip_b;
        state.copy_from_slice(stretch.as_slice());
        FrictionOutput {
            force_b: stretch * -input.parameters[0],
            bristle_b: Vec3::zeros(),
            sticks: true,
            stored: 0.5 * input.parameters[0] * stretch.norm_squared(),
        }
    }
}

/// A vertical post of radius 0.1 m and half height 1 m.
#[derive(Debug)]
struct Post;

impl CustomPrimitive for Post {
    fn kind_name(&self) -> &str {
        "Post"
    }

    fn support(&self, direction: &Vec3) -> f64 {
        0.1 * (direction.x * direction.x + direction.y * direction.y).sqrt() + direction.z.abs()
    }

    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

#[derive(Debug)]
struct Everywhere;

impl CustomVolume for Everywhere {
    fn kind_name(&self) -> &str {
        "Everywhere"
    }

    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

fn point_post(a: PrimitiveRef<'_>, b: PrimitiveRef<'_>, x_ba: &Transform) -> Option<Interference> {
    let (PrimitiveRef::Point(point), PrimitiveRef::Custom(_)) = (a, b) else { return None };
    let p = x_ba.point(&point.position);
    let out = Vec3::new(p.x, p.y, 0.0);
    let depth = 0.1 - out.norm();
    let inside = depth > 0.0 && p.z.abs() < 1.0;
    inside.then(|| Interference { depth, normal_b: out.normalize(), deepest_b: p, feature: Feature::WHOLE })
}

pub fn extensions() -> Extensions {
    let mut extensions = Extensions::new();
    extensions.add_primitive("Post", Arc::new(|_: &[f64]| Ok(Arc::new(Post) as Arc<dyn CustomPrimitive>)));
    extensions.add_contact_test("Point", "Post", Arc::new(point_post));
    extensions.add_volume(
        "Everywhere",
        Arc::new(|_: &[&dyn Bounded]| Arc::new(Everywhere) as Arc<dyn CustomVolume>),
    );
    for kind in ["Aabb", "Sphere", "Obb", "Everywhere"] {
        let always = |_: &Volume, _: &Volume, _: &Transform| true;
        extensions.add_volume_test("Everywhere", kind, Arc::new(always));
    }
    extensions
}

pub fn laws() -> Laws {
    let mut laws = Laws::default();
    laws.add_normal("cubic", Arc::new(Cubic));
    laws.add_friction("glue", Arc::new(Glue));
    laws
}
