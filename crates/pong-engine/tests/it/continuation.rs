//! Continuation in a world of more or fewer Objects: common Objects continue bit-identically (docs/theory.md,
//! 5).

use crate::common::stage::{Scene, Stage, workers};
use crate::common::*;
use pong_engine::{
    Config, Continuation, EngineError, FrictionForce, FrictionInput, FrictionOutput, InterfaceId, Laws,
    ObjectId, PairId, State, StatusBits, World, WorldBuilder, WrenchCoupling,
};
use pong_geometry::{Quat, Vec3};
use std::sync::Arc;

/// Everything that a world reports about the Objects of a scene, as bits, independent of additional Objects
/// and their order.
fn told_of(stage: &Stage<'_>) -> Vec<u64> {
    let world = &stage.world;
    let mut told = Vec::new();
    let mut put = |numbers: &[f64]| told.extend(numbers.iter().map(|number| number.to_bits()));
    for group in &stage.groups {
        for wrench in [world.wrench(*group).unwrap(), world.wrench_common(*group).unwrap()] {
            put(wrench.force.as_slice());
            put(wrench.moment.as_slice());
        }
    }
    let ledger = world.ledger();
    put(&[ledger.stored, ledger.work, ledger.dissipated]);
    for contact in world.contacts_iter() {
        for vector in [&contact.point, &contact.normal, &contact.force, &contact.slip_velocity] {
            put(vector.as_slice());
        }
        put(&[contact.depth, contact.weight, contact.stored, contact.work, contact.dissipated]);
        put(&[contact.a.primitive, contact.a.element, contact.b.primitive, contact.feature.0].map(f64::from));
    }
    let (account, all) = (world.account(), world.pair_accounts());
    put(&[account.work_in, account.inserted, account.friction_loss, account.hold_error, account.resolution]);
    for pair in all.filter(|pair| stage.pairs.contains(&pair.pair)) {
        put(&[pair.total.work_out, pair.episode.damping_loss, pair.excess, pair.episodes as f64]);
    }
    let standing = world.standing_groups(1e-3).unwrap();
    told.extend(standing.iter().map(|group| stage.groups.iter().position(|g| g == group).unwrap() as u64));
    told.push(u64::from(world.tunnelling().map_or(0, |passage| passage.count)));
    told.push(u64::from(world.report().contacts) << 32 | u64::from(world.report().status.bits()));
    told
}

fn step(stage: &mut Stage<'_>, frame: usize) -> Vec<u64> {
    stage.prepare(frame);
    stage.world.step().unwrap();
    told_of(stage)
}

/// A larger world that continues a stage.
fn larger<'s>(stage: &Stage<'s>, newcomers: &[usize], count: usize) -> Stage<'s> {
    let scene = stage.scene;
    let mut larger = scene.set_up_beside(newcomers, workers(count));
    let went_on = larger.world.continue_from(&stage.world).unwrap();
    assert_eq!((went_on.objects, went_on.pairs), (scene.objects.len(), scene.pairs.len()), "{}", scene.name);
    assert_eq!((went_on.objects_left, went_on.pairs_left), (0, 0));
    assert_eq!((went_on.contacts_left, went_on.energy_left), (0, 0.0));
    assert!(went_on.contacts > 0 || stage.world.contact_count() == 0, "{}", scene.name);
    assert!(matches!(larger.world.wrench(larger.groups[0]), Err(EngineError::WrongPhase { .. })));
    larger
}

fn compare(stage: &mut Stage<'_>, larger: &mut Stage<'_>, frame: usize) {
    let (expected, told) = (step(stage, frame), step(larger, frame));
    let differs = told.iter().zip(&expected).position(|(a, b)| a != b);
    let name = stage.scene.name;
    assert!(
        told == expected,
        "{name}, frame {frame}: number {differs:?} of {}, {}",
        told.len(),
        expected.len()
    );
}

