//! Tunnelling is reported, and nothing else is. Shots by the ten thousand are in `pong verify --extremes`.

use crate::common::*;
use pong_engine::{Config, StatusBits, has_tester};
use pong_geometry::primitive::PrimitiveKind;
use pong_geometry::{Quat, Vec3};
use pong_testkit::Random;

const POINT: &str = "Point(name: \"p\", position: (0,0,0))";
const BALL: &str = "Sphere(name: \"s\", center: (0,0,0), radius: 0.02)";
const BAR: &str = "LineSegment(name: \"l\", ends: ((0,-0.1,0),(0,0.1,0)))";
const EGG: &str = "Ellipsoid(name: \"e\", center: (0,0,0), semi_axes: (0.02,0.03,0.04))";
const CAPSULE: &str = "Capsule(name: \"c\", ends: ((0,-0.1,0),(0,0.1,0)), radius: 0.02)";
const PIN: &str = "Cylinder(name: \"n\", ends: ((0,-0.05,0),(0,0.05,0)), radius: 0.02)";
const RAY: &str = "Ray(name: \"r\", origin: (0,0,0), direction: (-1,0,0), length: 0.05)";

/// A plate 10 mm thick, its faces normal to x.
fn plate() -> String {
    box_polyhedron("w", [0.0; 3], [0.005, 0.5, 0.5], "")
}

/// A sheet with its front along +x.
fn sheet(rest: &str) -> String {
    plate_mesh("m", 4, 1.0, |x, y| Vec3::new(0.0, x, y))
        .replace("TriangleMesh(", &format!("TriangleMesh({rest}"))
}

fn rig(a: &str, b: &str) -> Rig {
    let steel = surface(1e5, "");
    Rig::new(&model("a", &steel, a), &model("b", &steel, b))
}

/// Places A along x, frame after frame; returns the frames with tunnelling.
fn told(rig: &mut Rig, places: &[f64]) -> Vec<bool> {
    let places = places.iter().map(|x| Vec3::new(*x, 0.03, 0.02));
    told_at(rig, places)
}

fn told_at(rig: &mut Rig, places: impl IntoIterator<Item = Vec3>) -> Vec<bool> {
    let step = |place| {
        rig.place_a(place, Quat::identity());
        let report = rig.world.step().unwrap();
        let told = report.status.contains(StatusBits::TUNNELLED);
        assert_eq!(told, rig.world.tunnelling().is_some());
        assert_eq!(told, !report.status.is_complete());
        told
    };
    places.into_iter().map(step).collect()
}

#[test]
fn everything_that_goes_through_a_plate_is_told_once() {
    for bullet in [POINT, BALL, BAR, EGG, RAY, CAPSULE] {
        for from in [1.0, -1.0] {
            let mut rig = rig(bullet, &plate());
            let places = [0.5, 0.3, -0.3, -0.5].map(|x| x * from);
            assert_eq!(told(&mut rig, &places), [false, false, true, false], "{bullet} from {from}");
        }
    }
}

#[test]
fn it_is_named() {
    let mut rig = rig(
        &format!("{POINT}, {}", POINT.replace("\"p\", position: (0,0,0)", "\"q\", position: (0,2,0)")),
        &plate(),
    );
    told(&mut rig, &[0.3, -0.3]);
    let passage = rig.world.tunnelling().unwrap();
    assert_eq!((passage.interface, passage.through), (rig.interfaces[0], rig.interfaces[1]));
    assert_eq!((passage.primitive, passage.count), (0, 1));
}

#[test]
fn an_evaluation_tells_it_as_well_and_the_same_again() {
    let mut rig = rig(POINT, &plate());
    told(&mut rig, &[0.3]);
    for x in [-0.3, 0.2, -0.3] {
        rig.place_a(Vec3::x() * x, Quat::identity());
        let report = rig.world.evaluate().unwrap();
        assert_eq!(report.status.contains(StatusBits::TUNNELLED), x < 0.0);
    }
}

