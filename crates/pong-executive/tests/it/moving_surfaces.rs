//! Bodies on surfaces that move along themselves, against closed forms.

use pong_engine::{Config, SurfaceMotion};
use pong_executive::{
    BodyId, Integrator, MassProperties, Motion, Path, Pose, RigidBody, Simulation, Twist, Vec3,
};
use pong_testkit::ron::box_polyhedron;
use pong_testkit::worlds::paired_with_first;

const G: f64 = 9.81;
const MU: f64 = 0.5;
const RADIUS: f64 = 0.1;
const MASS: f64 = 2.0;
const STEP: f64 = 2e-4;

const SURFACE: &str = "stiffness: 1e6, foundation: 5e7, normal: Linear(damping: 2000), friction: Bristle(mu: 0.5, damping: 500)";
const BALL: &str = "Sphere(name: \"ball\", center: (0, 0, 0), radius: 0.1)";
const FEET: &str = "Sphere(name: \"a\", center: (0.1, 0.1, 0), radius: 0.1), \
                    Sphere(name: \"b\", center: (-0.1, 0.1, 0), radius: 0.1), \
                    Sphere(name: \"c\", center: (0, -0.1, 0), radius: 0.1)";

fn model(name: &str, contact: &str, primitives: &str) -> String {
    format!(
        r#"(format: "pong-model", version: 1, name: "{name}", surfaces: {{ "s": ({SURFACE}) }},
            root: (name: "{name}", surface: "s"{contact}, primitives: [{primitives}]))"#
    )
}

fn plane() -> String {
    model("plane", "", "Plane(name: \"floor\", normal: (0, 0, 1), offset: 0)")
}

/// Bodies that meet a moving surface on z = 0, in a simulation with energies.
fn on(belt: RigidBody, ground: &str, body: &str, height: f64) -> (Simulation, BodyId) {
    let integrator = Integrator::RungeKutta4;
    let config = Config {
        accounts: integrator.wrench_coupling(),
        ledger: true,
        moving_surfaces: true,
        ..Config::default()
    };
    let (world, _, interfaces) = paired_with_first(config, &[ground, body]);
    let mut simulation = Simulation::new(world, integrator, STEP).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    simulation.add_body(belt.touching(interfaces[0])).unwrap();
    let mass = MassProperties::principal(MASS, [0.4 * MASS * RADIUS * RADIUS; 3]);
    let pose = Pose::new(Vec3::new(0.0, 0.0, height), [1.0, 0.0, 0.0, 0.0]);
    let body = simulation.add_body(RigidBody::free("body", mass).at(pose).touching(interfaces[1])).unwrap();
    (simulation, body)
}

fn belt(linear_velocity: [f64; 3]) -> RigidBody {
    RigidBody::fixed("belt").with_surface(SurfaceMotion { linear_velocity, ..SurfaceMotion::default() })
}

/// Three feet on a belt gain μ·g·t up to the speed of the belt, and then stay with it: no creep.
#[test]
fn a_body_on_a_belt_takes_its_speed() {
    let (mut simulation, body) = on(belt([1.0, 0.0, 0.0]), &plane(), &model("feet", "", FEET), 0.1);
    simulation.run_for(0.1).unwrap();
    let speed = simulation.twist(body).linear.x;
    // The bristle takes its first deflection, and the feet land: the force is not the full one from the start.
    assert!((speed - MU * G * 0.1).abs() < 0.02, "{speed}");
    let before = speed;
    simulation.run_for(0.05).unwrap();
    let gained = simulation.twist(body).linear.x - before;
    assert!((gained / (MU * G * 0.05) - 1.0).abs() < 1e-3, "{gained}");
    simulation.run_for(2.0).unwrap();
    let twist = simulation.twist(body);
    assert!((twist.linear.x - 1.0).abs() < 1e-9 && twist.angular.norm() < 1e-9, "{twist:?}");
    let place = simulation.pose(body).position.x;
    simulation.run_for(1.0).unwrap();
    assert!((simulation.pose(body).position.x - place - 1.0).abs() < 1e-9);
}

