//! Scenes of solids with known answers: a corner, a disc and a ring, a peg, an unrolled nut, dominoes.

use super::solids::{G, Part, at, block, damped, fixed, ground, of_block, prism, rough, simulate, solid};
use pong_executive::{BodyId, Integrator, MassProperties, Simulation, Twist, Vec3};
use pong_testkit::ron::place_of;
use std::f64::consts::PI;

/// Surface without friction.
fn smooth(modulus: f64) -> String {
    format!("stiffness: 1e5, foundation: {modulus:?}, normal: Linear(damping: 300.0), friction: None")
}

/// Body that does not move.
pub(super) fn fixed_at(text: String, position: [f64; 3]) -> Part {
    Part { text, moves: None, pose: at(position) }
}

/// Fastest of the bodies, linear m/s plus 0.1 m times angular speed.
fn fastest(simulation: &Simulation, bodies: &[BodyId]) -> f64 {
    let speed = |body: &BodyId| {
        let twist = simulation.twist(*body);
        twist.linear.norm() + 0.1 * twist.angular.norm()
    };
    bodies.iter().map(speed).fold(0.0, f64::max)
}

/// Prism along y over a convex outline in the xz plane, counter-clockwise seen from −y.
pub(super) fn bar_of(name: &str, outline: &[[f64; 2]], half: f64) -> String {
    let count = outline.len();
    let corner = |index: usize| {
        let [x, z] = outline[index % count];
        place_of(&Vec3::new(x, if index < count { -half } else { half }, z))
    };
    let vertices: Vec<String> = (0..2 * count).map(corner).collect();
    let list = |indices: Vec<usize>| {
        format!("[{}]", indices.iter().map(ToString::to_string).collect::<Vec<_>>().join(","))
    };
    let mut faces = vec![list((0..count).collect()), list((count..2 * count).rev().collect())];
    for index in 0..count {
        let next = (index + 1) % count;
        faces.push(list(vec![next, index, index + count, next + count]));
    }
    format!(
        "Polyhedron(name: \"{name}\", vertices: [{}], faces: [{}])",
        vertices.join(", "),
        faces.join(", ")
    )
}

/// A block pressed into the corner of three flush boxes takes the weight's three components on the three
/// walls, and is at rest.
#[test]
fn block_in_a_corner_of_boxes_is_at_rest() {
    for mu in [0.0, 0.5] {
        let surface = if mu > 0.0 { rough(1e7, mu) } else { smooth(1e7) };
        let wall = || block(&surface, [0.3; 3]);
        let parts = [
            fixed_at(wall(), [0.2, 0.2, -0.3]),
            fixed_at(wall(), [-0.3, 0.2, 0.3]),
            fixed_at(wall(), [0.3, -0.3, 0.3]),
            of_block(&surface, 2.0, [0.1; 3], at([0.1; 3])),
        ];
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-4);
        simulation.set_gravity(Vec3::new(-3.0, -2.0, -G));
        simulation.run_for(1.5).unwrap();
        let mut worst = 0.0_f64;
        for _ in 0..1000 {
            simulation.step().unwrap();
            worst = worst.max(fastest(&simulation, &bodies));
        }
        let force = simulation.contact_wrench(bodies[3]).force;
        let walls = [2, 1, 0].map(|wall| -simulation.contact_wrench(bodies[wall]).force);
        println!("mu {mu}: speed {worst:e}, force {force:?}, walls {walls:?}");
        assert!(worst < 1e-8, "{worst}");
        assert!((force - Vec3::new(6.0, 4.0, 2.0 * G)).norm() < 1e-6, "{force:?}");
        if mu == 0.0 {
            // Each wall carries its own component.
            assert!((walls[2].z - 2.0 * G).abs() < 2e-2 * G, "{walls:?}");
            assert!((walls[1].x - 6.0).abs() < 0.1 && (walls[0].y - 4.0).abs() < 0.1, "{walls:?}");
        }
    }
}

/// Time until the speed of a uniform body with dry friction has fallen to a share of the first one, by direct
/// integration over points at the radii `rings` of equal weight. `inertia` is per m, m².
fn time_to_share(mu: f64, inertia: f64, rings: &[f64], [mut v, mut spin]: [f64; 2], share: f64) -> f64 {
    let (start, step, mut time) = (v, 1e-5, 0.0);
    while v > share * start {
        let (mut force, mut moment, mut count) = (0.0, 0.0, 0.0);
        for radius in rings {
            for index in 0..48 {
                let (sine, cosine) = (2.0 * PI * (f64::from(index) + 0.5) / 48.0).sin_cos();
                let (x, y) = (v - spin * radius * sine, spin * radius * cosine);
                let size = x.hypot(y).max(1e-12);
                force += x / size;
                moment += radius * (y * cosine - x * sine) / size;
                count += 1.0;
            }
        }
        v -= mu * G * force / count * step;
        spin -= mu * G * moment / count / inertia * step;
        time += step;
    }
    time
}

