//! Evaluate is pure, commit is the only writer, and a saved block continues bit for bit (docs/theory.md, 5).

use crate::common::*;
use pong_engine::{EngineError, State, World};
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

fn sliding_pair() -> (String, String) {
    let rubber =
        surface(1e5, "normal: Linear(damping: 100.0), friction: Bristle(mu: 0.4, static_excess: 0.5)");
    let movers = "Sphere(name: \"ball\", center: (0.0,0.0,0.0), radius: 0.1), \
                  LineSegment(name: \"bar\", ends: ((-0.2,0.05,-0.1),(0.2,0.05,-0.1))), \
                  Point(name: \"tip\", position: (0.05,-0.05,-0.1))";
    let grounds = [
        plate_mesh("plate", 8, 1.0, |x, y| Vec3::new(x, y, 0.0)),
        box_polyhedron("block", [0.0, 0.0, -0.05], [0.5, 0.5, 0.05], ""),
    ];
    (model("movers", &rubber, movers), model("grounds", &rubber, &grounds.join(",")))
}

fn path(t: f64) -> State {
    moving(
        Vec3::new(0.2 * (3.0 * t).sin(), 0.1 * (5.0 * t).cos(), 0.0985 + 0.001 * (40.0 * t).sin()),
        Quat::from_scaled_axis(Vec3::new(0.01 * (9.0 * t).sin(), 0.02 * (7.0 * t).cos(), 2.0 * t)),
        Vec3::new(0.6 * (3.0 * t).cos(), -0.5 * (5.0 * t).sin(), 0.04 * (40.0 * t).cos()),
        Vec3::new(0.09 * (9.0 * t).cos(), -0.14 * (7.0 * t).sin(), 2.0),
    )
}

fn rig() -> Rig {
    let (a, b) = sliding_pair();
    Rig::new(&a, &b)
}

fn saved(world: &World) -> Vec<u8> {
    let mut block = vec![0; world.state_size()];
    world.save_state(&mut block).unwrap();
    block
}

fn bits(rig: &Rig) -> Vec<u64> {
    (0..2)
        .flat_map(|side| {
            let w = rig.world.wrench(rig.interfaces[side]).unwrap();
            w.force.iter().chain(w.moment.iter()).map(|x| x.to_bits()).collect::<Vec<_>>()
        })
        .collect()
}

#[test]
fn fifty_throw_away_evaluations_change_nothing() {
    let (mut plain, mut busy) = (rig(), rig());
    let mut random = Random(2);
    for step in 0..200 {
        let t = f64::from(step) * 1e-3;
        for _ in 0..50 {
            let elsewhere = path(t + random.between(-0.2, 0.2));
            busy.place([elsewhere, State::identity()]);
            busy.world.evaluate().unwrap();
        }
        for rig in [&mut plain, &mut busy] {
            rig.place([path(t), State::identity()]);
            rig.world.step().unwrap();
        }
        assert_eq!(bits(&plain), bits(&busy), "step {step}");
        assert_eq!(saved(&plain.world), saved(&busy.world), "step {step}");
        assert!(plain.world.contact_count() >= 3);
    }
}

#[test]
fn a_rejected_step_leaves_no_trace() {
    let (mut direct, mut retried) = (rig(), rig());
    for step in 0..100 {
        let t = f64::from(step) * 2e-3;
        retried.place([path(t + 7e-3), State::identity()]);
        retried.world.evaluate().unwrap();
        for rig in [&mut direct, &mut retried] {
            rig.place([path(t), State::identity()]);
            rig.world.evaluate().unwrap();
            rig.world.commit().unwrap();
        }
        assert_eq!(bits(&direct), bits(&retried));
    }
}

/// Commit evaluates the states if they were not evaluated last, and does not evaluate twice.
#[test]
fn commit_accepts_the_states_presently_set() {
    let (mut stepped, mut committed) = (rig(), rig());
    for step in 0..50 {
        let state = path(f64::from(step) * 1e-3);
        stepped.place([state, State::identity()]);
        stepped.world.step().unwrap();
        committed.place([state, State::identity()]);
        committed.world.commit().unwrap();
        assert_eq!(saved(&stepped.world), saved(&committed.world));
    }
}

