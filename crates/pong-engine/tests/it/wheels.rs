//! Cylinders on polyhedra, pieces and triangles (docs/theory.md, 2.8): the wrench of a plane on everything that is
//! flat, that of a ball where a wheel rolls over an edge, wrenches as derivatives of the stored energy.

use crate::common::*;
use pong_geometry::{Quat, Vec3, Wrench};
use pong_testkit::{Random, long_samples};

const K: f64 = 1e5;

fn elastic() -> String {
    surface(K, "friction: None")
}

const WHEEL: &str = "Cylinder(name: \"c\", ends: ((0,-0.15,0),(0,0.15,0)), radius: 0.25)";
const PLUG: &str = "Cone(name: \"k\", ends: ((0,-0.15,0),(0,0.15,0)), radii: (0.25,0.18))";

fn wheel() -> String {
    model("wheel", &elastic(), WHEEL)
}

fn on(part: &str, name: &str, parts: &str) -> Rig {
    Rig::new(&model("part", &elastic(), part), &model(name, &elastic(), parts))
}

fn stored(rig: &Rig) -> f64 {
    rig.world.contacts().iter().map(|contact| contact.stored).sum()
}

fn pressed(rig: &mut Rig, position: Vec3, orientation: Quat) -> (Wrench, f64) {
    let object = rig.objects[0];
    rig.world.clear_contact_history(object).unwrap();
    rig.place_a(position, orientation);
    rig.world.evaluate().unwrap();
    (rig.wrench(0), stored(rig))
}

/// Flat ground with its top at z = 0: a box, two and nine pieces of one, and a plate of triangles.
fn flat_grounds() -> Vec<(&'static str, String)> {
    let halves = [
        box_polyhedron("l", [-1.0, 0.0, -0.5], [1.0, 2.0, 0.5], "5"),
        box_polyhedron("r", [1.0, 0.0, -0.5], [1.0, 2.0, 0.5], "4"),
    ];
    vec![
        ("box", box_polyhedron("b", [0.0, 0.0, -0.5], [2.0, 2.0, 0.5], "")),
        ("halves", halves.join(",")),
        ("plate", plate_mesh("m", 16, 4.0, |x, y| Vec3::new(x, y, 0.0))),
        ("skewed plate", plate_mesh("m", 7, 4.0, |x, y| Vec3::new(x + 0.3 * y, y - 0.2 * x, 0.0))),
    ]
}

/// Lying, leaning and standing, wherever the seams are: the wrench is that of a plane.
#[test]
fn flat_ground_of_any_parts_is_a_plane() {
    for (part, radii) in [(WHEEL, [0.25, 0.25]), (PLUG, [0.25, 0.18])] {
        flat_ground_is_a_plane(part, radii);
    }
}

fn flat_ground_is_a_plane(part: &str, radii: [f64; 2]) {
    let mut plane = on(part, "plane", "Plane(name: \"p\", normal: (0,0,1), offset: 0)");
    for (name, parts) in flat_grounds() {
        let mut ground = on(part, name, &parts);
        let mut random = Random(5);
        let mut worst = 0.0_f64;
        for case in 0..300 {
            let spin = Quat::from_scaled_axis(Vec3::y() * random.between(-3.0, 3.0));
            let lean = match case % 4 {
                0 => 0.0,
                1 => random.between(-0.02, 0.02),
                2 => std::f64::consts::FRAC_PI_2 + random.between(-0.01, 0.01),
                _ => random.between(-1.4, 1.4),
            };
            let turn = Quat::from_scaled_axis(Vec3::z() * random.between(-3.0, 3.0))
                * Quat::from_scaled_axis(Vec3::x() * lean)
                * spin;
            let axis = turn * Vec3::y();
            let aside = (1.0 - axis.z * axis.z).max(0.0).sqrt();
            let reach = (radii[0] * aside + 0.15 * axis.z).max(radii[1] * aside - 0.15 * axis.z);
            let (x, y) = match case % 3 {
                0 => (0.0, 0.0),
                1 => (0.25 * axis.x, 0.0),
                _ => (random.between(-0.5, 0.5), random.between(-0.5, 0.5)),
            };
            let position = Vec3::new(x, y, reach - random.between(0.0005, 0.004));
            let (expected, energy) = pressed(&mut plane, position, turn);
            let (found, stored) = pressed(&mut ground, position, turn);
            let force = (found.force - expected.force).norm() / expected.force.norm();
            let moment = (found.moment - expected.moment).norm() / expected.force.norm();
            worst = worst.max(force).max(moment);
            assert!(
                force < 1e-9 && moment < 1e-9 && (stored / energy - 1.0).abs() < 1e-9,
                "{name}, case {case}, lean {lean}: {found:?} {expected:?}"
            );
        }
        println!("{name}: off a plane by at most {worst:.1e} of the force");
    }
}

