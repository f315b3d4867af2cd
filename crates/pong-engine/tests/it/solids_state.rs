//! State of contacts between solids: saved, restored, cloned, continued, committed by pairs, cleared; the same
//! bits with any number of workers; more contacts than capacity; new surface values; the ledger.

use crate::common::stage::workers;
use crate::common::{Rig, load, moving};
use pong_engine::*;
use pong_geometry::{Quat, Vec3};
use pong_model::{Extensions, Surface};
use pong_testkit::ron::box_polyhedron;

const ROUGH: &str = "stiffness: 1e5, foundation: 2e7, normal: HuntCrossley(dissipation: 0.5, exponent: 1.0), \
                     friction: Bristle(mu: 0.6, static_excess: 0.2)";

fn solids(primitives: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "solids", surfaces: {{ "s": ({ROUGH}) }},
            root: (name: "solids", surface: "s", contact: Solid, primitives: [{primitives}]))"#
    )
}

/// Boxes of half extents 0.1 m in a square of `side` × `side`, 0.25 m apart, in z from −0.1 to 0.1.
fn boxes(side: usize) -> String {
    let place = |index: usize| 0.25 * (index as f64 - 0.5 * (side - 1) as f64);
    let one = |index: usize| {
        let center = [place(index % side), place(index / side), 0.0];
        box_polyhedron(&format!("box {index}"), center, [0.1; 3], "")
    };
    solids(&(0..side * side).map(one).collect::<Vec<_>>().join(", "))
}

fn slab() -> String {
    solids(&box_polyhedron("slab", [0.0, 0.0, -0.1], [2.0, 2.0, 0.1], ""))
}

fn rig(side: usize, config: Config) -> Rig {
    Rig::with_config(config, &boxes(side), &slab())
}

fn with_ledger() -> Config {
    Config { ledger: true, ..Config::default() }
}

/// Boxes that come down, press, slide, turn about the normal, tilt and lift off, over and over.
fn path(frame: usize) -> State {
    let t = frame as f64 * 2e-3;
    let turn = Vec3::new(2e-3 * (11.0 * t).sin(), 3e-3 * (8.0 * t).cos(), 0.3 * t);
    let rate = Vec3::new(2.2e-2 * (11.0 * t).cos(), -2.4e-2 * (8.0 * t).sin(), 0.3);
    moving(
        Vec3::new(0.02 * (3.0 * t).sin(), 0.03 * t, 0.1 + 2e-3 * (30.0 * t).cos()),
        Quat::from_scaled_axis(turn),
        Vec3::new(0.06 * (3.0 * t).cos(), 0.03, -0.06 * (30.0 * t).sin()),
        rate,
    )
}

/// Steps a frame; returns wrenches, contacts, ledger and the saved contact state as bits.
fn step(rig: &mut Rig, frame: usize) -> Vec<u64> {
    rig.place([path(frame), State::identity()]);
    rig.world.step().unwrap();
    bits(rig)
}

fn bits(rig: &Rig) -> Vec<u64> {
    let mut block = Vec::new();
    rig.world.save_state_packed(&mut block);
    let wrenches = [0, 1].map(|side| rig.world.wrench(rig.interfaces[side]).unwrap());
    let mut numbers: Vec<f64> =
        wrenches.iter().flat_map(|wrench| wrench.force.iter().chain(&wrench.moment).copied()).collect();
    for contact in rig.world.contacts_iter() {
        for vector in [&contact.point, &contact.normal, &contact.force, &contact.slip_velocity] {
            numbers.extend(vector.iter());
        }
        numbers.extend([contact.depth, contact.weight, contact.stored, contact.work, contact.dissipated]);
    }
    let Ledger { stored, work, dissipated, .. } = rig.world.ledger();
    numbers.extend([stored, work, dissipated]);
    numbers.iter().map(|number| number.to_bits()).chain(block.iter().map(|byte| u64::from(*byte))).collect()
}

/// Contact state that is saved amid contact and restored into another world goes on to the same bits.
#[test]
fn restored_state_continues_to_the_same_bits() {
    for cut in [10, 37, 120] {
        let mut rig = rig(2, Config::default());
        (0..cut).for_each(|frame| _ = step(&mut rig, frame));
        let mut block = Vec::new();
        rig.world.save_state_packed(&mut block);
        let mut other = self::rig(2, Config::default());
        other.world.restore_state(&block).unwrap();
        let mut touched = 0;
        for frame in cut..cut + 200 {
            assert_eq!(step(&mut rig, frame), step(&mut other, frame), "from {cut}, frame {frame}");
            touched += usize::from(rig.world.contact_count() > 0);
        }
        assert!(touched > 50, "{touched}");
    }
}