/// A point pressed slowly through comes out on the far side without a long path in any frame.
#[test]
fn what_is_pressed_slowly_through_is_told_when_it_comes_out() {
    for (bullet, wall) in [
        (POINT, plate()),
        (BALL, plate()),
        (BALL, sheet("")),
        (EGG, sheet("")),
        (BAR, plate()),
        (EGG, plate()),
    ] {
        let mut rig = rig(bullet, &wall);
        let places: Vec<f64> = (0..200).map(|i| 0.1 - 0.001 * f64::from(i)).collect();
        let count = told(&mut rig, &places).into_iter().filter(|told| *told).count();
        assert!((1..=2).contains(&count), "{bullet} through {wall}: {count}");
    }
}

#[test]
fn sheets_are_passed_from_behind_by_right() {
    for bullet in [BALL, EGG, CAPSULE] {
        let mut one = rig(bullet, &sheet(""));
        assert_eq!(told(&mut one, &[-0.3, 0.3, -0.3]), [false, false, true], "{bullet}");
        let mut two = rig(bullet, &sheet("two_sided: true, "));
        assert_eq!(told(&mut two, &[-0.3, 0.3, -0.3]), [false, true, true], "{bullet}");
    }
}

/// Out of a hole, at once or pressed slowly; from behind it may come in.
#[test]
fn the_wall_of_a_hole_is_gone_through_from_within() {
    let bore = "Bore(name: \"b\", ends: ((0,0,-0.25),(0,0,0.25)), radii: (0.12,0.1), thickness: 0.01)";
    for bullet in [POINT, BALL, RAY, BAR, CAPSULE, PIN] {
        let mut rig = rig(bullet, bore);
        let direction = if bullet == RAY { -1.0 } else { 1.0 };
        let places = [0.0, 0.3, 0.0, 0.3, 0.5].map(|x| x * direction);
        assert_eq!(told(&mut rig, &places), [false, true, false, true, false], "{bullet}");
    }
    for bullet in [POINT, BALL] {
        let mut rig = rig(bullet, bore);
        let places: Vec<f64> = (0..200).map(|i| 0.001 * f64::from(i)).collect();
        let count = told(&mut rig, &places).into_iter().filter(|told| *told).count();
        assert_eq!(count, 1, "{bullet}");
    }
}

#[test]
fn what_is_stopped_or_leaves_as_it_came_is_not_told() {
    for (bullet, wall) in
        [(POINT, plate()), (BALL, plate()), (BALL, sheet("")), (BALL, sheet("two_sided: true, "))]
    {
        let mut rig = rig(bullet, &wall);
        // Fast in, faster out; then deep, but still pushed to where it came from.
        let places = [0.3, 0.001, 0.4, 0.3, -0.004, 0.001, 0.5];
        assert_eq!(told(&mut rig, &places), [false; 7], "{bullet} on {wall}");
    }
}

#[test]
fn past_the_edge_over_the_rim_and_round_the_corner_is_not_told() {
    let mut past = rig(POINT, &plate());
    let beside = [0.3, -0.3, 0.3].map(|x| Vec3::new(x, 0.5 + 1e-9, 0.0));
    assert_eq!(told_at(&mut past, beside), [false; 3]);
    // Pressed on the face, then off over its rim.
    let mut slid = rig(POINT, &plate());
    let off = [0.0, 0.3, 0.49, 0.6, 0.9].map(|y| Vec3::new(0.004, y, 0.0));
    assert_eq!(told_at(&mut slid, [Vec3::x()].into_iter().chain(off)), [false; 6]);
    let mut sheet_rim = rig(BALL, &sheet(""));
    let off = [0.0, 0.3, 0.49, 0.6, 0.9].map(|y| Vec3::new(-0.005, y, 0.0));
    assert_eq!(told_at(&mut sheet_rim, [Vec3::x() * 0.03].into_iter().chain(off)), [false; 6]);
}

/// The latch of a docking ring, pressed down the slope of its striker, snaps over the edge to the back.
#[test]
fn from_one_face_of_a_wedge_to_the_other_is_not_told() {
    let wedge = "Polyhedron(name: \"w\", vertices: [(0, 0, -1), (-0.1, 0, -1), (-0.1, -0.1, -1), (0, 0, 1), \
                 (-0.1, 0, 1), (-0.1, -0.1, 1)], \
                 faces: [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]])";
    let mut rig = rig(POINT, wedge);
    let round = [(0.0, -0.02), (-0.010, -0.0098), (-0.010, -0.0001), (-0.010, 0.001)];
    assert_eq!(told_at(&mut rig, round.map(|(x, y)| Vec3::new(x, y, 0.0))), [false; 4]);
}