/// Runs a scene beside larger worlds, which continue it from some frames on, and compares them.
fn run_beside(scene: &Scene, frames: usize, count: usize, arrivals: &[(usize, &[usize])]) {
    let mut stage = scene.set_up(workers(count));
    let mut beside = None;
    for frame in 0..frames.min(scene.frames) {
        if let Some((_, newcomers)) = arrivals.iter().find(|(arrival, _)| *arrival == frame) {
            beside = Some(larger(&stage, newcomers, count));
        }
        match &mut beside {
            Some(beside) => compare(&mut stage, beside, frame),
            None => _ = step(&mut stage, frame),
        }
    }
}

#[test]
fn every_scene_goes_on_to_the_bit_beside_newcomers() {
    // The bowl takes longer than all other scenes together, and has one pair of Objects like many of them.
    for mut scene in scenes::all().into_iter().filter(|scene| scene.name != "bowl") {
        let last = scene.objects.len();
        run_beside(&scene, 240, 0, &[(7, &[last]), (15, &[0]), (40, &[1, last])]);
        run_beside(&scene, 60, 2, &[(5, &[0, 1]), (18, &[0, last])]);
        scene.accounts = Some(WrenchCoupling::ZeroOrderHold { delay_frames: 2 });
        run_beside(&scene, 60, 0, &[(11, &[1]), (20, &[0])]);
    }
}

/// Pairs with different commit epochs keep them.
#[test]
fn pairs_go_on_from_the_moments_of_their_own_commits() {
    let arms = scenes::all().into_iter().find(|scene| scene.name == "arms").unwrap();
    let mut stage = arms.set_up(None);
    (0..100).for_each(|frame| _ = step(&mut stage, frame));
    for (index, pair) in stage.pairs.clone().into_iter().enumerate().skip(1).chain([(0, stage.pairs[1])]) {
        stage.place(100 + index);
        stage.world.evaluate().unwrap();
        stage.world.commit_pairs(&[pair]).unwrap();
    }
    let mut larger = larger(&stage, &[0, 2], 0);
    (105..200).for_each(|frame| compare(&mut stage, &mut larger, frame));
}

/// A soft floor with rigid tips on it, each held by a bristle, and a plate that a tip passes through.
struct Yard {
    world: World,
    names: Vec<String>,
}

const SOFT: f64 = 2e4;
const BRISTLE: f64 = 1e4;

fn law(stiffness: &str, bristle: &str) -> String {
    format!("\"s\": (stiffness: {stiffness}, friction: Bristle(mu: 0.4{bristle}))")
}

fn text_of(name: &str) -> String {
    let yields = law(&format!("{SOFT:?}"), &format!(", stiffness: {BRISTLE:?}, damping: 0.0"));
    match &name[..3] {
        "flo" => model("floor", &yields, "Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)"),
        "wal" => model("wall", &yields, &box_polyhedron("w", [0.0; 3], [0.005, 0.5, 0.5], "")),
        _ => model("tip", &law("inf", ""), "Point(name: \"tip\", position: (0,0,0))"),
    }
}

/// Objects of these names, at rest 100 m up; all pairs of different kinds.
fn builder_of(config: Config, names: &[&str]) -> WorldBuilder {
    let mut builder = WorldBuilder::new(config);
    let objects: Vec<ObjectId> = names
        .iter()
        .map(|name| {
            let model = load(&mut builder, &text_of(name));
            builder.create_object(model, name).unwrap()
        })
        .collect();
    for (i, a) in objects.iter().enumerate() {
        for (j, b) in objects.iter().enumerate().skip(i + 1) {
            if names[i][..3] != names[j][..3] {
                builder.pair(*a, *b).unwrap();
            }
        }
        let interface = builder.scene().interface(*a, "").unwrap();
        builder.set_states(&[(interface, at(Vec3::z() * 100.0, Quat::identity()))]).unwrap();
    }
    builder
}

fn ledger() -> Config {
    Config { ledger: true, ..Config::default() }
}

fn interface(world: &World, name: &str) -> InterfaceId {
    world.scene().interface(world.scene().object(name).unwrap(), "").unwrap()
}

fn pair(world: &World, a: &str, b: &str) -> PairId {
    let [a, b] = [a, b].map(|name| world.scene().object(name).unwrap());
    world.scene().pairs().find(|(_, objects)| objects.contains(&a) && objects.contains(&b)).unwrap().0
}

