//! Many Objects, all paired: every pair finds the same as in a world of its own, where every pair is visited.

use crate::common::*;
use pong_engine::{Config, InterfaceId, State, StatusBits, World, WorldBuilder};
use pong_geometry::Vec3;
use std::sync::Arc;

const COUNT: usize = 36;
const FRAMES: usize = 25;

fn world_of(count: usize, contacts: impl Into<Option<usize>>) -> (World, Vec<InterfaceId>) {
    let text = model("m", &surface(1e5, ""), "Sphere(name: \"s\", center: (0.1,0,0), radius: 0.1)");
    let mut builder =
        WorldBuilder::new(Config { ledger: true, contact_capacity: contacts.into(), ..Config::default() });
    let made = pong_model::parse(&text, "m", None, builder.scene().extensions()).unwrap();
    let made = builder.add_model(Arc::new(made));
    let objects: Vec<_> =
        (0..count).map(|i| builder.create_object(made, &format!("o{i}")).unwrap()).collect();
    for (i, &a) in objects.iter().enumerate() {
        objects[i + 1..].iter().for_each(|&b| _ = builder.pair(a, b).unwrap());
    }
    let (world, _) = builder.seal().unwrap();
    let interfaces = objects.iter().map(|object| world.scene().interface(*object, "").unwrap()).collect();
    (world, interfaces)
}

/// State of ball `i`: a swarm of balls of 0.1 m with crossing paths, every third fast enough to pass through
/// others.
fn state(i: usize, frame: usize) -> State {
    let speed = if i.is_multiple_of(3) { 0.35 } else { 0.02 };
    let angle = 2.4 * i as f64;
    let way = Vec3::new(angle.cos(), angle.sin(), 0.3 * (1.7 * angle).sin());
    let place = Vec3::new((3.1 * i as f64).sin(), (4.3 * i as f64).cos(), 0.4 * (5.9 * i as f64).sin()) * 0.8;
    let position = place + way * (speed * (frame as f64 - 0.5 * FRAMES as f64));
    let half = 0.02 * frame as f64 * (i % 5) as f64;
    State {
        position: position.into(),
        orientation: [half.cos(), 0.0, half.sin(), 0.0],
        linear_velocity: (way * speed * 1e3).into(),
        ..State::identity()
    }
}

#[test]
fn each_pair_finds_what_it_finds_alone() {
    let (mut many, interfaces) = world_of(COUNT, 500);
    let mut alone: Vec<_> = (0..COUNT)
        .flat_map(|a| (a + 1..COUNT).map(move |b| (a, b)))
        .map(|pair| (pair, world_of(2, 4)))
        .collect();
    let (mut touched, mut passages, mut apart) = (0, 0, 0);
    for frame in 0..FRAMES {
        let states: Vec<_> = (0..COUNT).map(|i| (interfaces[i], state(i, frame))).collect();
        many.set_states(&states).unwrap();
        let report = many.step().unwrap();
        let (mut expected, mut passed) = (Vec::new(), 0);
        for ((a, b), (world, ends)) in &mut alone {
            world.set_states(&[(ends[0], state(*a, frame)), (ends[1], state(*b, frame))]).unwrap();
            world.step().unwrap();
            let contacts = told(world);
            apart += usize::from(contacts.is_empty());
            expected.extend(contacts);
            passed += world.tunnelling().map_or(0, |passages| passages.count);
        }
        assert_eq!(told(&many), expected, "frame {frame}");
        assert_eq!(many.tunnelling().map_or(0, |passages| passages.count), passed, "frame {frame}");
        assert_eq!(report.status.contains(StatusBits::TUNNELLED), passed > 0);
        (touched, passages) = (touched + expected.len(), passages + passed);
    }
    assert!(touched > 30 && passages > 3 && apart > 10_000, "{touched} {passages} {apart}");
    let energy = |ledger: pong_engine::Ledger| ledger.work + ledger.dissipated + ledger.stored;
    assert!(energy(many.ledger()).abs() < 1e-9 * many.ledger().work.abs(), "{:?}", many.ledger());
    let sum: f64 = alone.iter().map(|(_, (world, _))| world.ledger().work).sum();
    assert!((sum - many.ledger().work).abs() < 1e-12 * many.ledger().work.abs());
}

