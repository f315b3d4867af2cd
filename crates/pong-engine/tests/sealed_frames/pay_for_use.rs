//! Features that a scene does not use add nothing to its frames: no test, no contact, no memory, and the same
//! answers.

use crate::common::load;
use crate::common::scenes::{Parts, all};
use crate::common::stage;
use crate::common::stage::{FrameHash, Scene, Stage};
use crate::{common, heap};
use pong_engine::*;

fn scene(name: &str) -> Scene {
    all().into_iter().find(|scene| scene.name == name).expect(name)
}

/// Everything that a world reports about its size and about a frame, except parts that include a hash of the
/// whole scene.
#[derive(Debug, PartialEq)]
struct Told {
    answers: stage::Hash,
    counts: FrameCounts,
    memory: MemoryReport,
    contacts: usize,
    state_size: usize,
}

fn tell(stage: &mut Stage<'_>, frame: usize) -> Told {
    let FrameHash { answers, .. } = stage.step(frame);
    Told {
        answers,
        counts: stage.world.counts(),
        memory: stage.world.memory(),
        contacts: stage.world.contact_count(),
        state_size: stage.world.state_size(),
    }
}

/// Runs both scenes for some frames; every frame must report the same.
fn must_tell_the_same(what: &str, one: &Scene, other: &Scene, frames: usize) {
    let (mut one_stage, mut other_stage) = (one.set_up(None), other.set_up(None));
    let mut touched = 0;
    for frame in 0..frames {
        let told = tell(&mut one_stage, frame);
        touched += told.contacts;
        assert_eq!(told, tell(&mut other_stage, frame), "{what}, frame {frame}");
    }
    assert!(touched > 0, "{what}: nothing touches");
}

/// Allocator calls of some frames.
fn allocations(stage: &mut Stage<'_>) -> Vec<(&'static str, usize)> {
    let Stage { scene, world, groups, .. } = stage;
    let states: Vec<Vec<_>> = (40..50)
        .map(|frame| groups.iter().zip(&scene.paths).map(|(group, path)| (*group, path.at(frame))).collect())
        .collect();
    let _turn = heap::my_turn();
    heap::counted(|| {
        for states in &states {
            world.set_states(states).unwrap();
            world.step().unwrap();
        }
    })
}

/// A thousand unpaired Objects, in the midst of the others' contacts.
#[test]
fn a_thousand_objects_that_meet_nobody_add_nothing() {
    for name in ["stations", "pieces"] {
        let (without, mut with) = (scene(name), scene(name));
        let mut parts = Parts::new(77);
        parts.points(20, [0.0; 3], [0.5; 3]);
        parts.spheres(5, [0.0; 3], [0.5; 3], 0.1);
        with.models.push(common::model("idle", &common::surface(1e5, ""), &parts.joined()));
        let first_path = with.paths[0];
        let paired = with.paths.len();
        with.objects.extend([2; 1000]);
        with.paths.extend([first_path; 1000]);
        // Their states are never set; their wrenches are read at the end.
        let (mut one, mut other) = (without.set_up(None), with.set_up(None));
        let idle = other.groups.split_off(paired);
        let mut touched = 0;
        for frame in 0..40 {
            let told = tell(&mut one, frame);
            touched += told.contacts;
            assert_eq!(told, tell(&mut other, frame), "{name}, frame {frame}");
        }
        assert!(touched > 0);
        assert_eq!(allocations(&mut other), []);
        // Without a state they block no frame, and no wrench acts on them.
        for group in idle {
            assert_eq!(other.world.wrench(group).unwrap(), pong_geometry::Wrench::zero());
        }
    }
}

/// A pair that is switched off is equivalent to one that was never made.
#[test]
fn a_pair_that_is_off_adds_nothing_to_a_frame() {
    let mut on = scene("sheets");
    let mut both = scene("sheets");
    on.pairs.truncate(1);
    both.is_on = |_, pair| pair == 0;
    let (mut on, mut both) = (on.set_up(None), both.set_up(None));
    for frame in 0..60 {
        let (told, told_of_both) = (tell(&mut on, frame), tell(&mut both, frame));
        assert_eq!(told.counts, told_of_both.counts, "frame {frame}");
        assert_eq!(told.answers, told_of_both.answers, "frame {frame}");
    }
}

/// Without the ledger a frame has no energies, and is otherwise the same.
#[test]
fn without_the_ledger_only_the_energies_are_missing() {
    let (with, mut without) = (scene("pieces"), scene("pieces"));
    without.ledger = false;
    let (mut with, mut without) = (with.set_up(None), without.set_up(None));
    for frame in 0..60 {
        for stage in [&mut with, &mut without] {
            stage.prepare(frame);
            stage.world.step().unwrap();
        }
        assert_eq!(with.world.counts(), without.world.counts());
        let [kept, free] = [&with, &without].map(|stage| stage.world.memory());
        assert!(free.scratch_peak <= kept.scratch_peak);
        assert_eq!(MemoryReport { scratch_peak: kept.scratch_peak, ..free }, kept);
        let ledger = without.world.ledger();
        assert_eq!((ledger.work, ledger.dissipated), (0.0, 0.0));
        for (kept, free) in with.world.contacts_iter().zip(without.world.contacts_iter()) {
            assert_eq!((free.work, free.dissipated), (0.0, 0.0));
            assert_eq!((kept.force, kept.point, kept.stored), (free.force, free.point, free.stored));
        }
        for (a, b) in with.groups.iter().zip(&without.groups) {
            assert_eq!(with.world.wrench(*a).unwrap(), without.world.wrench(*b).unwrap());
        }
    }
}

/// Registered kinds and laws that no model of the scene names.
#[test]
fn registered_kinds_that_no_model_names_add_nothing() {
    for name in ["stations", "sheets", "arms"] {
        let (without, mut with) = (scene(name), scene(name));
        with.own_kinds = true;
        must_tell_the_same(name, &without, &with, 40);
    }
}

/// A world without a clock measures no times, and one without workers reports none of them.
#[test]
fn what_nobody_asked_for_is_not_measured() {
    let scene = scene("stations");
    let mut stage = scene.set_up(None);
    stage.step(0);
    assert_eq!(stage.world.stage_times(), StageTimes::default());
    assert_eq!(stage.world.thread_work().count(), 0);
    assert_eq!(stage.world.thread_times().collect::<Vec<_>>(), [WorkTimes::default()]);
}

/// Memory depends on what may meet, not on what exists: a model without pairs takes none.
#[test]
fn memory_follows_what_may_meet() {
    let sized = |idle: usize| {
        let mut builder = WorldBuilder::new(Config::default());
        let ball = "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)";
        let small = load(&mut builder, &common::model("ball", &common::surface(1e5, ""), ball));
        let mut parts = Parts::new(78);
        parts.points(2000, [0.0; 3], [1.0; 3]);
        let large = load(&mut builder, &common::model("cloud", &common::surface(1e5, ""), &parts.joined()));
        let pair = ["a", "b"].map(|name| builder.create_object(small, name).unwrap());
        builder.pair(pair[0], pair[1]).unwrap();
        for index in 0..idle {
            builder.create_object(large, &format!("idle_{index}")).unwrap();
        }
        let (world, report) = builder.seal().unwrap();
        (report.group_pairs, report.contact_capacity, report.state_size, world.memory())
    };
    assert_eq!(sized(0), sized(1000));
}
