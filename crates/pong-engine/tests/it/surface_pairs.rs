//! Surfaces of two models: errors for incompatible ones, entries for pairs of equal names, notes without
//! duplicates.

use crate::common::{Rig, box_polyhedron, load, model, surface};
use pong_engine::{Config, EngineError, SealReport, SetupNote, SetupWarning, WorldBuilder};
use pong_geometry::{Quat, Vec3};
use pong_testkit::assert_near;

const TIP: &str = "Point(name: \"p\", position: (0, 0, 0))";
const FLOOR: &str = "Plane(name: \"f\", normal: (0, 0, 1), offset: 0)";

fn with_pairs(text: &str, pairs: &str) -> String {
    text.replacen("root:", &format!("pairs: [{pairs}], root:"), 1)
}

/// Seals Objects of the models, all paired.
fn seal(texts: &[&str]) -> Result<SealReport, Vec<String>> {
    let mut builder = WorldBuilder::new(Config::default());
    let mut objects = Vec::new();
    for (index, text) in texts.iter().enumerate() {
        let model = load(&mut builder, text);
        objects.push(builder.create_object(model, &format!("o{index}")).unwrap());
    }
    for (index, a) in objects.iter().enumerate() {
        objects[index + 1..].iter().for_each(|b| _ = builder.pair(*a, *b).unwrap());
    }
    match builder.seal().map_err(EngineError::from) {
        Ok((_, report)) => Ok(report),
        Err(EngineError::Seal { problems }) => Err(problems),
        Err(other) => panic!("{other}"),
    }
}

/// The upward force on a tip 1 mm below a floor.
fn force(tip: &str, floor: &str) -> f64 {
    let mut rig = Rig::new(tip, floor);
    rig.place_a(Vec3::new(0.0, 0.0, -1e-3), Quat::identity());
    rig.world.step().unwrap();
    rig.wrench(0).force.z
}

#[test]
fn surfaces_that_differ_are_named_with_their_models() {
    let tyre = model("tyre", &surface(1e5, "normal: Linear(damping: 3, ramp: 1e-3)"), TIP);
    let road = model("road", &surface(1e6, "normal: Linear(damping: 3, ramp: 1e-4)"), FLOOR);
    let problems = seal(&[&tyre, &road]).unwrap_err();
    assert_eq!(
        problems,
        [
            "surfaces `road/s` and `tyre/s`: they differ in the ramp of their damping: 0.0001 m and 0.001 m; add an entry to \
          `pairs` for (\"road/s\", \"tyre/s\") that says what holds between them"
        ]
    );
    // As the error message suggests.
    let entry = "(surfaces: (\"road/s\", \"tyre/s\"), normal: Linear(damping: 4))";
    assert!(seal(&[&with_pairs(&tyre, entry), &road]).is_ok());
    assert!(seal(&[&tyre, &with_pairs(&road, entry)]).is_ok());
}

/// Three models with surfaces of one name: an entry that names the models applies only to these two.
#[test]
fn an_entry_can_tell_surfaces_of_one_name_apart() {
    let tip = |name: &str| model(name, &surface(1e5, ""), TIP);
    let floor = model("floor", &surface(3e5, ""), FLOOR);
    let of_series = 1e-3 / (1.0 / 1e5 + 1.0 / 3e5);
    let near = |got: f64, expected: f64| assert_near(got, expected, 1e-12);
    let entry = |names: &str, k: &str| format!("(surfaces: ({names}), stiffness: {k})");
    let one = with_pairs(&floor, &entry("\"a/s\", \"floor/s\"", "5e4"));
    near(force(&tip("a"), &one), 50.0);
    near(force(&tip("b"), &one), of_series);
    near(force(&tip("a"), &floor), of_series);
    // In either order, and with only one of the two models named.
    let half = with_pairs(&floor, &entry("\"s\", \"a/s\"", "6e4"));
    near(force(&tip("a"), &half), 60.0);
    near(force(&tip("b"), &half), of_series);
    // The more specific entry takes precedence, whichever model contains it.
    let both = [entry("\"s\", \"s\"", "7e4"), entry("\"floor/s\", \"a/s\"", "8e4")].join(", ");
    near(force(&tip("a"), &with_pairs(&floor, &both)), 80.0);
    near(force(&tip("b"), &with_pairs(&floor, &both)), 70.0);
    let in_tip = with_pairs(&tip("a"), &entry("\"s\", \"s\"", "9e4"));
    near(force(&in_tip, &one), 50.0);
    near(force(&in_tip, &floor), 90.0);
}