#[test]
fn clone_continues_to_the_same_bits() {
    let mut rig = rig(2, with_ledger());
    (0..60).for_each(|frame| _ = step(&mut rig, frame));
    let world = rig.world.try_clone().unwrap();
    let Rig { models, objects, interfaces, pair, .. } = rig;
    let mut clone = Rig { world, models, objects, interfaces, pair };
    (60..200).for_each(|frame| assert_eq!(step(&mut rig, frame), step(&mut clone, frame), "frame {frame}"));
}

#[test]
fn continued_world_has_the_same_bits() {
    let mut rig = rig(2, with_ledger());
    (0..60).for_each(|frame| _ = step(&mut rig, frame));
    let mut other = self::rig(2, with_ledger());
    let went_on = other.world.continue_from(&rig.world).unwrap();
    assert!(went_on.contacts > 0 && went_on.contacts_left == 0, "{went_on:?}");
    (60..200).for_each(|frame| assert_eq!(step(&mut rig, frame), step(&mut other, frame), "frame {frame}"));
}

#[test]
fn workers_give_the_same_bits() {
    let mut plain = rig(6, with_ledger());
    let mut busy = [1, 3].map(|count| rig(6, Config { workers: workers(count), ..with_ledger() }));
    let mut most = 0;
    for frame in 0..150 {
        let expected = step(&mut plain, frame);
        most = most.max(plain.world.contact_count());
        for rig in &mut busy {
            assert!(step(rig, frame) == expected, "frame {frame}");
        }
    }
    assert!(most > 36 * 3, "{most}");
}

/// Two bodies on one slab: a pair committed alone has the bits of a world with this pair alone, and the pair
/// that is not committed keeps its past.
#[test]
fn pairs_are_committed_one_by_one() {
    let mut builder = WorldBuilder::new(Config::default());
    let [mover, ground] = [boxes(1), slab()].map(|text| load(&mut builder, &text));
    let ground = builder.create_object(ground, "slab").unwrap();
    let movers = ["a", "b"].map(|name| builder.create_object(mover, name).unwrap());
    let pairs = movers.map(|mover| builder.pair(mover, ground).unwrap());
    let groups = movers.map(|mover| builder.scene().interface(mover, "").unwrap());
    let ground = builder.scene().interface(ground, "").unwrap();
    let (mut world, _) = builder.seal().unwrap();
    let mut alone = rig(1, Config::default());
    for frame in 0..100 {
        let still = path(0);
        world
            .set_states(&[(groups[0], path(frame)), (groups[1], still), (ground, State::identity())])
            .unwrap();
        world.evaluate().unwrap();
        world.commit_pairs(&pairs[..1]).unwrap();
        step(&mut alone, frame);
        let (got, expected) =
            (world.wrench(groups[0]).unwrap(), alone.world.wrench(alone.interfaces[0]).unwrap());
        assert_eq!(got, expected, "frame {frame}");
    }
    world.commit().unwrap();
}

/// A thin plate pushes to the side of entry, and a bristle pulls back, until the history is cleared.
#[test]
fn cleared_history_forgets_entry_and_bristle() {
    let plate = solids(&box_polyhedron("plate", [0.0; 3], [0.5, 0.5, 0.001], ""));
    let mut rig = Rig::new(&boxes(1), &plate);
    let below = Vec3::new(0.01, 0.02, -0.06);
    let descend = |rig: &mut Rig| {
        for step in 0..=40 {
            let height = 0.102 + (below.z - 0.102) * f64::from(step) / 40.0;
            rig.place_a(Vec3::new(0.0, 0.02, height), Quat::identity());
            rig.world.step().unwrap();
        }
        rig.place_a(below, Quat::identity());
        rig.world.step().unwrap();
    };
    descend(&mut rig);
    let remembered = rig.wrench(0);
    assert!(remembered.force.z > 0.0 && remembered.force.x < 0.0, "{remembered:?}");
    rig.world.clear_contact_history(rig.objects[0]).unwrap();
    rig.place_a(below, Quat::identity());
    rig.world.step().unwrap();
    let forgotten = rig.wrench(0);
    assert!(forgotten.force.z < 0.0 && forgotten.force.xy().norm() < 1e-9, "{forgotten:?}");
    let ledger = rig.world.ledger();
    let balance = ledger.work + ledger.stored + ledger.dissipated;
    assert!(balance.abs() < 1e-12 * ledger.stored.abs().max(ledger.work.abs()), "{ledger:?}");
}

