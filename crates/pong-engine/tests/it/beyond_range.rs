//! Values at the ends of their range: a frame that cannot be computed is refused, and the next good frame is
//! unaffected. Found by the fuzz targets (docs/fuzzing.md).

use pong_engine::{
    Config, EngineError, FrictionProps, InterfaceId, Laws, NormalForce, NormalInput, State, StateError,
    World, WorldBuilder, combine_surfaces,
};
use pong_model::{Exponent, Extensions, FrictionLaw, NormalLaw, Surface};
use std::sync::Arc;

const CHECKSUM: usize = 8;
/// Bytes of a block before its first f64: magic, version, count, world (`state/block.rs`).
const HEAD: usize = 24;

struct Rig {
    world: World,
    interfaces: [InterfaceId; 2],
}

impl Rig {
    /// A ball of 1 m on a ball of 1 m, with this stiffness (N/m) and normal law.
    fn new(stiffness: &str, normal: &str) -> Self {
        let text = format!(
            r#"(format: "pong-model", version: 1, name: "ball",
                surfaces: {{"s": (stiffness: 1.0, normal: Linear(damping: 1.0), friction: Bristle(mu: 0.3))}},
                pairs: [(surfaces: ("s", "s"), stiffness: {stiffness}, normal: {normal})],
                root: (name: "ball", surface: "s", primitives: [Sphere(name: "b", center: (0, 0, 0), radius: 1)]))"#
        );
        let mut laws = Laws::default();
        laws.add_normal("steep", Arc::new(Steep));
        let config = Config { ledger: true, contact_capacity: Some(2), ..Config::default() };
        let mut builder = WorldBuilder::with_extensions(config, Extensions::new(), laws);
        let model = pong_model::parse(&text, "ball", None, builder.scene().extensions()).unwrap();
        let model = builder.add_model(Arc::new(model));
        let objects = ["a", "b"].map(|name| builder.create_object(model, name).unwrap());
        builder.pair(objects[0], objects[1]).unwrap();
        let (world, _) = builder.seal().unwrap();
        let interfaces = objects.map(|object| world.scene().interface(object, "").unwrap());
        let mut rig = Self { world, interfaces };
        rig.set(0, [0.0; 3], 0.0);
        rig.set(1, [1.9, 0.1, 0.0], 0.1);
        rig
    }

    fn set(&mut self, which: usize, position: [f64; 3], speed: f64) {
        let mut state = State { position, ..State::identity() };
        state.linear_velocity = [-speed, speed, 0.0];
        self.world.set_state(self.interfaces[which], &state).unwrap();
    }

    fn saved(&self) -> Vec<u8> {
        let mut block = Vec::new();
        self.world.save_state_packed(&mut block);
        block
    }

    fn wrench_bits(&self) -> Vec<u64> {
        let wrench = self.world.wrench(self.interfaces[0]).unwrap();
        wrench.force.iter().chain(wrench.moment.iter()).map(|x| x.to_bits()).collect()
    }
}

/// A host's law near the largest number: finite at 0.1 m/s, overflowing at 100 m/s.
#[derive(Debug)]
struct Steep;

impl NormalForce for Steep {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        1e307 * input.rate.abs()
    }

    fn stored(&self, _: &NormalInput<'_>) -> f64 {
        0.0
    }
}

const STEEP: &str = r#"Custom(name: "steep", parameters: [])"#;
const SOFT: &str = "Linear(damping: 1.0)";

#[test]
fn a_frame_beyond_the_range_of_numbers_is_refused_and_leaves_no_trace() {
    let mut rig = Rig::new("1e6", STEEP);
    rig.set(1, [1.999, 0.0, 0.0], 0.1);
    rig.world.step().unwrap();
    let before = rig.saved();

    rig.set(1, [0.1, 0.0, 0.0], 100.0);
    match rig.world.step() {
        Err(EngineError::NotFinite { interface }) => assert!(interface.starts_with("a/"), "{interface}"),
        other => panic!("{other:?}"),
    }
    assert!(matches!(rig.world.wrench(rig.interfaces[0]), Err(EngineError::WrongPhase { .. })));
    assert!(matches!(rig.world.commit(), Err(EngineError::NotFinite { .. })));
    assert_eq!(
        (rig.world.contact_count(), rig.world.contacts().len()),
        (0, 0),
        "contacts of a refused frame"
    );
    assert_eq!(rig.saved(), before, "the contact state after a refused frame");

    rig.set(1, [1.999, 0.0, 0.0], 0.1);
    rig.world.restore_state(&before).unwrap();
    rig.world.evaluate().unwrap();
    let mut other = Rig::new("1e6", STEEP);
    other.world.restore_state(&before).unwrap();
    other.set(1, [1.999, 0.0, 0.0], 0.1);
    other.world.evaluate().unwrap();
    assert_eq!(rig.wrench_bits(), other.wrench_bits(), "a world that was never refused a frame");
}

