//! Valid models, and the results of loading them.

use crate::common::{CUBE_FACES, cube_vertices, load, model_of};
use pong_geometry::Vec3;
use pong_geometry::bounding::Volume;
use pong_geometry::primitive::{PrimitiveKind, RayResponse};
use pong_model::{Exponent, Extensions, FrictionLaw, NormalLaw};

#[test]
fn every_primitive_and_option_is_read() {
    let model = load(include_str!("../models/everything.ron"));
    assert_eq!(model.name, "everything");
    assert!(!model.entry_memory);
    assert_eq!(model.bodies.len(), 3);
    let root = &model.bodies[0];
    assert_eq!((root.name.as_str(), root.path.as_str(), root.parent), ("vehicle", "vehicle", None));
    let arm = &model.bodies[1];
    assert_eq!((arm.path.as_str(), arm.parent), ("vehicle/arm", Some(0)));
    let tip = &model.bodies[2];
    assert_eq!((tip.path.as_str(), tip.parent), ("vehicle/arm/tip", Some(1)));
    let kinds: Vec<_> = root.primitives.iter().map(|p| p.kind).collect();
    assert_eq!(kinds[..3], [PrimitiveKind::Point, PrimitiveKind::Plane, PrimitiveKind::LineSegment]);
    assert_eq!(root.rays[0].response, RayResponse::Axial);
    assert_eq!(root.rays[0].reach, Some(0.25));
    assert_eq!(root.rays[0].direction, Vec3::new(0.0, 0.0, 1.0));
    assert_eq!(root.planes[0].normal, Vec3::new(0.0, 0.0, 1.0));
    assert_eq!(root.ellipsoids[0].semi_axes, Vec3::new(3.0, 2.0, 1.0));
    assert_eq!(root.triangles.triangles.len(), 1 + 2 * 2);
    assert!(matches!(root.tree.nodes[0].volume, Volume::Unbounded));
    assert!(model.warnings.is_empty(), "{:?}", model.warnings);
}

/// The deepest accepted tree of groups loads on the stack that docs/model_format.md asks for (Rust's own
/// threads have 2 MiB). One level more is refused there, and so are texts of unlimited nesting.
#[test]
fn the_deepest_text_loads_on_a_small_stack() {
    const STACK: usize = 256 * 1024;
    let nested = |groups: usize| {
        let tip = r#"primitives: [Point(name: "p", position: (0, 0, 0))]"#.to_owned();
        let inside =
            (0..groups).fold(tip, |inside, level| format!("groups: [(name: \"g{level}\", {inside})]"));
        format!(
            r#"(format: "pong-model", version: 1, name: "m", surfaces: {{ "s": (stiffness: 1e5) }},
                root: (name: "m", surface: "s", {inside}))"#
        )
    };
    let rules = |text: String| {
        let read = move || match pong_model::parse(&text, "m.ron", None, &Extensions::new()) {
            Ok(_) => Vec::new(),
            Err(errors) => errors.0.iter().map(|error| error.rule).collect(),
        };
        std::thread::Builder::new().stack_size(STACK).spawn(read).unwrap().join().unwrap()
    };
    // A point in a primitive is three levels below its group.
    assert_eq!(rules(nested(61)), [""; 0]);
    assert_eq!(rules(nested(62)), ["too-deep"]);
    assert_eq!(rules("[".repeat(100_000)), ["too-deep"]);
    assert_eq!(rules("(a: ".repeat(100_000)), ["too-deep"]);
}