#[test]
fn a_restored_block_continues_bit_for_bit() {
    let mut original = rig();
    for step in 0..120 {
        original.place([path(f64::from(step) * 1e-3), State::identity()]);
        original.world.step().unwrap();
    }
    let block = saved(&original.world);
    let mut fresh = rig();
    fresh.world.restore_state(&block).unwrap();
    for step in 120..240 {
        for rig in [&mut original, &mut fresh] {
            rig.place([path(f64::from(step) * 1e-3), State::identity()]);
            rig.world.step().unwrap();
        }
        assert_eq!(bits(&original), bits(&fresh), "step {step}");
    }
    assert_eq!(saved(&original.world), saved(&fresh.world));
}

/// Restored right after a commit: the displacement since the last commit starts at the block's poses, not at
/// the world's.
#[test]
fn a_world_put_back_to_an_earlier_block_goes_the_same_way_again() {
    let mut rig = rig();
    steps(&mut rig, 0..120);
    let block = saved(&rig.world);
    let once = steps(&mut rig, 120..200);
    for _ in 0..2 {
        rig.world.restore_state(&block).unwrap();
        assert_eq!(steps(&mut rig, 120..200), once);
    }
}

/// Environment variable with the file of the block for the child process.
const BLOCK_FILE: &str = "PONG_TEST_BLOCK";

fn steps(rig: &mut Rig, range: std::ops::Range<u32>) -> Vec<Vec<u64>> {
    range
        .map(|step| {
            rig.place([path(f64::from(step) * 1e-3), State::identity()]);
            rig.world.step().unwrap();
            bits(rig)
        })
        .collect()
}

/// The test runs itself again as a child, which restores the block from a file and prints the bits of every
/// wrench.
#[test]
fn a_block_continues_in_a_new_process() {
    let mut rig = rig();
    if let Ok(file) = std::env::var(BLOCK_FILE) {
        rig.world.restore_state(&std::fs::read(file).unwrap()).unwrap();
        println!("bits {:?}", steps(&mut rig, 120..200));
        return;
    }
    steps(&mut rig, 0..120);
    let file = std::env::temp_dir().join(format!("pong_block_{}", std::process::id()));
    std::fs::write(&file, saved(&rig.world)).unwrap();
    let child = std::process::Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "contact_state::a_block_continues_in_a_new_process", "--nocapture"])
        .env(BLOCK_FILE, &file)
        .output()
        .unwrap();
    std::fs::remove_file(&file).unwrap();
    let printed = String::from_utf8(child.stdout).unwrap();
    assert!(child.status.success(), "{printed}");
    let expected = format!("bits {:?}", steps(&mut rig, 120..200));
    assert!(printed.contains(&expected), "the child went another way");
}

#[test]
fn a_foreign_or_damaged_block_is_refused_and_loses_nothing() {
    let mut rig = rig();
    rig.place([path(0.0), State::identity()]);
    rig.world.step().unwrap();
    let good = saved(&rig.world);
    let used = rig.world.state_used();
    let mut damaged = good.clone();
    damaged[used / 2] ^= 1;
    let mut behind = good.clone();
    behind[used] = 1;
    let longer = [&good[..], &[0]].concat();
    let (a, _) = sliding_pair();
    let other =
        Rig::new(&a, &model("other", &surface(1.0, ""), "Plane(name: \"p\", normal: (0,0,1), offset: 0.0)"));
    let foreign = saved(&other.world);
    for block in [&damaged[..], &behind[..], &longer[..], &foreign[..], &good[..used - 1], &[][..]] {
        assert!(matches!(rig.world.restore_state(block), Err(EngineError::State(_))));
        assert_eq!(saved(&rig.world), good);
    }
}