impl Yard {
    fn new(names: &[&str]) -> Self {
        let world = builder_of(ledger(), names).seal().unwrap().0;
        Self { world, names: names.iter().map(|name| (*name).to_owned()).collect() }
    }

    /// Places some Objects and steps; the floor is at the origin.
    fn step(&mut self, places: &[(&str, Vec3)]) {
        let floor =
            self.names.iter().find(|name| name.starts_with("flo")).map(|name| (&**name, Vec3::zeros()));
        for (name, place) in places.iter().copied().chain(floor) {
            let interface = interface(&self.world, name);
            self.world.set_state(interface, &at(place, Quat::identity())).unwrap();
        }
        self.world.step().unwrap();
    }

    fn force(&self, name: &str) -> Vec3 {
        self.world.wrench(interface(&self.world, name)).unwrap().force
    }

    fn saved(&self) -> Vec<u8> {
        let mut block = Vec::new();
        self.world.save_state_packed(&mut block);
        block
    }
}

fn tip(x: f64) -> Vec3 {
    Vec3::new(x, 0.0, -1e-3)
}

/// A stretched bristle continues; that of an Object that arrives in contact starts at zero.
#[test]
fn an_object_that_arrives_in_contact_begins_without_friction() {
    let mut yard = Yard::new(&["floor", "tip_a"]);
    yard.step(&[("tip_a", tip(0.0))]);
    yard.step(&[("tip_a", tip(1e-4))]);
    assert!((yard.force("tip_a").x + BRISTLE * 1e-4).abs() < 1e-9, "{:?}", yard.force("tip_a"));
    let mut larger = Yard::new(&["tip_0", "floor", "tip_a", "tip_b"]);
    assert_eq!(larger.world.continue_from(&yard.world).unwrap().contacts, 1);
    let arrived = [("tip_0", 7.0), ("tip_b", 3.0)];
    for (shift, own) in [(0.0, 0.0), (5e-5, 5e-5)] {
        let mut places = vec![("tip_a", tip(1e-4 + shift))];
        places.extend(arrived.iter().map(|(name, x)| (*name, tip(x + shift))));
        larger.step(&places);
        yard.step(&places[..1]);
        assert_eq!(larger.force("tip_a"), yard.force("tip_a"));
        assert!((yard.force("tip_a").x + BRISTLE * (1e-4 + shift)).abs() < 1e-9);
        for (name, _) in arrived {
            assert!((larger.force(name).x + BRISTLE * own).abs() < 1e-9, "{name}: {:?}", larger.force(name));
        }
    }
}

/// The first frame reports tunnelling since the last commit, and the side of entry of a tip is kept.
#[test]
fn the_way_since_the_last_commit_goes_on() {
    for (before, after, through) in [(-0.1, 0.1, true), (-0.0045, 0.004, false)] {
        let mut yard = Yard::new(&["wall", "tip_a"]);
        yard.step(&[("wall", Vec3::zeros()), ("tip_a", Vec3::x() * -0.2)]);
        yard.step(&[("tip_a", Vec3::x() * before)]);
        let mut larger = Yard::new(&["tip_0", "wall", "wall_2", "tip_a"]);
        larger.world.continue_from(&yard.world).unwrap();
        larger.step(&[("tip_a", Vec3::x() * after)]);
        assert_eq!(larger.world.report().status.contains(StatusBits::TUNNELLED), through);
        // Nearly through from the left: pushed back to the left.
        let depth = if through { 0.0 } else { after + 0.005 };
        assert!((larger.force("tip_a").x + SOFT * depth).abs() < 1e-9, "{:?}", larger.force("tip_a"));
    }
}