#[test]
fn surfaces_and_pairs_are_read() {
    let model = load(include_str!("../models/everything.ron"));
    let by_name = |name: &str| model.surfaces.iter().find(|s| s.name == name).unwrap();
    assert_eq!(by_name("steel").stiffness, f64::INFINITY);
    // A rigid surface takes laws it does not name from the other surface.
    assert_eq!(by_name("steel").normal, NormalLaw::Inherited);
    let NormalLaw::Linear { damping, .. } = by_name("rubber").normal else { panic!() };
    // zeta 0.25528 gives e = 0.5 for the law that never pulls; the textbook formula would give 0.2155.
    assert!((damping - 2.0 * 0.25528 * (1e4_f64 * 100.0).sqrt()).abs() < 0.02, "{damping}");
    let NormalLaw::HuntCrossley { dissipation, exponent } = by_name("foam").normal else { panic!() };
    assert_eq!(exponent, Exponent::ThreeHalves);
    assert!((dissipation * 0.1 - 1.0).abs() < 1e-4);
    let NormalLaw::PowerLaw { damping, exponent, damping_exponent } = by_name("glass").normal else {
        panic!()
    };
    assert_eq!((exponent, damping_exponent), (Exponent::ThreeHalves, 1.0));
    // c·2^(−0.2)·k^(−0.8)·m^(−0.2)·v^0.6 = 0.60744 gives e = 0.6 (an integration in time by another program).
    let group = damping * (1e9_f64.powf(-0.8) * (2.0_f64 * 0.04).powf(-0.2) * 2.0_f64.powf(0.6));
    assert!((group - 0.607_435).abs() < 1e-4, "{group}");
    let bristle = FrictionLaw::Bristle {
        mu: 0.2,
        static_excess: 0.1,
        stiffness: None,
        damping: Some(3.0),
        rolling: 0.0,
        spinning: 0.0,
    };
    assert_eq!(by_name("rubber").friction, bristle);
    assert_eq!(model.pair_overrides[0].surfaces, ["steel".to_owned(), "elsewhere".to_owned()]);
    assert_eq!(model.pair_overrides[0].friction, Some(FrictionLaw::None));
    assert_eq!(model.pair_overrides[0].normal, None);
}

#[test]
fn poses_compose_down_to_the_movable_group_and_in_the_root_frame() {
    let model = load(include_str!("../models/everything.ron"));
    let tip = &model.bodies[2];
    // arm is at (1, 0, 0), rotated by 90° about z; mount is 2 m along its x; tip is 1 m above the mount.
    let x_rt = tip.initial_pose.unwrap();
    assert!((x_rt.position - Vec3::new(1.0, 2.0, 1.0)).norm() < 1e-15);
    // mount's point at its own (0, 0, 1) is at (2, 0, 1) in the frame of arm.
    let arm = &model.bodies[1];
    assert!((arm.points[0].position - Vec3::new(2.0, 0.0, 1.0)).norm() < 1e-15);
}

#[test]
fn a_cube_has_six_faces_twelve_pushing_edges_and_eight_pushing_vertices() {
    let model = load(&model_of(&format!(
        "Polyhedron(name: \"c\", vertices: {}, faces: {CUBE_FACES})",
        cube_vertices([0.0; 3], [1.0; 3])
    )));
    let cube = &model.bodies[0].polyhedra[0];
    assert_eq!((cube.faces.len(), cube.edges.len(), cube.vertices.len()), (6, 12, 8));
    assert!(cube.edges.iter().all(|edge| edge.push.is_some()));
    assert!(cube.vertices.iter().all(|v| v.pushes && v.cone_count == 3));
    assert_eq!(cube.diameter, 3.0_f64.sqrt());
    for (index, face) in cube.faces.iter().enumerate() {
        for rim in cube.rim(index) {
            let edge = &cube.edges[rim.edge as usize];
            assert!(edge.faces.contains(&(index as u32)) && edge.faces.contains(&rim.neighbor));
            assert_ne!(rim.neighbor, index as u32);
            assert!(rim.outward.dot(&face.normal).abs() < 1e-14);
            assert!(rim.outward.dot(&edge.direction).abs() < 1e-14);
            assert!(rim.outward.dot(&(Vec3::repeat(0.5) - rim.anchor)) < 0.0);
            assert_eq!(rim.anchor, cube.vertices[edge.vertices[0] as usize].position);
        }
    }
    for vertex in 0..8 {
        let out = cube.vertices[vertex].position - Vec3::repeat(0.5);
        assert!(cube.cone(vertex).iter().all(|away| away.dot(&out) < 0.0));
    }
}

