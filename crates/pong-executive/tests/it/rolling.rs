//! Cylinders that roll, against closed forms: a wheel over seams, a coin on its rim, a drum on rollers, logs on logs, the
//! rollers of a bearing.

use pong_engine::{Config, InterfaceId, State, World, WorldBuilder};
use pong_executive::{BodyId, Integrator, MassProperties, Pose, RigidBody, Simulation, Twist, Vec3};
use pong_model::Extensions;
use pong_testkit::ron::{box_polyhedron, model, plate_mesh, surface};
use pong_testkit::worlds::paired_with_first;
use std::f64::consts::{FRAC_PI_6, TAU};
use std::sync::Arc;

const G: f64 = 9.81;

/// Integrator and step, s.
pub type Host = (Integrator, f64);

/// Classical Runge–Kutta steps, s.
fn steps(step: f64) -> Host {
    (Integrator::RungeKutta4, step)
}

/// A cylinder as `body` on a fixed `ground`; both surfaces have twice the stiffness of the pair, N/m.
pub fn on_ground(
    cylinder: &str,
    ground: &str,
    stiffness: f64,
    friction: &str,
    body: RigidBody,
    (integrator, step): Host,
) -> (Simulation, BodyId) {
    let surface = surface(2.0 * stiffness, &format!("normal: Linear(damping: 0.0), friction: {friction}"));
    let models = [model("body", &surface, cylinder), model("ground", &surface, ground)];
    let (world, _, interfaces) = paired_with_first(Config::default(), &[&models[0], &models[1]]);
    let mut simulation = Simulation::new(world, integrator, step).unwrap();
    let body = simulation.add_body(body.touching(interfaces[0])).unwrap();
    simulation.add_body(RigidBody::fixed("ground").touching(interfaces[1])).unwrap();
    (simulation, body)
}

/// A wheel that rolls down a slope has two thirds of the acceleration of a slide, on a plane as over seams of boxes and over
/// triangles, and neither rises nor sinks on its way.
#[test]
fn a_wheel_rolls_down_a_slope_of_any_parts() {
    const K: f64 = 1e6;
    let (mass, radius, half, slope) = (10.0, 0.25, 0.1, 0.1_f64);
    let wheel =
        format!("Cylinder(name: \"w\", ends: ((0,{:?},0),(0,{half:?},0)), radius: {radius:?})", -half);
    // Walls between boxes are inactive.
    let walls = ["5", "4, 5", "4, 5", "4, 5", "4"];
    let boxes: Vec<String> = (0..5)
        .map(|i| {
            let middle = [-0.4 + 0.8 * i as f64, 0.0, -0.5];
            box_polyhedron(&format!("b{i}"), middle, [0.4, 1.0, 0.5], walls[i])
        })
        .collect();
    let grounds = [
        ("plane", "Plane(name: \"p\", normal: (0,0,1), offset: 0)".to_owned()),
        ("boxes", boxes.join(",")),
        ("triangles", plate_mesh("m", 24, 7.0, |x, y| Vec3::new(x, y, 0.0))),
    ];
    let across = mass * (3.0 * radius * radius + 4.0 * half * half) / 12.0;
    let moments = [across, 0.5 * mass * radius * radius, across];
    let mut on_plane = None;
    for (name, ground) in grounds {
        let height = radius - mass * G * slope.cos() / K;
        let body = RigidBody::free("wheel", MassProperties::principal(mass, moments))
            .at(Pose::new(Vec3::new(0.0, 0.0, height), [1.0, 0.0, 0.0, 0.0]));
        let friction = "Bristle(mu: 0.8, stiffness: 1e6, damping: 2e3)";
        let (mut simulation, wheel) = on_ground(&wheel, &ground, K, friction, body, steps(5e-4));
        simulation.set_gravity(Vec3::new(G * slope.sin(), 0.0, -G * slope.cos()));
        let mut bump = 0.0_f64;
        for _ in 0..4_000 {
            simulation.step().unwrap();
            bump = bump.max((simulation.pose(wheel).position.z - height).abs());
        }
        let (x, v) = (simulation.pose(wheel).position.x, simulation.twist(wheel).linear.x);
        let expected = 2.0 / 3.0 * G * slope.sin() * 2.0;
        println!("{name}: x {x:.9} v {v:.9} (rolls {expected:.9}), bump {bump:.1e}");
        assert!(
            (v / expected - 1.0).abs() < 1e-3 && bump < 1e-10,
            "{name}: v {v} for {expected}, bump {bump}"
        );
        let (x_plane, v_plane) = *on_plane.get_or_insert((x, v));
        assert!((x - x_plane).abs() < 1e-9 && (v - v_plane).abs() < 1e-9, "{name}: {x} for {x_plane}");
    }
}

