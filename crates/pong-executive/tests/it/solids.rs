//! Solids that touch by overlapped volume, moved by the executive: rest, stacks, slopes, spin, thin plates.

use pong_engine::{Config, InterfaceId, WorldBuilder};
use pong_executive::{BodyId, Integrator, MassProperties, Pose, Quat, RigidBody, Simulation, Twist, Vec3};
use pong_model::Extensions;
use pong_testkit::Random;
use pong_testkit::long_samples;
use pong_testkit::ron::box_polyhedron;
use std::f64::consts::PI;
use std::sync::Arc;

pub(super) const G: f64 = 9.81;

/// Model of one solid with the given primitives.
pub(super) fn solid(surface: &str, primitives: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "solid", surfaces: {{ "s": ({surface}) }},
            root: (name: "solid", surface: "s", contact: Solid, primitives: [{primitives}]))"#
    )
}

/// Box of half extents around the origin.
pub(super) fn block(surface: &str, half: [f64; 3]) -> String {
    solid(surface, &box_polyhedron("box", [0.0; 3], half, ""))
}

/// Regular prism around z.
pub(super) fn prism(surface: &str, sides: usize, radius: f64, half: f64) -> String {
    let corner = |index: usize, z: f64| {
        let (sine, cosine) = (2.0 * PI * index as f64 / sides as f64).sin_cos();
        format!("({:?}, {:?}, {z:?})", radius * cosine, radius * sine)
    };
    let vertices: Vec<String> =
        (0..2 * sides).map(|index| corner(index % sides, if index < sides { -half } else { half })).collect();
    let mut faces = vec![
        (0..sides).rev().map(|index| index.to_string()).collect::<Vec<_>>().join(","),
        (sides..2 * sides).map(|index| index.to_string()).collect::<Vec<_>>().join(","),
    ];
    for index in 0..sides {
        let next = (index + 1) % sides;
        faces.push(format!("{index},{next},{},{}", next + sides, index + sides));
    }
    let faces: Vec<String> = faces.iter().map(|face| format!("[{face}]")).collect();
    solid(
        surface,
        &format!(
            "Polyhedron(name: \"prism\", vertices: [{}], faces: [{}])",
            vertices.join(", "),
            faces.join(", ")
        ),
    )
}

/// Plane z = 0 under everything.
pub(super) fn ground(surface: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "ground", surfaces: {{ "s": ({surface}) }},
            root: (name: "ground", surface: "s", primitives: [
                Plane(name: "floor", normal: (0.0, 0.0, 1.0), offset: 0.0)]))"#
    )
}

pub(super) fn rough(modulus: f64, mu: f64) -> String {
    damped(modulus, 300.0, mu)
}

/// Damping c, N·s/m, beside the stiffness of 1e5 N/m; solids scale it by modulus over stiffness.
pub(super) fn damped(modulus: f64, damping: f64, mu: f64) -> String {
    format!(
        "stiffness: 1e5, foundation: {modulus:?}, normal: Linear(damping: {damping:?}), friction: Bristle(mu: {mu:?})"
    )
}

const RIGID: &str = "stiffness: inf";

/// Body of a scene: its model, and its mass and pose if it moves.
pub(super) struct Part {
    pub text: String,
    pub moves: Option<MassProperties>,
    pub pose: Pose,
}

pub(super) fn at(position: [f64; 3]) -> Pose {
    Pose::new(position.into(), [1.0, 0.0, 0.0, 0.0])
}

pub(super) fn fixed(text: String) -> Part {
    Part { text, moves: None, pose: at([0.0; 3]) }
}

pub(super) fn of_block(surface: &str, mass: f64, half: [f64; 3], pose: Pose) -> Part {
    let moves = Some(MassProperties::cuboid(mass, half.map(|h| 2.0 * h)));
    Part { text: block(surface, half), moves, pose }
}