/// A group that stood still across the continuation is reported; one that has just arrived is not, wherever
/// it is.
#[test]
fn groups_that_stand_still_are_named_in_the_first_frame() {
    let belt = moving(Vec3::zeros(), Quat::identity(), Vec3::new(0.2, 0.0, 0.0), Vec3::zeros());
    let mut yard = Yard::new(&["floor", "tip_a"]);
    let step = |yard: &mut Yard, names: &[&str], shift: f64| {
        let floor = interface(&yard.world, "floor");
        yard.world.set_state(floor, &belt).unwrap();
        for name in names {
            let tip = moving(tip(shift), Quat::identity(), Vec3::x(), Vec3::zeros());
            let interface = interface(&yard.world, name);
            yard.world.set_state(interface, &tip).unwrap();
        }
        yard.world.step().unwrap();
        let named = yard.world.standing_groups(1e-3).unwrap().into_iter();
        named.map(|group| yard.world.scene().group_name(group).unwrap()).collect::<Vec<_>>()
    };
    step(&mut yard, &["tip_a"], 0.0);
    let mut larger = Yard::new(&["floor", "tip_a", "tip_b"]);
    // Frames of its own, without effect on the result.
    (0..3).for_each(|frame| _ = step(&mut larger, &["tip_a", "tip_b"], 1e-3 * f64::from(frame)));
    larger.world.continue_from(&yard.world).unwrap();
    assert_eq!(larger.world.standing_groups(1e-3).unwrap(), []);
    assert_eq!(step(&mut larger, &["tip_a", "tip_b"], 1e-3), ["floor"]);
    assert_eq!(step(&mut larger, &["tip_a", "tip_b"], 1e-3), ["floor", "tip_a", "tip_b"]);
}

/// Objects that are removed take their contacts with them; the stored energy is dissipated, as after a clear.
#[test]
fn a_smaller_world_goes_on_with_what_is_left() {
    let names = ["tip_0", "floor", "tip_a", "tip_b"];
    let places = |x: f64| [("tip_0", tip(1.0 + x)), ("tip_a", tip(2.0 + x)), ("tip_b", tip(3.0 + x))];
    let (mut yard, mut forgets) = (Yard::new(&names), Yard::new(&names));
    for x in [0.0, 3e-5, 1e-4] {
        [&mut yard, &mut forgets].into_iter().for_each(|yard| yard.step(&places(x)));
    }
    let stored = yard.world.ledger().stored;
    let mut smaller = Yard::new(&["floor", "tip_a"]);
    let went_on = smaller.world.continue_from(&yard.world).unwrap();
    let energy_left = went_on.energy_left;
    let expected = Continuation {
        objects: 2,
        pairs: 1,
        contacts: 1,
        objects_left: 2,
        pairs_left: 2,
        contacts_left: 2,
        energy_left,
    };
    assert_eq!(went_on, expected);
    assert!((energy_left - stored * 2.0 / 3.0).abs() < 1e-12 * stored && stored > 0.0);
    for gone in ["tip_0", "tip_b"] {
        let object = forgets.world.scene().object(gone).unwrap();
        forgets.world.clear_contact_history(object).unwrap();
        let pair = pair(&forgets.world, gone, "floor");
        forgets.world.set_pair_enabled(pair, false).unwrap();
    }
    for x in [1.2e-4, 5e-5, 0.0] {
        forgets.step(&places(x));
        smaller.step(&places(x)[1..2]);
        assert_eq!(smaller.force("tip_a"), forgets.force("tip_a"));
        let [left, all] = [&smaller, &forgets].map(|yard| yard.world.ledger());
        assert_eq!((left.work, left.stored), (all.work, all.stored));
        assert!((left.dissipated - all.dissipated).abs() < 1e-12 * all.dissipated.abs());
        assert!((left.work + left.stored + left.dissipated).abs() < 1e-12 * stored);
    }
}

