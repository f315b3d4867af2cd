//! Regression tests, named after the symptoms.

use crate::common::{Rig, at, load, model, surface};
use pong_engine::{
    Config, EngineError, Laws, NormalForce, NormalInput, ObjectId, State, StatusBits, World, WorldBuilder,
};
use pong_geometry::extension::PrimitiveRef;
use pong_geometry::interference::{Feature, Interference};
use pong_geometry::primitive::CustomPrimitive;
use pong_geometry::{Quat, Transform, Vec3};
use pong_model::Extensions;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

const FLOOR: &str = "Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)";

#[derive(Debug)]
struct Blob(&'static str);

impl CustomPrimitive for Blob {
    fn kind_name(&self) -> &str {
        self.0
    }
    fn support(&self, direction: &Vec3) -> f64 {
        direction.norm()
    }
    fn as_any(&self) -> &dyn std::any::Any {
        self
    }
}

/// Extensions with two custom kinds; the named kinds always touch.
fn blobs(kind_a: &str, kind_b: &str) -> Extensions {
    let mut extensions = Extensions::new();
    for kind in ["Torus", "Cone"] {
        let make = move |_: &[f64]| Ok(Arc::new(Blob(kind)) as Arc<dyn CustomPrimitive>);
        extensions.add_primitive(kind, Arc::new(make));
    }
    let touch = |_: PrimitiveRef<'_>, _: PrimitiveRef<'_>, _: &Transform| {
        let (normal_b, deepest_b) = (Vec3::z(), Vec3::zeros());
        Some(Interference { depth: 1e-3, normal_b, deepest_b, feature: Feature::WHOLE })
    };
    extensions.add_contact_test(kind_a, kind_b, Arc::new(touch));
    extensions
}

/// A world of two Objects at the origin, paired in either order.
fn two(extensions: Extensions, primitives: [&str; 2], reversed: bool) -> World {
    let mut builder = WorldBuilder::with_extensions(Config::default(), extensions, Laws::default());
    let models = primitives.map(|text| {
        let text = model("m", &surface(1e5, ""), text);
        let model = pong_model::parse(&text, "m.ron", None, builder.scene().extensions());
        builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}"))))
    });
    let objects: [ObjectId; 2] = [0, 1].map(|i| builder.create_object(models[i], ["a", "b"][i]).unwrap());
    builder.pair(objects[usize::from(reversed)], objects[usize::from(!reversed)]).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    for object in objects {
        let interface = world.scene().interface(object, "").unwrap();
        world.set_state(interface, &State::identity()).unwrap();
    }
    world
}

#[test]
fn a_ray_hits_one_plane_whatever_a_registered_test_finds_for_it() {
    let ray = "Ray(name: \"r\", origin: (0,0,0.5), direction: (0,0,-1), length: 1.0)";
    let torus = "Custom(name: \"t\", kind: \"Torus\", parameters: [])";
    let planes =
        "Plane(name: \"f\", normal: (0,0,1), offset: 0.0), Plane(name: \"g\", normal: (0,0,1), offset: -0.1)";
    for parts in [format!("{torus}, {planes}"), format!("{planes}, {torus}")] {
        let mut world = two(blobs("Ray", "Torus"), [ray, &parts], false);
        world.step().unwrap();
        assert_eq!(world.contacts().len(), 2, "the nearer plane and the torus: {parts}");
    }
}

#[test]
fn two_kinds_of_ones_own_touch_in_either_order_of_pairing() {
    let parts =
        ["Torus", "Cone"].map(|kind| format!("Custom(name: \"c\", kind: \"{kind}\", parameters: [])"));
    for reversed in [false, true] {
        let mut world = two(blobs("Torus", "Cone"), [&parts[0], &parts[1]], reversed);
        world.step().unwrap();
        assert_eq!(world.contacts().len(), 1, "reversed: {reversed}");
        let mut alike = two(blobs("Torus", "Torus"), [&parts[0], &parts[0]], reversed);
        alike.step().unwrap();
        assert_eq!(alike.contacts().len(), 1, "of one kind only once");
    }
}

