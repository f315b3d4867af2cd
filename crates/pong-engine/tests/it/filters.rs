//! Filters: groups that never touch. The rest of a pair is bit-identical to a scene without these groups.

use pong_engine::{
    Config, EngineError, InterfaceId, ObjectId, State, StatusBits, WorkerSettings, World, WorldBuilder,
};
use pong_model::{Extensions, Model};
use std::sync::Arc;

/// A plug with lugs that reach past the bore of a socket, as in a bayonet: the lugs touch the slots, the pin
/// the bore.
fn plug(lugs: &str, bound: &str) -> String {
    let lugs = if lugs.is_empty() {
        String::new()
    } else {
        format!(
            "(name: \"lugs\", bound: {bound}, groups: [(name: \"all\", bound: {bound}, primitives: [{lugs}])]),"
        )
    };
    format!(
        "(format: \"pong-model\", version: 1, name: \"plug\", surfaces: {{ \"s\": (stiffness: inf), \"lug\": (stiffness: inf) }},
         root: (name: \"plug\", surface: \"s\", groups: [
            {lugs}
            (name: \"pin\", bound: {bound}, primitives: [
                Cylinder(name: \"shaft\", ends: ((0.0, 0.0, 0.04), (0.0, 0.0, 0.08)), radius: 0.02)])]))"
    )
}

const LUGS: &str =
    "Capsule(name: \"l0\", surface: \"lug\", ends: ((0.017, 0.0, 0.05), (0.022, 0.0, 0.05)), radius: 0.003),
    Capsule(name: \"l1\", surface: \"lug\", ends: ((-0.022, 0.0, 0.05), (-0.017, 0.0, 0.05)), radius: 0.003)";

const SOCKET: &str = "(format: \"pong-model\", version: 1, name: \"socket\", surfaces: {
        \"slot\": (stiffness: 2e5, friction: Bristle(mu: 0.15)),
        \"guide\": (stiffness: 2e5, normal: Linear(damping: 10.0), friction: Bristle(mu: 0.15)) },
    root: (name: \"socket\", surface: \"slot\", groups: [
        (name: \"hole\", bound: Above, primitives: [
            Bore(name: \"bore\", surface: \"guide\", ends: ((0.0, 0.0, -0.04), (0.0, 0.0, 0.0)), radii: (0.0203, 0.0203))]),
        (name: \"slots\", bound: Above, primitives: [
            Sphere(name: \"stop\", center: (0.0, 0.0, -0.035), radius: 0.004)])]))";

fn model(text: &str) -> Arc<Model> {
    Arc::new(
        pong_model::parse(text, "test.ron", None, &Extensions::new())
            .unwrap_or_else(|e| panic!("{e}\n{text}")),
    )
}

/// A world of the paired Objects `plug` and `socket`, with filters by group.
fn world(
    plug: &str,
    socket: &str,
    filters: &[(&str, &str)],
    config: Config,
) -> (World, [InterfaceId; 2], usize) {
    world_of(false, [plug, socket], filters, config)
}

/// World with the socket or the plug as the first Object of the pair.
fn world_of(
    socket_first: bool,
    [plug, socket]: [&str; 2],
    filters: &[(&str, &str)],
    config: Config,
) -> (World, [InterfaceId; 2], usize) {
    let mut builder = WorldBuilder::new(config);
    let [a, b] = [("plug", plug), ("socket", socket)].map(|(name, text)| {
        let model = builder.add_model(model(text));
        builder.create_object(model, name).unwrap()
    });
    if socket_first { builder.pair(b, a) } else { builder.pair(a, b) }.unwrap();
    for (of_plug, of_socket) in filters {
        builder.filter(b, of_socket, a, of_plug).unwrap();
    }
    let roots = [a, b].map(|object| builder.scene().interface(object, "").unwrap());
    let (world, report) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    assert!(report.warnings.is_empty() && report.notes.is_empty(), "{report:?}");
    (world, roots, report.filters)
}

/// Wrenches of some frames on a path into the socket, as bits, and the largest contact count; there must be
/// no tunnelling.
fn run(
    (mut world, [plug, socket], _): (World, [InterfaceId; 2], usize),
    is_quiet: bool,
) -> (Vec<u64>, usize) {
    let (mut bits, mut most) = (Vec::new(), 0);
    for frame in 0..60 {
        let s = f64::from(frame) / 60.0;
        let angle = 0.02 * (7.0 * s).sin();
        let state = State {
            position: [4e-4 * (9.0 * s).sin(), 3e-4, -0.045 - 0.04 * s],
            orientation: [(0.5 * angle).cos(), 0.0, (0.5 * angle).sin(), 0.0],
            linear_velocity: [0.0, 0.01, -0.1],
            ..State::identity()
        };
        world.set_states(&[(plug, state), (socket, State::identity())]).unwrap();
        world.step().unwrap();
        most = most.max(world.contact_count());
        for root in [plug, socket] {
            let wrench = world.wrench(root).unwrap();
            bits.extend(wrench.force.iter().chain(&wrench.moment).map(|x| x.to_bits()));
        }
        if is_quiet {
            assert_eq!(world.report().status.bits(), 0, "frame {frame}");
        }
    }
    (bits, most)
}

fn workers(count: usize) -> Config {
    let settings = WorkerSettings { workers: count, ..WorkerSettings::default() };
    Config { workers: (count > 0).then_some(settings), ..Config::default() }
}

#[test]
fn the_rest_of_a_pair_is_as_without_the_filtered_groups_to_the_bit() {
    let expected = run(world(&plug("", "Aabb"), SOCKET, &[], Config::default()), true);
    assert!(expected.1 > 0 && expected.0.iter().any(|&bits| f64::from_bits(bits) != 0.0));
    let with_lugs = run(world(&plug(LUGS, "Aabb"), SOCKET, &[], Config::default()), false);
    assert_ne!(expected.0, with_lugs.0, "the lugs touch the bore");
    for bound in ["Aabb", "Sphere", "Obb", "Above"] {
        for count in [0, 2] {
            let filtered = world(&plug(LUGS, bound), SOCKET, &[("lugs", "")], workers(count));
            assert_eq!(filtered.2, 1);
            let clone = (filtered.0.try_clone().unwrap(), filtered.1, 1);
            assert_eq!(run(filtered, true), expected, "{bound} {count}");
            assert_eq!(run(clone, true), expected, "clone, {bound} {count}");
        }
    }
}

/// The order of the two Objects in their pair does not matter.
#[test]
fn filters_hold_for_pairs_in_either_order() {
    let without = plug("", "Aabb");
    let expected = run(world_of(true, [&without, SOCKET], &[], Config::default()), true);
    let lugs = plug(LUGS, "Aabb");
    assert_eq!(run(world_of(true, [&lugs, SOCKET], &[("lugs", "")], Config::default()), true), expected);
}

/// A hinged arm beside a base: balls of both overlap, and so do those of a subgroup of each.
fn hinge(filters: &str, arm: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"hinge\", surfaces: {{ \"s\": (stiffness: 1e5) }}, {filters}
         root: (name: \"hinge\", surface: \"s\", groups: [
            (name: \"base\", bound: Above, primitives: [
                Sphere(name: \"b\", center: (0.0, 0.0, 0.0), radius: 0.1),
                Sphere(name: \"c\", center: (1.0, 0.0, 0.0), radius: 0.1)]),
            (name: \"arm\", movable: true, groups: [
                {arm}
                (name: \"far\", bound: Above, primitives: [Sphere(name: \"f\", center: (1.0, 0.15, 0.0), radius: 0.1)])])]))"
    )
}

const NEAR: &str = "(name: \"near\", bound: Above, groups: [(name: \"deep\", bound: Above, primitives: [
    Sphere(name: \"n\", center: (0.0, 0.15, 0.0), radius: 0.1)])]),";

/// Wrench on the arm, as bits, with the Object paired with itself.
fn hinged(text: &str, filters: &[(&str, &str)]) -> (Vec<u64>, usize) {
    let mut builder = WorldBuilder::new(Config::default());
    let model = builder.add_model(model(text));
    let object = builder.create_object(model, "hinge").unwrap();
    builder.pair(object, object).unwrap();
    filters.iter().for_each(|(a, b)| builder.filter(object, a, object, b).unwrap());
    let [root, arm] = ["", "arm"].map(|path| builder.scene().interface(object, path).unwrap());
    let (mut world, report) = builder.seal().unwrap();
    world.set_states(&[(root, State::identity()), (arm, State::identity())]).unwrap();
    world.step().unwrap();
    let wrench = world.wrench(arm).unwrap();
    (wrench.force.iter().chain(&wrench.moment).map(|x| x.to_bits()).collect(), report.filters)
}

#[test]
fn nested_groups_of_one_object_are_kept_apart_by_its_model_or_by_the_host() {
    let expected = hinged(&hinge("", ""), &[]).0;
    assert_ne!(hinged(&hinge("", NEAR), &[]).0, expected);
    for group in ["near", "arm/near", "hinge/arm/near/deep", "deep"] {
        assert_eq!(hinged(&hinge("", NEAR), &[("base", group)]), (expected.clone(), 1), "{group}");
        assert_eq!(hinged(&hinge("", NEAR), &[(group, "base")]), (expected.clone(), 1), "{group}");
    }
    let of_model = hinge("filters: [(\"near\", \"base\")],", NEAR);
    assert_eq!(hinged(&of_model, &[]), (expected, 1));
    // With the arm filtered as a whole, no pair of movable groups is left.
    let (none, filters) = hinged(&of_model, &[("arm", "base")]);
    assert!(filters == 2 && none.iter().all(|&bits| f64::from_bits(bits) == 0.0));
}

/// A path through a filtered group is no tunnelling.
#[test]
fn filtered_groups_raise_no_tunnelling_event_and_combine_no_surfaces() {
    let wall = "(format: \"pong-model\", version: 1, name: \"wall\", surfaces: { \"w\": (stiffness: inf) }, root: (name: \"wall\",
        surface: \"w\", groups: [(name: \"ball\", primitives: [Sphere(name: \"s\", center: (0.0, 0.0, 0.0), radius: 0.1)])]))";
    let dot = "(format: \"pong-model\", version: 1, name: \"dot\", surfaces: { \"d\": (stiffness: inf) }, root: (name: \"dot\",
        surface: \"d\", groups: [(name: \"tip\", primitives: [Point(name: \"p\", position: (0.0, 0.0, 0.0))]),
            (name: \"far\", primitives: [Point(name: \"q\", position: (9.0, 0.0, 0.0))])]))";
    let soft = dot.replace("inf", "1e5");
    for (text, filters, tunnels) in
        [(soft.as_str(), &[][..], true), (&soft, &["tip"][..], false), (dot, &["tip", "far"][..], false)]
    {
        let mut builder = WorldBuilder::new(Config::default());
        let [a, b] = [("dot", text), ("wall", wall)].map(|(name, text)| {
            let model = builder.add_model(model(text));
            builder.create_object(model, name).unwrap()
        });
        builder.pair(a, b).unwrap();
        filters.iter().for_each(|group| builder.filter(a, group, b, "ball").unwrap());
        let [dot, wall] = [a, b].map(|object| builder.scene().interface(object, "").unwrap());
        let (mut world, report) = builder.seal().unwrap();
        assert_eq!(report.group_pairs, usize::from(filters.len() < 2), "all is kept apart");
        world.set_states(&[(dot, State::identity()), (wall, State::identity())]).unwrap();
        for z in [1.0, -1.0] {
            world.set_state(dot, &State { position: [0.0, 0.0, z], ..State::identity() }).unwrap();
            world.step().unwrap();
        }
        assert_eq!(
            world.report().status.contains(pong_engine::StatusBits::TUNNELLED),
            tunnels,
            "{filters:?}"
        );
    }
    assert!(
        matches!(
            {
                let mut builder = WorldBuilder::new(Config::default());
                let [a, b] = [("dot", dot), ("wall", wall)].map(|(name, text)| {
                    let model = builder.add_model(model(text));
                    builder.create_object(model, name).unwrap()
                });
                builder.pair(a, b).unwrap();
                builder.seal().map_err(EngineError::from).err()
            },
            Some(EngineError::Seal { .. })
        ),
        "two rigid surfaces that can meet are refused"
    );
}

#[test]
fn bad_filters_are_refused_and_change_nothing() {
    let mut builder = WorldBuilder::new(Config::default());
    let model = builder.add_model(model(&hinge("", NEAR)));
    let [a, b] = ["a", "b"].map(|name| builder.create_object(model, name).unwrap());
    let refused =
        |builder: &mut WorldBuilder, a: ObjectId, of_a: &str, b: ObjectId, of_b: &str, words: &[&str]| {
            let told = builder.filter(a, of_a, b, of_b).unwrap_err().to_string();
            assert!(words.iter().all(|word| told.contains(word)), "{told}");
        };
    refused(&mut builder, a, "nearr", b, "arm", &["group `a/nearr`", "hinge/arm/near"]);
    refused(&mut builder, a, "near", a, "far", &["one rigid body"]);
    refused(&mut builder, a, "base", a, "base", &["one rigid body"]);
    builder.filter(b, "near", a, "base").unwrap();
    refused(&mut builder, a, "base", b, "near", &["already there"]);
    assert_eq!(builder.scene().filters().len(), 1);
    builder.pair(a, a).unwrap();
    let (world, report) = builder.seal().unwrap();
    assert_eq!(report.filters, 0);
    assert!(report.notes[0].to_string().contains("are not paired"), "{:?}", report.notes);
    let mut other = WorldBuilder::new(Config::default());
    let model = other.add_model(Arc::clone(world.scene().models().next().unwrap().1));
    let [a, _] = ["a", "b"].map(|name| other.create_object(model, name).unwrap());
    other.pair(a, a).unwrap();
    assert_ne!(other.seal().unwrap().0.scene_hash(), world.scene_hash(), "filters are in the hash");
}

/// A ball that is shot through a thin rod is reported, also where a filter leaves out the rods before it.
#[test]
fn passages_through_round_solids_are_reported_beside_filtered_ones() {
    const BALL: &str =
        "(format: \"pong-model\", version: 1, name: \"ball\", surfaces: { \"s\": (stiffness: 1e5) },
        root: (name: \"ball\", surface: \"s\", groups: [(name: \"skin\", primitives: [
            Sphere(name: \"s\", center: (0.0, 0.0, 0.0), radius: 0.01)])]))";
    const RODS: &str =
        "(format: \"pong-model\", version: 1, name: \"rods\", surfaces: { \"s\": (stiffness: 1e5) },
        root: (name: \"rods\", surface: \"s\", groups: [
            (name: \"far\", primitives: [
                Capsule(name: \"c\", ends: ((0.0, -1.0, 0.5), (0.0, 1.0, 0.5)), radius: 0.1)]),
            (name: \"near\", primitives: [
                Capsule(name: \"c\", ends: ((0.0, -1.0, 0.0), (0.0, 1.0, 0.0)), radius: 0.01)])]))";
    for filters in [&[][..], &[("ball/skin", "rods/far")]] {
        let (mut world, [ball, rods], _) = world(BALL, RODS, filters, Config::default());
        let reported = [0.3, 0.2, -0.2, -0.3].map(|x| {
            let state = State { position: [x, 0.0, 0.0], ..State::identity() };
            world.set_states(&[(ball, state), (rods, State::identity())]).unwrap();
            world.step().unwrap().status.contains(StatusBits::TUNNELLED)
        });
        assert_eq!(reported, [false, false, true, false], "{filters:?}");
    }
}
