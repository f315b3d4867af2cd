//! Set-up: many Objects of one model, several movable groups, pairs, limits, surfaces, wrong calls.

use crate::common::*;
use pong_engine::{Config, EngineError, SetupWarning, State, StatusBits, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_model::{FrictionLaw, NormalLaw};

fn floor() -> String {
    model("floor", &surface(1e5, ""), "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)")
}

fn tip() -> String {
    model("tip", &surface(1e5, ""), "Point(name: \"p\", position: (0,0,0))")
}

/// A hand with two fingers, each a movable group.
fn hand() -> String {
    let steel = surface(1e5, "");
    let finger = |name: &str, x: f64| {
        format!(
            "(name: \"{name}\", movable: true, pose: (position: ({x:?},0,0)), primitives: [\
             Point(name: \"tip\", position: (0,0,0)), Sphere(name: \"pad\", center: (0,0,0.2), radius: 0.1)])"
        )
    };
    format!(
        "(format: \"pong-model\", version: 1, name: \"hand\", surfaces: {{ {steel} }}, root: (name: \"palm\", surface: \"s\", \
         groups: [{}, {}, (name: \"skin\", primitives: [Sphere(name: \"heel\", center: (0,0,-0.5), radius: 0.1)])]))",
        finger("left", -0.3),
        finger("right", 0.3)
    )
}

#[test]
fn one_model_makes_many_independent_objects() {
    let mut builder = WorldBuilder::new(Config::default());
    let (tips, floor) = (load(&mut builder, &tip()), load(&mut builder, &floor()));
    let ground = builder.create_object(floor, "ground").unwrap();
    let objects: Vec<_> = (0..100)
        .map(|i| {
            let object = builder.create_object(tips, &format!("tip{i}")).unwrap();
            builder.pair(object, ground).unwrap();
            object
        })
        .collect();
    let (mut world, _) = builder.seal().unwrap();
    let interfaces: Vec<_> =
        objects.iter().map(|object| world.scene().interface(*object, "").unwrap()).collect();
    world.set_state(world.scene().interface(ground, "").unwrap(), &State::identity()).unwrap();
    for (i, interface) in interfaces.iter().enumerate() {
        world.set_state(*interface, &at(Vec3::new(0.0, 0.0, -1e-4 * i as f64), Quat::identity())).unwrap();
    }
    world.step().unwrap();
    for (i, interface) in interfaces.iter().enumerate() {
        let force = world.wrench(*interface).unwrap().force.z;
        assert!((force - 5e4 * 1e-4 * i as f64).abs() < 1e-9);
    }
}

#[test]
fn every_movable_group_has_its_own_interface() {
    let mut builder = WorldBuilder::new(Config::default());
    let (hands, floor) = (load(&mut builder, &hand()), load(&mut builder, &floor()));
    let (hand, ground) =
        (builder.create_object(hands, "hand").unwrap(), builder.create_object(floor, "ground").unwrap());
    builder.pair(hand, ground).unwrap();
    builder.pair(hand, hand).unwrap();
    let (mut world, _) = builder.seal().unwrap();
    assert_eq!(world.scene().interfaces(hand).unwrap().len(), 3);
    let [palm, left, right] =
        ["", "left", "palm/right"].map(|path| world.scene().interface(hand, path).unwrap());
    let authored = world.scene().authored_pose(right).unwrap();
    assert_eq!(authored.position, Vec3::new(0.3, 0.0, 0.0));
    world.set_state(world.scene().interface(ground, "").unwrap(), &State::identity()).unwrap();
    world.set_state(palm, &at(Vec3::new(0.0, 0.0, 2.0), Quat::identity())).unwrap();
    world.set_state(left, &at(Vec3::new(0.0, 0.0, -1e-3), Quat::identity())).unwrap();
    world.set_state(right, &at(Vec3::new(0.19, 0.0, 0.5), Quat::identity())).unwrap();
    world.step().unwrap();
    assert!((world.wrench(left).unwrap().force.z - 50.0).abs() < 1e-9);
    assert_eq!(world.wrench(palm).unwrap().force, Vec3::zeros());
    // Brought together, the two pads press each other, because the hand is paired with itself.
    world.set_state(right, &at(Vec3::new(0.19, 0.0, -1e-3), Quat::identity())).unwrap();
    world.step().unwrap();
    assert!((world.wrench(left).unwrap().force.x + 5e4 * 0.01).abs() < 1e-6);
    let unknown = world.scene().interface(hand, "thumb").unwrap_err().to_string();
    assert!(unknown.contains("hand/thumb") && unknown.contains("palm/left"), "{unknown}");
}

#[test]
fn a_ray_stops_at_the_first_surface_of_an_object() {
    let walls = [
        box_polyhedron("far", [0.0, 0.0, -1.0], [0.5, 0.5, 0.2], ""),
        "Plane(name: \"near\", normal: (0,0,1), offset: -0.5)".to_owned(),
        plate_mesh("middle", 1, 1.0, |x, y| Vec3::new(x, y, -0.6)),
    ];
    let walls = model("walls", &surface(1e5, ""), &walls.join(","));
    let plunger = "Ray(name: \"r\", origin: (0.1,0.2,0), direction: (0,0,-1), length: 0.9)";
    let plunger = model("plunger", &surface(1e5, ""), plunger);
    let mut rig = Rig::new(&plunger, &walls);
    rig.place_a(Vec3::zeros(), Quat::identity());
    rig.world.step().unwrap();
    let contacts = rig.world.contacts();
    assert_eq!(contacts.len(), 1);
    assert!((contacts[0].depth - 0.4).abs() < 1e-15);
    assert_eq!(
        rig.world.scene().primitive_path(contacts[0].b.interface, contacts[0].b.primitive).unwrap(),
        "walls/near"
    );
}

/// With more contacts than capacity, the deepest are kept and the frame reports it; the next frame that fits
/// is exact.
#[test]
fn the_contact_limit_keeps_the_deepest_and_tells() {
    let points: Vec<String> = (0..10)
        .map(|i| format!("Point(name: \"p{i}\", position: ({i},0,{:?}))", 1e-4 * f64::from(i)))
        .collect();
    let comb = model("comb", &surface(1e5, ""), &points.join(","));
    let config = Config { contact_capacity: Some(4), ..Config::default() };
    let (mut tight, mut roomy) = (Rig::with_config(config, &comb, &floor()), Rig::new(&comb, &floor()));
    for rig in [&mut tight, &mut roomy] {
        rig.place_a(Vec3::new(0.0, 0.0, -1.05e-3), Quat::identity());
        rig.world.step().unwrap();
    }
    let report = tight.world.report();
    assert!(report.status.contains(StatusBits::CONTACT_LIMIT));
    assert_eq!((report.contacts, report.contacts_wanted), (4, 10));
    let kept: Vec<u32> = tight.world.contacts().iter().map(|c| c.a.primitive).collect();
    assert_eq!(kept, [0, 1, 2, 3]);
    for rig in [&mut tight, &mut roomy] {
        rig.place_a(Vec3::new(0.0, 0.0, -0.35e-3), Quat::identity());
        rig.world.step().unwrap();
    }
    assert!(tight.world.report().status.is_complete());
    assert_eq!(tight.wrench(0), roomy.wrench(0));
}

#[test]
fn surface_values_change_between_frames_and_laws_do_not() {
    let mut rig = Rig::new(&tip(), &floor());
    let model = rig.models[0];
    let mut soft = rig.world.surface(model, "s").unwrap().clone();
    rig.place_a(Vec3::new(0.0, 0.0, -1e-3), Quat::identity());
    rig.world.step().unwrap();
    assert!((rig.wrench(0).force.z - 50.0).abs() < 1e-9);
    soft.stiffness = 1e5 / 3.0;
    rig.world.set_surface(model, &soft).unwrap();
    rig.world.step().unwrap();
    assert!((rig.wrench(0).force.z - 25.0).abs() < 1e-9);
    for bad in [f64::NAN, 0.0, -1.0] {
        let surface = pong_model::Surface { stiffness: bad, ..soft.clone() };
        assert!(matches!(rig.world.set_surface(model, &surface), Err(EngineError::BadValue { .. })));
    }
    let other_law = pong_model::Surface {
        normal: NormalLaw::HuntCrossley { dissipation: 0.1, exponent: pong_model::Exponent::One },
        ..soft.clone()
    };
    assert!(rig.world.set_surface(model, &other_law).is_err());
    let power_law = pong_model::Surface {
        normal: NormalLaw::PowerLaw {
            damping: 1.0,
            exponent: pong_model::Exponent::One,
            damping_exponent: 0.0,
        },
        ..soft.clone()
    };
    assert!(rig.world.set_surface(model, &power_law).is_err());
    let rough = pong_model::Surface { friction: FrictionLaw::Coulomb { mu: 0.1, slip_speed: 1e-3 }, ..soft };
    assert!(rig.world.set_surface(model, &rough).is_err());
    rig.world.step().unwrap();
    assert!((rig.wrench(0).force.z - 25.0).abs() < 1e-9);
}

#[test]
fn calls_that_come_twice_too_early_or_of_another_world_are_refused() {
    let mut builder = WorldBuilder::new(Config::default());
    let tips = load(&mut builder, &tip());
    let object = builder.create_object(tips, "a").unwrap();
    assert!(matches!(builder.create_object(tips, "a"), Err(EngineError::Duplicate { .. })));
    for unfit in ["", "a/b"] {
        assert!(matches!(builder.create_object(tips, unfit), Err(EngineError::BadValue { .. })));
    }
    assert!(matches!(builder.pair(object, object), Err(EngineError::BadValue { .. })));
    let other = Rig::new(&tip(), &floor());
    assert!(matches!(builder.pair(object, other.objects[1]), Err(EngineError::UnknownId { .. })));
    assert!(matches!(builder.scene().interface(other.objects[0], ""), Err(EngineError::UnknownId { .. })));
    let second = builder.create_object(tips, "b").unwrap();
    builder.pair(object, second).unwrap();
    assert!(matches!(builder.pair(second, object), Err(EngineError::Duplicate { .. })));
    // Points against points: nothing to test, which is reported.
    let (world, report) = builder.seal().unwrap();
    assert!(report.warnings.iter().any(|w| matches!(w, SetupWarning::NothingToTest { .. })));
    assert!(report.warnings.iter().any(|w| matches!(w, SetupWarning::IgnoredPair { .. })));
    let interface = world.scene().interface(object, "").unwrap();
    assert!(matches!(world.wrench(interface), Err(EngineError::WrongPhase { .. })));
}

#[test]
fn surfaces_that_do_not_go_together_are_all_named_at_seal() {
    let two_rigid = |name: &str, primitive: &str| {
        let surfaces = "\"s\": (stiffness: inf, normal: Linear(damping: 0)), \"t\": (stiffness: 1e5, normal: HuntCrossley(dissipation: 0.1, exponent: 1.0))";
        model(name, surfaces, primitive)
    };
    let mut builder = WorldBuilder::new(Config::default());
    let a = load(
        &mut builder,
        &two_rigid(
            "a",
            "Point(name: \"p\", position: (0,0,0)), Point(name: \"q\", position: (1,0,0), surface: \"t\")",
        ),
    );
    let b = load(&mut builder, &two_rigid("b", "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"));
    let (a, b) = (builder.create_object(a, "a").unwrap(), builder.create_object(b, "b").unwrap());
    builder.pair(a, b).unwrap();
    let error = builder.seal().err().unwrap();
    let EngineError::Seal { problems } = error.error() else { panic!("{error}") };
    assert_eq!(problems.len(), 2, "{problems:?}");
}

/// Nothing is lost: the fault can be corrected in the builder that is returned.
#[test]
fn a_refused_seal_gives_the_builder_back() {
    let rigid = "\"s\": (stiffness: inf, normal: Linear(damping: 0), friction: None)";
    let mut builder = WorldBuilder::new(Config::default());
    let tip = load(&mut builder, &model("tip", rigid, "Point(name: \"p\", position: (0,0,0))"));
    let floor =
        load(&mut builder, &model("floor", rigid, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)"));
    let objects = [tip, floor].map(|model| builder.create_object(model, &format!("{model:?}")).unwrap());
    builder.pair(objects[0], objects[1]).unwrap();
    let roots = objects.map(|object| builder.scene().interface(object, "").unwrap());
    builder.set_states(&[(roots[1], State::identity())]).unwrap();
    let (mut builder, error) = builder.seal().err().unwrap().into_parts();
    assert!(error.to_string().contains("tip/s") && error.to_string().contains("rigid"), "{error}");
    assert_eq!((builder.scene().objects().len(), builder.scene().pairs().len()), (2, 1));
    let soft = pong_model::Surface { stiffness: 1e5, ..builder.surface(tip, "s").unwrap().clone() };
    builder.set_surface(tip, &soft).unwrap();
    let (mut world, report) = builder.seal().unwrap();
    assert_eq!(report.group_pairs, 1);
    assert_eq!(world.state_as_set(roots[1]), Ok(Some(&State::identity())));
    world.set_state(roots[0], &at(Vec3::new(0.0, 0.0, -1e-3), Quat::identity())).unwrap();
    world.step().unwrap();
    assert!((world.wrench(roots[0]).unwrap().force.z - 100.0).abs() < 1e-9);
}

/// Stored energy, work and dissipation: the ledger balances over a bounce, with and without damping.
#[test]
fn the_ledger_closes() {
    for damping in [0.0, 30.0] {
        let rubber =
            surface(1e5, &format!("normal: Linear(damping: {damping:?}), friction: Bristle(mu: 0.4)"));
        let ball = model("ball", &rubber, "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)");
        let ground = model("ground", &rubber, "Plane(name: \"f\", normal: (0,0,1), offset: 0.0)");
        let mut errors = Vec::new();
        for steps in [1000, 2000, 4000] {
            let mut rig = Rig::new(&ball, &ground);
            let (mut work, mut before) = (0.0, (Vec3::zeros(), Vec3::zeros()));
            for i in 0..=steps {
                let t = f64::from(i) / f64::from(steps);
                let dip = (std::f64::consts::PI * t).sin();
                let position = Vec3::new(0.002 * t, 0.0, 0.1001 - 0.001 * dip);
                let velocity =
                    Vec3::new(0.02, 0.0, -0.01 * std::f64::consts::PI * (std::f64::consts::PI * t).cos());
                rig.place([moving(position, Quat::identity(), velocity, Vec3::zeros()), State::identity()]);
                rig.world.step().unwrap();
                let force = rig.wrench(0).force;
                if i > 0 {
                    work += 0.5 * (force + before.1).dot(&(position - before.0));
                }
                before = (position, force);
                for c in rig.world.contacts() {
                    assert!((c.work + c.stored + c.dissipated).abs() < 1e-15);
                }
            }
            let ledger = rig.world.ledger();
            assert_eq!(ledger.stored, 0.0);
            assert!((ledger.work - work).abs() < 1e-12 + 1e-9 * work.abs());
            assert!((ledger.work + ledger.dissipated).abs() < 1e-15 + 1e-12 * ledger.work.abs());
            assert!(ledger.dissipated > 0.0, "friction slid and dissipated");
            errors.push(ledger.dissipated);
        }
        // The trapezoidal error converges with the step.
        assert!((errors[2] - errors[1]).abs() <= 0.6 * (errors[1] - errors[0]).abs() + 1e-9);
    }
}

/// Finite states with infinite squares would produce NaN: they are refused, and the previous frame stays
/// valid.
#[test]
fn a_state_beyond_any_scene_is_refused() {
    let mut rig = Rig::new(&tip(), &floor());
    rig.place_a(Vec3::new(0.0, 0.0, -0.1), Quat::identity());
    rig.world.step().unwrap();
    let before = rig.wrench(0);
    let far = at(Vec3::new(1e308, 0.0, -1e308), Quat::identity());
    let fast = moving(Vec3::zeros(), Quat::identity(), Vec3::new(0.0, -1e200, 0.0), Vec3::zeros());
    for state in [far, fast] {
        let error = rig.world.set_state(rig.interfaces[0], &state).unwrap_err().to_string();
        assert!(error.contains("`a/tip`") && error.contains("1e100"), "{error}");
    }
    assert_eq!(rig.wrench(0), before);
    rig.place_a(Vec3::new(0.0, 0.0, -1e100), Quat::identity());
    rig.world.step().unwrap();
    assert!(rig.wrench(0).force.z.is_finite());
}
