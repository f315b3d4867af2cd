//! Round parts in the engine: springs, ends of contacts and directions against the theory manual (2.8).

use crate::common::*;
use pong_engine::StatusBits;
use pong_geometry::{Quat, Vec3, Wrench};
use pong_testkit::Random;

const K: f64 = 1e4;

fn part(text: &str) -> String {
    model("part", &surface(K, "friction: None"), text)
}

/// Force on A, N, and the ends of the contacts, for a part placed on another.
fn set_down(a: &str, b: &str) -> (Vec3, Vec<u32>) {
    let mut rig = Rig::new(&part(a), &part(b));
    rig.place_a(Vec3::zeros(), Quat::identity());
    rig.world.evaluate().unwrap();
    (rig.wrench(0).force, rig.world.contacts().iter().map(|contact| contact.end).collect())
}

/// Checks a part at this depth with this share of the pair's spring: two equal springs in series.
fn check(a: &str, b: &str, depth: f64, share: f64, ends: &[u32]) {
    let (force, found) = set_down(a, b);
    let expected = 0.5 * K * share * depth;
    assert!((force - Vec3::z() * expected).norm() < 1e-9 * expected, "{a}: {force}");
    assert_eq!(found, ends, "{a}");
}

#[test]
fn parts_on_a_plane_carry_half_a_spring_at_each_place() {
    let floor = "Plane(name: \"p\", normal: (0,0,1), offset: 0)";
    check("Capsule(name: \"c\", ends: ((0,0,0.28),(1,0,0.28)), radius: 0.3)", floor, 0.02, 1.0, &[0, 1]);
    check("Capsule(name: \"c\", ends: ((0,0,0.28),(1,0,0.7)), radius: 0.3)", floor, 0.02, 0.5, &[0]);
    check("Cylinder(name: \"c\", ends: ((0,0,0.28),(1,0,0.28)), radius: 0.3)", floor, 0.02, 1.0, &[0, 1]);
    check("Cylinder(name: \"c\", ends: ((0,0,0.6),(0,0,-0.02)), radius: 0.3)", floor, 0.02, 1.0, &[1, 3]);
    check("Cone(name: \"c\", ends: ((0,0,-0.02),(0,0,1)), radii: (0.3,0.1))", floor, 0.02, 1.0, &[0, 2]);
    check("Cone(name: \"c\", ends: ((0,0,1),(0,0,-0.02)), radii: (0.3,0))", floor, 0.02, 0.5, &[1]);
}

#[test]
fn rays_press_on_round_parts() {
    let ray = "Ray(name: \"r\", origin: (0,0,1), direction: (0,0,-1), length: 0.8)";
    for b in [
        "Sphere(name: \"s\", center: (0,0,-0.08), radius: 0.3)",
        "Ellipsoid(name: \"e\", center: (0,0,0.12), semi_axes: (0.3,0.2,0.1))",
        "Capsule(name: \"c\", ends: ((0.5,0,-0.08),(-0.5,0,-0.08)), radius: 0.3)",
        "Cylinder(name: \"c\", ends: ((0.5,0,-0.08),(-0.5,0,-0.08)), radius: 0.3)",
        "Cone(name: \"c\", ends: ((0,0,0.22),(0,0,-1)), radii: (0.1,0.3))",
    ] {
        check(ray, b, 0.02, 1.0, &[0]);
    }
}

const LONG: &str = "Capsule(name: \"l\", ends: ((-0.9,0,0),(0.9,0.1,0)), radius: 0.1)";
const SHORT: &str = "Capsule(name: \"l\", ends: ((-0.2,0,0),(0.2,0.1,0)), radius: 0.1)";
const RIDGE: &str = "TriangleMesh(name: \"m\", vertices: [(0,0,0.4),(1,0,0),(0.8,0.9,0),(-0.9,0.6,0),(-0.5,-0.9,0),(0.7,-0.8,0)], \
                     triangles: [(0,1,2),(0,2,3),(0,3,4),(0,4,5),(0,5,1)])";

fn solid() -> String {
    box_polyhedron("b", [0.0, 0.0, 0.0], [0.5, 0.4, 0.3], "")
}

