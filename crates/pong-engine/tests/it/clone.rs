//! A clone of a sealed world continues bit-identically, and independently if it gets other calls.

use crate::common::*;
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use std::sync::Arc;

const FLOOR: &str = "Plane(name: \"f\", normal: (0, 0, 1), offset: 0)";

/// Balls that rub over a floor, with energies and accounts.
fn rig(workers: Option<WorkerSettings>) -> Rig {
    let rough = surface(1e5, "normal: Linear(damping: 50.0), friction: Bristle(mu: 0.5, static_excess: 0.2)");
    let balls: Vec<String> = (0..40)
        .map(|i| format!("Sphere(name: \"b{i}\", center: ({:?}, {:?}, 0.1), radius: 0.1)", i % 8, i / 8))
        .collect();
    let accounts = Some(WrenchCoupling::SemiImplicit);
    let config = Config { accounts, workers, contact_capacity: Some(64), ..Config::default() };
    Rig::with_config(config, &model("balls", &rough, &balls.join(",")), &model("floor", &rough, FLOOR))
}

fn workers() -> Option<WorkerSettings> {
    Some(WorkerSettings { workers: 2, oversubscribe: true, ..WorkerSettings::default() })
}

/// States of both bodies in a frame: a path that sticks, slips, rotates, lifts off and comes down again.
fn states(frame: usize) -> [State; 2] {
    let t = frame as f64 * 0.05;
    let height = -2e-3 * (t.sin() + 0.6);
    let turn = Quat::from_scaled_axis(Vec3::new(1e-4 * t.cos(), 1e-4, 0.01 * t));
    let place = Vec3::new(1e-3 * (3.0 * t).sin(), 2e-3 * t, height);
    [
        moving(place, turn, Vec3::new(0.06 * t.cos(), 0.04, -0.04 * t.cos()), Vec3::z() * 0.2),
        State::identity(),
    ]
}

/// All results of a step, as bits.
fn step(world: &mut World, sides: [InterfaceId; 2], states: [State; 2]) -> Vec<u64> {
    world.set_states(&[(sides[0], states[0]), (sides[1], states[1])]).unwrap();
    world.step().unwrap();
    let mut block = Vec::new();
    world.save_state_packed(&mut block);
    let wrenches = sides.map(|side| world.wrench(side).unwrap());
    let numbers = wrenches.iter().flat_map(|wrench| wrench.force.iter().chain(wrench.moment.iter()).copied());
    let contacts = world.contacts_iter().flat_map(|contact| <[f64; 3]>::from(contact.force));
    let numbers = numbers.chain(contacts).map(f64::to_bits);
    numbers.chain(block.iter().map(|byte| u64::from(*byte))).collect()
}

#[test]
fn a_clone_continues_to_the_same_bits_with_workers_and_without() {
    for workers in [None, workers()] {
        let Rig { mut world, interfaces: sides, .. } = rig(workers);
        let (mut touched, mut apart) = (0, 0);
        for begin in [0, 7, 60, 100] {
            let mut clone = world.try_clone().unwrap();
            assert_eq!(clone.worker_starts().len(), world.worker_starts().len());
            assert_eq!((clone.scene_hash(), clone.account()), (world.scene_hash(), world.account()));
            for frame in begin..begin + 40 {
                let expected = step(&mut world, sides, states(frame));
                assert_eq!(step(&mut clone, sides, states(frame)), expected, "frame {frame} after {begin}");
                touched += world.contact_count();
                apart += usize::from(world.contact_count() == 0);
            }
        }
        assert!(touched > 1000 && apart > 5, "{touched} contacts, {apart} frames without");
    }
}

#[test]
fn a_clone_and_its_origin_go_their_own_ways() {
    let [Rig { mut world, models, objects, pair, interfaces: sides }, untouched] = [rig(None), rig(None)];
    let (mut untouched, other_sides) = (untouched.world, untouched.interfaces);
    for frame in 0..20 {
        assert_eq!(
            step(&mut world, sides, states(frame)),
            step(&mut untouched, other_sides, states(frame)),
            "{frame}"
        );
    }
    let mut clone = world.try_clone().unwrap();
    let hard = pong_model::Surface { stiffness: 3e5, ..clone.surface(models[0], "s").unwrap().clone() };
    clone.set_surface(models[0], &hard).unwrap();
    let mut other = world.try_clone().unwrap();
    other.clear_contact_history(objects[0]).unwrap();
    let mut off = world.try_clone().unwrap();
    off.set_pair_enabled(pair, false).unwrap();
    let mut differ = [false; 2];
    for frame in 20..60 {
        let expected = step(&mut untouched, other_sides, states(frame));
        differ[0] |= step(&mut clone, sides, states(frame)) != expected;
        differ[1] |= step(&mut other, sides, states(frame)) != expected;
        step(&mut off, sides, states(frame));
        assert_eq!(off.contact_count(), 0);
        assert_eq!(step(&mut world, sides, states(frame)), expected, "{frame}");
    }
    assert_eq!(differ, [true, true]);
    // Changes before the clone are part of it.
    let second = clone.try_clone().unwrap();
    assert_eq!(second.surface(models[0], "s"), Ok(&hard));
    assert_eq!(second.state_as_set(sides[0]), Ok(Some(&states(59)[0])));
    assert_eq!(off.try_clone().unwrap().pair_enabled(pair), Ok(false));
}

#[test]
fn a_clone_has_no_frame_before_its_first() {
    let Rig { mut world, interfaces: sides, .. } = rig(None);
    let expected = step(&mut world, sides, states(3));
    let mut clone = world.try_clone().unwrap();
    assert!(matches!(clone.wrench(sides[0]), Err(EngineError::WrongPhase { .. })));
    assert_eq!((clone.contact_count(), clone.is_evaluated()), (0, false));
    // The states are copied; none need be set.
    clone.evaluate().unwrap();
    world.evaluate().unwrap();
    assert_eq!(clone.wrench(sides[0]), world.wrench(sides[0]));
    assert!(!expected.is_empty());
    // The original may be dropped.
    drop(world);
    clone.step().unwrap();
}

#[test]
fn laws_of_a_clone_must_be_those_of_the_world() {
    let world = rig(None).world;
    assert!(world.try_clone_with_laws(Laws::default()).is_ok());
    let mut laws = Laws::default();
    laws.add_normal("stray", Arc::new(Stray));
    let refused = world.try_clone_with_laws(laws).err().unwrap().to_string();
    assert!(refused.contains("laws of a clone") && refused.contains("same name"), "{refused}");
}

#[derive(Debug)]
struct Stray;

impl NormalForce for Stray {
    fn force(&self, input: &NormalInput<'_>) -> f64 {
        input.stiffness * input.depth
    }

    fn stored(&self, _: &NormalInput<'_>) -> f64 {
        0.0
    }
}