#[test]
fn poses_of_nested_groups_turn_one_after_the_other() {
    // Half a turn about z, 2 m along x and 5 m up; below it a quarter turn about x.
    let model = load(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: { \"s\": (stiffness: 1) },
         root: (name: \"root\", surface: \"s\", groups: [
           (name: \"a\", pose: (position: (2, 0, 5), orientation: (0, 0, 0, 1)), groups: [
             (name: \"b\", pose: (position: (0, 1, 0), orientation: (0.7071067811865476, 0.7071067811865476, 0, 0)),
              primitives: [
                Point(name: \"p\", position: (1, 2, 3)),
                Plane(name: \"q\", normal: (0, 1, 0), offset: 2),
                Ray(name: \"r\", origin: (0, 0, 0), direction: (1, 0, 0), length: 1),
                Ellipsoid(name: \"e\", center: (0, 0, 0), semi_axes: (1, 2, 3)),
              ])])]))",
    );
    let body = &model.bodies[0];
    let near = |a: Vec3, b: [f64; 3]| (a - Vec3::from(b)).norm() < 1e-14;
    // b maps (1, 2, 3) to (1, 1 − 3, 2); a maps that to (2 − 1, 2, 5 + 2).
    assert!(near(body.points[0].position, [1.0, 2.0, 7.0]), "{}", body.points[0].position);
    assert!(near(body.planes[0].normal, [0.0, 0.0, 1.0]));
    assert!((body.planes[0].offset - 7.0).abs() < 1e-14);
    assert!(near(body.rays[0].direction, [-1.0, 0.0, 0.0]));
    assert!((body.ellipsoids[0].half_width(&Vec3::z()) - 2.0).abs() < 1e-14);
}

/// Model with the given tables of surfaces and pairs, in RON.
fn with_tables(surfaces: &str, pairs: &str) -> pong_model::Model {
    load(&format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{ \"s\": (stiffness: 1), {surfaces} }}, pairs: [{pairs}],\n\
         root: (name: \"root\", surface: \"s\", primitives: [Point(name: \"p\", position: (0,0,0))]))"
    ))
}

/// c_t = 2·√(k_t·m) if a mass is given; else by the damping ratio of the linear law, c·√(k_t/k); else 0.
#[test]
fn a_bristle_without_damping_takes_it_from_a_mass_or_from_the_normal_law() {
    let rebound = "normal: Linear(restitution: (e: 0.5, mass: 3.0))";
    let crossley = "normal: HuntCrossley(dissipation: 0.2, exponent: 1.5)";
    let power =
        "normal: PowerLaw(exponent: 1, damping_exponent: 1, restitution: (e: 0.5, speed: 1.0, mass: 3.0))";
    let damped_power = "normal: PowerLaw(exponent: 1, damping_exponent: 0, damping: 60)";
    let (k, third): (f64, f64) = (9e5, 2.0 / 3.0);
    for (laws, k_t, c_t) in [
        (format!("{rebound}, friction: Bristle(mu: 0.3)"), third * k, 2.0 * (third * k * 3.0).sqrt()),
        (format!("{rebound}, friction: Bristle(mu: 0.3, stiffness: 4e4)"), 4e4, 2.0 * (4e4_f64 * 3.0).sqrt()),
        (
            format!("{rebound}, friction: Bristle(mu: 0.3, mass: 0.5)"),
            third * k,
            2.0 * (third * k * 0.5).sqrt(),
        ),
        (format!("{rebound}, friction: Bristle(mu: 0.3, damping: 7)"), third * k, 7.0),
        (format!("{rebound}, friction: Bristle(mu: 0.3, damping: 0)"), third * k, 0.0),
        (
            format!("{crossley}, friction: Bristle(mu: 0.3, mass: 2)"),
            third * k,
            2.0 * (third * k * 2.0).sqrt(),
        ),
        (format!("{crossley}, friction: Bristle(mu: 0.3)"), third * k, 0.0),
        (format!("{power}, friction: Bristle(mu: 0.3)"), third * k, 2.0 * (third * k * 3.0).sqrt()),
        (format!("{damped_power}, friction: Bristle(mu: 0.3)"), third * k, 0.0),
        ("friction: Bristle(mu: 0.3, mass: 2)".to_owned(), third * k, 2.0 * (third * k * 2.0).sqrt()),
        ("friction: Bristle(mu: 0.3)".to_owned(), third * k, 0.0),
        (
            "normal: Linear(damping: 60), friction: Bristle(mu: 0.3)".to_owned(),
            third * k,
            60.0 * third.sqrt(),
        ),
        (
            "normal: Linear(damping: 60), friction: Bristle(mu: 0.3, stiffness: 1e4)".to_owned(),
            1e4,
            60.0 / 90_f64.sqrt(),
        ),
    ] {
        let model = with_tables(&format!("\"t\": (stiffness: 9e5, {laws})"), "");
        let (found_k_t, found_c_t) = model.surfaces[1].bristle().unwrap();
        assert!((found_k_t - k_t).abs() <= 1e-15 * k_t, "{laws}: {found_k_t}");
        assert!((found_c_t - c_t).abs() <= 1e-15 * c_t, "{laws}: {found_c_t}");
    }
}

/// A rigid surface gives no default damping of a bristle; for a soft bristle of its own it may give the mass.
#[test]
fn a_bristle_of_a_rigid_surface_needs_no_damping() {
    for (bristle, k_t, c_t) in [
        ("Bristle(mu: 0.3)", f64::INFINITY, 0.0),
        ("Bristle(mu: 0.3, stiffness: 4e4)", 4e4, 0.0),
        ("Bristle(mu: 0.3, stiffness: 4e4, mass: 1)", 4e4, 400.0),
    ] {
        for normal in ["", "normal: Linear(damping: 60),"] {
            let model = with_tables(&format!("\"t\": (stiffness: inf, {normal} friction: {bristle})"), "");
            assert_eq!(model.surfaces[1].bristle(), Some((k_t, c_t)), "{normal} {bristle}");
        }
    }
}

/// An entry of `pairs` gives mass and stiffness itself, or leaves the damping to the two surfaces.
#[test]
fn a_bristle_of_a_pair_takes_the_mass_that_its_entry_names() {
    for (values, expected) in [
        (
            "stiffness: 6e4, normal: Linear(restitution: (e: 0.5, mass: 1)), friction: Bristle(mu: 0.3)",
            Some(400.0),
        ),
        ("stiffness: 6e4, friction: Bristle(mu: 0.3, mass: 4)", Some(800.0)),
        ("friction: Bristle(mu: 0.3, stiffness: 1e4, mass: 4)", Some(400.0)),
        ("stiffness: 6e4, normal: Linear(damping: 9), friction: Bristle(mu: 0.3)", None),
        ("friction: Bristle(mu: 0.3)", None),
        ("friction: Bristle(mu: 0.3, damping: 0)", Some(0.0)),
    ] {
        let model = with_tables("", &format!("(surfaces: (\"s\", \"s\"), {values})"));
        let Some(FrictionLaw::Bristle { damping, .. }) = model.pair_overrides[0].friction else { panic!() };
        assert_eq!(damping, expected, "{values}");
    }
}

/// Omitted damping follows the normal law in effect, so the model differs from one with the same number or
/// with none.
#[test]
fn the_hash_knows_whether_a_bristle_gives_its_damping() {
    let hash = |bristle: &str| {
        with_tables(
            &format!("\"t\": (stiffness: 1e5, normal: Linear(damping: 9), friction: Bristle({bristle}))"),
            "",
        )
        .hash
    };
    let derived = format!("mu: 0.3, damping: {:?}", 9.0 * (2.0_f64 / 3.0).sqrt());
    assert_ne!(hash("mu: 0.3"), hash("mu: 0.3, damping: 0"));
    assert_ne!(hash("mu: 0.3"), hash(&derived));
    assert_eq!(
        hash("mu: 0.3, mass: 6"),
        hash(&format!("mu: 0.3, damping: {:?}", 2.0 * (2.0 / 3.0 * 1e5 * 6.0_f64).sqrt()))
    );
}

/// Lengths of rolling and spinning resistance are read and hashed; lengths of zero are as if they were left out.
#[test]
fn rolling_and_spinning_resistance_is_read() {
    let read =
        |bristle: &str| with_tables(&format!("\"t\": (stiffness: 1e5, friction: Bristle({bristle}))"), "");
    let model = read("mu: 0.3, rolling: 2e-3, spinning: 1e-3");
    let surface = model.surfaces.iter().find(|surface| surface.name == "t").unwrap();
    assert_eq!(surface.resistances(), [2e-3, 1e-3]);
    let hash = |bristle: &str| read(bristle).hash;
    assert_eq!(hash("mu: 0.3"), hash("mu: 0.3, rolling: 0, spinning: 0"));
    let hashes = ["mu: 0.3", "mu: 0.3, rolling: 2e-3", "mu: 0.3, spinning: 2e-3"].map(hash);
    assert!(hashes[0] != hashes[1] && hashes[1] != hashes[2] && hashes[0] != hashes[2]);
}
