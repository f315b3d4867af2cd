//! Custom force laws, a primitive, its contact tests and a bounding volume; and laws that stall a worker.

use pong_engine::{FrictionForce, FrictionInput, FrictionOutput, Laws, NormalForce, NormalInput};
use pong_geometry::bounding::{Bounded, CustomVolume, Volume};
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::CustomPrimitive;
use pong_geometry::{Transform, Vec3};
use pong_model::Extensions;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// A worker sleeps after every this many calls of the laws; never if 0.
pub static STALL_EVERY: AtomicU64 = AtomicU64::new(0);

/// Sleep of a stalling worker, longer than the worker timeout of the tests.
pub const STALL: Duration = Duration::from_millis(4);

/// Calls of the laws on workers since the process began.
pub static CALLS_ON_WORKERS: AtomicU64 = AtomicU64::new(0);

/// Returns true if this thread is a worker.
pub fn on_a_worker() -> bool {
    std::thread::current().name().is_some_and(|name| name.starts_with("pong-worker"))
}

fn stall_if_asked() {
    if !on_a_worker() {
        return;
    }
    let call = CALLS_ON_WORKERS.fetch_add(1, Ordering::Relaxed) + 1;
    let every = STALL_EVERY.load(Ordering::Relaxed);
    if every > 0 && call.is_multiple_of(every) {
        std::thread::sleep(STALL);
    }
}

/// F = k·δ².
#[derive(Debug)]
struct Quadratic;

impl NormalForce for Quadratic {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        stall_if_asked();
        input.parameters[0] * input.depth * input.depth
    }

    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        input.parameters[0] * input.depth * input.depth * input.depth / 3.0
    }
}

/// A spring to the point of first touch; it has three state values.
#[derive(Debug)]
pub struct Glue;

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

pub fn laws() -> Laws {
    let mut laws = Laws::default();
    laws.add_normal("quadratic", Arc::new(Quadratic));
    laws.add_friction("glue", Arc::new(Glue));
    laws
}

/// A vertical cylinder of infinite length.
#[derive(Debug)]
struct Post {
    radius: f64,
}

impl CustomPrimitive for Post {
    fn kind_name(&self) -> &str {
        "Post"
    }

    fn support(&self, direction: &Vec3) -> f64 {
        if direction.z != 0.0 { f64::INFINITY } else { self.radius * direction.norm() }
    }

    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

impl Post {
    /// Contact with a ball around `center` in the post's frame; a point has radius 0.
    fn pushes(&self, center: &Vec3, radius: f64) -> Option<Interference> {
        let out = Vec3::new(center.x, center.y, 0.0);
        let depth = self.radius + radius - out.norm();
        let normal = out.normalize();
        (depth > 0.0).then(|| Interference {
            depth,
            normal_b: normal,
            deepest_b: center - normal * radius,
            feature: Feature::WHOLE,
        })
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

pub fn extensions() -> Extensions {
    let mut extensions = without_volume_tests();
    for kind in ["Aabb", "Sphere", "Obb", "Unbounded", "Everywhere"] {
        let always = |_: &Volume, _: &Volume, _: &Transform| true;
        extensions.add_volume_test("Everywhere", kind, Arc::new(always));
    }
    extensions
}

/// These extensions, without a test between the bounding volume and others.
pub fn without_volume_tests() -> Extensions {
    let mut extensions = Extensions::new();
    extensions.add_primitive(
        "Post",
        Arc::new(|parameters: &[f64]| match parameters {
            [radius] if *radius > 0.0 => Ok(Arc::new(Post { radius: *radius }) as Arc<dyn CustomPrimitive>),
            _ => Err("a Post takes one positive parameter, its radius".to_owned()),
        }),
    );
    for kind in ["Point", "Sphere"] {
        extensions.add_contact_test(kind, "Post", Arc::new(test_post));
    }
    extensions.add_volume(
        "Everywhere",
        Arc::new(|_: &[&dyn Bounded]| Arc::new(Everywhere) as Arc<dyn CustomVolume>),
    );
    extensions
}

fn test_post(a: PrimitiveRef<'_>, b: PrimitiveRef<'_>, x_ba: &Transform) -> Option<Interference> {
    let PrimitiveRef::Custom(post) = b else { return None };
    let post = post.as_any().downcast_ref::<Post>()?;
    match a {
        PrimitiveRef::Point(point) => post.pushes(&x_ba.point(&point.position), 0.0),
        PrimitiveRef::Sphere(sphere) => post.pushes(&x_ba.point(&sphere.center), sphere.radius),
        _ => None,
    }
}