#[test]
fn an_endless_floor_holds_a_ball_wherever_it_is_though_a_mesh_lies_beside() {
    let mesh = "Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(0,1,0)), thickness: 0.01)";
    let steel = surface(1e5, "");
    let ground = model("ground", &steel, &format!("{mesh}, {FLOOR}"));
    // A single ball is tested with its own box, several by the floor's tree together.
    for balls in [1, 3] {
        let each = |i| format!("Sphere(name: \"s{i}\", center: (0, {i}, 0), radius: 0.1)");
        let spheres: Vec<String> = (0..balls).map(each).collect();
        let mut rig = Rig::new(&model("balls", &steel, &spheres.join(", ")), &ground);
        for x in [-1e6, 1e37, 1e39, 1e50, 1e99] {
            rig.place([at(Vec3::new(x, 0.0, 0.09), Quat::identity()), State::identity()]);
            rig.world.evaluate().unwrap();
            assert_eq!(rig.world.contacts().len(), balls, "{x:e}");
        }
    }
}

/// A law that panics on demand.
#[derive(Debug, Default)]
struct Moody(AtomicBool);

impl NormalForce for Moody {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        assert!(!self.0.load(Relaxed), "moody");
        input.stiffness * input.depth
    }
    fn stored(&self, input: &NormalInput<'_>) -> f64 {
        0.5 * input.stiffness * input.depth * input.depth
    }
}

#[test]
fn a_frame_in_which_a_law_panicked_is_no_frame() {
    let law = Arc::new(Moody::default());
    let mut laws = Laws::default();
    laws.add_normal("moody", law.clone());
    let own = surface(1e5, "normal: Custom(name: \"moody\", parameters: [])");
    let mut builder = WorldBuilder::with_extensions(Config::default(), Extensions::new(), laws);
    let models = ["Point(name: \"p\", position: (0,0,-1e-3))", FLOOR]
        .map(|parts| load(&mut builder, &model("m", &own, parts)));
    let objects = [0, 1].map(|i| builder.create_object(models[i], ["a", "b"][i]).unwrap());
    builder.pair(objects[0], objects[1]).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let interfaces = objects.map(|object| world.scene().interface(object, "").unwrap());
    interfaces.iter().for_each(|&i| world.set_state(i, &State::identity()).unwrap());
    for _ in 0..2 {
        law.0.store(true, Relaxed);
        assert!(catch_unwind(AssertUnwindSafe(|| world.evaluate())).is_err());
        law.0.store(false, Relaxed);
        assert!(!world.is_evaluated());
        assert!(matches!(world.wrench(interfaces[0]), Err(EngineError::WrongPhase { .. })));
        world.commit().unwrap();
        assert!(
            (world.wrench(interfaces[0]).unwrap().force.z - 50.0).abs() < 1e-9,
            "commit computes it first"
        );
    }
}

#[test]
fn pairs_committed_at_different_times_that_are_too_many_ask_for_enough() {
    let touching = |capacity: usize| {
        let mut builder = WorldBuilder::new(Config { contact_capacity: Some(capacity), ..Config::default() });
        let balls: String =
            (0..3).map(|i| format!("Sphere(name: \"b{i}\", center: ({i},0,0), radius: 0.1),")).collect();
        let (balls, floor) = (
            load(&mut builder, &model("a", &surface(1e5, ""), &balls)),
            load(&mut builder, &model("b", &surface(1e5, ""), FLOOR)),
        );
        let floor = builder.create_object(floor, "floor").unwrap();
        let floor_root = builder.scene().interface(floor, "").unwrap();
        builder.set_states(&[(floor_root, State::identity())]).unwrap();
        let above: Vec<_> =
            (0..3).map(|k| builder.create_object(balls, &format!("balls {k}")).unwrap()).collect();
        let pairs: Vec<_> = above.iter().map(|&balls| builder.pair(balls, floor).unwrap()).collect();
        let (mut world, _) = builder.seal().unwrap();
        for (now, &pair) in pairs.iter().enumerate() {
            for (k, &balls) in above.iter().enumerate() {
                let height = if k == now { 0.09 } else { 1.0 };
                let root = world.scene().interface(balls, "").unwrap();
                world.set_state(root, &at(Vec3::new(0.0, 0.0, height), Quat::identity())).unwrap();
            }
            world.evaluate().unwrap();
            world.commit_pairs(&[pair]).unwrap();
        }
        world.report()
    };
    let tight = touching(4);
    assert!(tight.status.contains(StatusBits::CONTACT_LIMIT) && tight.contacts_wanted > 4);
    assert!(touching(tight.contacts_wanted as usize).status.is_complete());
}
