//! Distance of two movable groups: closed forms, all pairs of elements one by one, and zero where there is contact.

use crate::common::{Rig, at, box_polyhedron, load, model, plate_mesh, rough};
use pong_engine::{Config, EngineError, GroupDistance, State, World, WorldBuilder};
use pong_geometry::distance::Solid;
use pong_geometry::primitive::Sphere;
use pong_geometry::{Quat, Vec3};
use pong_testkit::{Random, samples};

fn ball(center: [f64; 3], radius: f64) -> String {
    let [x, y, z] = center;
    model(
        "ball",
        &rough(1e4),
        &format!("Sphere(name: \"ball\", center: ({x:?},{y:?},{z:?}), radius: {radius:?})"),
    )
}

fn thing(primitives: &str) -> String {
    model("thing", &rough(1e4), primitives)
}

fn distance(rig: &Rig) -> GroupDistance {
    rig.world.distance(rig.interfaces[0], rig.interfaces[1]).unwrap()
}

fn refusal(world: &World, rig: &Rig) -> String {
    world.distance(rig.interfaces[0], rig.interfaces[1]).unwrap_err().to_string()
}

#[test]
fn a_ball_over_a_floor_is_as_far_as_its_lowest_point_before_any_frame() {
    let floor = "Point(name: \"p\", position: (0,0,0)), Plane(name: \"floor\", normal: (0,0,1), offset: 0.0)";
    let mut rig = Rig::new(&ball([0.5, 0.0, 0.0], 0.1), &thing(floor));
    assert!(refusal(&rig.world, &rig).contains("never set"));
    // Turned by a quarter about z, the ball is at y = 0.5; the floor is raised by 0.25.
    let turn = Quat::from_axis_angle(&Vec3::z_axis(), std::f64::consts::FRAC_PI_2);
    rig.place([at(Vec3::new(1.0, 2.0, 3.0), turn), at(Vec3::new(0.0, 0.0, 0.25), Quat::identity())]);
    let found = distance(&rig);
    assert!((found.distance - 2.65).abs() < 1e-14, "{found:?}");
    let [of_ball, of_floor] = found.nearest.unwrap();
    assert!((of_ball.point - Vec3::new(1.0, 2.5, 2.9)).norm() < 1e-14, "{found:?}");
    assert!((of_floor.point - Vec3::new(1.0, 2.5, 0.25)).norm() < 1e-14, "{found:?}");
    // The point of the floor's group is not tested against planes of its own, but against the ball.
    assert_eq!([of_ball.primitive, of_floor.primitive, of_floor.element], [0, 1, 0]);
    let turned = rig.world.distance(rig.interfaces[1], rig.interfaces[0]).unwrap();
    assert_eq!((turned.distance, turned.nearest), (found.distance, Some([of_floor, of_ball])));
    // A state alone changes it; a frame does not.
    rig.world.set_state(rig.interfaces[0], &at(Vec3::new(1.0, 2.0, 0.3), turn)).unwrap();
    assert_eq!(distance(&rig).distance, 0.0);
    rig.world.step().unwrap();
    assert_eq!((distance(&rig).distance, rig.world.contact_count()), (0.0, 1));
}