/// Simulation of bodies that all touch each other, under gravity.
pub(super) fn simulate(parts: &[Part], integrator: Integrator, step: f64) -> (Simulation, Vec<BodyId>) {
    let config = Config { accounts: integrator.wrench_coupling(), ..Config::default() };
    let mut builder = WorldBuilder::new(config);
    let mut objects = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let model = pong_model::parse(&part.text, "test.ron", None, &Extensions::new());
        let model = model.unwrap_or_else(|errors| panic!("{errors}\n{}", part.text));
        let model = builder.add_model(Arc::new(model));
        objects.push(builder.create_object(model, &format!("o{index}")).unwrap());
    }
    for (index, a) in objects.iter().enumerate() {
        for (b, part) in objects.iter().zip(parts).skip(index + 1) {
            if parts[index].moves.is_some() || part.moves.is_some() {
                builder.pair(*a, *b).unwrap();
            }
        }
    }
    let roots: Vec<InterfaceId> =
        objects.iter().map(|object| builder.scene().interface(*object, "").unwrap()).collect();
    let (world, _) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    let mut simulation = Simulation::new(world, integrator, step).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let mut bodies = Vec::new();
    for (index, (part, root)) in parts.iter().zip(roots).enumerate() {
        let name = format!("o{index}");
        let body = match &part.moves {
            Some(mass) => RigidBody::free(&name, *mass),
            None => RigidBody::fixed(&name),
        };
        bodies.push(simulation.add_body(body.at(part.pose).touching(root)).unwrap());
    }
    (simulation, bodies)
}

/// A box on a plane sinks by m·g/(K·a), and is at rest.
#[test]
fn box_rests_at_its_weight_over_modulus_and_area() {
    let parts =
        [fixed(ground(RIGID)), of_block(&rough(1e7, 0.5), 2.0, [0.1, 0.05, 0.03], at([0.0, 0.0, 0.03]))];
    let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-4);
    simulation.run_for(1.0).unwrap();
    let sink = 0.03 - simulation.pose(bodies[1]).position.z;
    // Series: the rim of width δ of the box's own field is shallower.
    let expected = 2.0 * G / (1e7 * 0.2 * 0.1);
    println!("sink {sink:e}, expected {expected:e}, {:?}", simulation.twist(bodies[1]));
    assert!((sink / expected - 1.0).abs() < 2e-3, "{sink} for {expected}");
    assert!(simulation.twist(bodies[1]).linear.norm() < 1e-9);
}

/// Stacks of equal boxes set edge on edge, with offsets from nothing to a millimetre, stand.
#[test]
fn equal_boxes_stacked_edge_on_edge_stand() {
    for count in [2, 3, 10] {
        for offset in [0.0, 1e-9, 1e-6, 1e-4, 1e-3] {
            let mut parts = vec![fixed(ground(RIGID))];
            for level in 0..count {
                let aside = if level % 2 == 0 { offset } else { -offset };
                let pose = at([aside, 0.5 * aside, 0.1 + 0.2 * level as f64]);
                parts.push(of_block(&rough(1e7, 0.5), 1.0, [0.1; 3], pose));
            }
            let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 5e-4);
            let time = if count == 10 { 0.5 } else { 1.0 };
            simulation.run_for(time).unwrap();
            let mut worst = 0.0_f64;
            for (body, part) in bodies.iter().zip(&parts).skip(1) {
                let moved = simulation.pose(*body).position - part.pose.position;
                worst = worst.max(moved.xy().norm());
                assert!(moved.z.abs() < 4e-3, "{count} boxes, offset {offset}: {moved:?}");
            }
            let speed = bodies.iter().map(|body| simulation.twist(*body).linear.norm()).fold(0.0, f64::max);
            println!("{count} boxes, offset {offset:e}: drift {worst:.1e} m, speed {speed:.1e} m/s");
            assert!(worst < 1e-3, "{count} boxes, offset {offset}: drift {worst}");
        }
    }
}

