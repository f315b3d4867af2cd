//! Round parts in model files: loaded values, refusals, and the hash.

use crate::common::{faults, load, model_of};
use pong_geometry::Vec3;
use pong_geometry::primitive::PrimitiveKind;
use pong_model::MovableGroup;

const CAPSULE: &str = "Capsule(name: \"p\", ends: ((1, 2, 3), (1, 2, 5)), radius: 0.5)";
const CYLINDER: &str = "Cylinder(name: \"p\", ends: ((1, 2, 3), (1, 2, 5)), radius: 0.5)";
const CONE: &str = "Cone(name: \"p\", ends: ((1, 2, 3), (1, 2, 5)), radii: (0.5, 0.25))";
const BORE: &str = "Bore(name: \"p\", ends: ((1, 2, 3), (1, 2, 5)), radii: (0.5, 0.25), thickness: 0.125, mouths: (true, false))";

fn body(primitive: &str) -> MovableGroup {
    load(&model_of(primitive)).bodies.remove(0)
}

/// Rule, cause and cure of the only fault of a primitive.
fn refused(primitive: &str) -> (&'static str, String, String) {
    let errors = faults(&model_of(primitive));
    let [error] = &errors.0[..] else { panic!("{primitive}: {errors}") };
    assert_eq!(error.path, "root/p");
    (error.rule, error.cause.clone(), error.cure.clone())
}

#[test]
fn each_is_read_with_its_numbers() {
    let ends = [Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 2.0, 5.0)];
    let capsule = body(CAPSULE);
    assert_eq!((capsule.capsules[0].ends, capsule.capsules[0].radius), (ends, 0.5));
    let cylinder = body(CYLINDER);
    assert_eq!((cylinder.frusta[0].ends, cylinder.frusta[0].radii), (ends, [0.5, 0.5]));
    assert_eq!((cylinder.frusta[0].axis, cylinder.frusta[0].length), (Vec3::z(), 2.0));
    let cone = body(CONE);
    assert_eq!((cone.frusta[0].ends, cone.frusta[0].radii), (ends, [0.5, 0.25]));
    let bore = body(BORE);
    assert_eq!((bore.bores[0].hole.ends, bore.bores[0].hole.radii), (ends, [0.5, 0.25]));
    assert_eq!((bore.bores[0].thickness, bore.bores[0].mouths), (0.125, [true, false]));
    let kinds = [capsule, cylinder, cone, bore].map(|body| body.primitives[0].kind);
    let expected =
        [PrimitiveKind::Capsule, PrimitiveKind::Cylinder, PrimitiveKind::Cone, PrimitiveKind::Bore];
    assert_eq!(kinds, expected);
}

#[test]
fn a_bore_has_two_mouths_and_pushes_from_as_far_as_its_smaller_radius_where_nothing_else_is_said() {
    let bore = |radii: &str| {
        let text = format!("Bore(name: \"p\", ends: ((0,0,0), (1,0,0)), radii: {radii})");
        let bore = body(&text).bores[0];
        (bore.thickness, bore.mouths)
    };
    assert_eq!(bore("(0.5, 0.25)"), (0.25, [true, true]));
    assert_eq!(bore("(0.5, 0.75)"), (0.5, [true, true]));
    assert_eq!(bore("(0, 0.75)"), (0.75, [true, true]), "a tip is no radius");
}

/// 2 m along y, a quarter turn about z.
#[test]
fn the_pose_of_a_group_carries_them() {
    let turned = |primitive: &str| {
        let text = model_of("").replace(
            "primitives: [\n\n]",
            &format!(
                "groups: [(name: \"g\", pose: (position: (0, 2, 0), orientation: (0.7071067811865476, 0, 0, \
                 0.7071067811865476)), primitives: [{primitive}])]"
            ),
        );
        load(&text).bodies.remove(0)
    };
    let bodies = [CAPSULE, CYLINDER, CONE, BORE].map(turned);
    let ends = [
        bodies[0].capsules[0].ends,
        bodies[1].frusta[0].ends,
        bodies[2].frusta[0].ends,
        bodies[3].bores[0].hole.ends,
    ];
    for [one, other] in ends {
        assert!((one - Vec3::new(-2.0, 3.0, 3.0)).norm() < 1e-15, "{one}");
        assert!((other - Vec3::new(-2.0, 3.0, 5.0)).norm() < 1e-15, "{other}");
    }
}