/// Surface values, switched pairs and states come from the other world for common Objects.
#[test]
fn surfaces_switches_and_states_go_with_the_contacts() {
    let mut yard = Yard::new(&["floor", "wall", "tip_a"]);
    let floor_of = |world: &World| world.scene().model_id_of(world.scene().object("floor").unwrap()).unwrap();
    let model = floor_of(&yard.world);
    let soft =
        pong_model::Surface { stiffness: 0.5 * SOFT, ..yard.world.surface(model, "s").unwrap().clone() };
    yard.world.set_surface(model, &soft).unwrap();
    let off = pair(&yard.world, "wall", "tip_a");
    yard.world.set_pair_enabled(off, false).unwrap();
    yard.step(&[("wall", Vec3::zeros()), ("tip_a", tip(0.0))]);
    let mut larger = Yard::new(&["tip_0", "floor", "wall", "tip_a"]);
    let own = pair(&larger.world, "tip_0", "floor");
    larger.world.set_pair_enabled(own, false).unwrap();
    larger.step(&[("tip_0", Vec3::y())]);
    larger.world.continue_from(&yard.world).unwrap();
    let state =
        |yard: &Yard, name: &str| *yard.world.state_as_set(interface(&yard.world, name)).unwrap().unwrap();
    assert_eq!(state(&larger, "tip_a"), state(&yard, "tip_a"));
    assert_eq!(state(&larger, "tip_0"), at(Vec3::y(), Quat::identity()));
    assert_eq!(larger.world.surface(floor_of(&larger.world), "s"), Ok(&soft));
    let switched = [own, pair(&larger.world, "wall", "tip_a"), pair(&larger.world, "tip_0", "wall")];
    assert_eq!(switched.map(|pair| larger.world.pair_enabled(pair).unwrap()), [false, false, true]);
    yard.world.evaluate().unwrap();
    larger.world.evaluate().unwrap();
    assert_eq!(larger.force("tip_a"), yard.force("tip_a"));
    assert!((larger.force("tip_a").z - 0.5 * SOFT * 1e-3).abs() < 1e-9);
}

/// A builder made from a sealed world has all its Objects, with their ids, and accepts more.
#[test]
fn a_builder_extends_a_sealed_world() {
    let mut yard = Yard::new(&["floor", "tip_a"]);
    yard.step(&[("tip_a", tip(0.0))]);
    let mut builder = WorldBuilder::extending(&yard.world);
    let known = interface(&yard.world, "tip_a");
    assert_eq!(builder.scene().interface(builder.scene().object("tip_a").unwrap(), ""), Ok(known));
    let [floor, tip_a] = ["floor", "tip_a"].map(|name| yard.world.scene().object(name).unwrap());
    assert!(matches!(builder.pair(tip_a, floor), Err(EngineError::Duplicate { .. })));
    assert!(matches!(
        builder.create_object(yard.world.scene().model_id_of(floor).unwrap(), "tip_a"),
        Err(EngineError::Duplicate { .. })
    ));
    let model = yard.world.scene().model_id_of(tip_a).unwrap();
    let arrived = builder.create_object(model, "tip_b").unwrap();
    builder.pair(floor, arrived).unwrap();
    // The other world runs on meanwhile.
    yard.step(&[("tip_a", tip(1e-4))]);
    let (mut world, report) = builder.seal().unwrap();
    assert_eq!(report.group_pairs, 2);
    world.continue_from(&yard.world).unwrap();
    let new = world.scene().interface(arrived, "").unwrap();
    world.set_states(&[(new, at(tip(1.0), Quat::identity()))]).unwrap();
    yard.step(&[("tip_a", tip(2e-4))]);
    world.set_states(&[(known, at(tip(2e-4), Quat::identity()))]).unwrap();
    world.step().unwrap();
    assert_eq!(world.wrench(known), yard.world.wrench(known));
    assert!((world.wrench(known).unwrap().force.x + BRISTLE * 2e-4).abs() < 1e-9);
    assert_eq!(world.wrench(new).unwrap().force.x, 0.0);
    assert!(matches!(yard.world.wrench(new), Err(EngineError::UnknownId { .. })));
    // Without additions it is the same world.
    let (same, _) = WorldBuilder::extending(&yard.world).seal().unwrap();
    assert_eq!(same.scene_hash(), yard.world.scene_hash());
}

/// Law with a given number of state values; the first is the slipped distance.
#[derive(Debug)]
struct Remembers(usize);

impl FrictionForce for Remembers {
    fn state_len(&self) -> usize {
        self.0
    }