#[test]
fn entries_that_say_as_much_and_differ_are_refused() {
    let tip = model("a", &surface(1e5, ""), TIP);
    let floor = model("floor", &surface(3e5, ""), FLOOR);
    let clash =
        "(surfaces: (\"a/s\", \"s\"), stiffness: 1e4), (surfaces: (\"floor/s\", \"s\"), stiffness: 2e4)";
    let problems = seal(&[&tip, &with_pairs(&floor, clash)]).unwrap_err();
    assert!(
        matches!(&problems[..], [told] if told.contains("(\"a/s\", \"s\") and (\"floor/s\", \"s\")") && told.contains("`floor`")),
        "{problems:?}"
    );
    // Equal values are no contradiction.
    assert!(seal(&[&tip, &with_pairs(&floor, &clash.replace("2e4", "1e4"))]).is_ok());
}

#[test]
fn friction_that_only_one_surface_has_is_told() {
    let rough = "friction: Bristle(mu: 0.5)";
    let tip = model("foot", &surface(1e5, rough), TIP);
    let notes = |floor: &str| seal(&[&tip, floor]).unwrap().notes;
    for smooth in ["", "friction: None"] {
        let told = notes(&model("ice", &surface(1e5, smooth), FLOOR));
        let [SetupNote::NoFriction { rough, law, smooth }] = &told[..] else { panic!("{told:?}") };
        assert_eq!((&rough[..], &law[..], &smooth[..]), ("foot/s", "Bristle", "ice/s"));
    }
    // Both have friction; the rigid one leaves it out and takes the other's; an entry states that none is
    // meant.
    assert!(notes(&model("road", &surface(1e5, rough), FLOOR)).is_empty());
    assert!(notes(&model("rock", "\"s\": (stiffness: inf)", FLOOR)).is_empty());
    let meant = "(surfaces: (\"foot/s\", \"ice/s\"), friction: None)";
    assert!(notes(&with_pairs(&model("ice", &surface(1e5, ""), FLOOR), meant)).is_empty());
    // A rigid surface that states no friction is noted.
    assert_eq!(notes(&model("glass", "\"s\": (stiffness: inf, friction: None)", FLOOR)).len(), 1);
}

/// Kinds of the noted pairs, for one part of each of two models.
fn limits_of(a: &str, b: &str) -> Vec<(usize, String)> {
    let [a, b] = [("a", a), ("b", b)].map(|(name, part)| model(name, &surface(1e5, ""), part));
    let of = |note: &SetupNote| match note {
        SetupNote::KnownLimit { models, kinds, limit } => {
            assert!(limit.len() > 60 && note.to_string().contains("(docs/theory.md, 6)"), "{note}");
            let [[kind_a, kind_b]] = &kinds[..] else { panic!("{kinds:?}") };
            Some((1, format!("{} {kind_a}, {} {kind_b}", models[0], models[1])))
        }
        SetupNote::NoFriction { .. } | SetupNote::IdleFilter { .. } => None,
    };
    let mut counted: Vec<(usize, String)> = Vec::new();
    for (one, kinds) in seal(&[&a, &b]).unwrap().notes.iter().filter_map(of) {
        match counted.iter_mut().find(|(_, other)| *other == kinds) {
            Some((count, _)) => *count += one,
            None => counted.push((one, kinds)),
        }
    }
    counted
}