/// The size returned after the seal is always sufficient; the saved block is as long as its contents.
#[test]
fn a_state_takes_no_room_for_contacts_that_there_are_not() {
    let mut rig = rig();
    let before = rig.world.state_used();
    rig.place([path(0.0), State::identity()]);
    rig.world.step().unwrap();
    let (used, most) = (rig.world.state_used(), rig.world.state_size());
    assert!(before < used && 100 * used < most, "{before}, {used}, {most} bytes");
    let mut kept = Vec::new();
    rig.world.save_state_packed(&mut kept);
    assert_eq!(kept.len(), used);
    let whole = saved(&rig.world);
    assert!(whole[..used] == kept && whole[used..].iter().all(|byte| *byte == 0));
    let onward = steps(&mut rig, 1..20);
    for block in [&kept[..], &whole[..used + 5], &whole[..]] {
        rig.world.restore_state(block).unwrap();
        assert_eq!(saved(&rig.world), whole);
        assert_eq!(steps(&mut rig, 1..20), onward);
    }
    let object = rig.world.scene().object("a").unwrap();
    rig.world.clear_contact_history(object).unwrap();
    assert_eq!(rig.world.state_used(), before);
}

#[test]
fn a_forgotten_object_has_no_past() {
    let (mut moved, mut fresh) = (rig(), rig());
    for step in 0..50 {
        moved.place([path(f64::from(step) * 1e-3), State::identity()]);
        moved.world.step().unwrap();
    }
    let object = moved.objects[0];
    moved.world.clear_contact_history(object).unwrap();
    for rig in [&mut moved, &mut fresh] {
        rig.place([path(0.3), State::identity()]);
        rig.world.step().unwrap();
    }
    assert_eq!(bits(&moved), bits(&fresh));
}

#[test]
fn a_pair_switched_off_has_no_contacts_and_comes_back_without_a_past() {
    let mut rig = rig();
    rig.place([path(0.0), State::identity()]);
    rig.world.step().unwrap();
    assert!(rig.world.contact_count() > 0);
    rig.world.set_pair_enabled(rig.pair, false).unwrap();
    rig.world.step().unwrap();
    assert_eq!(rig.world.contact_count(), 0);
    assert_eq!(rig.wrench(0).force, Vec3::zeros());
    rig.world.set_pair_enabled(rig.pair, true).unwrap();
    rig.world.step().unwrap();
    assert!(rig.world.contact_count() > 0);
}

#[test]
fn bad_states_are_refused_by_name_and_the_frame_before_stays() {
    let mut rig = rig();
    let object = rig.interfaces[0];
    assert!(
        matches!(rig.world.evaluate(), Err(EngineError::UnsetState { interface }) if interface == "a/movers")
    );
    rig.place([path(0.0), State::identity()]);
    rig.world.step().unwrap();
    let before = (bits(&rig), saved(&rig.world));
    let bad = [
        State { position: [f64::NAN, 0.0, 0.0], ..path(0.1) },
        State { angular_velocity: [0.0, f64::INFINITY, 0.0], ..path(0.1) },
        State { orientation: [1.002, 0.0, 0.0, 0.0], ..path(0.1) },
        State { orientation: [0.0; 4], ..path(0.1) },
    ];
    for state in bad {
        let error = rig.world.set_state(object, &state).unwrap_err();
        assert!(error.to_string().contains("a/movers"), "{error}");
        // A batch is accepted as a whole or not at all.
        let batch = [(rig.interfaces[1], path(0.2)), (object, state)];
        assert!(rig.world.set_states(&batch).is_err());
        assert_eq!((bits(&rig), saved(&rig.world)), before);
        rig.world.evaluate().unwrap();
        assert_eq!(bits(&rig), {
            let mut again = common_rig_at_zero();
            again.world.evaluate().unwrap();
            bits_after_step(&mut again)
        });
    }
}

fn common_rig_at_zero() -> Rig {
    let mut rig = rig();
    rig.place([path(0.0), State::identity()]);
    rig.world.step().unwrap();
    rig
}

fn bits_after_step(rig: &mut Rig) -> Vec<u64> {
    rig.world.evaluate().unwrap();
    bits(rig)
}