/// A new foundation modulus acts at once, and both in series: 1/K = 1/K_A + 1/K_B.
#[test]
fn set_surface_changes_the_modulus_at_once() {
    let mut rig = rig(1, Config::default());
    let force = |rig: &mut Rig| {
        rig.place_a(Vec3::new(0.0, 0.0, 0.099), Quat::identity());
        rig.world.evaluate().unwrap();
        rig.wrench(0).force.z
    };
    let before = force(&mut rig);
    let text = boxes(1).replace("foundation: 2e7", "foundation: 6e7");
    let stiffer = pong_model::parse(&text, "stiffer.ron", None, &Extensions::new()).unwrap();
    let surface: &Surface = stiffer.surfaces.iter().find(|surface| surface.name == "s").unwrap();
    rig.world.set_surface(rig.models[0], surface).unwrap();
    let after = force(&mut rig);
    // K was 1e7 N/m³ and is 1.5e7 N/m³; the shares of the fields change the volume along the rim alone.
    assert!((after / before / 1.5 - 1.0).abs() < 1e-2, "{before} {after}");
}

/// With too little room the deepest contacts remain, the status says so, and nothing panics.
#[test]
fn too_small_capacity_is_reported() {
    for capacity in [1, 2, 5, 20] {
        for count in [0, 2] {
            let config =
                Config { contact_capacity: Some(capacity), workers: workers(count), ..with_ledger() };
            let mut rig = rig(4, config);
            let mut limited = 0;
            for frame in 0..100 {
                rig.place([path(frame), State::identity()]);
                let report = rig.world.step().unwrap();
                assert!(rig.world.contact_count() <= capacity);
                assert!(rig.wrench(0).force.iter().all(|x| x.is_finite()));
                limited += usize::from(report.status.contains(StatusBits::CONTACT_LIMIT));
            }
            assert!(limited > 20, "{capacity}: {limited}");
        }
    }
}

/// A box in free flight bounces, slides and spins on the slab: work, stored energy and losses balance, and
/// nothing makes energy.
#[test]
fn ledger_balances_for_boxes_that_bounce_slide_and_spin() {
    let (mass, inertia, step) = (4.0, 0.027, 2e-5);
    let mut rig = rig(1, with_ledger());
    let mut state = moving(
        Vec3::new(0.0, 0.0, 0.18),
        Quat::from_scaled_axis(Vec3::new(0.3, 0.2, 0.1)),
        Vec3::new(1.0, 0.3, -0.5),
        Vec3::new(1.0, -2.0, 6.0),
    );
    let (mut largest, mut dissipated, mut touches) = (0.0_f64, 0.0_f64, 0);
    for frame in 0..40_000 {
        rig.place([state, State::identity()]);
        rig.world.step().unwrap();
        let ledger = rig.world.ledger();
        largest = largest.max(ledger.work.abs()).max(ledger.stored);
        let balance = ledger.work + ledger.stored + ledger.dissipated;
        assert!(balance.abs() <= 1e-12 * largest, "frame {frame}: {ledger:?}");
        dissipated = dissipated.max(ledger.dissipated);
        assert!(ledger.dissipated >= dissipated - 1e-3 * largest, "frame {frame}: {ledger:?}");
        touches += usize::from(rig.world.contact_count() > 0);
        let wrench = rig.wrench(0);
        let linear = Vec3::from(state.linear_velocity) + (wrench.force / mass - Vec3::z() * 9.81) * step;
        let angular = Vec3::from(state.angular_velocity) + wrench.moment / inertia * step;
        let pose = state.pose();
        let turned = Quat::from_scaled_axis(angular * step) * pose.orientation;
        state = moving(pose.position + linear * step, turned, linear, angular);
    }
    println!("{touches} frames in contact, {dissipated} J lost");
    assert!(touches > 1000 && dissipated > 0.3, "{touches} {dissipated}");
}