/// Random pose of A about a position.
fn random_pose(random: &mut Random, center: Vec3, size: f64, turn: f64) -> (Vec3, Quat) {
    (center + random.vector(size), Quat::from_scaled_axis(random.vector(turn)))
}

impl Rig {
    /// Places A without an earlier pose.
    fn set_down(&mut self, (place, orientation): (Vec3, Quat)) -> Wrench {
        self.world.clear_contact_history(self.objects[0]).unwrap();
        self.place_a(place, orientation);
        self.world.evaluate().unwrap();
        self.wrench(0)
    }
}

/// The wrench is minus the derivative of the stored energy along any motion, for any features in contact.
#[test]
fn the_wrench_of_a_capsule_derives_from_its_energy() {
    const STEP: f64 = 1e-6;
    let solid = solid();
    for (name, capsule, of, center, size, turn) in [
        ("long on box", LONG, &*solid, Vec3::new(0.1, 0.0, 0.38), 0.06, 0.1),
        ("short on box", SHORT, &solid, Vec3::new(0.45, 0.35, 0.38), 0.1, 0.3),
        ("long on ridge", LONG, RIDGE, Vec3::new(0.1, 0.0, 0.43), 0.05, 0.1),
        ("short on ridge", SHORT, RIDGE, Vec3::new(0.4, 0.1, 0.3), 0.1, 0.3),
    ] {
        let mut rig = Rig::new(&part(capsule), &part(of));
        let mut random = Random(5);
        let (mut compared, mut between) = (0, 0);
        for case in 0..2000 {
            let (place, orientation) = random_pose(&mut random, center, size, turn);
            let (velocity, rate) = (random.direction(), random.direction());
            let mut at = |time: f64| {
                let moved = (place + velocity * time, Quat::from_scaled_axis(rate * time) * orientation);
                let wrench = rig.set_down(moved);
                let contacts = rig.world.contacts();
                between += usize::from(contacts.iter().any(|contact| contact.end >= 2));
                (contacts.iter().map(|contact| contact.stored).sum::<f64>(), wrench)
            };
            let ((before, _), (after, _), (middle, wrench)) = (at(-STEP), at(STEP), at(0.0));
            let force = wrench.force.norm();
            // The energy has a kink where another feature becomes the nearest one, and no derivative there.
            let halves = [(after - middle) / STEP, (middle - before) / STEP];
            if force == 0.0 || (halves[0] - halves[1]).abs() > 1e-3 * force {
                continue;
            }
            let power = wrench.force.dot(&velocity) + wrench.moment.dot(&rate);
            let slope = 0.5 * (halves[0] + halves[1]);
            assert!((power + slope).abs() < 1e-6 * force, "{name} {case}: {power} {slope}");
            compared += 1;
        }
        // On a solid the load is between two contacts at the ends of the overlap.
        assert!(compared > 1200 && (of == solid || between > 100), "{name}: {compared} {between}");
    }
}

/// A capsule whose axis is outside a box stores ½k·max δ²/(1 + 4x²) over the places x of the axis, −½…½, δ the radius
/// minus the distance from the box, found by bisection.
#[test]
fn capsules_store_in_a_box_what_its_distance_tells() {
    let solid = solid();
    for capsule in [LONG, SHORT] {
        let mut rig = Rig::new(&part(capsule), &part(&solid));
        let mut random = Random(6);
        let (mut touching, mut outside) = (0, 0);
        for _ in 0..3000 {
            let (place, orientation) = random_pose(&mut random, Vec3::new(0.4, 0.3, 0.35), 0.25, 1.0);
            let half = if capsule == LONG { 0.9 } else { 0.2 };
            let end = |x: f64, y: f64| place + orientation * Vec3::new(x, y, 0.0);
            let ends = [end(-half, 0.0), end(half, 0.1)];
            let distance = |x: f64| {
                let p: Vec3 = ends[0] + (ends[1] - ends[0]) * (x + 0.5);
                (p.abs() - Vec3::new(0.5, 0.4, 0.3)).sup(&Vec3::zeros()).norm()
            };
            let least = |of: &dyn Fn(f64) -> f64| {
                let (mut low, mut high) = (-0.5, 0.5);
                for _ in 0..200 {
                    let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                    if of(a) < of(b) { high = b } else { low = a }
                }
                of(0.5 * (low + high))
            };
            if least(&distance) < 1e-9 {
                continue;
            }
            // Where nothing is stored, the distance shows the way to where something is.
            let ratio = |x: f64| (distance(x) - 0.1).max((distance(x) - 0.1) / (1.0 + 4.0 * x * x).sqrt());
            let expected = 0.25 * K * least(&ratio).min(0.0).powi(2);
            rig.set_down((place, orientation));
            let found = rig.world.contacts().iter().map(|contact| contact.stored).sum::<f64>();
            assert!((found - expected).abs() < 1e-7 * K * 1e-2, "{found} {expected}");
            touching += usize::from(found > 0.0);
            outside += usize::from(found == 0.0);
        }
        assert!(touching > 200 && outside > 200, "{touching} {outside}");
    }
}