/// Random stacks of equal and unequal boxes whose centres of mass are supported: all rest.
#[test]
fn random_stacks_rest() {
    let count = long_samples(40, 400);
    let mut random = Random::new(46, 0, 0);
    let mut fallen = Vec::new();
    for number in 0..count {
        let levels = 2 + random.below(4);
        let mut parts = vec![fixed(ground(RIGID))];
        let (mut height, mut below) = (0.0, [0.1_f64; 2]);
        let equal = random.below(2) == 0;
        for _ in 0..levels {
            let half = if equal { [0.1; 3] } else { [0; 3].map(|_| random.between(0.06, 0.14)) };
            let slack = [0, 1].map(|axis| 0.1 * below[axis].min(half[axis]));
            let place = [0, 1].map(|axis| {
                if random.below(3) == 0 { 0.0 } else { random.between(-slack[axis], slack[axis]) }
            });
            let turn = if random.below(3) == 0 { random.between(-PI, PI) } else { 0.0 };
            let pose = Pose {
                position: Vec3::new(place[0], place[1], height + half[2]),
                orientation: Quat::from_scaled_axis(Vec3::z() * turn),
            };
            let mass = 8.0 * 500.0 * half[0] * half[1] * half[2];
            parts.push(of_block(&damped(3e7, 100.0, 0.5), mass, half, pose));
            height += 2.0 * half[2];
            below = [half[0], half[1]];
        }
        let (mut simulation, bodies) = simulate(&parts, Integrator::SemiImplicitEuler, 5e-4);
        simulation.run_for(2.0).unwrap();
        let stays = bodies.iter().zip(&parts).skip(1).all(|(body, part)| {
            let moved = simulation.pose(*body).position - part.pose.position;
            moved.z.abs() < 5e-3 && moved.xy().norm() < 5e-3
        });
        if !stays {
            for (body, part) in bodies.iter().zip(&parts).skip(1) {
                let moved = simulation.pose(*body).position - part.pose.position;
                println!(
                    "{number}: moved {:.1e} {:.1e} {:.1e}, speed {:.1e}",
                    moved.x,
                    moved.y,
                    moved.z,
                    simulation.twist(*body).linear.norm()
                );
            }
            fallen.push(number);
        }
    }
    println!("{} of {count} stacks rest; not {fallen:?}", count - fallen.len());
    assert!(fallen.len() * 100 <= count, "{fallen:?}");
}

/// On a slope of 0.99·tan μ a box stays, and on one of 1.01·tan μ it slides with g·(sin − μ·cos).
#[test]
fn box_on_a_slope_holds_below_the_friction_angle_and_slides_above() {
    let mu = 0.4_f64;
    for (factor, slides) in [(0.99, false), (1.01, true)] {
        let angle = (factor * mu).atan();
        let down = Quat::from_scaled_axis(Vec3::y() * angle);
        let position = down * Vec3::new(0.0, 0.0, 0.05);
        let mut parts = vec![
            fixed(ground(&rough(1e8, mu))),
            of_block(&rough(1e8, mu), 1.0, [0.1, 0.1, 0.05], Pose { position, orientation: down }),
        ];
        parts[0].pose.orientation = down;
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-4);
        simulation.run_for(0.5).unwrap();
        let earlier = down.inverse() * simulation.twist(bodies[1]).linear;
        let start = down.inverse() * simulation.pose(bodies[1]).position;
        simulation.run_for(1.0).unwrap();
        let end = down.inverse() * simulation.pose(bodies[1]).position;
        let velocity = down.inverse() * simulation.twist(bodies[1]).linear;
        println!("factor {factor}: moved {:?}, velocity {velocity:?}", end - start);
        let acceleration = G * (angle.sin() - mu * angle.cos());
        if slides {
            // The damped rim of the front face adds a thousandth of the friction.
            let error = velocity.x - earlier.x - acceleration;
            assert!(error.abs() < 1e-3 * mu * G, "{velocity:?} {earlier:?} {acceleration}");
        } else {
            assert!((end - start).norm() < 1e-9, "{:?}", end - start);
        }
    }
}