/// Where a wheel rolls squarely over a ridge, a step and through a valley, it is held as a ball of its radius.
#[test]
fn wheel_that_rolls_over_edges_is_held_as_a_ball() {
    let ball = model("ball", &elastic(), "Sphere(name: \"s\", center: (0,0,0), radius: 0.25)");
    // Triangles between lines across the way, cut at other places than the middle plane of the ball.
    let terrain = |heights: &[(f64, f64)]| {
        let vertices: Vec<String> =
            heights.iter().flat_map(|(x, z)| [-1.0, 1.1].map(|y| format!("({x:?},{y:?},{z:?})"))).collect();
        let strips = (0..heights.len() - 1).map(|i| {
            let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
            format!("({a},{c},{d}),({a},{d},{b})")
        });
        let strips: Vec<String> = strips.collect();
        format!(
            "TriangleMesh(name: \"m\", vertices: [{}], triangles: [{}])",
            vertices.join(","),
            strips.join(",")
        )
    };
    let grounds = [
        ("ridge", terrain(&[(-2.0, -0.5), (0.0, 0.0), (2.0, -0.7)])),
        ("valley", terrain(&[(-2.0, 0.4), (0.0, 0.0), (2.0, 0.3)])),
        ("hill", terrain(&[(-2.0, 0.0), (-0.8, 0.0), (-0.3, 0.12), (0.2, 0.16), (0.9, 0.02), (2.0, 0.0)])),
        ("step of boxes", {
            let low = box_polyhedron("l", [-1.0, 0.0, -0.55], [1.0, 2.0, 0.5], "");
            let high = box_polyhedron("h", [1.0, 0.0, -0.5], [1.0, 2.0, 0.5], "");
            format!("{low},{high}")
        }),
    ];
    for (name, parts) in grounds {
        let ground = model(name, &elastic(), &parts);
        let (mut wheels, mut balls) = (Rig::new(&wheel(), &ground), Rig::new(&ball, &ground));
        let (mut touched, mut worst) = (0, 0.0_f64);
        for step in 0..400 {
            let x = -0.9 + 1.8 * f64::from(step) / 400.0;
            for z in [0.1, 0.16, 0.2, 0.22, 0.245, 0.249, 0.3, 0.36, 0.4] {
                let position = Vec3::new(x, 0.013, z);
                let (expected, _) = pressed(&mut balls, position, Quat::identity());
                // Deeper than that the flat ends may be the shorter way out of a box.
                let depth = expected.force.norm() / K;
                if depth == 0.0 || depth > 0.1 {
                    continue;
                }
                let turn = Quat::from_scaled_axis(Vec3::y() * (7.0 * x));
                let (found, _) = pressed(&mut wheels, position, turn);
                touched += 1;
                let force = found.force - expected.force;
                worst = worst.max(force.norm() / expected.force.norm());
                assert!(
                    force.norm() < 1e-9 * expected.force.norm()
                        && found.moment.norm() < 1e-9 * expected.force.norm(),
                    "{name} at {position}: {found:?} {expected:?}"
                );
            }
        }
        println!("{name}: {touched} contacts, off a ball by at most {worst:.1e}");
        assert!(touched > 200, "{name}: {touched}");
    }
}