/// A capsule that lies with both ends on a face, and that crosses an edge in its middle, carries kδ, a tip half of that.
#[test]
fn a_capsule_that_lies_or_crosses_carries_its_spring_and_a_tip_half_of_it() {
    let solid = solid();
    let plate = plate_mesh("m", 5, 2.0, |x, y| Vec3::new(x, y, 0.3));
    for b in [&*solid, &plate] {
        let at = |ends: &str| format!("Capsule(name: \"c\", ends: ({ends}), radius: 0.1)");
        check(&at("(-0.2,0,0.38),(0.33,0.1,0.38)"), b, 0.02, 1.0, &[0, 1]);
        check(&at("(-0.2,0,0.38),(0.33,0.1,0.6)"), b, 0.02, 0.5, &[0]);
    }
    // Perpendicular to the edge x = 0.5, z = 0.3 along its bisector.
    let depth = 0.02;
    let over = (0.1 - depth) / 2.0_f64.sqrt();
    let across = |sign: f64| format!("({:?},0.03,{:?})", 0.5 + over + 0.7 * sign, 0.3 + over - 0.7 * sign);
    let capsule = format!("Capsule(name: \"c\", ends: ({}, {}), radius: 0.1)", across(-1.0), across(1.0));
    let (force, ends) = set_down(&capsule, &solid);
    let bisector = Vec3::new(1.0, 0.0, 1.0).normalize();
    assert!((force - bisector * (0.5 * K * depth)).norm() < 1e-9 * K, "{force}");
    assert_eq!(ends, [0, 1]);
}

/// A capsule that lies across a box, with both ends past its sides, so deep that its axis is below the face:
/// it is held as on the face, by one piece and by two, and by half as much if a third piece makes the body concave,
/// however rounding decides the boundary cases of the face.
#[test]
fn a_capsule_sunk_in_along_a_face_is_held_as_on_it() {
    let mut random = Random(77);
    for case in 0..200 {
        let (depth, half) = (random.between(0.051, 0.09), random.between(0.6, 1.2));
        let ends = format!("ends: (({half:?},0.05,0),(-{half:?},0.05,0))");
        let capsule = format!("Capsule(name: \"c\", {ends}, radius: 0.05)");
        let piece = |name, z, walls| box_polyhedron(name, [0.0, 0.0, z], [0.5, 0.4, 0.15], walls);
        let two = format!("{}, {}", piece("t", 0.15, "0"), piece("u", -0.15, "1"));
        let foot = box_polyhedron("f", [0.3, 0.0, -0.4], [0.1, 0.1, 0.1], "1");
        let three = format!("{}, {}, {foot}", piece("t", 0.15, "0"), piece("u", -0.15, "1,0"));
        let turn = random.orientation();
        let above = turn * Vec3::new(0.0, 0.0, 0.35 - depth);
        for (b, share) in [(solid(), 1.0), (two, 1.0), (three, 0.5)] {
            let mut rig = Rig::new(&part(&capsule), &part(&b));
            rig.place([at(above, turn), at(Vec3::zeros(), turn)]);
            rig.world.evaluate().unwrap();
            let force = turn.inverse() * rig.wrench(0).force;
            let error = (force - Vec3::z() * (0.5 * K * share * depth)).norm();
            assert!(error < 1e-9 * K, "case {case}, {depth} deep: {force}");
        }
    }
}