#[test]
fn kinds_without_a_test_and_filtered_groups_do_not_count() {
    // Two polyhedra have no test with each other; the ball beside one of them has.
    let cube = |x: f64| box_polyhedron("cube", [x, 0.0, 0.0], [0.5, 0.5, 0.5], "");
    let rig_of = |a: &str, b: &str| {
        let mut rig = Rig::new(&thing(a), &thing(b));
        rig.place_a(Vec3::zeros(), Quat::identity());
        rig
    };
    let found = distance(&rig_of(&cube(0.0), &cube(0.0)));
    assert_eq!(found, GroupDistance { distance: f64::INFINITY, nearest: None });
    let with_ball = format!("{}, Sphere(name: \"s\", center: (3,0,0), radius: 0.25)", cube(0.0));
    let found = distance(&rig_of(&with_ball, &cube(0.0)));
    assert_eq!((found.distance, found.nearest.unwrap().map(|side| side.primitive)), (2.25, [1, 0]));

    let grouped = "(format: \"pong-model\", version: 1, name: \"two\", surfaces: { \"s\": (stiffness: 1e4) },
        root: (name: \"two\", surface: \"s\", groups: [
            (name: \"near\", bound: Above, primitives: [Sphere(name: \"n\", center: (1,0,0), radius: 0.25)]),
            (name: \"far\", bound: Above, primitives: [Sphere(name: \"f\", center: (3,0,0), radius: 0.25)])]))";
    for (filtered, expected) in [(vec![], 0.5), (vec!["near"], 2.5), (vec!["near", "far"], f64::INFINITY)] {
        let mut builder = WorldBuilder::new(Config::default());
        let [a, b] = [grouped, &ball([0.0, 0.0, 0.0], 0.25)].map(|text| load(&mut builder, text));
        let [a, b] = [(a, "a"), (b, "b")].map(|(model, name)| builder.create_object(model, name).unwrap());
        builder.pair(a, b).unwrap();
        filtered.iter().for_each(|group| builder.filter(a, group, b, "").unwrap());
        let ids = [a, b].map(|object| builder.scene().interface(object, "").unwrap());
        let mut world = builder.seal().unwrap().0;
        ids.iter().for_each(|id| world.set_state(*id, &State::identity()).unwrap());
        let found = world.distance(ids[0], ids[1]).unwrap();
        assert_eq!(found.distance, expected, "{filtered:?}");
    }
}

#[test]
fn what_has_no_distance_is_refused_with_its_cause() {
    let bore = "Sphere(name: \"s\", center: (0,0,0), radius: 0.1), \
                Bore(name: \"hole\", ends: ((0,0,-1), (0,0,0)), radii: (0.2, 0.2))";
    let mut rig = Rig::new(&ball([0.0, 0.0, 0.0], 0.1), &thing(bore));
    rig.place_a(Vec3::new(0.0, 0.0, 5.0), Quat::identity());
    let message = refusal(&rig.world, &rig);
    for part in ["`thing/hole`", "`b/thing`", "a Bore", "no convex solid", "filter"] {
        assert!(message.contains(part), "{message}");
    }
    // A polyhedron never touches a bore: the ball beside the bore is what counts.
    let mut rig = Rig::new(&thing(&box_polyhedron("cube", [0.0; 3], [0.5, 0.5, 0.5], "")), &thing(bore));
    rig.place_a(Vec3::new(0.0, 0.0, 5.0), Quat::identity());
    assert!((distance(&rig).distance - 4.4).abs() < 1e-14);

    let [a, b] = rig.interfaces;
    let same = rig.world.distance(a, a).unwrap_err();
    assert!(
        matches!(same, EngineError::BadValue { .. }) && same.to_string().contains("the same movable group")
    );
    let other = Rig::new(&ball([0.0; 3], 0.1), &ball([0.0; 3], 0.1));
    let stranger = other.world.distance(a, b).unwrap_err();
    assert!(matches!(stranger, EngineError::UnknownId { .. }), "{stranger}");
}

#[test]
fn the_nearest_of_ten_thousand_triangles_is_the_nearest_of_all() {
    let wavy = |x: f64, y: f64| Vec3::new(x, y, 0.1 * libm::sin(7.0 * x) * libm::cos(5.0 * y));
    let balls = "Sphere(name: \"s0\", center: (0,0,0), radius: 0.05), Sphere(name: \"s1\", center: (0.4,0.1,0), radius: 0.1), \
                 Point(name: \"p\", position: (0,0,-9))";
    let mut rig = Rig::new(&thing(balls), &thing(&plate_mesh("plate", 71, 2.0, wavy)));
    let centers = [Vec3::zeros(), Vec3::new(0.4, 0.1, 0.0)];
    let mesh = rig.world.scene().model_of(rig.objects[1]).unwrap().bodies[0].triangles.clone();
    assert!(mesh.triangles.len() > 10_000);
    let mut overlaps = 0;
    let count = samples(200);
    for index in 0..count {
        let mut random = Random::new(11, 0, index as u64);
        let (place, turn) = (random.vector(1.5), random.orientation());
        rig.place_a(place, turn);
        let found = distance(&rig);
        let mut expected = f64::INFINITY;
        for (center, radius) in centers.iter().zip([0.05, 0.1]) {
            let ball = Solid::sphere(&Sphere { center: place + turn * center, radius });
            for triangle in 0..mesh.triangles.len() as u32 {
                expected = expected.min(ball.to(&Solid::triangle(mesh.corners(triangle))).distance);
            }
        }
        assert!((found.distance - expected).abs() <= 1e-14, "pose {index}: {found:?}, not {expected}");
        overlaps += usize::from(expected == 0.0);
        let [of_ball, of_mesh] = found.nearest.unwrap();
        if expected > 0.0 {
            assert!(
                ((of_ball.point - of_mesh.point).norm() - expected).abs() <= 1e-14,
                "pose {index}: {found:?}"
            );
            let triangle = Solid::triangle(mesh.corners(of_mesh.element));
            let point = Solid::sphere(&Sphere { center: of_mesh.point, radius: 0.0 });
            assert!(triangle.to(&point).distance <= 1e-14, "pose {index}: {found:?}");
        }
    }
    assert!((1..count).contains(&overlaps), "{overlaps} poses overlap");
}

#[test]
fn the_distance_is_zero_where_and_only_where_there_is_contact() {
    let solids = [
        "Sphere(name: \"s\", center: (0.1,0,0), radius: 0.3)".to_owned(),
        "Capsule(name: \"c\", ends: ((-0.4,0,0), (0.4,0.1,0)), radius: 0.1)".to_owned(),
        "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.5,0.3,0.2))".to_owned(),
        "Point(name: \"p\", position: (0.3,0,0))".to_owned(),
    ];
    let others = [
        box_polyhedron("box", [0.0; 3], [0.5, 0.3, 0.4], ""),
        "Sphere(name: \"s\", center: (0,0,0), radius: 0.5)".to_owned(),
        "Capsule(name: \"c\", ends: ((-0.4,0,0), (0.4,0,0)), radius: 0.2)".to_owned(),
        "Plane(name: \"f\", normal: (0,0,1), offset: 0.2)".to_owned(),
    ];
    let count = samples(2_000);
    for (which, (a, b)) in solids.iter().flat_map(|a| others.iter().map(move |b| (a, b))).enumerate() {
        let mut rig = Rig::new(&thing(a), &thing(b));
        let (mut contacts, mut tested) = (0, true);
        for index in 0..count {
            let mut random = Random::new(12, which as u64, index as u64);
            rig.place_a(random.vector(0.8), random.orientation());
            rig.world.evaluate().unwrap();
            let found = distance(&rig);
            tested = found.nearest.is_some();
            let touches = rig.world.contact_count() > 0;
            contacts += usize::from(touches);
            assert_eq!(found.distance == 0.0, touches, "{a} on {b}, pose {index}: {found:?}");
        }
        assert!(
            !tested || (count / 50..count).contains(&contacts),
            "{a} on {b}: {contacts} of {count} touch"
        );
    }
}