/// A ball flies past another at a clearance of 10 mm, in axes that do not rotate. The other rotates by 14°
/// meanwhile. Seen from there, the first has come right through it: it started 1.5 m away, and the rotation
/// moves it by a quarter of that.
#[test]
fn what_a_turn_brings_into_the_way_is_told() {
    // The centre of each ball is 0.1 m along its x-axis.
    let ball_at = |middle: Vec3, angle: f64| {
        let position = middle - Vec3::new(angle.cos(), angle.sin(), 0.0) * 0.1;
        let orientation = [(0.5 * angle).cos(), 0.0, 0.0, (0.5 * angle).sin()];
        State { position: position.into(), orientation, ..State::identity() }
    };
    let flies = [1.5, -1.5].map(|x| ball_at(Vec3::new(x, 0.21, 0.0), 0.0));
    let turns = [0.0, -0.24].map(|angle| ball_at(Vec3::zeros(), angle));
    let rests = |i: usize| ball_at(Vec3::new(i as f64, 10.0, 3.0), 0.0);
    let (mut many, all) = world_of(COUNT, 500);
    let (mut alone, two) = world_of(2, 4);
    for frame in 0..2 {
        let states = all.iter().enumerate().map(|(i, ball)| match i {
            5 => (*ball, flies[frame]),
            9 => (*ball, turns[frame]),
            _ => (*ball, rests(i)),
        });
        many.set_states(&states.collect::<Vec<_>>()).unwrap();
        alone.set_states(&[(two[0], flies[frame]), (two[1], turns[frame])]).unwrap();
        let reports = [many.step().unwrap(), alone.step().unwrap()];
        for report in reports {
            assert_eq!(report.status.contains(StatusBits::TUNNELLED), frame == 1);
        }
    }
}

/// Pairs that were committed alone keep their own history, up to the maximum number of epochs.
#[test]
fn pairs_committed_at_many_moments_keep_their_own() {
    let (mut many, interfaces) = world_of(COUNT, 500);
    let pairs: Vec<_> = many.scene().pairs().map(|(pair, _)| pair).collect();
    let place = |world: &mut World, interfaces: &[InterfaceId], frame| {
        let states: Vec<_> = (0..COUNT).map(|i| (interfaces[i], state(i, frame))).collect();
        world.set_states(&states).unwrap();
    };
    // 630 pairs, but only 255 epochs.
    for (frame, pair) in pairs[..255].iter().enumerate() {
        place(&mut many, &interfaces, frame % FRAMES);
        many.commit_pairs(&[*pair]).unwrap();
    }
    let mut before = Vec::new();
    many.save_state_packed(&mut before);
    let refused = many.commit_pairs(&pairs[300..301]).unwrap_err().to_string();
    for part in ["commit of some pairs", "255 commit epochs", "commit some of them together"] {
        assert!(refused.contains(part), "{refused}");
    }
    let mut after = Vec::new();
    many.save_state_packed(&mut after);
    assert!(before == after && before.len() <= many.state_size());
    // Pairs that are committed together free epochs.
    many.commit_pairs(&pairs[..2]).unwrap();
    many.commit_pairs(&pairs[300..301]).unwrap();
    many.commit().unwrap();
    many.commit_pairs(&pairs[400..401]).unwrap();
    let (mut other, others) = world_of(COUNT, 500);
    many.save_state_packed(&mut after);
    other.restore_state(&after).unwrap();
    place(&mut many, &interfaces, 3);
    place(&mut other, &others, 3);
    assert_eq!(many.step().unwrap(), other.step().unwrap());
    assert_eq!(told(&many), told(&other));
}

/// A block of an older format is refused with its version and a remedy.
#[test]
fn a_block_of_an_older_format_is_refused() {
    let (mut world, interfaces) = world_of(3, 4);
    (0..3).for_each(|i| world.set_state(interfaces[i], &state(i, 0)).unwrap());
    world.step().unwrap();
    let mut block = Vec::new();
    world.save_state_packed(&mut block);
    block[8] = 2;
    let refused = world.restore_state(&block).unwrap_err().to_string();
    for part in ["contact state", "format version 2", "reads 3", "save it again"] {
        assert!(refused.contains(part), "{refused}");
    }
}

/// Without a capacity from the host, a world of many spheres has room for 16 pairs of each sphere. If more touch, the
/// deepest contacts are kept and the frame reports how many there were.
#[test]
fn default_capacity_has_sixteen_pairs_of_each_sphere() {
    for (count, capacity) in [(20, 256), (30, 30 * 29 / 2), (40, 16 * 40), (100, 1600)] {
        let (mut world, interfaces) = world_of(count, None);
        assert_eq!(world.contact_capacity(), capacity, "{count} spheres");
        let at = |i: usize| State { position: [1e-3 * i as f64, 0.0, 0.0], ..State::identity() };
        let states: Vec<_> = interfaces.iter().enumerate().map(|(i, sphere)| (*sphere, at(i))).collect();
        world.set_states(&states).unwrap();
        let report = world.step().unwrap();
        let pairs = count * (count - 1) / 2;
        assert_eq!(report.contacts as usize, pairs.min(capacity));
        assert_eq!(report.status.contains(StatusBits::CONTACT_LIMIT), pairs > capacity);
        assert_eq!(report.advised_capacity(capacity), (pairs > capacity).then_some(pairs));
    }
}