/// A capsule that is pushed into a plate past its middle is pushed back to the side from which it came; set down there it
/// leaves by the nearer side.
#[test]
fn a_plate_pushes_a_capsule_back_to_its_side() {
    let plate = box_polyhedron("b", [0.0, 0.0, -0.01], [0.5, 0.4, 0.01], "");
    for tilt in [0.0, 0.01, -0.01] {
        let mut rig = Rig::new(&part(SHORT), &part(&plate));
        let turn = Quat::from_scaled_axis(Vec3::new(0.0, tilt, 0.1));
        for step in 0..40 {
            rig.place_a(Vec3::new(0.02, 0.05, 0.06 - 0.002 * f64::from(step)), turn);
            rig.world.step().unwrap();
        }
        let (deep, force) = (rig.wrench(0).force, 0.5 * K * 0.118);
        assert!((deep - Vec3::z() * force).norm() < 0.01 * force, "{tilt}: {deep}");
        let anew = rig.set_down((Vec3::new(0.02, 0.05, -0.018), turn)).force;
        assert!(anew.z < -0.49 * K * 0.1, "{tilt}: {anew}");
    }
}

/// A plate cut into triangles, and a box cut into pieces, act like the uncut ones.
#[test]
fn cuts_have_no_effect_on_a_capsule() {
    let tilted = Quat::from_scaled_axis(Vec3::new(0.3, -0.2, 0.5));
    let single = |v: Vec3| v.map(|x| f64::from(x as f32));
    let normal = tilted * Vec3::z();
    let plane = format!("Plane(name: \"p\", normal: {}, offset: 0)", place_of(&normal));
    let plate = |rounded: bool| {
        plate_mesh("m", 9, 6.0, |x, y| {
            let place = tilted * Vec3::new(x, y, 0.0);
            if rounded { single(place) } else { place }
        })
    };
    let pieces = [
        box_polyhedron("l", [-0.3, 0.0, 0.0], [0.2, 0.4, 0.3], "5"),
        box_polyhedron("m", [0.1, 0.0, 0.0], [0.2, 0.4, 0.3], "4,5"),
        box_polyhedron("r", [0.4, 0.0, 0.0], [0.1, 0.4, 0.3], "4"),
    ]
    .join(",");
    for (name, bar, whole, cut, center, turn, limit) in [
        ("plate", LONG, plane.clone(), plate(false), normal * 0.09, 0.02, 1e-9),
        ("plate in single precision", LONG, plane, plate(true), normal * 0.09, 0.02, 1e-3),
        ("box", LONG, solid(), pieces, Vec3::new(0.1, 0.05, 0.38), 0.2, 1e-9),
    ] {
        let mut rigs = [whole, cut].map(|b| Rig::new(&part(bar), &part(&b)));
        let mut random = Random(7);
        let mut touching = 0;
        for case in 0..500 {
            let (place, orientation) = random_pose(&mut random, center, 0.02, turn);
            let pose = (place, if name == "box" { orientation } else { tilted * orientation });
            let [whole, cut] = rigs.each_mut().map(|rig| rig.set_down(pose));
            let off = (whole.force - cut.force).norm() + (whole.moment - cut.moment).norm();
            let size = whole.force.norm() + whole.moment.norm();
            assert!(off <= limit * size, "{name} {case}: {off:e} of {size}");
            touching += usize::from(size > 0.0);
        }
        assert!(touching > 300, "{name}: {touching}");
    }
}