/// A round punch that spins on a plane slows down with 4μg/(3R), the value of a uniform disc.
#[test]
fn spinning_punch_slows_down_as_a_uniform_disc() {
    let (radius, half, mu) = (0.1, 0.05, 0.3);
    let sides = 32;
    let surface = rough(1e8, mu);
    let moves = Some(MassProperties::principal(1.0, [0.01, 0.01, 0.5 * radius * radius]));
    let punch = Part { text: prism(&surface, sides, radius, half), moves, pose: at([0.0, 0.0, half]) };
    let (mut simulation, bodies) = simulate(&[fixed(ground(&surface)), punch], Integrator::RungeKutta4, 1e-4);
    simulation.run_for(0.3).unwrap();
    let pose = simulation.pose(bodies[1]);
    let spin = Twist { linear: Vec3::zeros(), angular: Vec3::new(0.0, 0.0, 10.0) };
    simulation.set_motion(bodies[1], pose, spin).unwrap();
    simulation.run_for(0.02).unwrap();
    let first = simulation.twist(bodies[1]).angular.z;
    simulation.run_for(0.1).unwrap();
    let slope = (simulation.twist(bodies[1]).angular.z - first) / 0.1;
    let expected = -4.0 * mu * G / (3.0 * radius);
    println!("slope {slope}, uniform disc {expected}");
    assert!((slope / expected - 1.0).abs() < 0.01, "{slope} for {expected}");
}

/// A block that hits a plate of 1 mm with 20 m/s goes in much deeper than the plate is thick, and comes back
/// with its energy.
#[test]
fn thin_plate_throws_a_fast_block_back() {
    let surface = "stiffness: 1e5, foundation: 1e9, friction: None";
    let plate = block(surface, [0.5, 0.5, 0.0005]);
    let parts = [fixed(plate), of_block(surface, 1.0, [0.05; 3], at([0.01, 0.02, 0.0515]))];
    let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 1e-5);
    simulation.set_gravity(Vec3::zeros());
    let pose = simulation.pose(bodies[1]);
    let twist = Twist { linear: Vec3::new(0.0, 0.0, -20.0), angular: Vec3::zeros() };
    simulation.set_motion(bodies[1], pose, twist).unwrap();
    let mut lowest = f64::INFINITY;
    for _ in 0..2000 {
        simulation.step().unwrap();
        lowest = lowest.min(simulation.pose(bodies[1]).position.z - 0.05);
    }
    let back = simulation.twist(bodies[1]).linear.z;
    println!("lowest {lowest}, back with {back}");
    assert!(lowest < -0.005, "{lowest}");
    assert!((back / 20.0 - 1.0).abs() < 1e-3, "{back}");
}

/// A box on a slope whose friction is preloaded to hold its weight does not slide to load its bristle.
#[test]
fn preloaded_friction_holds_from_the_first_step() {
    let (mu, modulus, half, mass) = (0.5, 1e7, 0.1, 1.0);
    let angle = 0.2_f64;
    let down = Quat::from_scaled_axis(Vec3::y() * angle);
    let sink = mass * G * angle.cos() / (modulus * 4.0 * half * half);
    let position = down * Vec3::new(0.0, 0.0, half - sink);
    let surface = rough(modulus, mu);
    let mut parts = vec![
        fixed(ground("stiffness: inf")),
        of_block(&surface, mass, [half; 3], Pose { position, orientation: down }),
    ];
    parts[0].pose.orientation = down;
    let drift = |preload: bool| {
        let (mut simulation, bodies) = simulate(&parts, Integrator::RungeKutta4, 2e-4);
        if preload {
            let (pair, _) = simulation.world().scene().pairs().next().expect("one pair");
            let weight = Vec3::new(0.0, 0.0, mass * G);
            let preload = pong_engine::FrictionPreload::Holding(-weight);
            simulation.preload_friction(pair, &preload).unwrap();
        }
        // The box pitches under the moment of the friction, so its lower face is watched.
        let foot = |simulation: &Simulation| {
            let pose = simulation.pose(bodies[1]);
            down.inverse() * (pose.position + pose.orientation * Vec3::new(0.0, 0.0, -half))
        };
        let start = foot(&simulation);
        simulation.run_for(0.3).unwrap();
        (foot(&simulation) - start).x.abs()
    };
    let (without, with) = (drift(false), drift(true));
    println!("moved {with:e} m with preload, {without:e} m without");
    assert!(with < 0.25 * without, "{with} {without}");
}