/// A drum that stands on the edge of a block or of a sheet, on a narrow block or on a rail, is held along the way up, by no
/// more than its spring and at a place of the ground, wherever its middle is and however it leans.
#[test]
fn a_standing_drum_is_never_pushed_aside() {
    const DEPTH: f64 = 1e-3;
    let grounds = [
        ("block", box_polyhedron("b", [-1.0, 0.0, -0.5], [1.0, 1.0, 0.5], "")),
        ("narrow block", box_polyhedron("b", [0.0, 0.0, -0.5], [0.05, 0.06, 0.5], "")),
        ("rail", box_polyhedron("b", [0.0, 0.0, -0.5], [0.02, 1.0, 0.5], "")),
        (
            "edge of a sheet",
            "TriangleMesh(name: \"m\", vertices: [(-2,-1,0),(0,-1,0),(0,1,0),(-2,1,0)], \
             triangles: [(0,1,2),(0,2,3)])"
                .to_owned(),
        ),
    ];
    for ((name, parts), part) in grounds.iter().flat_map(|ground| [WHEEL, PLUG].map(|part| (ground, part))) {
        let mut rig = on(part, name, parts);
        // The free edge of a sheet holds no drum whose middle has passed it.
        let last = if *name == "edge of a sheet" { -1 } else { 9 };
        for step in -9..=last {
            for lean in [0.0, 1e-9, -1e-9, 1e-5, -1e-5, 1e-3, -1e-3] {
                let turn = Quat::from_axis_angle(&Vec3::x_axis(), std::f64::consts::FRAC_PI_2)
                    * Quat::from_scaled_axis(Vec3::z() * lean);
                let position = Vec3::new(0.02 * f64::from(step) + 0.003, 0.011, 0.15 - DEPTH);
                let (wrench, _) = pressed(&mut rig, position, turn);
                let Wrench { force, moment } = wrench;
                let most = 0.5 * K * (DEPTH + 0.25 * lean.abs());
                let told = format!("{name}, {position:?}, {lean}: {force:?}");
                assert!(force.z > 0.2 * most && force.z < 1.001 * most, "{told}");
                assert!(force.xy().norm() < 0.01 * force.z, "{told}");
                // The load lies on the ground; its line leans a little where the middle is past an edge.
                let lever = position.z * force.xy() / force.z;
                let [x, y] = [-moment.y / force.z - lever.x, moment.x / force.z - lever.y];
                let [x, y] = [x + position.x, y + position.y];
                let (ahead, aside) = match *name {
                    "narrow block" => (0.05, 0.06),
                    "rail" => (0.02, 1.0),
                    _ => (2.0, 1.0),
                };
                let on_edge = 1e-5 + 0.3 * lean.abs();
                assert!(
                    x < if ahead < 1.0 { ahead } else { 0.0 } + on_edge && x > -ahead - on_edge,
                    "{told}"
                );
                assert!(y.abs() < aside + on_edge, "{told}");
            }
        }
    }
}

/// At faces, edges and corners, wherever the energy has a derivative it is the wrench.
#[test]
fn the_wrench_of_a_wheel_is_the_derivative_of_its_energy() {
    const STEP: f64 = 1e-6;
    let ridge = "TriangleMesh(name: \"m\", vertices: [(0,0,0.2),(1,0,-0.1),(0.8,0.9,-0.1),(-0.9,0.6,0),(-0.5,-0.9,0),\
                 (0.7,-0.8,0)], triangles: [(0,1,2),(0,2,3),(0,3,4),(0,4,5),(0,5,1)])";
    let grounds = [
        ("box", box_polyhedron("b", [0.0, 0.0, -0.2], [0.35, 0.3, 0.2], ""), 0.0),
        ("ridge", ridge.to_owned(), 0.1),
    ];
    for ((name, parts, top), part) in
        grounds.iter().flat_map(|ground| [WHEEL, PLUG].map(|part| (ground, part)))
    {
        let mut rig = on(part, name, parts);
        let mut random = Random(41);
        let (mut tested, mut kinks, mut worst) = (0, 0, 0.0_f64);
        let cases = long_samples(400, 4000);
        for case in 0..cases {
            let turn = Quat::from_scaled_axis(random.vector(0.5));
            let direction = random.direction();
            let position = Vec3::new(0.5 * direction.x, 0.5 * direction.y, top + 0.24 + 0.03 * direction.z);
            let (wrench, energy) = pressed(&mut rig, position, turn);
            // Deep discs that two edges share have another derivative (theory, 2.8, limits).
            let shared = rig.world.contacts().len() > 1;
            if energy == 0.0 || shared && rig.world.contacts_iter().any(|contact| contact.depth > 0.05) {
                continue;
            }
            let Wrench { force, moment } = wrench;
            for index in 0..6 {
                let vector = Vec3::ith(index % 3, 1.0);
                let mut at = |step: f64| match index < 3 {
                    true => pressed(&mut rig, position + vector * step, turn).1,
                    false => pressed(&mut rig, position, Quat::from_scaled_axis(vector * step) * turn).1,
                };
                let (wide, narrow) = (
                    (at(-2.0 * STEP) - at(2.0 * STEP)) / (4.0 * STEP),
                    (at(-STEP) - at(STEP)) / (2.0 * STEP),
                );
                let expected = if index < 3 { force[index] } else { moment[index - 3] };
                let scale = force.norm();
                if (wide - narrow).abs() > 1e-5 * scale {
                    kinks += 1;
                    continue;
                }
                tested += 1;
                worst = worst.max((narrow - expected).abs() / scale);
                assert!(
                    (narrow - expected).abs() < 3e-5 * scale,
                    "{name}, case {case}, {index}: {narrow} {expected} at {position} {turn}"
                );
            }
        }
        println!("{name}: {tested} derivatives, worst {worst:.1e} of the force; {kinks} at kinks");
        assert!(2 * tested > 3 * cases && 20 * kinks < tested, "{name}: {tested} {kinks}");
    }
}