/// Across and along prisms of many sides, the force converges with the square of their number to kδ/(1 + 4x²), where the
/// distance δ from the cylinder makes the most of δ²/(1 + 4x²).
#[test]
fn prisms_of_many_sides_come_closer_to_the_cylinder_as_the_square_of_their_number() {
    let prism = |sides: usize| {
        let corners = (0..2 * sides).map(|index| {
            let (sin, cos) = (std::f64::consts::TAU * (index / 2) as f64 / sides as f64).sin_cos();
            place_of(&Vec3::new(0.4 * sin, if index % 2 == 0 { -0.5 } else { 0.5 }, 0.4 * cos))
        });
        let caps = [0, 1].map(|cap| {
            let ring = (0..sides).map(|side| (2 * side + cap).to_string());
            let ring: Vec<String> = if cap == 0 { ring.rev().collect() } else { ring.collect() };
            format!("[{}]", ring.join(","))
        });
        let walls = (0..sides).map(|side| {
            let next = (side + 1) % sides;
            format!("[{},{},{},{}]", 2 * side, 2 * next, 2 * next + 1, 2 * side + 1)
        });
        let faces: Vec<String> = caps.into_iter().chain(walls).collect();
        let corners: Vec<String> = corners.collect();
        format!("Polyhedron(name: \"b\", vertices: [{}], faces: [{}])", corners.join(","), faces.join(","))
    };
    let exact = |(place, orientation): (Vec3, Quat)| {
        let depth = |x: f64| {
            let p = place + orientation * Vec3::new(1.8 * x, 0.1 * x + 0.05, 0.0);
            0.1 - (p.x.hypot(p.z) - 0.4).max(0.0).hypot((p.y.abs() - 0.5).max(0.0))
        };
        let ratio = |x: f64| depth(x) / (1.0 + 4.0 * x * x).sqrt();
        let (mut low, mut high) = (-0.5, 0.5);
        for _ in 0..200 {
            let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if ratio(a) > ratio(b) { high = b } else { low = a }
        }
        let x = 0.5 * (low + high);
        0.5 * K * depth(x) / (1.0 + 4.0 * x * x)
    };
    let mut rigs = [32, 64, 128].map(|sides| Rig::new(&part(LONG), &part(&prism(sides))));
    let mut random = Random(8);
    let (mut worst, mut touching) = ([0.0_f64; 3], 0);
    for _ in 0..200 {
        let pose = random_pose(&mut random, Vec3::new(0.0, 0.0, 0.46), 0.02, 0.15);
        let expected = exact(pose);
        if expected <= 0.0 {
            continue;
        }
        touching += 1;
        for (worst, rig) in worst.iter_mut().zip(&mut rigs) {
            *worst = worst.max((rig.set_down(pose).force.norm() - expected).abs() / K);
        }
    }
    println!("{worst:?}");
    let falls = [worst[0] / worst[1], worst[1] / worst[2]];
    assert!(touching > 100 && falls.iter().all(|fall| (3.0..5.0).contains(fall)), "{worst:?}");
}

/// A capsule thrown through a thin wall is reported, whichever of its points passes through.
#[test]
fn a_capsule_that_went_through_a_wall_is_told() {
    let wall = box_polyhedron("b", [0.0, 0.0, 0.0], [0.5, 0.4, 0.01], "");
    let sheet = plate_mesh("m", 4, 1.0, |x, y| Vec3::new(x, y, 0.0));
    for b in [wall, sheet] {
        for (offset, passes) in [(0.0, true), (0.7, true), (3.0, false)] {
            let mut rig = Rig::new(&part(LONG), &part(&b));
            rig.set_down((Vec3::new(offset, 0.0, 0.5), Quat::identity()));
            rig.world.commit().unwrap();
            rig.place_a(Vec3::new(offset, 0.0, -0.5), Quat::identity());
            let report = rig.world.evaluate().unwrap();
            assert_eq!(report.status.contains(StatusBits::TUNNELLED), passes, "{offset}");
        }
    }
}

/// The unit plate of corners 0 and 1, and the midpoints of its rims with the outward directions.
const PLATE: &str = "vertices: [(0,0,0),(1,0,0),(1,1,0),(0,1,0)], triangles: [(0,1,2),(0,2,3)]";
const RIMS: [([f64; 2], [f64; 2]); 4] = [
    ([1.0, 0.4], [1.0, 0.0]),
    ([0.0, 0.4], [-1.0, 0.0]),
    ([0.3, 1.0], [0.0, 1.0]),
    ([0.3, 0.0], [0.0, -1.0]),
];

fn plate(two_sided: bool) -> String {
    part(&format!("TriangleMesh(name: \"m\", two_sided: {two_sided}, {PLATE})"))
}