/// A thin coin leans by α and rolls on its rim about its centre, which rests: Ω² = 4g/(R·sin α).
#[test]
fn a_coin_rolls_on_its_rim() {
    let (mass, radius, half, lean) = (0.05, 0.05, 1e-6, 0.5_f64);
    let coin = format!("Cylinder(name: \"c\", ends: ((0,0,{:?}),(0,0,{half:?})), radius: {radius:?})", -half);
    let ground = "Plane(name: \"p\", normal: (0,0,1), offset: 0)";
    let moments =
        [0.25 * mass * radius * radius, 0.25 * mass * radius * radius, 0.5 * mass * radius * radius];
    // One disc touches, with half a spring.
    let depth = mass * G / 5e5;
    let height = radius * lean.sin() - depth;
    let around = (4.0 * G / (radius * lean.sin())).sqrt();
    // The angular velocity is along the diameter through the contact.
    let angular = Vec3::new(-lean.cos(), 0.0, lean.sin()) * (around * lean.sin());
    let pose = Pose::new(Vec3::new(0.0, 0.0, height), [(0.5 * lean).cos(), 0.0, (0.5 * lean).sin(), 0.0]);
    let body = RigidBody::free("coin", MassProperties::principal(mass, moments)).at(pose);
    let body = body.moving(Twist { linear: Vec3::zeros(), angular });
    let (mut simulation, coin) =
        on_ground(&coin, ground, 1e6, "Bristle(mu: 0.5, damping: 5.0)", body, steps(1e-5));
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let (mut wandered, mut leaned) = (0.0_f64, 0.0_f64);
    let turn = TAU / around;
    while simulation.time() < turn {
        simulation.step().unwrap();
        let pose = simulation.pose(coin);
        wandered = wandered.max((pose.position - Vec3::new(0.0, 0.0, height)).norm());
        leaned = leaned.max(((pose.orientation * Vec3::z()).z.acos() - lean).abs());
    }
    let axis = simulation.pose(coin).orientation * Vec3::z();
    let turned = axis.y.atan2(axis.x);
    println!("wandered {wandered:.1e} m, lean off {leaned:.1e} rad, after a turn {turned:.1e} rad");
    assert!(wandered < 1e-3 * radius && leaned < 2e-3 && turned.abs() < 0.02);
}

/// A drum that stands over the rim of a plate of triangles, seen 20 times a second: it stays as it is if its middle is over
/// the plate, and falls if it is past the rim.
#[test]
fn a_drum_stands_over_the_rim_of_a_plate() {
    const K: f64 = 4e3;
    let (mass, radius, half) = (10.0, 0.3, 0.15);
    let drum = format!("Cylinder(name: \"d\", ends: ((0,0,{:?}),(0,0,{half:?})), radius: {radius:?})", -half);
    let plate = plate_mesh("p", 3, 2.0, |x, y| Vec3::new(x, y, 0.0));
    let across = mass * (3.0 * radius * radius + 4.0 * half * half) / 12.0;
    let height = half - mass * G / K;
    for (x, y) in [(0.95, 0.1), (-0.99, 0.2), (0.9, -0.95), (1.02, 0.1), (0.1, -1.05)] {
        let start = Vec3::new(x, y, height);
        let moments = [across, across, 0.5 * mass * radius * radius];
        let body = RigidBody::free("drum", MassProperties::principal(mass, moments))
            .at(Pose::new(start, [1.0, 0.0, 0.0, 0.0]));
        let (mut simulation, drum) = on_ground(&drum, &plate, K, "None", body, steps(0.05));
        simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
        let mut moved = 0.0_f64;
        for _ in 0..60 {
            simulation.step().unwrap();
            moved = moved.max((simulation.pose(drum).position - start).norm());
        }
        println!("{x} {y}: moved {moved:.1e} m");
        match x.abs().max(y.abs()) < 1.0 {
            true => assert!(moved < 1e-9, "{x} {y}: moved {moved:e}"),
            false => assert!(simulation.pose(drum).position.z < -1.0, "{x} {y}: moved {moved:e}"),
        }
    }
}

/// A cylinder around y, or around x, of the given half length and radius, m.
fn log(name: &str, axis: &str, half: f64, radius: f64) -> String {
    let end = |at: f64| if axis == "y" { format!("(0,{at:?},0)") } else { format!("({at:?},0,0)") };
    format!("Cylinder(name: \"{name}\", ends: ({},{}), radius: {radius:?})", end(-half), end(half))
}

