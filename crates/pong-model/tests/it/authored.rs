//! Files as written, and faults of shapes by face and vertex.

use pong_geometry::Vec3;
use pong_model::Extensions;
use pong_model::authored::{self, Node, Value};
use pong_model::shapes::{check_polyhedron, check_triangles};

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];
const FACES: [[u32; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn model(primitive: &str) -> String {
    format!(
        "(format: \"pong-model\", version: 1, name: \"m\", surfaces: {{\"s\": (stiffness: 1e6)}},\n\
         root: (name: \"m\", surface: \"s\", primitives: [\n{primitive}\n]))"
    )
}

fn field<'n>(node: &'n Node, name: &str) -> &'n Node {
    let Value::Struct(_, fields) = &node.value else { panic!("{node:?} has no fields") };
    &fields.iter().find(|field| field.name.as_ref() == name).unwrap().value
}

fn rules(primitive: &str) -> Vec<(u32, &'static str)> {
    let errors = authored::parse(&model(primitive), "m.ron").expect_err("it is refused");
    errors.0.iter().map(|error| (error.line, error.rule)).collect()
}

#[test]
fn a_shape_that_the_loader_refuses_is_read() {
    let shapes = [
        "Polyhedron(name: \"p\", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]])",
        "LineSegment(name: \"p\", ends: ((1, 2, 3), (1, 2, 3)))",
        "TriangleMesh(name: \"p\", vertices: [(0, 0, 0)], triangles: [(0, 0, 0)])",
        "TriangleMesh(name: \"p\", vertices: [], triangles: [])",
        "TriangleMesh(name: \"p\", file: \"there/is/none.obj\", scale: 2)",
        "Sphere(name: \"p\", center: (0, 0, 0), radius: 1e-40)",
        "Custom(name: \"p\", kind: \"of the host\")",
    ];
    for shape in shapes {
        let text = model(shape);
        assert!(pong_model::parse(&text, "m.ron", None, &Extensions::new()).is_err(), "{shape}");
        let tree = authored::parse(&text, "m.ron").unwrap_or_else(|errors| panic!("{shape}: {errors}"));
        assert_eq!(field(&tree, "name").value, Value::Text("m".to_owned()));
        let Value::List(primitives) = &field(field(&tree, "root"), "primitives").value else { panic!() };
        assert_eq!(field(&primitives[0], "name").value, Value::Text("p".to_owned()));
    }
}

#[test]
fn what_is_no_matter_of_shape_is_refused_with_its_place() {
    assert_eq!(rules("Sphere(name: \"p\", center: (0, 0, 0), radius: -1)"), [(3, "not-positive")]);
    assert_eq!(rules("Sphere(name: \"p\", center: (0, 0), radius: 1, colour: 2)").len(), 2);
    assert_eq!(rules("Point(name: \"p\", surface: \"ice\", position: (0, 0, 0))"), [(3, "unknown-surface")]);
    let no_vertex = "TriangleMesh(name: \"p\", vertices: [(0, 0, 0), (1, 0, 0), (0, 1, 0)],\ntriangles: [(0, 1, 2), (0, 1, 3)])";
    assert_eq!(rules(no_vertex), [(4, "index-out-of-range")]);
    let no_face =
        "Polyhedron(name: \"p\", vertices: [(0, 0, 0)], faces: [[0, 0, 0], [0, 0, 9]], inactive_faces: [7])";
    assert_eq!(rules(no_face), [(3, "index-out-of-range"), (3, "index-out-of-range")]);
    assert_eq!(rules("Point(name: \"p\" position)"), [(3, "syntax")]);
}

fn cube(change: impl Fn(usize, Vec3) -> Vec3) -> Vec<Vec3> {
    CUBE.iter().enumerate().map(|(index, &vertex)| change(index, Vec3::from(vertex))).collect()
}

fn faces() -> Vec<&'static [u32]> {
    FACES.iter().map(|face| &face[..]).collect()
}

#[test]
fn faults_of_a_polyhedron_name_face_place_and_distance() {
    assert_eq!(check_polyhedron(&cube(|_, v| v), &faces(), &[3]), []);
    // One corner is lifted out of the upper face: 0.75 of its height is the distance to the plane through the
    // mean.
    let lift = |index, v: Vec3| if index == 6 { v + Vec3::new(0.0, 0.0, 0.01) } else { v };
    let lifted = check_polyhedron(&cube(lift), &faces(), &[]);
    assert_eq!(
        lifted.iter().map(|fault| (fault.rule, fault.face)).collect::<Vec<_>>(),
        [("face-not-planar", Some(1))]
    );
    assert!((lifted[0].off - 0.0025).abs() < 1e-6, "{:?}", lifted[0]);
    // A face is missing: each of its four neighbours has an open edge, whose ends are reported.
    let open = check_polyhedron(&cube(|_, v| v), &faces()[1..], &[]);
    assert_eq!(open.iter().map(|fault| fault.face).collect::<Vec<_>>(), [Some(1), Some(2), Some(3), Some(4)]);
    assert!(
        open.iter().all(|fault| fault.rule == "open-polyhedron" && fault.places.iter().all(|p| p.z == 0.0))
    );
    assert!(open.iter().all(|fault| fault.places.len() == 2));
}

fn square(z: f64) -> [[Vec3; 3]; 2] {
    let at = |x, y| Vec3::new(x, y, z);
    [[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
}

fn told(corners: &[[Vec3; 3]]) -> Vec<(bool, &'static str, Vec<u32>)> {
    check_triangles(corners).into_iter().map(|fault| (fault.is_error, fault.rule, fault.triangles)).collect()
}

#[test]
fn faults_of_triangles_name_all_that_are_concerned() {
    let [a, b] = square(0.0);
    assert_eq!(told(&[a, b]), []);
    let far = square(5.0);
    let turned = [b[1], b[2], b[0]];
    assert_eq!(told(&[far[0], a, b, turned]).first(), Some(&(true, "duplicate-triangle", vec![3])));
    assert_eq!(told(&[a, [b[0], b[2], b[1]]]), [(false, "winding", vec![0, 1])]);
    let wall = [a[0], a[2], Vec3::new(0.5, 0.5, 1.0)];
    assert_eq!(told(&[far[0], a, b, wall]), [(false, "crowded-edge", vec![1, 2, 3])]);
    let (middle, below) = (Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.5, -1.0, 0.0));
    let cut = [[a[0], below, middle], [middle, below, a[1]]];
    assert_eq!(told(&[a, b, cut[0], cut[1]]), [(false, "t-junction", vec![0])]);
    let sliver = [a[0], a[1], Vec3::new(0.5, 1e-10, 0.0)];
    assert_eq!(told(&[a, b, sliver, turned]), [(true, "sliver-triangle", vec![2])]);
}