/// A ball starts to slide and ends rolling: m·r·v and I·ω of the same impulse, and v + ω·r = u at the end, so that
/// v = u/(1 + m·r²/I) = 2/7·u.
#[test]
fn a_ball_on_a_belt_ends_with_two_sevenths_of_its_speed() {
    let (mut simulation, body) = on(belt([1.0, 0.0, 0.0]), &plane(), &model("ball", "", BALL), 0.1);
    simulation.run_for(1.0).unwrap();
    let twist = simulation.twist(body);
    assert!((twist.linear.x - 2.0 / 7.0).abs() < 1e-4, "{twist:?}");
    // The contact point is half of the depth of two equal springs in series above the lowest point of the ball.
    let radius = RADIUS - 0.5 * MASS * G / 5e5;
    assert!((twist.linear.x - twist.angular.y * radius - 1.0).abs() < 1e-5, "{twist:?}");
}

/// A belt up a slope below tan μ carries a body up at its speed; on a steeper one the body slips down by
/// g·(sin α − μ·cos α).
#[test]
fn a_belt_carries_up_a_slope_below_the_friction_angle() {
    for (tangent, holds) in [(0.4, true), (0.7, false)] {
        let (mut simulation, body) = on(belt([0.3, 0.0, 0.0]), &plane(), &model("feet", "", FEET), 0.1);
        simulation.set_gravity(Vec3::new(-tangent * G, 0.0, -G));
        simulation.run_for(1.5).unwrap();
        let speed = simulation.twist(body).linear.x;
        if holds {
            assert!((speed - 0.3).abs() < 1e-9, "{speed}");
        } else {
            simulation.run_for(0.5).unwrap();
            let gained = simulation.twist(body).linear.x - speed;
            assert!((gained / ((MU - tangent) * G * 0.5) - 1.0).abs() < 1e-3, "{gained}");
        }
    }
}