    fn evaluate(&self, input: &FrictionInput<'_>, state: &mut [f64]) -> FrictionOutput {
        state.iter_mut().enumerate().for_each(|(i, number)| *number += input.slip_b.x * (i + 1) as f64);
        let pull = -Vec3::x() * state.iter().sum::<f64>();
        FrictionOutput { force_b: pull, bristle_b: Vec3::zeros(), sticks: true, stored: 0.0 }
    }
}

/// A world in which some tips have laws with this many state values.
fn law_world(tips: &[(&str, &str, usize)]) -> World {
    let mut laws = Laws::default();
    tips.iter().for_each(|(_, law, count)| laws.add_friction(law, Arc::new(Remembers(*count))));
    let mut builder = WorldBuilder::with_extensions(ledger(), Default::default(), laws);
    let floor = load(
        &mut builder,
        &model("floor", "\"s\": (stiffness: inf)", "Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)"),
    );
    let floor = builder.create_object(floor, "floor").unwrap();
    let floor_group = builder.scene().interface(floor, "").unwrap();
    builder.set_states(&[(floor_group, State::identity())]).unwrap();
    for (name, law, _) in tips {
        let surface = surface(SOFT, &format!("friction: Custom(name: \"{law}\", parameters: [])"));
        let model = load(&mut builder, &model("tip", &surface, "Point(name: \"tip\", position: (0,0,0))"));
        let object = builder.create_object(model, name).unwrap();
        builder.pair(floor, object).unwrap();
    }
    builder.seal().unwrap().0
}

/// Laws of Objects that arrive or leave may have more state values than the others.
#[test]
fn registered_laws_keep_their_numbers() {
    let step = |world: &mut World, x: f64| {
        for object in world.scene().objects().skip(1).collect::<Vec<_>>() {
            let group = world.scene().interface(object, "").unwrap();
            world.set_state(group, &at(tip(x), Quat::identity())).unwrap();
        }
        world.step().unwrap();
        world.wrench(interface(world, "a")).unwrap().force.x
    };
    let mut world = law_world(&[("a", "two", 2)]);
    [0.0, 1e-3].into_iter().for_each(|x| _ = step(&mut world, x));
    let mut larger = law_world(&[("b", "five", 5), ("a", "two", 2)]);
    larger.continue_from(&world).unwrap();
    let expected = step(&mut world, 3e-3);
    assert!((expected + 9e-3).abs() < 1e-12);
    assert_eq!(step(&mut larger, 3e-3), expected);
    let mut smaller = law_world(&[("a", "two", 2)]);
    assert_eq!(smaller.continue_from(&larger).unwrap().contacts_left, 1);
    assert_eq!(step(&mut smaller, 4e-3), step(&mut world, 4e-3));
    let mut other = law_world(&[("a", "two", 3)]);
    let refused = other.continue_from(&world).unwrap_err().to_string();
    assert!(refused.contains("law `two`") && refused.contains("register the same law"), "{refused}");
}