#[test]
fn a_block_with_a_number_that_is_not_finite_is_refused_though_its_checksum_is_right() {
    let mut rig = Rig::new("1e6", SOFT);
    rig.world.step().unwrap();
    let good = rig.saved();
    let body = good.len() - CHECKSUM;
    // The unchanged block is valid, so that a refusal below is due to the changed number.
    let mut same = good.clone();
    make_checksum_right(&mut same);
    assert_eq!(same, good);
    let mut refused = 0;
    for at in (HEAD..body - 7).step_by(8) {
        for number in [f64::NAN, f64::INFINITY] {
            let mut block = good.clone();
            block[at..at + 8].copy_from_slice(&number.to_le_bytes());
            make_checksum_right(&mut block);
            match rig.world.restore_state(&block) {
                Err(error) => {
                    assert_eq!(error, EngineError::State(StateError::Damaged));
                    assert_eq!(rig.saved(), good);
                    refused += 1;
                }
                // Not the position of an f64, but of integers with arbitrary values.
                Ok(()) => {
                    let frame = rig.world.step();
                    assert!(frame.is_ok(), "a number that is not finite was accepted at {at}: {frame:?}");
                    assert!(
                        rig.wrench_bits().iter().all(|bits| f64::from_bits(*bits).is_finite()),
                        "at {at}"
                    );
                    rig.world.restore_state(&good).unwrap();
                }
            }
        }
    }
    // Two totals, two poses of seven, one record of fifteen numbers.
    assert!(refused >= 2 * (2 + 14 + 15), "{refused}");
}

fn surface(stiffness: f64, exponent: Exponent) -> Surface {
    let normal = match exponent {
        Exponent::One => NormalLaw::Linear { damping: 1.0, ramp: 0.0 },
        Exponent::ThreeHalves => NormalLaw::HuntCrossley { dissipation: 0.1, exponent },
    };
    let friction = FrictionLaw::Bristle {
        mu: 0.3,
        static_excess: 0.0,
        stiffness: Some(stiffness),
        damping: None,
        rolling: 0.0,
        spinning: 0.0,
    };
    Surface { name: "s".to_owned(), stiffness, foundation: None, area: None, normal, friction }
}

/// Two springs in series are softer than either, and at least half as stiff as the softer one, for any
/// stiffness.
#[test]
fn stiffnesses_at_the_ends_of_their_range_are_springs_in_series() {
    let ends = [Surface::SOFTEST, 1.0, Surface::STIFFEST];
    for exponent in [Exponent::One, Exponent::ThreeHalves] {
        for (k_a, k_b) in ends.into_iter().flat_map(|a| ends.into_iter().map(move |b| (a, b))) {
            let (a, b) = (surface(k_a, exponent), surface(k_b, exponent));
            let props = combine_surfaces(&a, &b, None, &Laws::default()).unwrap();
            let softer = k_a.min(k_b);
            assert!(props.stiffness <= softer && props.stiffness > 0.35 * softer, "{k_a} {k_b}: {props:?}");
            assert!((0.0..=1.0).contains(&props.share_a), "{props:?}");
            let FrictionProps::Bristle { stiffness, .. } = props.friction else { panic!("no bristle") };
            assert!(stiffness <= softer && stiffness >= 0.5 * softer, "{k_a} {k_b}: {stiffness}");
        }
    }
}