/// A body that stands on a turntable goes round at its rate, as long as ω²·r is below μ·g.
#[test]
fn a_turntable_takes_a_body_round() {
    let rate = 2.0;
    let surface = SurfaceMotion { angular_velocity: [0.0, 0.0, rate], ..SurfaceMotion::default() };
    let turntable = RigidBody::fixed("turntable").with_surface(surface);
    let (mut simulation, body) = on(turntable, &plane(), &model("feet", "", FEET), 0.1);
    let pose = Pose::new(Vec3::new(0.5, 0.0, 0.1), [1.0, 0.0, 0.0, 0.0]);
    let twist = Twist { linear: Vec3::new(0.0, rate * 0.5, 0.0), angular: Vec3::new(0.0, 0.0, rate) };
    simulation.set_motion(body, pose, twist).unwrap();
    simulation.run_for(3.0).unwrap();
    let (pose, twist) = (simulation.pose(body), simulation.twist(body));
    let radius = pose.position.xy().norm();
    // The bristles stretch until they hold the body on its circle.
    assert!((radius - 0.5).abs() < 2e-3, "{radius}");
    assert!((twist.angular.z - rate).abs() < 1e-3, "{twist:?}");
    let angle = pose.position.y.atan2(pose.position.x);
    let expected =
        (rate * 3.0 + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
    assert!((angle - expected).abs() < 1e-2, "{angle} {expected}");
}

/// Two belts under one body, at opposite speeds and each with half of the weight: the body stays where it is.
#[test]
fn opposite_belts_hold_a_body_in_place() {
    let integrator = Integrator::RungeKutta4;
    let strip = |name: &str, y: f64| {
        let top = box_polyhedron("top", [0.0, y, -0.1], [2.0, 0.2, 0.1], "");
        model(name, "", &top)
    };
    let feet = "Sphere(name: \"a\", center: (0.1, 0.2, 0), radius: 0.1), \
                Sphere(name: \"b\", center: (-0.1, 0.2, 0), radius: 0.1), \
                Sphere(name: \"c\", center: (0.1, -0.2, 0), radius: 0.1), \
                Sphere(name: \"d\", center: (-0.1, -0.2, 0), radius: 0.1)";
    let models = [&model("feet", "", feet), &strip("left", 0.2), &strip("right", -0.2)];
    let (world, _, interfaces) =
        paired_with_first(Config { moving_surfaces: true, ..Config::default() }, &models.map(String::as_str));
    let mut simulation = Simulation::new(world, integrator, STEP).unwrap();
    simulation.set_gravity(Vec3::new(0.0, 0.0, -G));
    let mass = MassProperties::principal(MASS, [0.1; 3]);
    let pose = Pose::new(Vec3::new(0.0, 0.0, 0.1), [1.0, 0.0, 0.0, 0.0]);
    let body = simulation.add_body(RigidBody::free("body", mass).at(pose).touching(interfaces[0])).unwrap();
    simulation.add_body(belt([1.0, 0.0, 0.0]).touching(interfaces[1])).unwrap();
    simulation.add_body(belt([-1.0, 0.0, 0.0]).touching(interfaces[2])).unwrap();
    simulation.run_for(0.05).unwrap();
    let (pose, twist) = (simulation.pose(body), simulation.twist(body));
    assert!(pose.position.x.abs() < 1e-9 && pose.position.y.abs() < 1e-4, "{pose:?}");
    // The couple of the two friction forces, μ·m·g·0.2 m, turns it.
    assert!(twist.angular.z < -0.3 && twist.linear.x.abs() < 1e-9, "{twist:?}");
}

/// A belt that moves along with its group: velocities of the group and of the belt add.
#[test]
fn a_belt_moves_with_its_group() {
    let path = Path::ConstantTwist {
        pose: Pose::identity(),
        twist: Twist { linear: Vec3::new(0.4, 0.0, 0.0), angular: Vec3::zeros() },
    };
    let carriage = RigidBody { motion: Motion::Prescribed(path), ..belt([0.6, 0.0, 0.0]) };
    let (mut simulation, body) = on(carriage, &plane(), &model("feet", "", FEET), 0.1);
    simulation.run_for(1.5).unwrap();
    assert!((simulation.twist(body).linear.x - 1.0).abs() < 1e-9, "{:?}", simulation.twist(body));
}

/// Solids: a box on a slab with a belt takes its speed, without creep.
#[test]
fn a_solid_on_a_belt_takes_its_speed() {
    let solid = ", contact: Solid";
    let slab = model("slab", solid, &box_polyhedron("slab", [0.0, 0.0, -0.1], [4.0, 1.0, 0.1], ""));
    let body = model("box", solid, &box_polyhedron("box", [0.0; 3], [0.1; 3], ""));
    let (mut simulation, body) = on(belt([0.5, 0.0, 0.0]), &slab, &body, 0.1);
    simulation.run_for(1.0).unwrap();
    let twist = simulation.twist(body);
    assert!((twist.linear.x - 0.5).abs() < 1e-9, "{twist:?}");
}

/// Power balance of a body that slips on a belt: the drive gives F·u, the body gets F·v, friction takes the rest.
#[test]
fn the_drive_gives_the_force_times_the_speed_of_the_belt() {
    let (mut simulation, body) = on(belt([2.0, 0.0, 0.0]), &plane(), &model("feet", "", FEET), 0.1);
    simulation.run_for(0.1).unwrap();
    let (before, v0) = (simulation.world().ledger().driven(), simulation.twist(body).linear.x);
    simulation.run_for(0.2).unwrap();
    let (after, v1) = (simulation.world().ledger().driven(), simulation.twist(body).linear.x);
    let expected = MASS * (v1 - v0) * 2.0;
    assert!(((after - before) / expected - 1.0).abs() < 1e-6, "{} {expected}", after - before);
    assert!(simulation.world().pair_accounts().all(|pair| !pair.gains_energy()));
}