#[test]
fn balls_and_eggs_are_gone_through_as_well() {
    for (bullet, target) in [
        (POINT, "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)"),
        (BALL, "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)"),
        (POINT, EGG),
    ] {
        let mut rig = rig(bullet, target);
        assert_eq!(
            told_at(&mut rig, [0.3, -0.3].map(|x| Vec3::new(x, 0.01, 0.0))),
            [false, true],
            "{bullet} {target}"
        );
        assert_eq!(told_at(&mut rig, [0.3, -0.3].map(|x| Vec3::new(x, 0.2, 0.0))), [false, false]);
    }
}

/// The pieces of a body are one solid: nothing enters through an internal face.
#[test]
fn pieces_are_one_solid() {
    let pieces = [
        box_polyhedron("near", [0.0, -0.25, 0.0], [0.005, 0.25, 0.5], "3"),
        box_polyhedron("far", [0.0, 0.25, 0.0], [0.005, 0.25, 0.5], "2"),
    ];
    let mut rig = rig(POINT, &pieces.join(","));
    let across = [Vec3::new(0.1, -0.1, 0.0), Vec3::new(-0.1, 0.1, 0.0), Vec3::new(0.002, 0.2, 0.0)];
    assert_eq!(told_at(&mut rig, across), [false, true, false]);
    // Inside, from one piece to the other.
    let mut rig = self::rig(POINT, &pieces.join(","));
    let along = [
        Vec3::new(0.1, -0.1, 0.0),
        Vec3::new(0.004, -0.1, 0.0),
        Vec3::new(0.004, 0.1, 0.0),
        Vec3::new(-0.1, 0.2, 0.0),
    ];
    assert_eq!(told_at(&mut rig, along), [false, false, false, true]);
}

#[test]
fn a_jump_that_is_meant_a_pair_that_is_off_and_a_first_frame_are_not_told() {
    let mut rig = rig(POINT, &plate());
    assert_eq!(told(&mut rig, &[0.3]), [false]);
    rig.world.clear_contact_history(rig.objects[0]).unwrap();
    assert_eq!(told(&mut rig, &[-0.3]), [false]);
    rig.world.set_pair_enabled(rig.pair, false).unwrap();
    assert_eq!(told(&mut rig, &[0.3]), [false]);
    rig.world.set_pair_enabled(rig.pair, true).unwrap();
    assert_eq!(told(&mut rig, &[-0.3, 0.3]), [false, true]);
}

/// A wall that rotates through a point: only the relative motion matters.
#[test]
fn a_wall_that_sweeps_over_a_point_is_told() {
    let steel = surface(1e5, "");
    let mut rig =
        Rig::with_config(Config::default(), &model("a", &steel, POINT), &model("b", &steel, &plate()));
    let point = at(Vec3::new(0.0, 0.3, 0.0), Quat::identity());
    let status = [-0.2, 0.2, 0.3].map(|angle| {
        rig.place([point, at(Vec3::zeros(), Quat::from_scaled_axis(Vec3::z() * angle))]);
        rig.world.step().unwrap().status.contains(StatusBits::TUNNELLED)
    });
    assert_eq!(status, [false, true, false]);
}

/// A path slightly longer than the plate's thickness goes through it.
#[test]
fn a_way_hardly_longer_than_the_plate_is_followed() {
    for bullet in [POINT, BAR, RAY] {
        let mut rig = rig(bullet, &plate());
        assert_eq!(told(&mut rig, &[0.0055, -0.0055]), [false, true], "{bullet}");
    }
}

/// An arm that swings: its origin stays in place, its tip goes through the plate.
#[test]
fn an_arm_that_swings_through_a_plate_is_told() {
    let mut rig = rig("Point(name: \"p\", position: (0,0.6,0))", &plate());
    let status = [-0.2, 0.2, 0.3].map(|angle| {
        rig.place_a(Vec3::new(0.0, -0.4, 0.0), Quat::from_scaled_axis(Vec3::z() * angle));
        rig.world.step().unwrap().status.contains(StatusBits::TUNNELLED)
    });
    assert_eq!(status, [false, true, false]);
}