/// Force of a plate on a capsule along `axis` whose middle is `apart` from the middle of a rim: the
/// components outward and across.
fn force_beside(plate: &str, axis: &Vec3, rim: ([f64; 2], [f64; 2]), apart: f64, q: &Quat) -> (f64, f64) {
    let ([x, y], [out_x, out_y]) = rim;
    let (middle, out) = (Vec3::new(x, y, 0.0), Vec3::new(out_x, out_y, 0.0));
    let ends = [-axis, *axis].map(|end| format!("({:?},{:?},{:?})", end.x, end.y, end.z)).join(",");
    let capsule = part(&format!("Capsule(name: \"c\", ends: ({ends}), radius: 0.1)"));
    let mut rig = Rig::new(&capsule, plate);
    let place = Vec3::new(0.2, -0.1, 0.3);
    rig.place([at(place + q * (middle + out * apart), *q), at(place, *q)]);
    rig.world.evaluate().unwrap();
    let force = q.inverse() * rig.wrench(0).force;
    (force.dot(&out), (force - out * force.dot(&out)).norm())
}

/// A capsule that stands upright beside a plate, or lies in its plane, is as much in front of it as behind:
/// the rim pushes it straight outward, once, for either order of its ends and any rotation of the scene.
#[test]
fn the_rim_of_a_plate_pushes_what_is_in_its_plane_once() {
    let mut random = Random(77);
    let quarter = |axis: &Vec3| Quat::from_scaled_axis(axis * std::f64::consts::FRAC_PI_2);
    let mut turns = vec![Quat::identity(), quarter(&Vec3::x()), quarter(&Vec3::y())];
    turns.extend((0..6).map(|_| random.rotation()));
    for rim in RIMS {
        let out = Vec3::new(rim.1[0], rim.1[1], 0.0);
        for sign in [1.0, -1.0] {
            for (index, q) in turns.iter().enumerate() {
                // Two equal springs in series; half of one at an end, the whole in the middle.
                let expected = 0.5 * K * 0.02;
                let upright = Vec3::z() * sign;
                let (along, aside) = force_beside(&plate(true), &upright, rim, 0.08, q);
                assert!(
                    (along - expected).abs() < 1e-6 && aside < 1e-6,
                    "{rim:?} turn {index}: {along} {aside}"
                );
                let lying = out * (0.5 * sign);
                let (along, aside) = force_beside(&plate(true), &lying, rim, 0.58, q);
                assert!(
                    (along - 0.5 * expected).abs() < 1e-6 && aside < 1e-6,
                    "{rim:?} turn {index}: {along} {aside}"
                );
            }
            // The same force on a one-sided plate, for centres exactly in its plane (scene not rotated).
            let (along, aside) =
                force_beside(&plate(false), &(Vec3::z() * sign), rim, 0.08, &Quat::identity());
            assert!((along - 0.5 * K * 0.02).abs() < 1e-9 && aside < 1e-9, "{rim:?}: {along} {aside}");
            // No contact pushes into the plate.
            let (along, aside) =
                force_beside(&plate(false), &(Vec3::z() * sign), rim, -0.08, &Quat::identity());
            assert!(along >= 0.0 && aside < 1e-9, "{rim:?}: {along} {aside}");
        }
    }
}

/// A rod that lies on another one is held at both ends of the overlap: turned about the normal by θ it is turned back
/// by ½k_t·(½L)²·θ at each of the two.
#[test]
fn a_rod_that_lies_on_another_resists_turning_about_the_normal() {
    let rubber = surface(K, "friction: Bristle(mu: 1.0, stiffness: 6e3, damping: 0)");
    let rod = "Capsule(name: \"c\", ends: ((-0.4,0,0),(0.4,0,0)), radius: 0.1)";
    let log = "Capsule(name: \"l\", ends: ((-0.9,0,0),(0.9,0,0)), radius: 0.2)";
    let mut rig = Rig::new(&model("rod", &rubber, rod), &model("log", &rubber, log));
    let height = Vec3::z() * 0.28;
    rig.place_a(height, Quat::identity());
    rig.world.step().unwrap();
    let angle = 1e-4;
    rig.place_a(height, Quat::from_scaled_axis(Vec3::z() * angle));
    rig.world.evaluate().unwrap();
    // Two equal bristles in series.
    let expected = -2.0 * 0.5 * 3e3 * 0.4 * 0.4 * angle;
    let found = rig.wrench(0).moment.z;
    assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
}