/// Every refusal names the thing and the cure, and changes nothing.
#[test]
fn what_would_not_go_on_as_it_was_is_refused_and_changes_nothing() {
    let names = ["floor", "tip_a", "wall"];
    let mut yard = Yard::new(&names);
    yard.step(&[("tip_a", tip(0.0))]);
    yard.step(&[("tip_a", tip(1e-4))]);

    let of = |change: fn(&mut WorldBuilder), names: &[&str], config: Config| {
        let mut builder = builder_of(config, names);
        change(&mut builder);
        builder.seal().unwrap().0
    };
    let nothing = |_: &mut WorldBuilder| ();
    let own = |name: &'static str, text: &str, pairs: &[[usize; 2]]| {
        let mut builder = WorldBuilder::new(ledger());
        let objects = ["floor", "tip_a", "wall"].map(|known| {
            let model = load(&mut builder, &if known == name { text.to_owned() } else { text_of(known) });
            builder.create_object(model, known).unwrap()
        });
        pairs.iter().for_each(|[a, b]| _ = builder.pair(objects[*a], objects[*b]).unwrap());
        builder.seal().unwrap().0
    };
    let all = [[0, 1], [0, 2], [1, 2]];
    let tighter = text_of("tip_a").replace("mu: 0.4", "mu: 0.5");
    let renamed = text_of("tip_a").replace("name: \"tip\", surface:", "name: \"top\", surface:");
    let cases: [(&str, &str, World); 9] = [
        ("object `tip_a`", "same model", own("tip_a", &tighter, &all)),
        ("object `tip_a`", "same model", own("tip_a", &renamed, &all)),
        ("object `wall`", "same model", own("wall", &text_of("floor"), &all[..2])),
        (
            "objects `tip_a` and `floor`",
            "create `floor` before `tip_a`",
            of(nothing, &["tip_a", "floor", "wall"], ledger()),
        ),
        ("pair (`tip_a`, `floor`)", "same order", own("", "", &[[1, 0], [0, 2], [1, 2]])),
        ("pair (`tip_a`, `wall`)", "pair them", own("", "", &all[..2])),
        ("settings", "same `ledger`", of(nothing, &names, Config::default())),
        (
            "settings",
            "same `ledger`",
            of(nothing, &names, Config { accounts: Some(WrenchCoupling::Stages), ..ledger() }),
        ),
        (
            "pair (`floor`, `tip_a`)",
            "same filters",
            of(
                |builder| {
                    let [a, b] = ["floor", "tip_a"].map(|name| builder.scene().object(name).unwrap());
                    builder.filter(a, "", b, "").unwrap();
                },
                &names,
                ledger(),
            ),
        ),
    ];
    for (thing, cure, mut world) in cases {
        let refused = world.continue_from(&yard.world).unwrap_err();
        assert!(matches!(refused, EngineError::BadValue { .. }), "{refused:?}");
        let refused = refused.to_string();
        assert!(refused.contains(thing) && refused.contains(cure), "{thing}: {refused}");
        assert!(!world.has_contact_state());
    }

    // Contact state, states, switches and frame of the refusing world are unchanged.
    let mut other =
        Yard { world: of(nothing, &["tip_a", "floor", "wall"], ledger()), names: yard.names.clone() };
    other.step(&[("tip_a", tip(2.0))]);
    other.step(&[("tip_a", tip(2.0001))]);
    let (before, force, saved) = (other.saved(), other.force("tip_a"), yard.saved());
    assert!(other.world.continue_from(&yard.world).is_err());
    assert_eq!((other.saved(), other.force("tip_a"), yard.saved()), (before, force, saved));
}

/// An evaluated frame without a commit may or may not be part of the run.
#[test]
fn worlds_with_an_open_frame_are_refused() {
    let mut yard = Yard::new(&["floor", "tip_a"]);
    let mut larger = Yard::new(&["floor", "tip_a", "tip_b"]);
    yard.step(&[("tip_a", tip(0.0))]);
    larger.step(&[]);
    let open = |world: &mut World| {
        world.evaluate().unwrap();
        assert!(world.is_evaluated());
    };
    open(&mut yard.world);
    assert!(matches!(larger.world.continue_from(&yard.world), Err(EngineError::WrongPhase { .. })));
    yard.world.commit().unwrap();
    open(&mut larger.world);
    assert!(matches!(larger.world.continue_from(&yard.world), Err(EngineError::WrongPhase { .. })));
    larger.world.commit().unwrap();
    larger.world.continue_from(&yard.world).unwrap();
}

