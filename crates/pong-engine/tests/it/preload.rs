//! Preloaded friction, against Coulomb's law and the sum of parallel springs.

use crate::common::{Rig, at, load, model, moving, surface};
use pong_engine::{Config, EngineError, FrictionPreload, State, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const MU: f64 = 0.4;
const K: f64 = 1e5;
const DEPTH: f64 = 1e-4;
const FEET: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [-0.5, 0.8, 0.0], [-0.5, -0.8, 0.0]];

fn feet(friction: &str) -> String {
    let points: String = FEET
        .iter()
        .enumerate()
        .map(|(i, [x, y, z])| format!("Point(name: \"p{i}\", position: ({x:?}, {y:?}, {z:?})),"))
        .collect();
    model("feet", &surface(K, &format!("friction: {friction}")), &points)
}

fn bristle() -> String {
    format!("Bristle(mu: {MU:?}, static_excess: 0.25, stiffness: 7e4)")
}

fn floor() -> String {
    model("floor", "\"s\": (stiffness: inf)", "Plane(name: \"f\", normal: (0, 0, 1), offset: 0)")
}

/// A tilted and moved floor, and feet on it that slide along it and rotate about its normal.
fn place(rig: &mut Rig, q: Quat, origin: Vec3, velocity: Vec3, spin: f64, swapped: bool) {
    let ground = at(origin, q);
    let feet =
        moving(origin + q * Vec3::new(0.3, 0.2, -DEPTH), q, q * velocity, q * Vec3::new(0.0, 0.0, spin));
    rig.place(if swapped { [ground, feet] } else { [feet, ground] });
}

/// Every foot has kinetic friction against its own velocity in the first frame; without a preload it has
/// none.
#[test]
fn what_slides_has_its_kinetic_friction_from_the_first_frame_on() {
    let mut random = Random(3);
    for round in 0..40 {
        let (q, origin) = (random.rotation(), random.vector(10.0));
        let (velocity, spin) = (Vec3::new(random.between(-2.0, 2.0), 1.0, 0.0), random.between(-1.0, 1.0));
        let swapped = round % 2 == 1;
        let texts = if swapped { [floor(), feet(&bristle())] } else { [feet(&bristle()), floor()] };
        let mut rig = Rig::new(&texts[0], &texts[1]);
        place(&mut rig, q, origin, velocity, spin, swapped);
        rig.world.evaluate().unwrap();
        assert!(rig.world.contacts_iter().all(|contact| contact.friction_force.norm() < 1e-9));
        assert_eq!(rig.world.preload_friction(rig.pair, &FrictionPreload::Sliding).unwrap(), 3);
        for frame in 0..2 {
            rig.world.evaluate().unwrap();
            assert_eq!(rig.world.contacts_iter().count(), 3);
            for contact in rig.world.contacts_iter() {
                let expected = contact.slip_velocity * (-MU * K * DEPTH / contact.slip_velocity.norm());
                let off = (contact.friction_force - expected).norm() / (MU * K * DEPTH);
                // Positions up to 17 m away round a depth of 0.1 mm to 2e-11 of it.
                assert!(off < 1e-9 && !contact.sticks, "round {round}, frame {frame}: {off:e}");
            }
            rig.world.commit().unwrap();
        }
    }
}