/// A drum of radius R in the groove between two rollers of radius r, their axes 2a apart: each carries W/(2 cos β) with
/// sin β = a/(R + r), and yields by this load over the stiffness.
#[test]
fn a_drum_rests_on_two_rollers() {
    const K: f64 = 1e6;
    let (mass, radius, roller, apart) = (20.0, 0.2, 0.1, 0.18_f64);
    let rollers = [-apart, apart].map(|x| {
        format!("Cylinder(name: \"r{x:?}\", ends: (({x:?},-0.5,0),({x:?},0.5,0)), radius: {roller:?})")
    });
    let beta = (apart / (radius + roller)).asin();
    let load = mass * G / (2.0 * beta.cos());
    // Both yield along the line of centres, which turns with the sag.
    let distance = radius + roller - load / K;
    let height = (distance * distance - apart * apart).sqrt();
    let inertia = 0.5 * mass * radius * radius;
    let body = RigidBody::free("drum", MassProperties::principal(mass, [inertia, inertia, inertia]))
        .at(Pose::new(Vec3::new(0.0, 0.0, height), [1.0, 0.0, 0.0, 0.0]));
    let friction = "Bristle(mu: 0.3, damping: 2e3)";
    let (mut simulation, drum) =
        on_ground(&log("d", "y", 0.3, radius), &rollers.join(","), K, friction, body, steps(2e-4));
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let mut moved = 0.0_f64;
    for _ in 0..2_000 {
        simulation.step().unwrap();
        moved = moved.max((simulation.pose(drum).position - Vec3::new(0.0, 0.0, height)).norm());
    }
    // The closed form takes the load for the groove that is not pressed.
    println!("sag {:.3e} m, moved {moved:.1e} m", load / K);
    assert!(moved < 2e-3 * load / K);
}

/// A log lies across a fixed one and rocks on it without slipping, as a plank of half the thickness h on a cylinder of radius
/// R: ω² = m·g·(R − h)/(I + m·h²).
#[test]
fn a_log_rocks_across_another() {
    let (mass, radius, half, below) = (8.0, 0.1, 0.5, 0.2);
    let across = mass * (3.0 * radius * radius + 4.0 * half * half) / 12.0;
    let moments = [0.5 * mass * radius * radius, across, across];
    let tilt = 0.01_f64;
    // Rolled over the log below by the tilt: its contact is on this log, and moves along its own side.
    let contact = Vec3::new(below * tilt.sin(), 0.0, below * tilt.cos());
    let (up, along) = (Vec3::new(tilt.sin(), 0.0, tilt.cos()), Vec3::new(tilt.cos(), 0.0, -tilt.sin()));
    let position = contact + up * (radius - mass * G / 1e7) - along * (below * tilt);
    let pose = Pose::new(position, [(0.5 * tilt).cos(), 0.0, (0.5 * tilt).sin(), 0.0]);
    let body = RigidBody::free("log", MassProperties::principal(mass, moments)).at(pose);
    let friction = "Bristle(mu: 0.9, stiffness: 2e7, damping: 2e3)";
    let ground = log("g", "y", 0.5, below);
    let (mut simulation, upper) =
        on_ground(&log("u", "x", half, radius), &ground, 1e7, friction, body, steps(1e-4));
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let rate = (mass * G * (below - radius) / (across + mass * radius * radius)).sqrt();
    let tilt_of = |simulation: &Simulation| {
        let axis = simulation.pose(upper).orientation * Vec3::x();
        -axis.z
    };
    let mut off = 0.0_f64;
    while simulation.time() < TAU / rate {
        simulation.step().unwrap();
        off = off.max((tilt_of(&simulation) - tilt * (rate * simulation.time()).cos()).abs());
    }
    println!("period {:.3} s, off {:.1e} of the tilt", TAU / rate, off / tilt);
    assert!(off < 0.01 * tilt);
}