/// Refused: too little room for contacts or epochs, one model instead of two, and surfaces that do not
/// combine.
#[test]
fn what_has_no_room_or_no_value_here_is_refused() {
    let (mut yard, places) = (Yard::new(&["floor", "tip_a", "tip_b", "tip_c"]), [1.0, 2.0, 3.0].map(tip));
    let names = ["tip_a", "tip_b", "tip_c"];
    yard.step(&[0, 1, 2].map(|i| (names[i], places[i])));
    let config = Config { contact_capacity: Some(1), ..ledger() };
    let mut small = builder_of(config, &["floor", "tip_a", "tip_b", "tip_c"]).seal().unwrap().0;
    let refused = small.continue_from(&yard.world).unwrap_err().to_string();
    assert!(
        refused.contains("3 contact records") && refused.contains("`contact_capacity` of 2"),
        "{refused}"
    );

    // One model for two Objects.
    let mut builder = WorldBuilder::new(ledger());
    let [floor, tips] = ["floor", "tip"].map(|name| load(&mut builder, &text_of(name)));
    let floor = builder.create_object(floor, "floor").unwrap();
    for name in names {
        let tip = builder.create_object(tips, name).unwrap();
        builder.pair(floor, tip).unwrap();
    }
    let mut one = builder.seal().unwrap().0;
    one.continue_from(&yard.world).unwrap();
    let model = yard.world.scene().model_id_of(yard.world.scene().object("tip_b").unwrap()).unwrap();
    let mut rough = yard.world.surface(model, "s").unwrap().clone();
    if let pong_model::FrictionLaw::Bristle { mu, .. } = &mut rough.friction {
        *mu = 0.9;
    }
    yard.world.set_surface(model, &rough).unwrap();
    let refused = one.continue_from(&yard.world).unwrap_err().to_string();
    assert!(
        refused.contains("objects `tip_a` and `tip_b`") && refused.contains("add the model twice"),
        "{refused}"
    );
}

/// Pairs with more commit epochs than a world of many Objects has room for are refused, until they are
/// committed together.
#[test]
fn more_commit_epochs_than_there_is_room_for_are_refused() {
    let names: Vec<String> =
        ["floor".to_owned()].into_iter().chain((0..9).map(|tip| format!("tip_{tip}"))).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut yard = Yard::new(&names);
    yard.step(&[]);
    for name in &names[1..] {
        let pair = pair(&yard.world, "floor", name);
        yard.world.evaluate().unwrap();
        yard.world.commit_pairs(&[pair]).unwrap();
    }
    // 16,384 poses: of 2,100 movable groups seven epochs, and at least eight.
    let mut builder = builder_of(ledger(), &names);
    let newcomer = load(&mut builder, &text_of("tip"));
    (0..2_100).for_each(|number| _ = builder.create_object(newcomer, &format!("newcomer_{number}")).unwrap());
    let mut larger = builder.seal().unwrap().0;
    let refused = larger.continue_from(&yard.world).unwrap_err().to_string();
    assert!(refused.contains("9 commit epochs") && refused.contains("room for 8"), "{refused}");
    assert!(refused.contains("commit all pairs at once first") && !larger.has_contact_state(), "{refused}");

    yard.step(&[]);
    assert_eq!(larger.continue_from(&yard.world).unwrap().pairs, 9);
}

/// Equal filters continue: the filtered pair of groups stays without contact, the others keep theirs.
#[test]
fn equal_filters_go_on() {
    let filtered = |names: &[&str]| {
        let mut builder = builder_of(ledger(), names);
        let [floor, tip] = ["floor", "tip_a"].map(|name| builder.scene().object(name).unwrap());
        builder.filter(floor, "", tip, "").unwrap();
        Yard {
            world: builder.seal().unwrap().0,
            names: names.iter().map(|name| (*name).to_owned()).collect(),
        }
    };
    let mut yard = filtered(&["floor", "tip_a", "tip_b"]);
    yard.step(&[("tip_a", tip(0.0)), ("tip_b", tip(1.0))]);
    yard.step(&[("tip_a", tip(1e-4)), ("tip_b", tip(1.0 + 1e-4))]);
    let mut larger = filtered(&["tip_0", "floor", "tip_a", "tip_b"]);
    let carried = larger.world.continue_from(&yard.world).unwrap();
    assert_eq!((carried.pairs, carried.contacts), (2, 1));
    for world in [&mut yard, &mut larger] {
        world.step(&[("tip_a", tip(2e-4)), ("tip_b", tip(1.0 + 2e-4))]);
        assert_eq!(world.force("tip_a"), Vec3::zeros());
        assert!((world.force("tip_b").x + BRISTLE * 2e-4).abs() < 1e-9, "{:?}", world.force("tip_b"));
    }
}