/// Three feet hold a third of the force each, limited to μ_s·F_n; a component out of the floor is no
/// friction. At rest it stays so.
#[test]
fn what_holds_a_force_holds_it_from_the_first_frame_on() {
    let mut random = Random(4);
    let limit = 1.25 * MU * K * DEPTH;
    for round in 0..40 {
        let (q, origin) = (random.rotation(), random.vector(10.0));
        let swapped = round % 2 == 1;
        let texts = if swapped { [floor(), feet(&bristle())] } else { [feet(&bristle()), floor()] };
        let mut rig = Rig::new(&texts[0], &texts[1]);
        place(&mut rig, q, origin, Vec3::zeros(), 0.0, swapped);
        let size = if round < 20 { 0.9 } else { 1.5 } * 3.0 * limit;
        let angle = random.between(0.0, std::f64::consts::TAU);
        let along = q * Vec3::new(angle.cos(), angle.sin(), 0.0);
        let force = along * size + q * Vec3::new(0.0, 0.0, 5.0);
        assert_eq!(rig.world.preload_friction(rig.pair, &FrictionPreload::Holding(force)).unwrap(), 3);
        let held = along * size.min(3.0 * limit);
        for _ in 0..3 {
            rig.world.step().unwrap();
            let sum: Vec3 = rig.world.contacts_iter().map(|contact| contact.friction_force).sum();
            // A is the point, whichever Object was named first.
            let on_first = if swapped { -sum } else { sum };
            assert!((on_first - held).norm() < 1e-9 * size, "round {round}: {on_first} {held}");
            assert!(rig.world.contacts_iter().all(|contact| contact.sticks));
            for contact in rig.world.contacts_iter() {
                assert!((contact.friction_force * 3.0 - sum).norm() < 1e-9 * size);
            }
        }
        // ½K|p|² each. No work was done: the host inserted all that springs and bristles store.
        let pressed = 3.0 * 0.5 * K * DEPTH * DEPTH;
        let stored = pressed + 3.0 * 0.5 * (held.norm() / 3.0).powi(2) / 7e4;
        let ledger = rig.world.ledger();
        assert!((ledger.stored / stored - 1.0).abs() < 1e-8, "{ledger:?} {stored}");
        assert!(
            ledger.work.abs() < 1e-9 * stored && (ledger.dissipated + stored).abs() < 1e-8 * stored,
            "{ledger:?}"
        );
    }
}

/// Contacts without a bristle, without load, or of another pair are unchanged.
#[test]
fn only_bristles_of_the_pair_are_preloaded() {
    for friction in ["None", "Coulomb(mu: 0.4, slip_speed: 1e-3)"] {
        let mut rig = Rig::new(&feet(friction), &floor());
        place(&mut rig, Quat::identity(), Vec3::zeros(), Vec3::x(), 0.0, false);
        assert_eq!(rig.world.preload_friction(rig.pair, &FrictionPreload::Sliding).unwrap(), 0);
    }
    let mut builder = WorldBuilder::new(Config::default());
    let models = [feet(&bristle()), floor()].map(|text| load(&mut builder, &text));
    let objects = [(0, "one"), (0, "two"), (1, "floor")]
        .map(|(m, name)| builder.create_object(models[m], name).unwrap());
    let pairs = [0, 1].map(|i| builder.pair(objects[i], objects[2]).unwrap());
    let (mut world, _) = builder.seal().unwrap();
    let sliding = moving(Vec3::new(0.0, 0.0, -DEPTH), Quat::identity(), Vec3::x(), Vec3::zeros());
    for (object, state) in objects.into_iter().zip([sliding, sliding, State::identity()]) {
        world.set_state(world.scene().interface(object, "").unwrap(), &state).unwrap();
    }
    assert_eq!(world.preload_friction(pairs[1], &FrictionPreload::Sliding).unwrap(), 3);
    world.evaluate().unwrap();
    for contact in world.contacts_iter() {
        let expected = if contact.pair == pairs[1] { MU * K * DEPTH } else { 0.0 };
        assert!((contact.friction_force.norm() - expected).abs() < 1e-12, "{contact:?}");
    }
}

#[test]
fn preloads_that_cannot_be_are_refused() {
    let mut builder = WorldBuilder::new(Config::default());
    let models = [feet(&bristle()), floor()].map(|text| load(&mut builder, &text));
    let objects =
        [builder.create_object(models[0], "a").unwrap(), builder.create_object(models[1], "b").unwrap()];
    let pair = builder.pair(objects[0], objects[1]).unwrap();
    let sliding = FrictionPreload::Sliding;
    let (mut world, _) = builder.seal().unwrap();
    assert!(matches!(world.preload_friction(pair, &sliding), Err(EngineError::UnsetState { .. })));
    let mut rig = Rig::new(&feet(&bristle()), &floor());
    assert!(matches!(rig.world.preload_friction(pair, &sliding), Err(EngineError::UnknownId { .. })));
    rig.place_a(Vec3::new(0.0, 0.0, -DEPTH), Quat::identity());
    let before = rig.world.state_used();
    let wrong = FrictionPreload::Holding(Vec3::new(f64::NAN, 0.0, 0.0));
    assert!(matches!(rig.world.preload_friction(rig.pair, &wrong), Err(EngineError::BadValue { .. })));
    assert_eq!(rig.world.state_used(), before);
}