/// Pressed below the top of a ball, along it and out again, far for one frame: it leaves in the direction of
/// the push.
#[test]
fn what_slides_over_a_ball_is_not_told() {
    let mut rig = rig(POINT, "Sphere(name: \"b\", center: (0,0,0), radius: 0.1)");
    let places = [(-0.055, 0.12), (-0.055, 0.08), (0.055, 0.095), (0.3, 0.095)];
    assert_eq!(told_at(&mut rig, places.map(|(x, y)| Vec3::new(x, y, 0.0))), [false; 4]);
}

/// Deep below both sides of a valley, then deeper below one of them: the contact with the other side has
/// ended, and the ball is farther behind that side than before.
#[test]
fn what_leaves_one_side_of_a_valley_for_the_other_is_not_told() {
    let valley = plate_mesh("m", 4, 1.0, |u, v| Vec3::new(0.3 * u.abs(), u, v))
        .replace("TriangleMesh(", "TriangleMesh(thickness: 0.06, ");
    for (turn, side) in [(0.0, 1.0), (0.7, 1.0), (0.0, -1.0), (0.7, -1.0)] {
        let mut rig = rig(BALL, &valley);
        let turned = Quat::from_axis_angle(&Vec3::z_axis(), turn);
        let pushing = [(-0.005, 0.001), (-0.02, 0.015)].map(|(x, u)| {
            let place = turned * Vec3::new(x, side * u, 0.02);
            rig.place([at(place, Quat::identity()), at(Vec3::zeros(), turned)]);
            let report = rig.world.step().unwrap();
            assert!(!report.status.contains(StatusBits::TUNNELLED), "at {x}, {u}, turned by {turn}");
            report.contacts
        });
        assert_eq!(pushing, [2, 1], "turned by {turn}");
    }
}

/// The faces are 135° apart: no wall. One end of the bar goes from one to the other while the other end
/// crosses an edge.
#[test]
fn a_bar_that_goes_round_the_edge_of_a_wedge_goes_through_nothing() {
    let wedge = "Polyhedron(name: \"w\", vertices: [(0,-0.05,0),(0,0.05,0),(0.03,-0.05,0),(0.03,0.05,0),(0.03,-0.05,-0.03),\
                 (0.03,0.05,-0.03)], faces: [[0,2,3,1],[0,1,5,4],[2,4,5,3],[0,4,2],[1,3,5]])";
    let bar = "LineSegment(name: \"l\", ends: ((0,-0.02,0),(0,0.02,0)))";
    let mut rig = rig(bar, wedge);
    let orientation =
        Quat::from_axis_angle(&Vec3::x_axis(), 0.01) * Quat::from_axis_angle(&Vec3::z_axis(), 0.03);
    for step in 0..60 {
        rig.place_a(Vec3::new(0.0, 0.0, -4e-4 + 2e-5 * f64::from(step)), orientation);
        let report = rig.world.step().unwrap();
        assert!(!report.status.contains(StatusBits::TUNNELLED), "step {step}");
    }
}

/// Bodies of about 0.1 m, one for every kind that is neither a shell nor unbounded.
const PARTS: [&str; 9] = [
    POINT,
    BAR,
    RAY,
    BALL,
    EGG,
    "Capsule(name: \"c\", ends: ((0,-0.1,0),(0,0.1,0.02)), radius: 0.05)",
    "Cylinder(name: \"n\", ends: ((0,-0.1,0),(0,0.1,0.02)), radius: 0.05)",
    "Cone(name: \"k\", ends: ((0,-0.06,0),(0,0.06,0.02)), radii: (0.07,0.03))",
    "Polyhedron(name: \"w\", vertices: [(0.1,0,-0.05),(-0.05,0.08,-0.05),(-0.05,-0.08,-0.05),(0,0,0.1)], \
     faces: [[0,2,1],[0,1,3],[1,2,3],[2,0,3]])",
];