#[test]
fn known_limits_are_noted_by_the_kinds_that_meet() {
    let capsule = "Capsule(name: \"c\", ends: ((0,0,0),(1,0,0)), radius: 0.1)";
    let bar = "LineSegment(name: \"l\", ends: ((0,0,0),(1,0,0)))";
    let pin = |length: f64| format!("Cylinder(name: \"p\", ends: ((0,0,0),({length:?},0,0)), radius: 0.1)");
    let cone = |tip: f64| format!("Cone(name: \"k\", ends: ((0,0,0),(1,0,0)), radii: (0.1,{tip:?}))");
    let bore = "Bore(name: \"b\", ends: ((0,0,0),(1,0,0)), radii: (0.1,0.1))";
    let solid = "Polyhedron(name: \"w\", vertices: [(1,0,0),(0,1,0),(0,0,1),(0,0,0)], faces: [[0,1,2],[0,3,1],[1,3,2],[2,3,0]])";
    let ball = "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)";
    let corner = "Point(name: \"t\", position: (1,0,0))";
    let cornered = format!("{corner}, {solid}");
    let boxes = [("l", -0.5, 0.0, "5"), ("r", 0.5, 0.0, "4,1"), ("t", 0.5, 0.6, "0")];
    let pieces = boxes.map(|(name, x, z, walls)| box_polyhedron(name, [x, 0.0, z], [0.5, 0.4, 0.3], walls));
    let (whole, pieces) = (
        pieces[..1].join(",") + ", " + &box_polyhedron("r", [0.5, 0.0, 0.0], [0.5, 0.4, 0.3], "4"),
        pieces.join(","),
    );
    for (a, b, expected) in [
        (capsule, capsule, vec![]),
        (bar, capsule, vec![]),
        (&*pin(1.0), bar, vec![]),
        (capsule, &cone(0.05), vec![]),
        (solid, capsule, vec![]),
        (&whole, capsule, vec![]),
        (&pieces, capsule, vec![(2, "b Capsule, a Polyhedron")]),
        (&pin(0.04), bore, vec![]),
        (&cone(0.0), FLOOR, vec![(1, "a Cone, b Plane")]),
        (&cone(0.05), FLOOR, vec![]),
        (ball, capsule, vec![]),
        (bar, solid, vec![]),
        (bar, &pieces, vec![(1, "a LineSegment, b Polyhedron")]),
        (&*pin(1.0), solid, vec![]),
        (&*pin(1.0), &pieces, vec![(1, "a Cylinder, b Polyhedron")]),
        (&pieces, &cone(0.05), vec![(1, "b Cone, a Polyhedron")]),
        (corner, solid, vec![]),
        // Bodies that stack: corners and a solid on both sides.
        (&cornered, &cornered, vec![(1, "a Point, b Polyhedron"), (1, "b Point, a Polyhedron")]),
        (capsule, FLOOR, vec![]),
    ] {
        let expected: Vec<_> = expected.into_iter().map(|(count, kinds)| (count, kinds.to_owned())).collect();
        assert_eq!(limits_of(a, b), expected, "{a} {b}");
    }
}

/// A rigid floor without laws holds a tip like one that repeats the tip's laws.
#[test]
fn a_silent_rigid_floor_is_the_one_that_repeats_the_other() {
    let law = "normal: HuntCrossley(dissipation: 0.3, exponent: 1.5), friction: Bristle(mu: 0.5, static_excess: 0.2)";
    let tip = model("tip", &surface(1e7, law), TIP);
    let [silent, telling] = ["", law]
        .map(|law| Rig::new(&tip, &model("floor", &format!("\"s\": (stiffness: inf, {law})"), FLOOR)));
    let run = |mut rig: Rig| {
        let mut wrenches = Vec::new();
        for k in 0..40 {
            let x = 1e-5 * f64::from(k);
            rig.place_a(Vec3::new(x, 0.0, -1e-4 - 0.2 * x), Quat::identity());
            rig.world.step().unwrap();
            wrenches.push(rig.wrench(0).force);
        }
        wrenches
    };
    let forces = run(silent);
    assert!(forces.iter().any(|force| force.x < -1e-3) && forces == run(telling));
}