/// A log on top of a parallel one that is fixed: without friction it slides off where cos φ = ⅔·cos φ₀, rolling it leaves
/// where cos φ = 4/7·cos φ₀, φ₀ the angle at which it was let go.
#[test]
fn a_log_leaves_a_parallel_one() {
    let (mass, radius, below, start) = (2.0, 0.1, 0.2, 0.2_f64);
    let inertia = 0.5 * mass * radius * radius;
    let ground = log("g", "y", 0.5, below);
    let frictions = [("None", 2.0 / 3.0), ("Bristle(mu: 50.0, stiffness: 1e7, damping: 500.0)", 4.0 / 7.0)];
    for (friction, share) in frictions {
        let distance = radius + below - mass * G * start.cos() / 1e7;
        let pose = Pose::new(Vec3::new(start.sin(), 0.0, start.cos()) * distance, [1.0, 0.0, 0.0, 0.0]);
        let body =
            RigidBody::free("log", MassProperties::principal(mass, [inertia, inertia, inertia])).at(pose);
        let (mut simulation, upper) =
            on_ground(&log("u", "y", 0.4, radius), &ground, 1e7, friction, body, steps(2e-5));
        simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
        let angle = loop {
            simulation.step().unwrap();
            let position = simulation.pose(upper).position;
            if position.norm() > radius + below {
                break position.x.atan2(position.z);
            }
        };
        let expected = (share * start.cos()).acos();
        println!("{friction}: leaves at {angle:.5} rad for {expected:.5}");
        assert!((angle - expected).abs() < 5e-3, "{friction}: {angle} for {expected}");
    }
}

/// Twelve rollers between a shaft and a bore of the same clearance: the shaft is displaced, each roller on its side by half of
/// that towards the bore. The roller in front carries 4/12 of the load (Stribeck), and nothing turns.
#[test]
fn a_bearing_of_twelve_rollers_shares_its_load() {
    const K: f64 = 1e8;
    let (shaft, roller, by) = (0.1, 0.02, 1e-6);
    let cylinder = |half: f64, radius: f64| {
        format!("Cylinder(name: \"c\", ends: ((0,{:?},0),(0,{half:?},0)), radius: {radius:?})", -half)
    };
    let surface = surface(2.0 * K, "friction: None");
    let wall = shaft + 2.0 * roller;
    let bore = format!("Bore(name: \"b\", ends: ((0,-0.05,0),(0,0.05,0)), radii: ({wall:?},{wall:?}))");
    let texts = [
        model("shaft", &surface, &cylinder(0.05, shaft)),
        model("roller", &surface, &cylinder(0.04, roller)),
        model("bore", &surface, &bore),
    ];
    let mut builder = WorldBuilder::new(Config::default());
    let models = texts.map(|text| {
        let model = pong_model::parse(&text, "bearing", None, &Extensions::new());
        builder.add_model(Arc::new(model.unwrap_or_else(|errors| panic!("{errors}\n{text}"))))
    });
    let shaft_object = builder.create_object(models[0], "shaft").unwrap();
    let bore_object = builder.create_object(models[2], "bore").unwrap();
    let mut objects = vec![shaft_object, bore_object];
    let mut on_shaft = Vec::new();
    for i in 0..12 {
        let one = builder.create_object(models[1], &format!("roller_{i}")).unwrap();
        on_shaft.push(builder.pair(shaft_object, one).unwrap());
        builder.pair(one, bore_object).unwrap();
        objects.push(one);
    }
    let ids: Vec<InterfaceId> =
        objects.iter().map(|object| builder.scene().interface(*object, "").unwrap()).collect();
    let (mut world, _) = builder.seal().unwrap_or_else(|error| panic!("{error}"));
    let place = |world: &mut World, id: InterfaceId, position: Vec3| {
        let pose = pong_geometry::Pose { position, orientation: pong_geometry::Quat::identity() };
        world.set_state(id, &State::from_motion(&pose, &pong_geometry::Twist::zero())).unwrap();
    };
    place(&mut world, ids[0], Vec3::x() * by);
    place(&mut world, ids[1], Vec3::zeros());
    for (i, id) in ids[2..].iter().enumerate() {
        let (sine, cosine) = (FRAC_PI_6 * i as f64).sin_cos();
        let out = shaft + roller + 0.5 * by * cosine;
        place(&mut world, *id, Vec3::new(cosine, 0.0, sine) * out);
    }
    world.evaluate().unwrap();
    let all = world.wrench_common(ids[0]).unwrap();
    let load = -all.force.x;
    assert!((load / (K * 0.5 * by * 3.0) - 1.0).abs() < 1e-4, "{load}");
    assert!(all.force.z.abs() < 1e-6 * load && all.moment.norm() < 1e-6 * load);
    let front = -world.pair_wrench(on_shaft[0], ids[0]).unwrap().force.x;
    assert!((front / (4.0 / 12.0 * load) - 1.0).abs() < 1e-4, "{front} of {load}");
    for id in &ids[2..] {
        // Each roller is in balance between shaft and bore.
        assert!(world.wrench_common(*id).unwrap().force.norm() < 1e-4 * load);
    }
}