fn kind_of(part: &str) -> PrimitiveKind {
    let is = |kind: &&PrimitiveKind| part.starts_with(&format!("{}(", kind.name()));
    *PrimitiveKind::ALL.iter().find(is).unwrap()
}

/// From any side, in any pose: through the middle, and past it by more than the widths of both.
#[test]
fn shots_through_are_reported_and_shots_past_are_not_for_every_pair_of_solids() {
    let mut random = Random(11);
    for a in PARTS {
        for b in PARTS {
            let kinds = [kind_of(a), kind_of(b)];
            let is_body = !matches!(kinds[1], PrimitiveKind::Point | PrimitiveKind::LineSegment);
            if !has_tester(kinds[0], kinds[1]) || !is_body {
                continue;
            }
            for shot in 0..50 {
                let turns = [0, 1].map(|_| Quat::from_scaled_axis(random.vector(3.0)));
                let way = random.direction();
                let aside = way.cross(&random.direction()).normalize();
                for (offset, goes_through) in [(0.005, true), (0.4, false)] {
                    let mut rig = rig(a, b);
                    let status = [-1.0, 1.0, 2.0].map(|at| {
                        let place = way * at + aside * offset;
                        rig.place([self::at(place, turns[0]), self::at(Vec3::zeros(), turns[1])]);
                        rig.world.step().unwrap().status.contains(StatusBits::TUNNELLED)
                    });
                    assert_eq!(
                        status,
                        [false, goes_through, false],
                        "{kinds:?}, shot {shot}, {offset} m aside"
                    );
                }
            }
        }
    }
}

/// A post between the middle and the end of a bar; a small part beside the centre of a large ball.
#[test]
fn round_solids_between_the_places_of_an_axis_are_reported() {
    let post = "Capsule(name: \"p\", ends: ((0,0,-0.2),(0,0,0.2)), radius: 0.01)";
    let drum = "Cylinder(name: \"p\", ends: ((0,0,-0.2),(0,0,0.2)), radius: 0.01)";
    let bead = "Sphere(name: \"p\", center: (0,0,0), radius: 0.01)";
    let great = "Sphere(name: \"s\", center: (0,0,0), radius: 0.1)";
    for (bullet, target) in [
        (BAR, post),
        (BAR, drum),
        (CAPSULE, post),
        (CAPSULE, drum),
        (great, post),
        (great, drum),
        (great, bead),
    ] {
        let mut rig = rig(bullet, target);
        let beside = [-0.5, 0.5, 0.8].map(|x| Vec3::new(x, 0.05, 0.0));
        assert_eq!(told_at(&mut rig, beside), [false, true, false], "{bullet} {target}");
    }
}

/// Off and on again, off sideways, round it by 1 rad per frame, and straight through.
#[test]
fn touch_on_a_round_solid_is_reported_only_where_it_ends_on_the_far_side() {
    for target in [
        "Capsule(name: \"b\", ends: ((0,0,-0.3),(0,0,0.3)), radius: 0.1)",
        "Cylinder(name: \"b\", ends: ((0,0,-0.3),(0,0,0.3)), radius: 0.1)",
        "Cone(name: \"b\", ends: ((0,0,-0.3),(0,0,0.3)), radii: (0.11,0.09))",
    ] {
        for (bullet, radius) in [(POINT, 0.0), (BALL, 0.02), (BAR, 0.0), (CAPSULE, 0.02)] {
            let (touch, upright) = (0.099 + radius, Quat::from_axis_angle(&Vec3::x_axis(), 1.5));
            let told = |places: &[Vec3]| {
                let mut rig = rig(bullet, target);
                let step = |place: &Vec3| {
                    rig.place_a(*place, upright);
                    let report = rig.world.step().unwrap();
                    (report.status.contains(StatusBits::TUNNELLED), report.contacts > 0)
                };
                places.iter().map(step).collect::<Vec<_>>()
            };
            let x = Vec3::x();
            let off = told(&[x * touch, x * 0.5, x * touch, Vec3::new(touch, 0.5, 0.0)]);
            assert_eq!(
                off,
                [(false, true), (false, false), (false, true), (false, false)],
                "{bullet} {target}"
            );
            let round: Vec<_> =
                (0..12).map(|i| Quat::from_axis_angle(&Vec3::z_axis(), f64::from(i)) * x * touch).collect();
            let round = told(&round);
            assert!(round.iter().all(|told| *told == (false, true)), "{bullet} {target}: {round:?}");
            let through = told(&[x * touch, -x * 0.5, x * 0.5]);
            assert!(
                through == [(false, true), (true, false), (true, false)],
                "{bullet} {target}: {through:?}"
            );
        }
    }
}