/// 200 Objects of two models: every warning appears once, with its number of pairs.
#[test]
fn a_warning_about_two_models_is_told_once() {
    let mut builder = WorldBuilder::new(Config::default());
    let soft = surface(1e5, "");
    let floor = load(&mut builder, &model("floor", &soft, FLOOR));
    let plate = load(
        &mut builder,
        &model("plate", &soft, "Triangle(name: \"t\", vertices: ((0, 0, 0), (1, 0, 0), (0, 1, 0)))"),
    );
    let floor = builder.create_object(floor, "floor").unwrap();
    for index in 0..200 {
        let object = builder.create_object(plate, &format!("plate {index}")).unwrap();
        // In either order of names.
        let (a, b) = if index % 2 == 0 { (object, floor) } else { (floor, object) };
        builder.pair(a, b).unwrap();
    }
    let (_, report) = builder.seal().unwrap();
    let told: Vec<String> = report.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "models `floor` and `plate`: Plane and Triangle have no tester and ignore each other (`floor` and `plate 0` and \
             199 more pairs): both are surfaces; declare them solids (`contact: Solid`), or give one points",
            "models `floor` and `plate` are paired but nothing of one can touch anything of the other (`floor` and `plate 0` \
             and 199 more pairs): they pass through each other; give one of them what the other can touch; Plane can touch Point, \
             LineSegment, Ray, Sphere, Ellipsoid, Capsule, Cylinder, Cone; Triangle can touch Ray, Sphere, Ellipsoid, Capsule, Cylinder, Cone",
        ]
    );
    assert!(matches!(report.warnings[0], SetupWarning::IgnoredPair { .. }));
    assert_eq!(report.untouchable_pairs.len(), 200);
    assert_eq!(
        report.untouchable_pairs[..2],
        [["plate 0", "floor"], ["floor", "plate 1"]].map(|pair| pair.map(str::to_owned))
    );
}

/// Every two built-in kinds without a tester that may be meant say why they ignore each other.
#[test]
fn pairs_without_a_tester_say_why() {
    let parts = [
        "Point(name: \"p\", position: (0,0,0))",
        "LineSegment(name: \"l\", ends: ((0,0,0),(1,0,0)))",
        "Ray(name: \"r\", origin: (0,0,0), direction: (0,0,1), length: 1)",
        "Sphere(name: \"s\", center: (0,0,0), radius: 1)",
        "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (1,2,3))",
        "Triangle(name: \"t\", vertices: ((0,0,0),(1,0,0),(0,1,0)))",
        "Polyhedron(name: \"w\", vertices: [(1,0,0),(0,1,0),(0,0,1),(0,0,0)], faces: [[0,1,2],[0,3,1],[1,3,2],[2,3,0]])",
        FLOOR,
        "Capsule(name: \"c\", ends: ((0,0,0),(1,0,0)), radius: 0.1)",
        "Cylinder(name: \"d\", ends: ((0,0,0),(1,0,0)), radius: 0.1)",
        "Cone(name: \"k\", ends: ((0,0,0),(1,0,0)), radii: (0.1,0.2))",
        "Bore(name: \"b\", ends: ((0,0,0),(1,0,0)), radii: (0.1,0.1))",
    ];
    let mut ignored = 0;
    for (index, a) in parts.iter().enumerate() {
        for b in &parts[index..] {
            let [a, b] = [("a", a), ("b", b)].map(|(name, part)| model(name, &surface(1e5, ""), part));
            for warning in seal(&[&a, &b]).unwrap().warnings {
                if let SetupWarning::IgnoredPair { .. } = &warning {
                    ignored += 1;
                    assert!(warning.to_string().contains("): "), "{warning}");
                }
            }
        }
    }
    assert!(ignored > 15, "{ignored}");
}