/// Extreme parameters of the built-in laws at the greatest speeds and rotations of a state: all results are
/// finite.
#[test]
fn what_a_model_may_say_stays_within_the_range_of_numbers() {
    for normal in [
        "Linear(damping: 1e100)",
        "HuntCrossley(dissipation: 1e100, exponent: 1.0)",
        "PowerLaw(exponent: 1.0, damping_exponent: 0.6, damping: 1e100)",
    ] {
        let mut rig = Rig::new("1e100", normal);
        for speed in [0.1, 1e50, State::LARGEST, -State::LARGEST] {
            rig.set(1, [0.1, 0.0, 0.0], speed);
            rig.world.step().unwrap_or_else(|error| panic!("{normal} at {speed}: {error}"));
            assert!(rig.wrench_bits().iter().all(|bits| f64::from_bits(*bits).is_finite()));
        }
    }
}

/// Maximum stiffness, at a depth of a metre and more: all results are finite.
#[test]
fn the_stiffest_contact_has_a_force() {
    let mut rig = Rig::new("1e100", SOFT);
    rig.set(1, [0.1, 0.0, 0.0], 0.1);
    rig.world.step().unwrap();
    let force = rig.world.wrench(rig.interfaces[0]).unwrap().force.norm();
    assert!((force / 1.9e100 - 1.0).abs() < 0.1, "{force}");
}

#[test]
fn stiffnesses_beyond_their_range_are_refused_by_name_and_change_nothing() {
    let mut rig = Rig::new("1e6", SOFT);
    let model = rig.world.scene().models().next().unwrap().0;
    let good = rig.world.surface(model, "s").unwrap().clone();
    for k in [1.01e100, f64::MAX, 0.99e-100, 5e-324] {
        let bad = Surface { stiffness: k, ..good.clone() };
        let bristle = FrictionLaw::Bristle {
            mu: 0.3,
            static_excess: 0.0,
            stiffness: Some(k),
            damping: None,
            rolling: 0.0,
            spinning: 0.0,
        };
        for bad in [bad, Surface { friction: bristle, ..good.clone() }] {
            match rig.world.set_surface(model, &bad) {
                Err(EngineError::BadValue { what, cause }) => {
                    assert!(what.contains("`s`") && cause.contains("1e-100 and 1e100"), "{what}: {cause}");
                }
                other => panic!("{k}: {other:?}"),
            }
        }
    }
    for damping in [1.01e100, f64::MAX] {
        let bad = Surface { normal: NormalLaw::Linear { damping, ramp: 0.0 }, ..good.clone() };
        assert!(matches!(rig.world.set_surface(model, &bad), Err(EngineError::BadValue { .. })), "{damping}");
        let rough = FrictionLaw::Bristle {
            mu: 0.3,
            static_excess: 0.0,
            stiffness: None,
            damping: Some(damping),
            rolling: 0.0,
            spinning: 0.0,
        };
        let bad = Surface { friction: rough, ..good.clone() };
        assert!(matches!(rig.world.set_surface(model, &bad), Err(EngineError::BadValue { .. })), "{damping}");
    }
    assert_eq!(rig.world.surface(model, "s").unwrap(), &good);
}

/// Rewrites the checksum, FNV-1a of everything before it.
fn make_checksum_right(block: &mut [u8]) {
    let body = block.len() - CHECKSUM;
    let checksum = pong_model::Fnv::of(&block[..body]);
    block[body..].copy_from_slice(&checksum.to_le_bytes());
}

/// Any integer of a block is changed: the block is refused, or frames continue, also after the contacts have
/// ended.
#[test]
fn a_block_that_names_what_is_not_there_is_refused_or_harmless() {
    let mut rig = Rig::new("1e6", SOFT);
    rig.world.step().unwrap();
    let good = rig.saved();
    for at in (HEAD..good.len() - CHECKSUM - 3).step_by(4) {
        for number in [1, 2, 0x4b6e_6f69, u32::MAX] {
            let mut block = good.clone();
            block[at..at + 4].copy_from_slice(&u32::to_le_bytes(number));
            make_checksum_right(&mut block);
            if rig.world.restore_state(&block).is_ok() {
                rig.set(1, [5.0, 0.0, 0.0], 0.0);
                rig.world.step().unwrap();
                rig.set(1, [1.9, 0.1, 0.0], 0.1);
            }
            rig.world.restore_state(&good).unwrap();
        }
    }
}