/// A box with these half edges as a solid.
fn solid_box(half: [f64; 3]) -> String {
    let text = model("solid", &surface(1e5, ""), &box_polyhedron("b", [0.0; 3], half, ""));
    text.replace("root: (", "root: (contact: Solid, ")
}

fn solids(a: [f64; 3], b: [f64; 3]) -> Rig {
    Rig::new(&solid_box(a), &solid_box(b))
}

#[test]
fn solid_shot_through_a_solid_plate_is_reported_once() {
    for from in [1.0, -1.0] {
        let mut rig = solids([0.02, 0.03, 0.05], [0.005, 0.5, 0.5]);
        let places = [0.5, 0.3, -0.3, -0.5].map(|x| x * from);
        assert_eq!(told(&mut rig, &places), [false, false, true, false], "from {from}");
        let mut plate_first = solids([0.005, 0.5, 0.5], [0.02, 0.03, 0.05]);
        assert_eq!(told(&mut plate_first, &places), [false, false, true, false], "plate from {from}");
    }
}

/// A slow solid that enters the plate is pushed back; one that comes out behind it in a single step has passed.
#[test]
fn solid_that_entered_a_plate_and_comes_out_behind_it_is_reported() {
    let mut rig = solids([0.02; 3], [0.005, 0.5, 0.5]);
    assert_eq!(told(&mut rig, &[0.1, 0.024, 0.0, -0.03]), [false, false, false, true]);
    let mut back = solids([0.02; 3], [0.005, 0.5, 0.5]);
    assert_eq!(told(&mut back, &[0.1, 0.024, 0.0, 0.03]), [false; 4]);
}

#[test]
fn solid_past_the_rim_and_round_the_corner_of_a_solid_is_not_reported() {
    let mut beside = solids([0.02; 3], [0.005, 0.5, 0.5]);
    let places = [0.3, -0.3].map(|x| Vec3::new(x, 0.53, 0.0));
    assert_eq!(told_at(&mut beside, places), [false, false]);
    // From above a cube to beside it, over its edge and through it: the sides are not opposite.
    let mut corner = solids([0.02; 3], [0.1; 3]);
    let places = [Vec3::new(0.08, 0.0, 0.14), Vec3::new(0.14, 0.0, 0.08)];
    assert_eq!(told_at(&mut corner, places), [false, false]);
}

/// Shots at random directions through and past a box, beside a path in small steps. An overlap may be shorter than
/// these steps of 2.5 mm, so the path goes past a box that is as much larger.
#[test]
fn random_shots_of_solids_are_reported_if_they_pass_through() {
    let mut random = Random(0x71);
    let mut through = 0;
    for _ in 0..300 {
        let mut rig = solids([0.03, 0.02, 0.04], [0.1, 0.05, 0.2]);
        let (direction, aside) = (random.direction(), random.direction() * 0.12);
        let turn = Quat::from_scaled_axis(random.direction() * 2.0);
        let mut at = |along: f64| {
            rig.place_a(aside + direction * along, turn);
            rig.world.step().unwrap()
        };
        at(0.5);
        let reported = at(-0.5).status.contains(StatusBits::TUNNELLED);
        let mut fine = solids([0.03, 0.02, 0.04], [0.1025, 0.0525, 0.2025]);
        let overlaps = (0..400).any(|i| {
            fine.place_a(aside + direction * (0.5 - f64::from(i) / 400.0), turn);
            fine.world.evaluate().unwrap().contacts > 0
        });
        through += usize::from(reported);
        assert!(overlaps || !reported, "reported, but never overlaps");
        let misses = direction.cross(&aside).norm();
        assert!(
            !overlaps || reported || misses > 0.05,
            "went through {misses} m from the middle, not reported"
        );
    }
    assert!(through > 60, "{through}");
}