/// A disc and a ring that slide at 0.5 m/s and spin at 5 rad/s keep 5 % of their speed for as long as points
/// with dry friction do, within 10 % for the disc, whose limit surface is a sphere, and 5 % for the ring.
#[test]
fn disc_and_ring_that_slide_and_spin_stop_together() {
    let (mu, radius, half) = (0.3, 0.1, 0.02);
    let surface = rough(1e8, mu);
    let disc = prism(&surface, 64, radius, half);
    // Sixteen trapezoids between the radii 0.09 m and 0.1 m, joined by internal faces.
    let mut pieces = Vec::new();
    for index in 0..16 {
        let place = |ray: usize, radius: f64, z: f64| {
            let (sine, cosine) = (2.0 * PI * (ray % 16) as f64 / 16.0).sin_cos();
            place_of(&Vec3::new(radius * cosine, radius * sine, z))
        };
        let corners: Vec<String> = [-half, half]
            .iter()
            .flat_map(|z| {
                [
                    place(index, 0.09, *z),
                    place(index, radius, *z),
                    place(index + 1, radius, *z),
                    place(index + 1, 0.09, *z),
                ]
            })
            .collect();
        pieces.push(format!(
            "Polyhedron(name: \"p{index}\", vertices: [{}], faces: [[3,2,1,0],[4,5,6,7],[0,1,5,4],[1,2,6,5],\
             [2,3,7,6],[3,0,4,7]], inactive_faces: [2, 4])",
            corners.join(", ")
        ));
    }
    let ring = solid(&surface, &pieces.join(", "));
    let discs: Vec<f64> = (0..20).map(|k| radius * ((f64::from(k) + 0.5) / 20.0).sqrt()).collect();
    let cases =
        [("disc", disc, 0.5 * radius * radius, discs, 0.10), ("ring", ring, 9.05e-3, vec![0.095], 0.05)];
    for (name, text, inertia, rings, tolerance) in cases {
        let moves = Some(MassProperties::principal(1.0, [0.01, 0.01, inertia]));
        let body = Part { text, moves, pose: at([0.0, 0.0, half]) };
        let (mut simulation, bodies) =
            simulate(&[fixed(ground(&surface)), body], Integrator::RungeKutta4, 1e-4);
        simulation.run_for(0.2).unwrap();
        let twist = Twist { linear: Vec3::new(0.5, 0.0, 0.0), angular: Vec3::new(0.0, 0.0, 5.0) };
        let pose = simulation.pose(bodies[1]);
        simulation.set_motion(bodies[1], pose, twist).unwrap();
        let start = simulation.time();
        while simulation.twist(bodies[1]).linear.norm() > 0.025 && simulation.time() < start + 1.0 {
            simulation.step().unwrap();
        }
        let time = simulation.time() - start;
        let spin = simulation.twist(bodies[1]).angular.z;
        let exact = time_to_share(mu, inertia, &rings, [0.5, 5.0], 0.05);
        println!("{name}: {time:.4} s, points {exact:.4} s, spin left {spin:.3} rad/s");
        assert!((time / exact - 1.0).abs() < tolerance, "{name}: {time} {exact}");
    }
}

/// Square hole of four fixed boxes with a peg of 0.1 mm clearance on each side.
fn peg_in_a_hole(surface: &str, mass_center: Vec3, low: f64) -> (Simulation, Vec<BodyId>) {
    let (hole, deep) = (0.0201, 0.02);
    let mut parts = Vec::new();
    for (x, y) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let half = if x == 0.0 { [hole, 0.02, deep] } else { [0.02, 0.06, deep] };
        let out = hole + 0.02;
        parts.push(fixed_at(block(surface, half), [x * out, y * out, 0.0]));
    }
    let moves = MassProperties::cuboid(1.0, [0.04, 0.04, 0.2]).with_mass_center(mass_center);
    let peg = block(surface, [0.02, 0.02, 0.1]);
    parts.push(Part { text: peg, moves: Some(moves), pose: at([0.0, 0.0, low]) });
    simulate(&parts, Integrator::RungeKutta4, 5e-5)
}