/// Every message names the numbers, the fault and the cure.
#[test]
fn what_has_no_length_no_radius_or_no_size_is_refused() {
    let kinds = [
        (CAPSULE, "move one end, or use a Sphere"),
        (CYLINDER, "move one end: a cylinder has a length"),
        (CONE, "move one end: a cone has a length"),
        (BORE, "move one end: a bore has a length"),
    ];
    for (text, cure) in kinds {
        let cause = "both ends of the axis are the same place";
        let told = refused(&text.replace("(1, 2, 5)", "(1, 2, 3)"));
        assert_eq!(told, ("zero-length", cause.to_owned(), cure.to_owned()));
        assert_eq!(refused(&text.replace("(1, 2, 5)", "(1, 2, NaN)")).0, "not-finite");
        assert_eq!(refused(&text.replace("((1, 2, 3), ", "((1, 2, 3), (0, 0, 0), ")).0, "wrong-type");
        assert_eq!(refused(&text.replace("ends: ((1, 2, 3), (1, 2, 5)), ", "")).0, "missing-field");
    }
    for text in [CAPSULE, CYLINDER] {
        assert_eq!(refused(&text.replace("0.5", "0")).0, "not-positive");
        assert_eq!(refused(&text.replace("0.5", "-0.5")).1, "the radius is -0.5");
        assert_eq!(refused(&text.replace("0.5", "inf")).0, "not-finite");
        let taken = text.replace("radius: 0.5", "radii: (1, 2)");
        let rules: Vec<_> = faults(&model_of(&taken)).0.iter().map(|error| error.rule).collect();
        assert_eq!(rules, ["missing-field", "unknown-field"]);
    }
    for (text, cure) in
        [(CONE, "give one end a radius, or use a LineSegment"), (BORE, "give one end a radius")]
    {
        let told = refused(&text.replace("(0.5, 0.25)", "(0, 0.0)"));
        assert_eq!(told, ("not-positive", "both radii are zero".to_owned(), cure.to_owned()));
        assert_eq!(refused(&text.replace("(0.5, 0.25)", "(0.5, -1)")).1, "a radius is -1");
        assert_eq!(refused(&text.replace("(0.5, 0.25)", "(0.5, -1)")).0, "negative");
        assert_eq!(refused(&text.replace("(0.5, 0.25)", "0.5")).0, "wrong-type");
    }
    assert_eq!(refused(&BORE.replace("0.125", "0")).1, "the thickness is 0");
    for mouths in ["true", "(true)", "(true, 1)", "(true, true, true)"] {
        assert_eq!(refused(&BORE.replace("(true, false)", mouths)).0, "wrong-type", "{mouths}");
    }
}

#[test]
fn one_fault_of_a_round_part_does_not_hide_the_next() {
    let bore = "Bore(name: \"p\", ends: ((0,0,0), (0,0,0)), radii: (-1, 0), thickness: -2, mouths: 3)";
    let rules: Vec<_> = faults(&model_of(bore)).0.iter().map(|error| error.rule).collect();
    assert_eq!(rules, ["zero-length", "negative", "not-positive", "wrong-type"]);
}

/// The hash includes every number and the kind: a cone of equal radii differs from a cylinder. Names are left
/// out.
#[test]
fn the_hash_knows_every_number_of_a_round_part() {
    let hash = |primitive: &str| load(&model_of(primitive)).hash;
    let mut hashes = Vec::new();
    for text in [CAPSULE, CYLINDER, CONE, BORE] {
        hashes.extend([hash(text), hash(&text.replace("(1, 2, 3)", "(1, 2, 3.0000000001)"))]);
        hashes.extend([hash(&text.replace("(1, 2, 5)", "(1, 2.5, 5)")), hash(&text.replace("0.5", "0.75"))]);
        assert_eq!(hash(text), hash(&text.replace("\"p\"", "\"other\"")));
    }
    hashes.push(hash(&CYLINDER.replace("Cylinder", "Cone").replace("radius: 0.5", "radii: (0.5, 0.5)")));
    hashes.extend([hash(&CONE.replace("0.25", "0.125")), hash(&BORE.replace("0.25", "0.375"))]);
    hashes.extend([
        hash(&BORE.replace("0.125", "0.0625")),
        hash(&BORE.replace("(true, false)", "(true, true)")),
    ]);
    let count = hashes.len();
    hashes.sort_unstable();
    hashes.dedup();
    assert_eq!(hashes.len(), count);
    assert_eq!(hash(&BORE.replace("thickness: 0.125, ", "")), hash(&BORE.replace("0.125", "0.25")));
    assert_eq!(hash(CAPSULE), 0xd903_4d44_0356_62d2, "stable on every machine and from version to version");
}
