//! Extensions by a Rust user: force laws, primitives, bounding volumes.

use crate::common::own_kinds;
use crate::common::*;
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use pong_model::Extensions;
use std::sync::Arc;

fn custom_laws() -> (String, String) {
    let own = surface(
        1.0,
        "normal: Custom(name: \"quadratic\", parameters: [3e7]), friction: Custom(name: \"glue\", parameters: [500.0])",
    );
    (
        model("tip", &own, "Point(name: \"p\", position: (0,0,0))"),
        model("floor", &own, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"),
    )
}

fn sealed_with(laws: Laws) -> Result<(World, [InterfaceId; 2]), EngineError> {
    let (a, b) = custom_laws();
    let mut builder =
        WorldBuilder::with_extensions(Config { ledger: true, ..Config::default() }, Extensions::new(), laws);
    let models = [load(&mut builder, &a), load(&mut builder, &b)];
    let objects = [builder.create_object(models[0], "a")?, builder.create_object(models[1], "b")?];
    builder.pair(objects[0], objects[1])?;
    let (world, _) = builder.seal()?;
    let interfaces = [world.scene().interface(objects[0], "")?, world.scene().interface(objects[1], "")?];
    Ok((world, interfaces))
}

#[test]
fn registered_laws_are_used_and_their_state_is_saved() {
    let (mut world, [tip, floor]) = sealed_with(own_kinds::laws()).unwrap();
    let place = |world: &mut World, x: f64| {
        world.set_state(floor, &State::identity()).unwrap();
        world.set_state(tip, &at(Vec3::new(x, 0.0, -2e-3), Quat::identity())).unwrap();
        world.step().unwrap();
        world.wrench(tip).unwrap().force
    };
    let first = place(&mut world, 0.0);
    assert!((first - Vec3::new(0.0, 0.0, 120.0)).norm() < 1e-9, "{first:?}");
    place(&mut world, 0.01);
    let mut block = vec![0; world.state_size()];
    world.save_state(&mut block).unwrap();
    let last = place(&mut world, 0.03);
    assert!((last - Vec3::new(-15.0, 0.0, 120.0)).norm() < 1e-9, "{last:?}");
    world.restore_state(&block).unwrap();
    assert_eq!(place(&mut world, 0.03), last);
}

/// Reports its input, and pulls at the surface, which no friction may do.
#[derive(Debug)]
struct Witness;

impl FrictionForce for Witness {
    fn state_len(&self) -> usize {
        0
    }

    fn evaluate(&self, input: &FrictionInput<'_>, _: &mut [f64]) -> FrictionOutput {
        let told = Vec3::new(input.stiffness, input.parameters[0], 0.0) * input.share;
        FrictionOutput {
            force_b: told - input.normal_b * 77.0,
            bristle_b: Vec3::zeros(),
            sticks: false,
            stored: 0.0,
        }
    }
}

/// By default a registered friction law is given the bristle stiffness ⅔·k of the pair, and its force is
/// projected into the contact plane.
#[test]
fn a_registered_friction_law_is_given_the_pair_and_kept_in_the_plane() {
    let own = |k: f64| surface(k, "friction: Custom(name: \"witness\", parameters: [500.0])");
    let mut laws = Laws::default();
    laws.add_friction("witness", Arc::new(Witness));
    let mut builder = WorldBuilder::with_extensions(Config::default(), Extensions::new(), laws);
    let tip = load(&mut builder, &model("tip", &own(3e5), "Point(name: \"p\", position: (0,0,0))"));
    let floor = model("floor", &own(1e5), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
    let floor = load(&mut builder, &floor);
    let objects = [builder.create_object(tip, "a").unwrap(), builder.create_object(floor, "b").unwrap()];
    builder.pair(objects[0], objects[1]).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let [tip, floor] = objects.map(|object| world.scene().interface(object, "").unwrap());
    world.set_state(floor, &State::identity()).unwrap();
    world.set_state(tip, &at(Vec3::new(0.0, 0.0, -2e-3), Quat::identity())).unwrap();
    world.step().unwrap();
    let expected = Vec3::new(2.0 / 3.0 * 7.5e4, 500.0, 7.5e4 * 2e-3);
    let force = world.wrench(tip).unwrap().force;
    assert!((force - expected).norm() < 1e-9, "{force:?}");
}

#[test]
fn a_law_that_nobody_registered_is_refused_at_seal() {
    let error = sealed_with(Laws::default()).err().unwrap().to_string();
    assert!(error.contains("quadratic") && error.contains("register"), "{error}");
}

fn post_world(with_volume_test: bool) -> Result<(World, [InterfaceId; 2]), EngineError> {
    let extensions =
        if with_volume_test { own_kinds::extensions() } else { own_kinds::without_volume_tests() };
    let mut builder = WorldBuilder::with_extensions(Config::default(), extensions.clone(), Laws::default());
    let steel = surface(2e5, "");
    let tip = model("tip", &steel, "Point(name: \"p\", position: (0,0,0))")
        .replace("root: (", "root: (bound: Custom(\"Everywhere\"), ");
    // A box around a ball beside the unbounded post: a pair of volumes that needs a test.
    let post = "Custom(name: \"c\", kind: \"Post\", parameters: [0.1])";
    let post = if with_volume_test { post } else { "Sphere(name: \"c\", center: (0,0,0), radius: 0.1)" };
    let post = model("post", &steel, post);
    let mut objects = Vec::new();
    for (name, text) in [("tip", tip), ("post", post)] {
        let parsed =
            pong_model::parse(&text, name, None, &extensions).unwrap_or_else(|errors| panic!("{errors}"));
        let id = builder.add_model(Arc::new(parsed));
        objects.push(builder.create_object(id, name)?);
    }
    builder.pair(objects[0], objects[1])?;
    let (world, _) = builder.seal()?;
    let interfaces = [world.scene().interface(objects[0], "")?, world.scene().interface(objects[1], "")?];
    Ok((world, interfaces))
}

#[test]
fn a_registered_primitive_and_volume_take_part() {
    let (mut world, [tip, post]) = post_world(true).unwrap();
    world.set_state(post, &State::identity()).unwrap();
    world.set_state(tip, &at(Vec3::new(0.06, -0.07, 3.0), Quat::identity())).unwrap();
    world.step().unwrap();
    let expected = Vec3::new(0.06, -0.07, 0.0).normalize() * 1e5 * (0.1 - Vec3::new(0.06, -0.07, 0.0).norm());
    assert!((world.wrench(tip).unwrap().force - expected).norm() < 1e-9);
}

#[test]
fn a_missing_pair_of_volumes_is_an_error_at_seal() {
    match post_world(false) {
        Err(EngineError::Seal { problems }) => assert!(problems[0].contains("Everywhere"), "{problems:?}"),
        Ok(_) => panic!("sealed without a test of the volumes"),
        Err(other) => panic!("{other}"),
    }
}