/// A centred peg falls through the hole without any force.
#[test]
fn centred_peg_falls_freely_through_a_square_hole() {
    let (mut simulation, bodies) = peg_in_a_hole(&rough(1e10, 0.3), Vec3::zeros(), 0.05);
    simulation.run_for(0.1).unwrap();
    let pose = simulation.pose(bodies[4]);
    let fallen = 0.05 - pose.position.z;
    println!("fallen {fallen}, {:?}", simulation.twist(bodies[4]));
    assert!((fallen - 0.5 * G * 0.01).abs() < 1e-9, "{fallen}");
    assert!(pose.position.xy().norm() < 1e-12);
}

/// Three teeth with the slope α of an unrolled thread on three others: the nut holds if tan α is below μ, and
/// otherwise slides down with g·(sin α − μ·cos α); the three teeth share its weight equally.
#[test]
fn unrolled_nut_holds_below_the_friction_angle() {
    let mu = 0.2_f64;
    for (factor, slides) in [(0.97, false), (1.05, true)] {
        let slope = factor * mu;
        let surface = damped(1e9, 100.0, mu);
        // Teeth of the bolt: parallelograms that rise along x, each above the last; the nut's lie on them.
        let teeth = |from: f64, to: f64, lift: f64| -> String {
            let tooth = |index: usize| {
                let z = 0.02 * index as f64 + lift;
                let outline = [
                    [from, z + slope * from],
                    [to, z + slope * to],
                    [to, z + slope * to + 0.008],
                    [from, z + slope * from + 0.008],
                ];
                bar_of(&format!("tooth{index}"), &outline, 0.01)
            };
            solid(&surface, &(0..3).map(tooth).collect::<Vec<_>>().join(", "))
        };
        let moves =
            Some(MassProperties::principal(0.5, [2e-4; 3]).with_mass_center(Vec3::new(0.0, 0.0, 0.033)));
        let parts = [
            fixed(teeth(-0.2, 0.2, 0.0)),
            Part { text: teeth(-0.02, 0.02, 0.008), moves, pose: at([0.0; 3]) },
        ];
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 1e-4);
        simulation.run_for(0.2).unwrap();
        let (start, speed) = (simulation.pose(bodies[1]).position, simulation.twist(bodies[1]).linear.norm());
        simulation.run_for(0.2).unwrap();
        let moved = (simulation.pose(bodies[1]).position - start).norm();
        let gained = (simulation.twist(bodies[1]).linear.norm() - speed) / 0.2;
        let angle = slope.atan();
        let expected = G * (angle.sin() - mu * angle.cos());
        let forces: Vec<f64> = simulation.world().contacts().iter().map(|c| c.normal_force).collect();
        println!("factor {factor}: moved {moved:e}, gained {gained}, expected {expected}, forces {forces:?}");
        if slides {
            assert!((gained - expected).abs() < 0.02 * mu * G, "{gained} {expected}");
        } else {
            assert!(moved < 1e-8, "{moved}");
        }
    }
}

/// A row of dominoes falls to the last one, and no energy comes from nowhere.
#[test]
fn row_of_dominoes_falls() {
    let surface = damped(1e9, 50.0, 0.4);
    let mut parts = vec![fixed(ground(&surface))];
    for index in 0..8 {
        parts.push(of_block(
            &surface,
            0.02,
            [0.004, 0.012, 0.024],
            at([0.025 * f64::from(index), 0.0, 0.024]),
        ));
    }
    let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-5);
    simulation.run_for(0.02).unwrap();
    let pose = simulation.pose(bodies[1]);
    let twist = Twist { linear: Vec3::new(0.12, 0.0, 0.0), angular: Vec3::new(0.0, 5.0, 0.0) };
    simulation.set_motion(bodies[1], pose, twist).unwrap();
    let first = simulation.energy().mechanical();
    let (mut least, mut growth) = (first, 0.0_f64);
    for _ in 0..30_000 {
        simulation.step().unwrap();
        let now = simulation.energy().mechanical();
        growth = growth.max(now - least);
        least = least.min(now);
    }
    let turned: Vec<f64> =
        bodies[1..].iter().map(|body| simulation.pose(*body).orientation.angle()).collect();
    println!("turned {turned:.3?}, energy {first:e} to {least:e}, growth {growth:e}");
    assert!(turned.iter().all(|angle| *angle > 0.8), "{turned:?}");
    assert!(growth < 1e-4 * (first - least), "{growth}");
}
